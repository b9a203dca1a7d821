// `gaussmesh convert`: a mesh in another format.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gaussmesh/write_mesh.h"
#include "molecule_options.h"

namespace gaussmesh::app {

struct ConvertCommand {
  std::string input;
  std::vector<std::string> outputs;
  std::optional<std::string> molecule;  ///< gives the nearest atoms
  MoleculeOptions reading;              ///< of the molecule
  WriteOptions writing;
};

/// Adds the sub-command to the program; parsing fills `command`, which must outlive it. @return the sub-command
CLI::App* add_convert_command(CLI::App& program, ConvertCommand& command);

/// Reads the mesh and writes it. @return the exit code @throws InputError, OptionError
int run_convert(const ConvertCommand& command);

}  // namespace gaussmesh::app
