#include "output_options.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>

#include "gaussmesh/error.h"
#include "validators.h"

namespace gaussmesh::app {
namespace {

/// Keeps what is read from being replaced by what is written. @throws OptionError
void require_other_file(const std::vector<std::string>& inputs, const std::string& output) {
  for (const std::string& input : inputs) {
    std::error_code error;  // of files that are not there
    if (!std::filesystem::is_regular_file(input, error) || !std::filesystem::equivalent(input, output, error)) continue;
    throw OptionError("expected another file to write than '" + input + "', which is read, got '" + output + "'");
  }
}

/// @throws InputError where the folder that the program runs in has been deleted
std::filesystem::path absolute(const std::string& output) {
  std::error_code error;
  std::filesystem::path path = std::filesystem::absolute(output, error);
  if (!error) return path;
  throw InputError(output +
                   ": expected an output file in the working directory, which cannot be found: " + error.message());
}

}  // namespace

std::vector<CLI::Option*> add_format_options(CLI::App& command, WriteOptions& writing) {
  std::vector<std::string> names;
  for (const MeshFormat& format : mesh_formats()) names.emplace_back(format.name);
  return {command
              .add_option("--format", writing.format,
                          "format of all meshes: " + join_names(names, ", ") + " (default: by extension)")
              ->type_name("NAME")
              ->check(one_of(names)),
          command.add_flag_callback(
              "--no-header", [&writing] { writing.msms_header = false; },
              "MSMS files without their three lines of header, for PyGBe and pbj (default: off)")};
}

void require_header_to_leave_out(const std::vector<std::string>& outputs, const WriteOptions& writing) {
  if (writing.msms_header) return;
  const auto is_msms = [&](const std::string& output) { return format_of(output, writing).name == "msms"; };
  if (std::any_of(outputs.begin(), outputs.end(), is_msms)) return;
  throw OptionError("--no-header: expected a mesh to write in the format msms, got " +
                    std::string(format_of(outputs.front(), writing).name) + " for '" + outputs.front() + "'");
}

std::vector<std::string> without_second_names(const std::vector<std::string>& outputs, const WriteOptions& writing) {
  std::vector<std::string> kept;
  for (const std::string& output : outputs) {
    const auto files = files_of(output, writing);
    const auto is_other_name = [&](const std::string& name) {
      return name != output && files.size() > 1 && files_of(name, writing) == files;
    };
    if (std::none_of(kept.begin(), kept.end(), is_other_name)) kept.push_back(output);
  }
  return kept;
}

void require_files(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  if (std::count(inputs.begin(), inputs.end(), "-") > 1)
    throw OptionError("expected '-' for one of the inputs, got it for two: standard input can be read once");
  std::set<std::filesystem::path> seen;
  for (const std::string& output : outputs) {
    if (output.empty()) continue;
    require_other_file(inputs, output);
    std::error_code error;
    std::filesystem::path place = output;
    if (output != "-") place = std::filesystem::weakly_canonical(absolute(output), error);
    if (error) place = output;  // of a pipe of the shell, whose link in /dev/fd leads nowhere
    const bool is_device = std::filesystem::is_character_file(place, error);
    if (!seen.insert(place).second && !is_device)
      throw OptionError("expected each output once, got '" + output + "' again");
    require_writable(output);
  }
}

void require_writable_outputs(const std::vector<std::string>& outputs, const std::string& report,
                              const WriteOptions& writing, const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& output : outputs) {
    for (const std::filesystem::path& file : files_of(output, writing)) files.push_back(file.string());
  }
  files.push_back(report);
  require_files(inputs, files);
}

void print_at_once(std::ostream& out, const std::string& text) {
  out << text << std::flush;
  if (!out && &out == &std::cout) throw InputError("standard output: cannot be written to");
}

bool is_standard_output(const std::string& output) {
  return output == "-" || output == "/dev/stdout" || output == "/dev/fd/1" || output == "/proc/self/fd/1";
}

}  // namespace gaussmesh::app
