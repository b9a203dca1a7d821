#include "check_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gaussmesh/mesh_surface.h"
#include "report_parts.h"

namespace gaussmesh::app {
namespace {

/// One kind of defect: how the report and JSON name it.
struct Defect {
  const char* text;  // of many
  const char* one;
  const char* key;
  std::size_t count;
};

enum class Side { kOutside, kCavity };

/// Outsides or cavities that are turned the wrong way. None where a surface is not closed: the cavities in it would be
/// taken for outsides.
std::size_t count_inverted(const MeshCheck& mesh, Side side) {
  if (!all_are_closed(mesh)) return 0;
  return static_cast<std::size_t>(
      std::count_if(mesh.components.begin(), mesh.components.end(),
                    [&](const MeshComponent& c) { return c.inverted && c.is_cavity() == (side == Side::kCavity); }));
}

std::vector<Defect> defects_of(const CheckFindings& found) {
  const MeshCheck& mesh = found.mesh;
  std::vector<Defect> defects{
      {"triangles that name a missing vertex", "triangle that names a missing vertex", "bad_indices", mesh.bad_indices},
      {"vertices without usable coordinates", "vertex without usable coordinates", "bad_coordinates",
       mesh.bad_coordinates},
      {"boundary edges, in one triangle only", "boundary edge, in one triangle only", "boundary_edges",
       mesh.boundary_edges},
      {"non-manifold edges, in more than two", "non-manifold edge, in more than two", "nonmanifold_edges",
       mesh.nonmanifold_edges},
      {"edges whose triangles turn against each other", "edge whose triangles turn against each other",
       "misoriented_edges", mesh.misoriented_edges},
      {"vertices whose triangles are not one closed fan", "vertex whose triangles are not one closed fan",
       "nonmanifold_vertices", mesh.nonmanifold_vertices},
      {"vertices in no triangle", "vertex in no triangle", "isolated_vertices", mesh.isolated_vertices},
      {"vertices at the place of another", "vertex at the place of another", "duplicate_vertices",
       mesh.duplicate_vertices},
      {"triangles of zero area", "triangle of zero area", "degenerate_triangles", mesh.degenerate_triangles},
      {"pairs of triangles that cross or touch", "pair of triangles that cross or touch", "intersecting_pairs",
       mesh.intersecting_pairs},
      {"outer surfaces whose faces turn inwards", "outer surface whose faces turn inwards", "inward_surfaces",
       count_inverted(mesh, Side::kOutside)},
      {"cavities whose faces turn outwards", "cavity whose faces turn outwards", "outward_cavities",
       count_inverted(mesh, Side::kCavity)}};
  if (found.charges_outside)
    defects.push_back(
        {"charges outside the mesh", "charge outside the mesh", "charges_outside", found.charges_outside->size()});
  if (found.near && found.separation_is_required)
    defects.push_back({"pairs of vertices too near to each other", "pair of vertices too near to each other",
                       "near_pairs", found.near->pairs});
  return defects;
}

/// The first few of a list, each as text_of() has it, in a line behind `what`; nothing if there are none.
template <class Entry, class TextOf>
std::string examples_line(const std::string& what, const std::vector<Entry>& entries, const TextOf& text_of) {
  constexpr std::size_t kMostExamples = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostExamples, entries.size()); ++i)
    text += (i == 0 ? "" : ", ") + text_of(entries[i]);
  return text.empty() ? "" : "  " + what + "counted from 0: " + text + "\n";
}

std::string pair_text(const std::array<std::uint32_t, 2>& pair) { return line("%u and %u", pair[0], pair[1]); }

std::string defects_text(const CheckFindings& found) {
  const MeshCheck& mesh = found.mesh;
  std::string text = "Defects\n";
  for (const Defect& defect : defects_of(found)) text += line("  %-49s %11zu\n", defect.text, defect.count);
  if (!all_are_closed(mesh))
    text += std::string("  a surface is not closed: which ones turn the wrong way") +
            (found.tolerance ? ", and which charges are outside," : "") + " is not known\n";
  const std::size_t inward = count_inverted(mesh, Side::kOutside);
  if (inward > 0 && inward == mesh.components.size())
    text += "  all surfaces turn inwards: is this a cavity by itself, as --cavities separate writes it?\n";
  text += examples_line("triangles that cross or touch, ", mesh.intersecting_examples, pair_text);
  if (found.charges_outside)
    text += examples_line("atoms of charges outside, ", *found.charges_outside,
                          [](std::uint32_t atom) { return std::to_string(atom); });
  return text;
}

std::string shape_text(const MeshCheck& mesh) {
  return "Shape of the triangles\n" +
         line("  angles                         %.4g to %.4g deg\n", mesh.min_angle_deg, mesh.max_angle_deg) +
         line("  smallest angle, mean           %.4g deg, below 30 deg in %.4g %%\n", mesh.mean_min_angle_deg,
              100 * mesh.fraction_under_30_deg) +
         line("  shortest / longest edge, mean  %.4g\n", mesh.mean_edge_ratio) +
         line("  edges                          %.4g to %.4g A, mean %.4g A\n", mesh.min_edge, mesh.max_edge,
              mesh.mean_edge);
}

