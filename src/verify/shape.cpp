#include "verify/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "verify/vector3.h"

namespace gaussmesh {
namespace {

constexpr std::size_t kTrianglesInChunk = 8192;

/// Sums over one chunk of triangles.
struct ShapeSums {
  double min_angle_deg = std::numeric_limits<double>::infinity();
  double max_angle_deg = 0.0;
  double sum_min_angle_deg = 0.0;
  double sum_edge_ratio = 0.0;
  double min_edge = std::numeric_limits<double>::infinity();
  double max_edge = 0.0;
  double sum_edges = 0.0;
  std::size_t under_30_deg = 0;
  RatioHistogram ratio_histogram{};
  AngleHistogram angle_histogram{};
};

double in_degrees(double angle) { return angle * (180 / std::numbers::pi); }

template <std::size_t N>
void count_in(std::array<std::size_t, N>& histogram, double value, double range) {
  const auto bin = static_cast<std::size_t>(value / range * static_cast<double>(N));
  ++histogram[std::min(bin, N - 1)];
}

/// Angles of a triangle with the sides ab, bc, ca: smallest, middle, largest. The smallest and the largest come
/// from sine and cosine together, which loses nothing in needles; the third is what is left.
std::array<double, 3> angles_deg(const std::array<Point, 3>& sides, const std::array<double, 3>& lengths) {
  const auto shortest = std::min_element(lengths.begin(), lengths.end()) - lengths.begin();
  const auto longest = std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
  if (lengths[longest] == 0.0) return {0, 0, 180};
  if (shortest == longest) return {60, 60, 60};
  const double sine = length(cross(sides[0], sides[1]));
  const auto across = [&](std::ptrdiff_t side) {  // the angle between the two other sides
    return in_degrees(std::atan2(sine, -dot(sides[(side + 1) % 3], sides[(side + 2) % 3])));
  };
  const double smallest = across(shortest);
  const double largest = across(longest);
  return {smallest, std::max(0.0, 180 - smallest - largest), largest};
}

void add_triangle(ShapeSums& sums, const Point& a, const Point& b, const Point& c) {
  const std::array<Point, 3> sides{difference(b, a), difference(c, b), difference(a, c)};
  std::array<double, 3> lengths{};
  for (int k = 0; k < 3; ++k) lengths[k] = length(sides[k]);
  const auto [shortest, longest] = std::minmax({lengths[0], lengths[1], lengths[2]});
  sums.min_edge = std::min(sums.min_edge, shortest);
  sums.max_edge = std::max(sums.max_edge, longest);
  sums.sum_edges += lengths[0] + lengths[1] + lengths[2];
  const double ratio = longest > 0.0 ? shortest / longest : 0.0;
  sums.sum_edge_ratio += ratio;
  count_in(sums.ratio_histogram, ratio, 1.0);

  const std::array<double, 3> angles = angles_deg(sides, lengths);
  sums.min_angle_deg = std::min(sums.min_angle_deg, angles[0]);
  sums.max_angle_deg = std::max(sums.max_angle_deg, angles[2]);
  sums.sum_min_angle_deg += angles[0];
  sums.under_30_deg += angles[0] < 30.0;
  for (const double angle : angles) count_in(sums.angle_histogram, angle, 180.0);
}

void add_sums(ShapeSums& to, const ShapeSums& from) {
  to.min_angle_deg = std::min(to.min_angle_deg, from.min_angle_deg);
  to.max_angle_deg = std::max(to.max_angle_deg, from.max_angle_deg);
  to.sum_min_angle_deg += from.sum_min_angle_deg;
  to.sum_edge_ratio += from.sum_edge_ratio;
  to.min_edge = std::min(to.min_edge, from.min_edge);
  to.max_edge = std::max(to.max_edge, from.max_edge);
  to.sum_edges += from.sum_edges;
  to.under_30_deg += from.under_30_deg;
  for (std::size_t i = 0; i < to.ratio_histogram.size(); ++i) to.ratio_histogram[i] += from.ratio_histogram[i];
  for (std::size_t i = 0; i < to.angle_histogram.size(); ++i) to.angle_histogram[i] += from.angle_histogram[i];
}

ShapeSums sum_shapes(const TriangleMesh& mesh) {
  const std::size_t chunks = (mesh.triangles.size() + kTrianglesInChunk - 1) / kTrianglesInChunk;
  std::vector<ShapeSums> parts(chunks);
#pragma omp parallel for
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t end = std::min((chunk + 1) * kTrianglesInChunk, mesh.triangles.size());
    for (std::size_t t = chunk * kTrianglesInChunk; t < end; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      add_triangle(parts[chunk], mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    }
  }
  ShapeSums all;
  for (const ShapeSums& part : parts) add_sums(all, part);
  return all;
}

}  // namespace

MeshCheck measure_shape(const TriangleMesh& mesh) {
  MeshCheck check;
  if (mesh.triangles.empty()) return check;
  const ShapeSums sums = sum_shapes(mesh);
  const auto count = static_cast<double>(mesh.triangles.size());
  check.min_angle_deg = sums.min_angle_deg;
  check.max_angle_deg = sums.max_angle_deg;
  check.mean_min_angle_deg = sums.sum_min_angle_deg / count;
  check.mean_edge_ratio = sums.sum_edge_ratio / count;
  check.min_edge = sums.min_edge;
  check.mean_edge = sums.sum_edges / (3 * count);
  check.max_edge = sums.max_edge;
  check.under_30_deg = static_cast<double>(sums.under_30_deg) / count;
  check.ratio_histogram = sums.ratio_histogram;
  check.angle_histogram = sums.angle_histogram;
  return check;
}

}  // namespace gaussmesh
