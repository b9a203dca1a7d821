#include "output_names.h"

#include <cstdlib>

#include "gaussmesh/error.h"
#include "gaussmesh/nearest_name.h"

namespace gaussmesh::app {
namespace {

/// The system's folder for temporary files. @throws InputError if there is none
std::filesystem::path temporary_folder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  for (const char* variable : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {  // in the order of the standard library
    const char* const value = std::getenv(variable);
    if (value == nullptr) continue;
    throw InputError("max-memory: expected a folder for the temporary file in the variable " + std::string(variable) +
                     ", got '" + value + "'");
  }
  throw InputError("max-memory: expected the folder /tmp for the temporary file, got none; set the variable TMPDIR");
}

}  // namespace

std::string numbered(const std::string& output, std::size_t number) {
  const std::filesystem::path path = output;
  std::filesystem::path stem = path.stem();
  std::string extension = path.extension().string();
  if (lower_case(extension) == ".gz") {
    extension = stem.extension().string() + extension;
    stem = stem.stem();
  }
  return (path.parent_path() / (stem.string() + "_" + std::to_string(number) + extension)).string();
}

std::string numbered_from(const std::string& output, std::size_t number, const WriteOptions& writing) {
  const auto is_there = [&](std::size_t n) {
    std::error_code error;  // of names that are too long
    return std::filesystem::exists(files_of(numbered(output, n), writing).front(), error);
  };
  if (!is_there(number)) return "";
  std::size_t last = number;
  while (is_there(last + 1)) ++last;
  return numbered(output, number) + (last > number ? " to " + numbered(output, last) : "");
}

std::filesystem::path folder_of_temporary(const std::filesystem::path& output) {
  std::error_code error;
  const bool is_pipe_or_device =
      std::filesystem::exists(output, error) && !std::filesystem::is_regular_file(output, error);
  if (output == "-" || is_pipe_or_device) return temporary_folder();
  return output.has_parent_path() ? output.parent_path() : ".";
}

}  // namespace gaussmesh::app
