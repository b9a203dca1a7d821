// What `gaussmesh check` found, in words and as JSON.
#pragma once

#include <optional>
#include <string>

#include "gaussmesh/check_mesh.h"

namespace gaussmesh::app {

/// All that was found out about one mesh.
struct CheckFindings {
  std::string name;  ///< of the file
  MeshCheck mesh;
  std::optional<double> tolerance;  ///< of the vertices' distance (A); there if a molecule was given
  std::optional<SurfaceDistance>
      distance;  ///< from the molecule's surface; missing too where it cannot be measured

  bool is_on_surface() const { return !tolerance || (distance && distance->max_vertex_distance <= *tolerance); }
  bool is_good() const { return mesh.fit_for_solver() && is_on_surface(); }
};

/// A report for people. Its last line begins with `OK` if the mesh is good, else with `FAILED`.
std::string findings_text(const CheckFindings& found);

/// The same for programs; a distance that is infinite, or not measured, is null.
std::string findings_json(const CheckFindings& found);

}  // namespace gaussmesh::app
