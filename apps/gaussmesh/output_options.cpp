#include "output_options.h"

#include <filesystem>
#include <set>

#include "gaussmesh/error.h"
#include "validators.h"

namespace gaussmesh::app {

std::vector<CLI::Option*> add_format_options(CLI::App& command, WriteOptions& writing, bool& no_header) {
  std::vector<std::string> names;
  for (const MeshFormat& format : mesh_formats()) names.emplace_back(format.name);
  return {command
              .add_option("--format", writing.format,
                          "format of all meshes: " + join_names(names, ", ") + " (default: by extension)")
              ->type_name("NAME")
              ->check(one_of(names)),
          command.add_flag("--no-header", no_header,
                           "MSMS files without their three lines of header, for PyGBe and pbj (default: off)")};
}

WriteOptions writing_options(WriteOptions writing, bool no_header) {
  writing.msms_header = !no_header;
  return writing;
}

void require_writable_outputs(const std::vector<std::string>& outputs, const std::string& report,
                              const WriteOptions& writing, const std::vector<std::string>& inputs) {
  std::set<std::filesystem::path> seen;
  const auto require_new = [&](const std::filesystem::path& file) {
    require_other_files(inputs, {file.string()});
    std::error_code error;
    std::filesystem::path place =
        file == "-" ? file : std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
    if (error) place = file;  // of a pipe of the shell, whose link in /dev/fd leads nowhere
    const bool is_device = std::filesystem::is_character_file(place, error);
    if (!seen.insert(place).second && !is_device) {
      throw OptionError("-o: expected each output once, got '" + file.string() + "' again");
    }
  };
  for (const std::string& output : outputs) {
    for (const std::filesystem::path& file : files_of(output, writing)) {
      require_new(file);
      require_writable(file);
    }
  }
  if (report.empty()) return;
  require_new(report);
  require_writable(report);
}

bool is_standard_output(const std::string& output) {
  return output == "-" || output == "/dev/stdout" || output == "/dev/fd/1" || output == "/proc/self/fd/1";
}

void require_other_files(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    for (const std::string& input : inputs) {
      std::error_code error;  // of files that are not there
      if (!std::filesystem::is_regular_file(input, error) || !std::filesystem::equivalent(input, output, error))
        continue;
      throw OptionError("expected another file to write than '" + input + "', which is read, got '" + output + "'");
    }
  }
}

}  // namespace gaussmesh::app
