// How far a mesh is from the exact surface: Newton's method from every vertex and every centroid.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/error.h"
#include "verify/atom_tree.h"
#include "verify/log_field.h"
#include "verify/morton_order.h"
#include "verify/vector3.h"

namespace gaussmesh {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || std::isinf(value))
    throw OptionError(std::string(what) + ": expected a number > 0, got '" + std::to_string(value) + "'");
}

/// The surface { log phi = log_isovalue }.
struct Level {
  LogField field;
  double log_isovalue = 0.0;
  double width = 0.0;  // 1 / sqrt(decay), of one Gaussian
};

/// Where Newton's method started.
struct Foot {
  double distance = 0.0;  // to the surface; infinite if it was not reached
  Point gradient{};       // of log phi at the start
};

/// Follows the gradient of log phi from `start` to the surface.
///
/// A step may be a quarter of a Gaussian's width long, so as not to leap where the gradient is small; this grows
/// with every step, so that the way from far outside is not long either. A step of size s leaves an error of about
/// s^2 / (2 width) behind, with which it is the last if that is below the precision promised.
Foot find_foot(Level& level, const Point& start) {
  constexpr int kMostSteps = 100;
  constexpr double kPrecision = 1e-8;
  double longest = 0.25 * level.width;
  Point x = start;
  LogValue log_phi = level.field.at(x);
  Foot foot{0.0, log_phi.gradient};
  for (int step = 0; step < kMostSteps; ++step, longest *= 1.5, log_phi = level.field.at(x)) {
    const double slope = length(log_phi.gradient);
    const double wanted = (level.log_isovalue - log_phi.value) / slope;
    if (!std::isfinite(wanted)) break;
    const double taken = std::clamp(wanted, -longest, longest);
    for (int k = 0; k < 3; ++k) x[k] += taken / slope * log_phi.gradient[k];
    const double rounding = 1e-12 * std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    if (taken * taken < kPrecision * level.width || std::abs(taken) < rounding) {
      foot.distance = length(difference(x, start));
      return foot;
    }
  }
  foot.distance = std::numeric_limits<double>::infinity();
  return foot;
}

/// Calls receive(number, foot) for every point, in parallel. The points are put in an order in which neighbours
/// follow each other, and cut into runs that start afresh, so that a foot does not depend on the threads.
template <class PointOf, class Receive>
void find_feet(const AtomTree& tree, double decay, double isovalue, std::size_t count, const PointOf& point_of,
               const Receive& receive) {
  constexpr std::size_t kPointsInRun = 512;
  const std::vector<std::uint32_t> order = morton_order(count, point_of);
  const std::size_t runs = (count + kPointsInRun - 1) / kPointsInRun;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t run = 0; run < runs; ++run) {
    Level level{LogField(tree, decay), std::log(isovalue), 1 / std::sqrt(decay)};
    const std::size_t end = std::min((run + 1) * kPointsInRun, count);
    for (std::size_t i = run * kPointsInRun; i < end; ++i) receive(order[i], find_foot(level, point_of(order[i])));
  }
}

struct MaxAndMean {
  double max = 0.0;
  double mean = 0.0;
};

MaxAndMean max_and_mean(const std::vector<double>& values) {
  MaxAndMean result;
  for (const double value : values) {
    result.max = std::max(result.max, value);
    result.mean += value / static_cast<double>(values.size());
  }
  return result;
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

SurfaceDistance distance_to_surface(const TriangleMesh& mesh, const std::vector<Atom>& atoms, double decay,
                                    double isovalue) {
  require_positive(decay, "decay");
  require_positive(isovalue, "isovalue");
  if (atoms.empty()) throw OptionError("atoms: expected at least one, got 'none'");
  const AtomTree tree(atoms);

  std::vector<double> at_vertices(mesh.vertices.size());
  find_feet(
      tree, decay, isovalue, mesh.vertices.size(), [&](std::uint32_t v) { return mesh.vertices[v]; },
      [&](std::uint32_t v, const Foot& foot) { at_vertices[v] = foot.distance; });

  std::vector<double> at_centroids(mesh.triangles.size());
  std::vector<std::uint8_t> against(mesh.triangles.size());
  find_feet(
      tree, decay, isovalue, mesh.triangles.size(),
      [&](std::uint32_t t) { return centroid_of(mesh, mesh.triangles[t]); },
      [&](std::uint32_t t, const Foot& foot) {
        at_centroids[t] = foot.distance;
        against[t] = is_against(mesh, mesh.triangles[t], foot.gradient);
      });

  const MaxAndMean vertices = max_and_mean(at_vertices);
  const MaxAndMean centroids = max_and_mean(at_centroids);
  const auto faces_against = static_cast<std::size_t>(std::count(against.begin(), against.end(), 1));
  return {vertices.max, vertices.mean, centroids.max, centroids.mean, faces_against};
}

}  // namespace gaussmesh
