// `gaussmesh measure`: area and volume of a mesh, and how it lies round the atoms of its molecule.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "molecule_options.h"

namespace gaussmesh::app {

struct MeasureCommand {
  std::string mesh;
  std::optional<std::string> molecule;    ///< measure by its atoms, too
  MoleculeOptions reading;                ///< of the molecule
  std::optional<std::string> atom_areas;  ///< write the area at each atom here
  int threads = 0;                        ///< 0: one for each processor
  std::optional<std::string> json;        ///< write JSON here; "-": to the terminal, in place of the report
};

/// Adds the sub-command to the program; parsing fills `command`, which must outlive it. @return the sub-command
CLI::App* add_measure_command(CLI::App& program, MeasureCommand& command);

/// Reads, measures and says so. @return the exit code @throws InputError
int run_measure(const MeasureCommand& command);

}  // namespace gaussmesh::app
