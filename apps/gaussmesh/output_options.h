// What the commands that write meshes share.
#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>
#include <vector>

#include "gaussmesh/write_mesh.h"

namespace gaussmesh::app {

/// Adds --format and --no-header; `writing` must outlive the command. @return the options
std::vector<CLI::Option*> add_format_options(CLI::App& command, WriteOptions& writing);

/// Only MSMS has a header that --no-header leaves out. @throws OptionError if it is asked for where none of `outputs`,
/// which are at least one, is MSMS
void require_header_to_leave_out(const std::vector<std::string>& outputs, const WriteOptions& writing);

/// The outputs without those that are an earlier one by its other name: a.vert and a.face are the same files of MSMS.
///
/// @throws OptionError for an unknown format
std::vector<std::string> without_second_names(const std::vector<std::string>& outputs, const WriteOptions& writing);

/// Finds out before the work what cannot be read and written; names may be empty.
///
/// @throws OptionError where two inputs are standard input, two outputs are one file, or an output is one of the inputs
/// @throws InputError  for a place that cannot be written to
void require_files(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// The same for the files that meshes become, and a report. @throws OptionError also for an unknown format
void require_writable_outputs(const std::vector<std::string>& outputs, const std::string& report,
                              const WriteOptions& writing, const std::vector<std::string>& inputs);

/// Prints the text where a failure can still be told. To be called before files are put in their places: then they are
/// not, where standard output is full or closed.
///
/// @throws InputError if standard output cannot be written to
void print_at_once(std::ostream& out, const std::string& text);

/// Whether the name is one of those that standard output goes by.
bool is_standard_output(const std::string& output);

}  // namespace gaussmesh::app
