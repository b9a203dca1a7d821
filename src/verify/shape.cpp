#include "verify/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "verify/lanes.h"
#include "verify/vector3.h"

namespace gaussmesh::verify {
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

/// The slow way, for triangles of any shape.
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

constexpr std::size_t kBatch = 64;  // triangles that are measured together

template <class T>
using Each = std::array<T, kBatch>;

/// Corners of the triangles of a batch: x, y, z of the first ones, of the second, of the third.
using Corners = std::array<Each<double>, 9>;

/// What the triangles of a batch are measured by.
struct Batch {
  Each<double> sine{};                    // of any of a triangle's angles, times the lengths of the sides there
  std::array<Each<double>, 3> cosines{};  // of its angles, times the same
  Each<double> least_cosine{}, most_cosine{};
  Each<double> shortest{}, longest{}, sum_of_edges{};
};

/// Sums over batches, of the triangles in the same place. `at_least` counts angles of at least (i + 1) 10 degrees,
/// or ratios of at least (i + 1) / 20.
struct BatchSums {
  Each<double> min_angle{}, min_cotangent{}, sum_min_angle{}, sum_edge_ratio{}, min_edge{}, max_edge{}, sum_edges{};
  std::array<std::int64_t, std::tuple_size_v<AngleHistogram> - 1> angle_at_least{};
  std::array<std::int64_t, std::tuple_size_v<RatioHistogram> - 1> ratio_at_least{};
  std::int64_t under_30_deg = 0;
  std::size_t triangles = 0;

  BatchSums() {
    for (Each<double>* least : {&min_angle, &min_cotangent, &min_edge})
      least->fill(std::numeric_limits<double>::infinity());
  }
};

/// Sine and cosine of the limits between the bins of angles.
struct AngleLimits {
  std::array<double, std::tuple_size_v<AngleHistogram> - 1> sine{}, cosine{};

  AngleLimits() {
    for (std::size_t i = 0; i < sine.size(); ++i) {
      const double angle = static_cast<double>(i + 1) * std::numbers::pi / static_cast<double>(sine.size() + 1);
      sine[i] = std::sin(angle);
      cosine[i] = std::cos(angle);
    }
  }
};

/// @return whether the batch has a triangle of which all sides are the same, or two corners in one place: there
///         rounding, or nothing at all, would say what its angles are
GAUSSMESH_LANE_CLONES
bool measure_batch(const Corners& p, Batch& batch) {
  std::int64_t special = 0;
  for (std::size_t i = 0; i < kBatch; ++i) {
    const double abx = p[3][i] - p[0][i], aby = p[4][i] - p[1][i], abz = p[5][i] - p[2][i];
    const double bcx = p[6][i] - p[3][i], bcy = p[7][i] - p[4][i], bcz = p[8][i] - p[5][i];
    const double cax = p[0][i] - p[6][i], cay = p[1][i] - p[7][i], caz = p[2][i] - p[8][i];
    const double ab = std::sqrt(abx * abx + aby * aby + abz * abz);
    const double bc = std::sqrt(bcx * bcx + bcy * bcy + bcz * bcz);
    const double ca = std::sqrt(cax * cax + cay * cay + caz * caz);
    const double shortest = std::min(ab, std::min(bc, ca));
    const double longest = std::max(ab, std::max(bc, ca));
    const double nx = aby * bcz - abz * bcy, ny = abz * bcx - abx * bcz, nz = abx * bcy - aby * bcx;
    const double at_a = -(cax * abx + cay * aby + caz * abz);
    const double at_b = -(abx * bcx + aby * bcy + abz * bcz);
    const double at_c = -(bcx * cax + bcy * cay + bcz * caz);
    batch.sine[i] = std::sqrt(nx * nx + ny * ny + nz * nz);
    batch.cosines[0][i] = at_a;
    batch.cosines[1][i] = at_b;
    batch.cosines[2][i] = at_c;
    batch.least_cosine[i] = std::min(at_a, std::min(at_b, at_c));
    batch.most_cosine[i] = std::max(at_a, std::max(at_b, at_c));
    batch.shortest[i] = shortest;
    batch.longest[i] = longest;
    batch.sum_of_edges[i] = ab + bc + ca;
    special |= std::int64_t{shortest == longest} | std::int64_t{shortest == 0.0};
  }
  return special != 0;
}

/// The smallest angles: those of the points (most_cosine, sine), between 0 and 60 degrees. Above 22.5 they are
/// taken from 45, so that the series of the arc tangent is asked for (tan 22.5)^2 = 0.172 at most; 18 terms leave
/// 4e-16.
GAUSSMESH_LANE_CLONES
void find_smallest_angles(const Batch& batch, Each<double>& angles) {
  constexpr double kTan22 = 0.41421356237309503;
  constexpr int kTerms = 18;
  Each<double> tangent, square, offset;
  for (std::size_t i = 0; i < kBatch; ++i) {
    const double sine = batch.sine[i], cosine = batch.most_cosine[i];
    const bool is_large = sine > kTan22 * cosine;
    tangent[i] = (is_large ? sine - cosine : sine) / (is_large ? sine + cosine : cosine);
    offset[i] = is_large ? std::numbers::pi / 4 : 0.0;
    square[i] = tangent[i] * tangent[i];
    angles[i] = 0.0;
  }
  for (int k = kTerms - 1; k >= 0; --k) {
    const double term = (k % 2 == 0 ? 1.0 : -1.0) / (2 * k + 1);
    for (std::size_t i = 0; i < kBatch; ++i) angles[i] = term + square[i] * angles[i];
  }
  for (std::size_t i = 0; i < kBatch; ++i) angles[i] = offset[i] + tangent[i] * angles[i];
}

GAUSSMESH_LANE_CLONES
void add_sizes(const Batch& batch, const Each<double>& angles, BatchSums& sums) {
  for (std::size_t i = 0; i < kBatch; ++i) {
    sums.sum_min_angle[i] += angles[i];
    sums.min_angle[i] = std::min(sums.min_angle[i], angles[i]);
    sums.min_cotangent[i] = std::min(sums.min_cotangent[i], batch.least_cosine[i] / batch.sine[i]);
    sums.sum_edge_ratio[i] += batch.shortest[i] / batch.longest[i];
    sums.min_edge[i] = std::min(sums.min_edge[i], batch.shortest[i]);
    sums.max_edge[i] = std::max(sums.max_edge[i], batch.longest[i]);
    sums.sum_edges[i] += batch.sum_of_edges[i];
  }
}

/// An angle is at least the limit if sin(angle - limit) >= 0.
GAUSSMESH_LANE_CLONES
void add_counts(const Batch& batch, const AngleLimits& limits, BatchSums& sums) {
  for (std::size_t limit = 0; limit < limits.sine.size(); ++limit) {
    const double sine = limits.sine[limit], cosine = limits.cosine[limit];
    std::int64_t count = 0;
    for (std::size_t i = 0; i < kBatch; ++i) {
      const double least = batch.sine[i] * cosine;
      count += std::int64_t{least >= batch.cosines[0][i] * sine} + std::int64_t{least >= batch.cosines[1][i] * sine} +
               std::int64_t{least >= batch.cosines[2][i] * sine};
    }
    sums.angle_at_least[limit] += count;
  }
  const double sine_30 = limits.sine[2], cosine_30 = limits.cosine[2];
  for (std::size_t i = 0; i < kBatch; ++i)
    sums.under_30_deg += batch.sine[i] * cosine_30 < batch.most_cosine[i] * sine_30;
  const auto bins = static_cast<double>(sums.ratio_at_least.size() + 1);
  for (std::size_t limit = 0; limit < sums.ratio_at_least.size(); ++limit) {
    const auto least = static_cast<double>(limit + 1);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < kBatch; ++i) count += batch.shortest[i] * bins >= least * batch.longest[i];
    sums.ratio_at_least[limit] += count;
  }
  sums.triangles += kBatch;
}

