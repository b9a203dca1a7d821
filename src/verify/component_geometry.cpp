#include "verify/component_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "verify/exact_orientation.h"
#include "verify/parallel.h"
#include "verify/vector3.h"

namespace gaussmesh::verify {
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

constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

void add_sums(Sums& to, const Sums& from) {
  to.triangles += from.triangles;
  to.area += from.area;
  to.volume += from.volume;
  to.product_size += from.product_size;
}

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

/// Each component's first triangle's first vertex.
std::vector<Point> find_origins(const TriangleMesh& mesh, const EdgeTopology& topology) {
  std::vector<Point> origins;
  for (std::size_t t = 0; t < mesh.triangles.size() && origins.size() < topology.components.size(); ++t)
    if (topology.component_of[t] == origins.size()) origins.push_back(mesh.vertices[mesh.triangles[t][0]]);
  return origins;
}

/// Sums of one chunk of triangles, for the components that are in it.
struct ChunkSums {
  std::vector<std::uint32_t> components;
  std::vector<Sums> sums;
};

/// @param place_of  room for a number for each component, kNowhere in all; so it is left
ChunkSums sum_chunk(const TriangleMesh& mesh, const EdgeTopology& topology, const std::vector<Point>& origins,
                    std::size_t begin, std::size_t end, std::vector<std::uint32_t>& place_of) {
  ChunkSums chunk;
  for (std::size_t t = begin; t < end; ++t) {
    const std::uint32_t component = topology.component_of[t];
    if (place_of[component] == kNowhere) {
      place_of[component] = static_cast<std::uint32_t>(chunk.components.size());
      chunk.components.push_back(component);
      chunk.sums.emplace_back().origin = origins[component];
    }
    const auto& [a, b, c] = mesh.triangles[t];
    add_triangle(chunk.sums[place_of[component]], mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  for (const std::uint32_t component : chunk.components) place_of[component] = kNowhere;
  return chunk;
}

std::vector<Sums> sum_components(const TriangleMesh& mesh, const EdgeTopology& topology) {
  constexpr std::size_t kTrianglesInChunk = 8192;
  const std::vector<Point> origins = find_origins(mesh, topology);
  std::vector<ChunkSums> chunks(chunk_count(mesh.triangles.size(), kTrianglesInChunk));
  parallel_for_workers(chunks.size(), [&] {
    return [&, place_of = std::vector<std::uint32_t>(origins.size(), kNowhere)](std::size_t i) mutable {
      chunks[i] = sum_chunk(mesh, topology, origins, i * kTrianglesInChunk,
                            std::min((i + 1) * kTrianglesInChunk, mesh.triangles.size()), place_of);
    };
  });
  std::vector<Sums> sums(origins.size());
  for (std::size_t c = 0; c < sums.size(); ++c) sums[c].origin = origins[c];
  for (const ChunkSums& chunk : chunks)
    for (std::size_t i = 0; i < chunk.components.size(); ++i) add_sums(sums[chunk.components[i]], chunk.sums[i]);
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
  const BoundingBox ray{p, {p[0], p[1], std::numeric_limits<double>::infinity()}};
  tree.for_each_block_meeting(ray, 0, [&](std::span<const std::uint32_t> block) {
    for (const std::uint32_t t : block) {
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
  parallel_for(components.size(), [&](std::size_t c) {
    components[c] = {sums[c].area, sums[c].volume, safe_volume_sign(sums[c]), {}};
    if (components.size() == 1 || !is_closed[c]) return;
    components[c].around = find_components_around(sums[c].origin, mesh, topology.component_of, is_closed, tree);
    std::erase(components[c].around, static_cast<std::uint32_t>(c));  // it is on this one, not inside
  });
  settle_volume_signs(mesh, topology, sums, components);
  return components;
}

}  // namespace gaussmesh::verify
