#include "write/region_points.h"

#include <algorithm>
#include <cmath>

#include "gaussmesh/error.h"
#include "verify/component_geometry.h"
#include "verify/triangle_tree.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

namespace {

/// Triangles tried for a component: where the largest lie in folds so thin that no point is under them, others do
/// not.
constexpr std::size_t kMostTriangles = 64;

/// Depths tried, as shares of the root of the triangle's area.
constexpr double kDepths[] = {0.25, 0.05, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

double doubled_area(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return length(cross(difference(mesh.vertices[b], mesh.vertices[a]), difference(mesh.vertices[c], mesh.vertices[a])));
}

/// The largest triangles of each component, largest first.
std::vector<std::vector<std::uint32_t>> find_large_triangles(const TriangleMesh& mesh, const MeshCheck& check) {
  std::vector<std::vector<std::uint32_t>> of(check.components.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) of[check.component_of[t]].push_back(t);
  for (std::vector<std::uint32_t>& triangles : of) {
    const auto end = triangles.begin() + static_cast<std::ptrdiff_t>(std::min(kMostTriangles, triangles.size()));
    std::partial_sort(triangles.begin(), end, triangles.end(), [&](std::uint32_t s, std::uint32_t t) {
      const double s_area = doubled_area(mesh, s), t_area = doubled_area(mesh, t);
      return s_area != t_area ? s_area > t_area : s < t;
    });
    triangles.erase(end, triangles.end());
  }
  return of;
}

/// The point at that height over the centroid of a triangle, along its normal and in terms of its size.
Point point_over(const TriangleMesh& mesh, std::uint32_t t, double height) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Point normal =
      cross(difference(mesh.vertices[b], mesh.vertices[a]), difference(mesh.vertices[c], mesh.vertices[a]));
  const double size = length(normal);
  const double step = height * std::sqrt(size);
  Point point{};
  for (int k = 0; k < 3; ++k) {
    const double centroid = (mesh.vertices[a][k] + mesh.vertices[b][k] + mesh.vertices[c][k]) / 3.0;
    point[k] = centroid + step * normal[k] / size;
  }
  return point;
}

}  // namespace

std::vector<RegionPoint> find_region_points(const TriangleMesh& mesh, const MeshCheck& check) {
  const TriangleTree tree(mesh);
  std::vector<bool> is_closed;
  for (const MeshComponent& component : check.components) is_closed.push_back(component.closed);
  const auto large = find_large_triangles(mesh, check);
  const auto is_in_region = [&](const Point& point, std::uint32_t component) {
    const std::vector<std::uint32_t> around = find_components_around(point, mesh, check.component_of, is_closed, tree);
    // Those around a point contain each other, so their number tells whether there are others than the ancestors.
    return around.size() == check.components[component].depth + 1 &&
           std::binary_search(around.begin(), around.end(), component);
  };
  const auto find_point = [&](std::uint32_t component) {
    const bool is_cavity = check.components[component].is_cavity();
    for (const std::uint32_t t : large[component]) {
      for (const double depth : kDepths) {
        const Point point = point_over(mesh, t, is_cavity ? depth : -depth);
        if (is_in_region(point, component)) return point;
      }
    }
    throw CannotMeshError("component " + std::to_string(component) + ": no point found inside of it; is it flat?");
  };
  std::vector<RegionPoint> points;
  for (std::uint32_t c = 0; c < check.components.size(); ++c) {
    if (is_closed[c]) points.push_back({c, find_point(c)});
  }
  return points;
}

}  // namespace gaussmesh
