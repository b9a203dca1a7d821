#include "verify/component_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/exact_orientation.h"
#include "verify/vector3.h"

namespace gaussmesh {
namespace {

double size(const Point& a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }

/// Running sums over one component.
struct Sums {
  Point origin{};
  std::size_t triangles = 0;
  double area = 0.0;
  double volume = 0.0;
  double product_size = 0.0;  // sum over the triangles of six products' sizes: what rounding is in proportion to
};

void add_triangle(Sums& sums, const Point& a, const Point& b, const Point& c) {
  const Point ab = difference(b, a);
  const Point ac = difference(c, a);
  const Point arm = difference(a, sums.origin);
  const Point normal = cross(ab, ac);
  ++sums.triangles;
  sums.area += length(normal) / 2;
  sums.volume += dot(normal, arm) / 6;
  sums.product_size += size(ab) * size(ac) * size(arm) / 6;
}

std::vector<Sums> sum_components(const TriangleMesh& mesh, const EdgeTopology& topology) {
  std::vector<Sums> sums(topology.components.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    Sums& mine = sums[topology.component_of[t]];
    if (mine.triangles == 0) mine.origin = mesh.vertices[a];
    add_triangle(mine, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  return sums;
}

/// +1 or -1 where rounding cannot have made the sign, else 0.
///
/// A term goes through nine roundings before it is added, and through at most as many additions as there are
/// triangles, each by a factor 1 + u, u = 2^-53. Twice that covers the roundings of the bound.
int safe_volume_sign(const Sums& sums) {
  const double roundings = 2 * (static_cast<double>(sums.triangles) + 9);
  const double bound = roundings * 0x1p-53 * sums.product_size;
  return sums.volume > bound ? 1 : sums.volume < -bound ? -1 : 0;
}

/// Settles the signs that rounding left open, by exact sums.
void settle_volume_signs(const TriangleMesh& mesh, const EdgeTopology& topology, const std::vector<Sums>& sums,
                         std::vector<ComponentGeometry>& components) {
  std::vector<ExactSum> exact(components.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = topology.component_of[t];
    if (components[component].volume_sign != 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    exact[component].add(
        exact_determinant(sums[component].origin, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  }
  for (std::size_t c = 0; c < components.size(); ++c)
    if (components[c].volume_sign == 0) components[c].volume_sign = exact[c].sign();
}

/// Sign of the turn a, b, p after p is moved by (e^2, e), e infinitesimal; 0 only if a and b are the same point.
int turn_of_moved(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  const int turn = orient2d(a, b, p);
  if (turn != 0) return turn;
  if (a[0] != b[0]) return b[0] > a[0] ? 1 : -1;
  if (a[1] != b[1]) return b[1] > a[1] ? -1 : 1;
  return 0;
}

/// Whether the ray from `p` upwards along z, moved as above, crosses the triangle.
bool is_below(const Point& p, const Point& a, const Point& b, const Point& c) {
  const PlanePoint foot = project_along(2, p);
  const PlanePoint corners[3] = {project_along(2, a), project_along(2, b), project_along(2, c)};
  const int turn = turn_of_moved(corners[0], corners[1], foot);
  if (turn == 0 || turn_of_moved(corners[1], corners[2], foot) != turn ||
      turn_of_moved(corners[2], corners[0], foot) != turn)
    return false;
  return orient3d(a, b, c, p) * turn < 0;
}

}  // namespace

std::vector<std::uint32_t> find_components_around(const Point& p, const TriangleMesh& mesh,
                                                  const std::vector<std::uint32_t>& component_of,
                                                  const std::vector<bool>& is_closed, const TriangleTree& tree) {
  std::vector<std::uint32_t> crossed;
  const Box ray{p, {p[0], p[1], std::numeric_limits<double>::infinity()}};
  tree.for_each_block_meeting(ray, 0, [&](std::size_t block) {
    for (const std::uint32_t t : tree.block(block)) {
      const std::uint32_t component = component_of[t];
      if (!is_closed[component]) continue;
      const auto& [a, b, c] = mesh.triangles[t];
      if (is_below(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])) crossed.push_back(component);
    }
  });
  std::sort(crossed.begin(), crossed.end());
  std::vector<std::uint32_t> around;
  for (std::size_t begin = 0, end = 0; begin < crossed.size(); begin = end) {
    while (end < crossed.size() && crossed[end] == crossed[begin]) ++end;
    if ((end - begin) % 2 == 1) around.push_back(crossed[begin]);
  }
  return around;
}

std::vector<ComponentGeometry> measure_components(const TriangleMesh& mesh, const EdgeTopology& topology,
                                                  const TriangleTree& tree) {
  const std::vector<Sums> sums = sum_components(mesh, topology);
  std::vector<ComponentGeometry> components(sums.size());
  std::vector<bool> is_closed;
  for (const ComponentTopology& component : topology.components) is_closed.push_back(component.closed);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t c = 0; c < components.size(); ++c) {
    components[c] = {sums[c].area, sums[c].volume, safe_volume_sign(sums[c]), {}};
    if (components.size() == 1 || !is_closed[c]) continue;
    components[c].around = find_components_around(sums[c].origin, mesh, topology.component_of, is_closed, tree);
    std::erase(components[c].around, static_cast<std::uint32_t>(c));  // it is on this one, not inside
  }
  settle_volume_signs(mesh, topology, sums, components);
  return components;
}

}  // namespace gaussmesh
