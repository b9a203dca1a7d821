// `gaussmesh check`: judges a mesh, and prints or writes what it finds.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "molecule_options.h"
#include "surface_options.h"

namespace gaussmesh::app {

/// What the command line asks of the check.
struct CheckCommand {
  std::string mesh;                      ///< in any format that is read
  std::optional<std::string> molecule;   ///< measure the distance to its surface, too
  MoleculeOptions reading;               ///< of the molecule
  SurfaceOptions surface;                ///< of the molecule
  double tolerance = 1e-6;               ///< largest distance (A) that a vertex may have from it
  std::optional<double> min_separation;  ///< least distance (A) of any two vertices
  int threads = 0;                       ///< 0: one for each processor
  std::optional<std::string> json;       ///< write JSON here; "-": to the terminal, in place of the report
};

/// Adds the sub-command to the program; parsing fills `command`, which must outlive it. @return the sub-command
CLI::App* add_check_command(CLI::App& program, CheckCommand& command);

/// Reads the mesh, judges it and says what was found.
///
/// @return the exit code: 0 if the mesh is fit for a solver, its vertices are apart as asked for and, with a molecule,
///         within the tolerance of the surface, and all charges are inside; else 5
/// @throws InputError, OptionError
int run_check(const CheckCommand& command);

}  // namespace gaussmesh::app
