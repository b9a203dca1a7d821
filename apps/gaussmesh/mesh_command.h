// gaussmesh MOL -o OUT: the main job.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "gaussmesh/mesh_surface.h"

namespace gaussmesh::app {

struct MeshCommand {
  std::string molecule;
  std::string output;
  std::string report;
  MeshOptions options;
};

/// Adds the options of the main job to the program itself; `command` must outlive it.
void add_mesh_options(CLI::App& program, MeshCommand& command);

/// Reads, meshes, writes and says so. @return the exit code
int run_mesh(const MeshCommand& command);

}  // namespace gaussmesh::app