/// Adds counts of values that are at least the limits between the bins.
template <std::size_t N>
void add_to_histogram(const std::array<std::int64_t, N - 1>& at_least, std::size_t count,
                      std::array<std::size_t, N>& histogram) {
  std::size_t above = count;
  for (std::size_t i = 0; i + 1 < N; ++i) {
    const auto next = static_cast<std::size_t>(at_least[i]);
    histogram[i] += above - next;
    above = next;
  }
  histogram[N - 1] += above;
}

void add_batch_sums(ShapeSums& to, const BatchSums& from) {
  for (std::size_t i = 0; i < kBatch; ++i) {
    to.min_angle_deg = std::min(to.min_angle_deg, in_degrees(from.min_angle[i]));
    to.max_angle_deg = std::max(to.max_angle_deg, in_degrees(std::atan2(1.0, from.min_cotangent[i])));
    to.sum_min_angle_deg += in_degrees(from.sum_min_angle[i]);
    to.sum_edge_ratio += from.sum_edge_ratio[i];
    to.min_edge = std::min(to.min_edge, from.min_edge[i]);
    to.max_edge = std::max(to.max_edge, from.max_edge[i]);
    to.sum_edges += from.sum_edges[i];
  }
  to.under_30_deg += static_cast<std::size_t>(from.under_30_deg);
  add_to_histogram(from.angle_at_least, 3 * from.triangles, to.angle_histogram);
  add_to_histogram(from.ratio_at_least, from.triangles, to.ratio_histogram);
}

void set_corners(const TriangleMesh& mesh, std::size_t begin, Corners& corners) {
  for (std::size_t i = 0; i < kBatch; ++i)
    for (int corner = 0; corner < 3; ++corner)
      for (int k = 0; k < 3; ++k) corners[3 * corner + k][i] = mesh.vertices[mesh.triangles[begin + i][corner]][k];
}

ShapeSums sum_chunk(const TriangleMesh& mesh, std::size_t begin, std::size_t end, const AngleLimits& limits) {
  ShapeSums sums;
  BatchSums batch_sums;
  Corners corners;
  Batch batch;
  Each<double> angles;
  for (std::size_t first = begin; first < end; first += kBatch) {
    const std::size_t next = std::min(first + kBatch, end);
    if (next == first + kBatch) {
      set_corners(mesh, first, corners);
      if (!measure_batch(corners, batch)) {
        find_smallest_angles(batch, angles);
        add_sizes(batch, angles, batch_sums);
        add_counts(batch, limits, batch_sums);
        continue;
      }
    }
    for (std::size_t i = first; i < next; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      add_triangle(sums, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    }
  }
  if (batch_sums.triangles > 0) add_batch_sums(sums, batch_sums);
  return sums;
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
  const AngleLimits limits;
#pragma omp parallel for schedule(static)
  for (std::size_t chunk = 0; chunk < chunks; ++chunk)
    parts[chunk] = sum_chunk(mesh, chunk * kTrianglesInChunk,
                             std::min((chunk + 1) * kTrianglesInChunk, mesh.triangles.size()), limits);
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
  check.fraction_under_30_deg = static_cast<double>(sums.under_30_deg) / count;
  check.ratio_histogram = sums.ratio_histogram;
  check.angle_histogram = sums.angle_histogram;
  return check;
}

}  // namespace gaussmesh::verify
