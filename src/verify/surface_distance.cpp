// How far a mesh is from the exact surface: the feet of its vertices and centroids on it.

#include <algorithm>
#include <array>
#include <cmath>

#include "gaussmesh/check_mesh.h"
#include "verify/atom_tree.h"
#include "verify/morton_order.h"
#include "verify/parallel.h"
#include "verify/surface_feet.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

namespace {

constexpr std::size_t kPointsInRun = 512;  // one run is one thread's work; each starts afresh and has its own result

constexpr double kPrecision = 1e-9;  // A

/// The surface, and how near to it points are expected.
struct Level {
  double decay = 0.0;
  double isovalue = 0.0;
  double reach = 0.0;  // A
};

/// Distances of a run of points, or of all.
struct DistanceSums {
  double max = 0.0;
  double sum = 0.0;
  std::size_t against = 0;  // faces turned against the gradient

  void add(double distance) {
    max = std::max(max, distance);
    sum += distance;
  }
};

/// Calls receive(number, foot, sums) for every point, in parallel. The points are put in an order in which
/// neighbours follow each other, and cut into runs that start afresh, so that the answer does not depend on the
/// threads.
template <class PointOf, class Receive>
DistanceSums sum_over_feet(const AtomTree& tree, const Level& level, std::size_t count, const PointOf& point_of,
                           const Receive& receive) {
  const std::vector<std::uint32_t> order = morton_order(count, point_of);
  std::vector<DistanceSums> parts(chunk_count(count, kPointsInRun));
  parallel_for_chunks(count, kPointsInRun, [&](std::size_t run, std::size_t begin, std::size_t end) {
    const std::size_t size = end - begin;
    std::array<Point, kPointsInRun> starts{};
    std::array<Foot, kPointsInRun> feet;
    for (std::size_t i = 0; i < size; ++i) starts[i] = point_of(order[begin + i]);
    FootFinder(tree, level.decay, level.isovalue, level.reach, kPrecision)
        .find({starts.data(), size}, {feet.data(), size});
    for (std::size_t i = 0; i < size; ++i) receive(order[begin + i], feet[i], parts[run]);
  });
  DistanceSums all;
  for (const DistanceSums& part : parts) {
    all.max = std::max(all.max, part.max);
    all.sum += part.sum;
    all.against += part.against;
  }
  return all;
}

double mean_of(const DistanceSums& sums, std::size_t count) {
  return count == 0 ? 0.0 : sums.sum / static_cast<double>(count);
}

VertexDistance distance_of_vertices(const TriangleMesh& mesh, const AtomTree& tree, double decay, double isovalue) {
  constexpr double kReach = 0.01;  // widths of a Gaussian; vertices farther off, which are few, take the slow path
  const Level level{decay, isovalue, kReach / std::sqrt(decay)};
  const DistanceSums sums = sum_over_feet(
      tree, level, mesh.vertices.size(), [&](std::uint32_t v) { return mesh.vertices[v]; },
      [](std::uint32_t, const Foot& foot, DistanceSums& to) { to.add(foot.distance); });
  return {sums.max, mean_of(sums, mesh.vertices.size())};
}

Point centroid_of(const TriangleMesh& mesh, const Triangle& triangle) {
  Point sum{};
  for (const std::uint32_t vertex : triangle)
    for (int k = 0; k < 3; ++k) sum[k] += mesh.vertices[vertex][k] / 3;
  return sum;
}

bool is_against(const TriangleMesh& mesh, const Triangle& triangle, const Point& gradient) {
  const auto& [a, b, c] = triangle;
  const Point& corner = mesh.vertices[a];
  return dot(cross(difference(mesh.vertices[b], corner), difference(mesh.vertices[c], corner)), gradient) > 0.0;
}

}  // namespace

VertexDistance vertex_distance_to_surface(const TriangleMesh& mesh, const std::vector<Atom>& atoms, double decay,
                                          double isovalue) {
  return distance_of_vertices(mesh, tree_for_surface(atoms, decay, isovalue), decay, isovalue);
}

SurfaceDistance distance_to_surface(const TriangleMesh& mesh, const std::vector<Atom>& atoms, double decay,
                                    double isovalue) {
  constexpr double kReach = 0.25;  // widths of a Gaussian: what the middle of a triangle may be off the surface
  const AtomTree tree = tree_for_surface(atoms, decay, isovalue);
  const VertexDistance vertices = distance_of_vertices(mesh, tree, decay, isovalue);
  const Level level{decay, isovalue, kReach / std::sqrt(decay)};
  const DistanceSums centroids = sum_over_feet(
      tree, level, mesh.triangles.size(), [&](std::uint32_t t) { return centroid_of(mesh, mesh.triangles[t]); },
      [&](std::uint32_t t, const Foot& foot, DistanceSums& to) {
        to.add(foot.distance);
        to.against += is_against(mesh, mesh.triangles[t], foot.gradient);
      });
  return {vertices.max, vertices.mean, centroids.max, mean_of(centroids, mesh.triangles.size()), centroids.against};
}

}  // namespace gaussmesh
