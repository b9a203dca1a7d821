// gaussmesh MOL -o OUT: the main job.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "gaussmesh/mesh_surface.h"
#include "gaussmesh/write_mesh.h"

namespace gaussmesh::app {

struct MeshCommand {
  std::string molecule;
  std::vector<std::string> outputs;
  std::string report;
  bool no_header = false;
  WriteOptions writing;
  MeshOptions options;
};

/// Adds the options of the main job to the program itself; `command` must outlive it.
void add_mesh_options(CLI::App& program, MeshCommand& command);

/// Reads, meshes, writes and says so. @return the exit code
int run_mesh(const MeshCommand& command);

}  // namespace gaussmesh::app