std::string near_text(const CheckFindings& found) {
  if (!found.near) return "";
  const NearVertices& near = *found.near;
  std::string text = line("Vertices nearer to each other than %.4g A: ", found.separation) +
                     counted(near.pairs, "pair", "pairs") +
                     line("%s, %zu of them joined by an edge, %zu crowded\n",
                          near.pairs == kMostNearPairs ? " or more" : "", near.short_edges, near.crowded);
  text += examples_line("", near.examples, pair_text);
  if (near.crowded != 0 && !found.separation_is_required)
    text += "  WARNING: " + counted(near.crowded, "pair is", "pairs are") +
            " nearer than a quarter of the edges there; boundary-element solvers may not converge\n";
  return text;
}

std::string distance_text(const CheckFindings& found) {
  if (!found.tolerance) return "";
  if (!found.distance) return "Distance from the surface: not measured, since vertices are missing or unusable\n";
  const SurfaceDistance& d = *found.distance;
  const TwoSidedDistance& both = *found.two_sided;
  return "Distance from the surface\n" +
         line("  vertices         mean %.4g A, largest %.4g A, tolerance %.4g A\n", d.mean_vertex_distance,
              d.max_vertex_distance, *found.tolerance) +
         line("  centroids        mean %.4g A, largest %.4g A\n", d.mean_centroid_distance, d.max_centroid_distance) +
         line("  and middles of edges: mean %.4g A, largest %.4g A; from the surface to the mesh %.4g A\n",
              both.mean_mesh_to_surface, both.mesh_to_surface, both.surface_to_mesh) +
         line("  faces turned against the gradient  %zu\n", d.faces_against_gradient) +
         (std::isinf(both.mesh_to_surface) || std::isinf(d.max_vertex_distance)
              ? "  inf: from some of these no way leads to the surface, as from a cavity that it has not\n"
              : "");
}

std::string verdict_text(const CheckFindings& found) {
  if (found.is_good()) return "OK: fit for a solver" + std::string(found.tolerance ? ", and on the surface\n" : "\n");
  std::string reasons = found.mesh.triangles == 0 ? "; no triangle" : "";
  for (const Defect& defect : defects_of(found))
    if (defect.count != 0) reasons += "; " + counted(defect.count, defect.one, defect.text);
  if (!found.is_on_surface()) reasons += "; vertices are not on the surface";
  return "FAILED: " + reasons.substr(2) + "\n";
}

Json near_json(const CheckFindings& found) {
  if (!found.near) return nullptr;
  return {{"separation_A", found.separation},
          {"pairs", found.near->pairs},
          {"short_edges", found.near->short_edges},
          {"crowded", found.near->crowded},
          {"examples", found.near->examples}};
}

Json distance_json(const CheckFindings& found) {
  if (!found.distance) return nullptr;
  const SurfaceDistance& d = *found.distance;
  return {{"tolerance_A", *found.tolerance},
          {"vertex_distance_max_A", d.max_vertex_distance},
          {"vertex_distance_mean_A", d.mean_vertex_distance},
          {"centroid_distance_max_A", d.max_centroid_distance},
          {"centroid_distance_mean_A", d.mean_centroid_distance},
          {"faces_against_gradient", d.faces_against_gradient},
          {"mesh_to_surface_max_A", found.two_sided->mesh_to_surface},
          {"mesh_to_surface_mean_A", found.two_sided->mean_mesh_to_surface},
          {"surface_to_mesh_max_A", found.two_sided->surface_to_mesh}};
}

}  // namespace

std::string findings_text(const CheckFindings& found) {
  return found.name + ": " + size_text(found.mesh) + "\n" + defects_text(found) + components_text(found.mesh) +
         shape_text(found.mesh) + near_text(found) + distance_text(found) + verdict_text(found);
}

std::string findings_json(const CheckFindings& found) {
  Json defects;
  for (const Defect& defect : defects_of(found)) defects[defect.key] = defect.count;
  defects["inverted_components"] = found.mesh.inverted_components;
  const Json json = {{"mesh", found.name},
                     {"good", found.is_good()},
                     {"fit_for_solver", found.mesh.fit_for_solver()},
                     {"vertices", found.mesh.vertices},
                     {"triangles", found.mesh.triangles},
                     {"chi", found.mesh.chi},
                     {"area_A2", found.mesh.area},
                     {"volume_A3", found.mesh.volume},
                     {"defects", defects},
                     {"intersecting_examples", found.mesh.intersecting_examples},
                     {"components", components_json(found.mesh)},
                     {"quality", Json::parse(quality_json(found.mesh))},
                     {"near_vertices", near_json(found)},
                     {"charges_outside", found.charges_outside ? Json(*found.charges_outside) : Json()},
                     {"surface", distance_json(found)}};
  return json_text(json);
}

}  // namespace gaussmesh::app
