// Pairs of vertices that are nearly in one place, by a hash table of cubes.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "gaussmesh/error.h"
#include "gaussmesh/measure_mesh.h"
#include "verify/bounding_box.h"
#include "verify/number_text.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool are_near(const Point& a, const Point& b, double distance) {
  const Point way = difference(a, b);
  return dot(way, way) < distance * distance;
}

/// Vertices by cubes of a little more than `distance`, so that those that are near are in cubes that touch.
class CubeTable {
 public:
  CubeTable(const std::vector<Point>& points, double distance)
      : points_(points), heads_(std::bit_ceil(points.size() + 1), kNone), next_(points.size(), kNone) {
    for (const Point& p : points) box_.include(p);
    // Cubes are numbered by whole numbers that doubles hold, however small the distance.
    double extent = 0.0;
    for (int k = 0; k < 3; ++k) extent = std::max(extent, box_.high[k] - box_.low[k]);
    cube_ = std::max(1.0001 * distance, extent * 0x1p-40);
  }

  /// Calls visit(j) for every vertex put in before that may be near vertex i, until it returns false.
  template <class Visit>
  void for_each_around(std::uint32_t i, const Visit& visit) const {
    const Point place = place_of(points_[i]);
    std::array<std::size_t, 27> seen{};  // slots: different cubes may share one
    std::size_t count = 0;
    for (int cube = 0; cube < 27; ++cube) {
      const int dx = cube % 3 - 1, dy = cube / 3 % 3 - 1, dz = cube / 9 - 1;
      const std::size_t slot = slot_of({place[0] + dx, place[1] + dy, place[2] + dz});
      if (std::find(seen.begin(), seen.begin() + count, slot) != seen.begin() + count) continue;
      seen[count++] = slot;
      for (std::uint32_t j = heads_[slot]; j != kNone; j = next_[j])
        if (!visit(j)) return;
    }
  }

  void put(std::uint32_t i) {
    std::uint32_t& head = heads_[slot_of(place_of(points_[i]))];
    next_[i] = head;
    head = i;
  }

 private:
  Point place_of(const Point& p) const {
    Point place{};
    for (int k = 0; k < 3; ++k) place[k] = std::floor((p[k] - box_.low[k]) / cube_);
    return place;
  }

  std::size_t slot_of(const Point& place) const {
    std::uint64_t hash = 0;
    for (const double x : place) {
      hash = (hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(x))) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return hash & (heads_.size() - 1);
  }

  const std::vector<Point>& points_;
  BoundingBox box_;
  double cube_ = 0.0;
  std::vector<std::uint32_t> heads_;  // of each slot's list
  std::vector<std::uint32_t> next_;
};

std::size_t count_short_edges(const TriangleMesh& mesh, double distance) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      if (a != b && are_near(mesh.vertices[a], mesh.vertices[b], distance)) edges.push_back({a, b});
    }
  std::sort(edges.begin(), edges.end());
  return static_cast<std::size_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
}

/// The mean length of the edges at each vertex; 0 where there is none.
std::vector<double> mean_edges(const TriangleMesh& mesh) {
  std::vector<double> sums(mesh.vertices.size(), 0.0);
  std::vector<std::uint32_t> counts(mesh.vertices.size(), 0);
  for (const Triangle& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t ends[2] = {triangle[k], triangle[(k + 1) % 3]};
      const double edge = length(difference(mesh.vertices[ends[0]], mesh.vertices[ends[1]]));
      for (const std::uint32_t v : ends) sums[v] += edge, ++counts[v];
    }
  for (std::size_t v = 0; v < sums.size(); ++v)
    if (counts[v] > 0) sums[v] /= counts[v];
  return sums;
}

}  // namespace

NearVertices find_near_vertices(const TriangleMesh& mesh, double distance) {
  constexpr std::size_t kExamples = 10;
  if (!(distance > 0.0) || std::isinf(distance))
    throw OptionError("distance: expected a number > 0, got '" + text_of(distance) + "'");
  NearVertices result;
  CubeTable table(mesh.vertices, distance);
  const std::vector<double> edges = mean_edges(mesh);
  for (std::uint32_t i = 0; i < mesh.vertices.size() && result.pairs < kMostNearPairs; ++i) {
    table.for_each_around(i, [&](std::uint32_t j) {
      if (!are_near(mesh.vertices[i], mesh.vertices[j], distance)) return true;
      const double edge = std::max(edges[i], edges[j]);
      if (are_near(mesh.vertices[i], mesh.vertices[j], kCrowded * edge)) ++result.crowded;
      result.examples.push_back({j, i});
      if (result.examples.size() >= 8 * kExamples) {
        std::sort(result.examples.begin(), result.examples.end());
        result.examples.resize(kExamples);
      }
      return ++result.pairs < kMostNearPairs;
    });
    table.put(i);
  }
  std::sort(result.examples.begin(), result.examples.end());
  if (result.examples.size() > kExamples) result.examples.resize(kExamples);
  result.short_edges = count_short_edges(mesh, distance);
  return result;
}

}  // namespace gaussmesh
