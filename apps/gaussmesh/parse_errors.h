// What is wrong with the command line or the configuration file, told in the program's own words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gaussmesh::app {

/// The message for an error that `program` threw while it was parsing: where, what was expected and what was got, and
/// which name is near to one that there is not. CLI11 lists what fits nowhere backwards, and knows no near names.
std::string message_of(const CLI::App& program, const CLI::ParseError& error);

/// A sub-command that was not written well is taken for the molecule.
///
/// @throws OptionError where the molecule is no file, and nearly the name of a sub-command
void require_known_command(const CLI::App& program);

/// Options before the name of a sub-command are those of meshing, and nothing is meshed then. @throws OptionError if
/// there are any
void require_command_alone(const CLI::App& program);

}  // namespace gaussmesh::app
