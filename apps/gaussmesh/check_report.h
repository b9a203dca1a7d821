// What `gaussmesh check` found, in words and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/measure_mesh.h"
#include "gaussmesh/two_sided_distance.h"

namespace gaussmesh::app {

/// All that was found out about one mesh.
struct CheckFindings {
  std::string name;  ///< of the file
  MeshCheck mesh;
  std::optional<double> tolerance;            ///< of the vertices' distance (A); there if a molecule was given
  std::optional<SurfaceDistance> distance;    ///< from the molecule's surface; missing too where it cannot be measured
  std::optional<TwoSidedDistance> two_sided;  ///< likewise
  std::optional<std::vector<std::uint32_t>> charges_outside;  ///< atoms; likewise, and if it is not closed
  double separation = 0.0;                                    ///< of the vertices (A)
  bool separation_is_required = false;                        ///< nearer ones are a defect, and not only told
  std::optional<NearVertices> near;                           ///< nearer than that; missing where it cannot be measured

  bool is_on_surface() const { return !tolerance || (distance && distance->max_vertex_distance <= *tolerance); }
  bool has_all_charges() const { return !charges_outside || charges_outside->empty(); }
  bool is_separated() const { return !separation_is_required || (near && near->pairs == 0); }
  bool is_good() const { return mesh.fit_for_solver() && is_on_surface() && has_all_charges() && is_separated(); }
};

/// A report for people. Its last line begins with `OK` if the mesh is good, else with `FAILED`.
std::string findings_text(const CheckFindings& found);

/// The same for programs; a distance that is infinite, or not measured, is null.
std::string findings_json(const CheckFindings& found);

}  // namespace gaussmesh::app
