// gaussmesh MOL -o OUT: the main job.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gaussmesh/mesh_surface.h"
#include "gaussmesh/write_mesh.h"
#include "molecule_options.h"
#include "surface_options.h"

namespace gaussmesh::app {

/// What becomes of cavities: they stay, are filled, or each closed surface has a file.
enum class Cavities { kKeep, kDrop, kSeparate };

struct MeshCommand {
  std::string molecule;  ///< "-": standard input
  SurfaceOptions surface;
  MoleculeOptions reading;
  Cavities cavities = Cavities::kKeep;
  double min_cavity_volume = 0.0;    ///< A^3; smaller cavities are left out
  std::optional<double> density;     ///< vertices per A^2, instead of options.spacing
  std::vector<std::string> outputs;  ///< "-": standard output
  std::string report;                ///< empty: none
  std::string config;                ///< file of options that has been read; empty: none
  bool quiet = false;
  bool verbose = false;
  std::uint64_t max_memory = 0;  ///< bytes; 0: no limit
  WriteOptions writing;
  MeshOptions options;  ///< but decay and isovalue, which are in `surface`
};

/// What --cavities takes.
std::vector<std::string> cavity_choices();

/// Adds the options of the main job to the program itself; `command` must outlive it.
void add_mesh_options(CLI::App& program, MeshCommand& command);

/// Reads, meshes, writes and says so. @return the exit code
int run_mesh(MeshCommand command);

}  // namespace gaussmesh::app
