#include "check_report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

namespace gaussmesh::app {
namespace {

using Json = nlohmann::ordered_json;

/// One kind of defect: how the report and JSON name it.
struct Defect {
  const char* text;
  const char* key;
  std::size_t count;
};

std::vector<Defect> defects_of(const MeshCheck& mesh) {
  return {{"triangles that name a missing vertex", "bad_indices", mesh.bad_indices},
          {"vertices without usable coordinates", "bad_coordinates", mesh.bad_coordinates},
          {"boundary edges, in one triangle only", "boundary_edges", mesh.boundary_edges},
          {"non-manifold edges, in more than two", "nonmanifold_edges", mesh.nonmanifold_edges},
          {"edges whose triangles turn against each other", "misoriented_edges", mesh.misoriented_edges},
          {"vertices whose triangles are not one closed fan", "nonmanifold_vertices", mesh.nonmanifold_vertices},
          {"vertices in no triangle", "isolated_vertices", mesh.isolated_vertices},
          {"vertices at the place of another", "duplicate_vertices", mesh.duplicate_vertices},
          {"triangles of zero area", "degenerate_triangles", mesh.degenerate_triangles},
          {"pairs of triangles that cross or touch", "intersecting_pairs", mesh.intersecting_pairs},
          {"components turned inside out", "inverted_components", mesh.inverted_components}};
}

/// printf into a string; a line is never longer than the buffer.
[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

const char* kind_of(const MeshComponent& component) {
  if (!component.closed) return "not closed";
  return component.depth % 2 == 0 ? "outside" : "cavity";
}

std::string defects_text(const MeshCheck& mesh) {
  constexpr std::size_t kMostExamples = 3;
  std::string text = "Defects\n";
  for (const Defect& defect : defects_of(mesh)) text += line("  %-49s %11zu\n", defect.text, defect.count);
  std::string pairs;
  for (std::size_t i = 0; i < std::min(kMostExamples, mesh.intersecting_examples.size()); ++i)
    pairs +=
        line("%s%u and %u", i == 0 ? "" : ", ", mesh.intersecting_examples[i][0], mesh.intersecting_examples[i][1]);
  return pairs.empty() ? text : text + "  triangles that cross or touch, counted from 0: " + pairs + "\n";
}

std::string components_text(const MeshCheck& mesh) {
  constexpr std::size_t kMost = 20;
  std::string text = line("Components: %zu, Euler number %lld, area %.8g A^2, volume %.8g A^3\n",
                          mesh.components.size(), static_cast<long long>(mesh.chi), mesh.area, mesh.volume);
  text += "  kind         triangles    vertices   handles        area/A^2      volume/A^3\n";
  for (std::size_t i = 0; i < std::min(kMost, mesh.components.size()); ++i) {
    const MeshComponent& c = mesh.components[i];
    text += line("  %-10s %11zu %11zu %9lld %15.8g %15.8g%s\n", kind_of(c), c.triangles, c.vertices,
                 static_cast<long long>(c.genus), c.area, c.volume, c.inverted ? "  inside out" : "");
  }
  if (mesh.components.size() > kMost) text += line("  and %zu smaller ones\n", mesh.components.size() - kMost);
  return text;
}

std::string shape_text(const MeshCheck& mesh) {
  return "Shape of the triangles\n" +
         line("  angles                         %.4g to %.4g deg\n", mesh.min_angle_deg, mesh.max_angle_deg) +
         line("  smallest angle, mean           %.4g deg, below 30 deg in %.4g %%\n", mesh.mean_min_angle_deg,
              100 * mesh.under_30_deg) +
         line("  shortest / longest edge, mean  %.4g\n", mesh.mean_edge_ratio) +
         line("  edges                          %.4g to %.4g A, mean %.4g A\n", mesh.min_edge, mesh.max_edge,
              mesh.mean_edge);
}

std::string distance_text(const CheckFindings& found) {
  if (!found.tolerance) return "";
  if (!found.distance) return "Distance from the surface: not measured, since vertices are missing or unusable\n";
  const SurfaceDistance& d = *found.distance;
  return "Distance from the surface\n" +
         line("  vertices         mean %.4g A, largest %.4g A, tolerance %.4g A\n", d.mean_vertex_distance,
              d.max_vertex_distance, *found.tolerance) +
         line("  centroids        mean %.4g A, largest %.4g A\n", d.mean_centroid_distance,
              d.max_centroid_distance) +
         line("  faces turned against the gradient  %zu\n", d.faces_against_gradient);
}

std::string verdict_text(const CheckFindings& found) {
  if (found.is_good())
    return "OK: fit for a solver" + std::string(found.tolerance ? ", and on the surface\n" : "\n");
  std::string reasons = found.mesh.triangles == 0 ? "; no triangle" : "";
  for (const Defect& defect : defects_of(found.mesh))
    if (defect.count != 0) reasons += line("; %zu %s", defect.count, defect.text);
  if (!found.is_on_surface()) reasons += "; vertices are not on the surface";
  return "FAILED: " + reasons.substr(2) + "\n";
}

Json components_json(const MeshCheck& mesh) {
  Json list = Json::array();
  for (const MeshComponent& c : mesh.components)
    list.push_back({{"kind", kind_of(c)},
                    {"depth", c.depth},
                    {"inverted", c.inverted},
                    {"triangles", c.triangles},
                    {"vertices", c.vertices},
                    {"chi", c.chi},
                    {"genus", c.genus},
                    {"area_A2", c.area},
                    {"volume_A3", c.volume}});
  return list;
}

Json quality_json(const MeshCheck& mesh) {
  return {{"min_angle_deg", mesh.min_angle_deg},
          {"max_angle_deg", mesh.max_angle_deg},
          {"mean_min_angle_deg", mesh.mean_min_angle_deg},
          {"fraction_under_30_deg", mesh.under_30_deg},
          {"mean_edge_ratio", mesh.mean_edge_ratio},
          {"min_edge_A", mesh.min_edge},
          {"mean_edge_A", mesh.mean_edge},
          {"max_edge_A", mesh.max_edge},
          {"triangles_by_edge_ratio", mesh.ratio_histogram},
          {"angles_by_10_deg", mesh.angle_histogram}};
}

Json distance_json(const CheckFindings& found) {
  if (!found.distance) return nullptr;
  const SurfaceDistance& d = *found.distance;
  return {{"tolerance_A", *found.tolerance},
          {"vertex_distance_max_A", d.max_vertex_distance},
          {"vertex_distance_mean_A", d.mean_vertex_distance},
          {"centroid_distance_max_A", d.max_centroid_distance},
          {"centroid_distance_mean_A", d.mean_centroid_distance},
          {"faces_against_gradient", d.faces_against_gradient}};
}

}  // namespace

std::string findings_text(const CheckFindings& found) {
  return found.name + line(": %zu vertices, %zu triangles\n", found.mesh.vertices, found.mesh.triangles) +
         defects_text(found.mesh) + components_text(found.mesh) + shape_text(found.mesh) + distance_text(found) +
         verdict_text(found);
}

std::string findings_json(const CheckFindings& found) {
  Json defects;
  for (const Defect& defect : defects_of(found.mesh)) defects[defect.key] = defect.count;
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
                     {"quality", quality_json(found.mesh)},
                     {"surface", distance_json(found)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gaussmesh::app
