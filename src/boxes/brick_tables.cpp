#include "boxes/brick_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/simd.h"
#include "core/vector_exp.h"
#include "core/vectors.h"

namespace gaussmesh {
namespace {

constexpr int kPlanes = BrickTables::kPlanes;

/// Atoms that are summed up at once: their tables stay in the cache.
constexpr std::size_t kBlock = 256;

/// Sums are taken to be at least this: weights up to e^600 and three factors down to e^-700 each lose 1e-30 at most.
constexpr double kLeastSum = 1e-20;
constexpr double kLargestExponent = 600.0;

/// result[i] += sum of weight t_i, rows of `table` for the planes i.
GAUSSMESH_SIMD_CLONES
void add_products(const double* weight, const double* table, std::size_t n, double* result) {
  static_assert(kPlanes == 11);
  const double *t0 = table, *t1 = t0 + kBlock, *t2 = t1 + kBlock, *t3 = t2 + kBlock, *t4 = t3 + kBlock,
               *t5 = t4 + kBlock, *t6 = t5 + kBlock, *t7 = t6 + kBlock, *t8 = t7 + kBlock, *t9 = t8 + kBlock,
               *t10 = t9 + kBlock;
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0, s8 = 0, s9 = 0, s10 = 0;
#pragma omp simd reduction(+ : s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10)
  for (std::size_t i = 0; i < n; ++i) {
    const double a = weight[i];
    s0 += a * t0[i];
    s1 += a * t1[i];
    s2 += a * t2[i];
    s3 += a * t3[i];
    s4 += a * t4[i];
    s5 += a * t5[i];
    s6 += a * t6[i];
    s7 += a * t7[i];
    s8 += a * t8[i];
    s9 += a * t9[i];
    s10 += a * t10[i];
  }
  const double sums[] = {s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10};
  for (int j = 0; j < kPlanes; ++j) result[j] += sums[j];
}

GAUSSMESH_SIMD_CLONES
void multiply(const double* a, const double* b, std::size_t n, double* result) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) result[i] = a[i] * b[i];
}

/// exp(-d (x^2 - x0^2)) for the distances x of coordinates p from a plane and x0 from the interval of all planes.
GAUSSMESH_SIMD_CLONES
void fill_plane(const double* p, std::size_t n, double d, double first, double last, double plane, double* at) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double below = first - p[i], above = p[i] - last;
    const double outside = below > above ? below : above;
    const double x0 = outside > 0.0 ? outside : 0.0;
    const double x = p[i] - plane;
    at[i] = vector_exp(-d * (x * x - x0 * x0));
  }
}

GAUSSMESH_SIMD_CLONES
void take_logarithms(double* values, std::size_t n) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) values[i] = vector_log(values[i] > kLeastSum ? values[i] : kLeastSum);
}

/// The bounds by which is_free() judges one cell, for a row of cells along x at once: one by one takes longer (2 % of a
/// raw mesh).
/// @param psi      at the lowest corner of the first cell; neighbours are 1, kPlanes and kPlanes^2 further
/// @param loss     d (3/4) a^2
/// @param largest  by cell, psi at the corner where it is largest
/// @param least    by cell, a bound that psi is not below in it
GAUSSMESH_SIMD_CLONES
void bound_row(const double* psi, double loss, double* largest, double* least) {
  for (int i = 0; i < kBrickCells; ++i) {
    largest[i] = -std::numeric_limits<double>::infinity();
    least[i] = std::numeric_limits<double>::infinity();
  }
  for (int corner = 0; corner < 8; ++corner) {
    const int is_right = corner & 1, is_back = corner >> 1 & 1, is_top = corner >> 2;
    const double* at = psi + is_right + kPlanes * (is_back + kPlanes * is_top);
    const double* behind[3] = {at + (is_right ? 1 : -1), at + (is_back ? kPlanes : -kPlanes),
                               at + (is_top ? kPlanes * kPlanes : -kPlanes * kPlanes)};
#pragma omp simd
    for (int i = 0; i < kBrickCells; ++i) {
      const double x = 0.5 * (at[i] - behind[0][i]) - loss;
      const double y = 0.5 * (at[i] - behind[1][i]) - loss;
      const double z = 0.5 * (at[i] - behind[2][i]) - loss;
      const double bound = at[i] + ((x < 0.0 ? x : 0.0) + (y < 0.0 ? y : 0.0) + (z < 0.0 ? z : 0.0));
      largest[i] = at[i] > largest[i] ? at[i] : largest[i];
      least[i] = bound < least[i] ? bound : least[i];
    }
  }
}

}  // namespace

void BrickTables::build(const NearAtoms& atoms, double decay, const Planes& planes) {
  inside_above_ = std::numeric_limits<double>::infinity();
  outside_below_ = -inside_above_;
  free_above_ = inside_above_;
  grows_below_ = outside_below_;
  cells_.fill(1);
  if (!sum_up(atoms, decay, planes)) return;
  take_logarithms(log_sums_.data(), log_sums_.size());

  // Rounding of an exponent: some ulp of the log-weight and of d times the squares of distances, in the sums above and
  // in the tables; and those of planes, which are not quite evenly spaced.
  double largest_sq = 0.0, largest_coordinate = 0.0, edge = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double reach = std::max(std::abs(planes[k].back() - atoms.lo[k]), std::abs(atoms.hi[k] - planes[k].front()));
    largest_sq += atoms.size() > 0 ? reach * reach : 0.0;
    largest_coordinate = std::max({largest_coordinate, std::abs(planes[k].front()), std::abs(planes[k].back())});
    edge = std::max(edge, planes[k][1] - planes[k][0]);
  }
  const double error = 2.0 * sum_error(atoms.size()) + kVectorLogError + 1e-14 * (atoms.w_size + decay * largest_sq) +
                       1e-12 + 1e-15 * decay * std::sqrt(largest_sq) * largest_coordinate;
  for (int k = 0; k < 3; ++k) origin_[k] = planes[k][1];
  edge_ = edge;
  square_ = decay * edge * edge * (1.0 + 1e-9);
  inside_above_ = error;
  free_above_ = 4.0 * error;
  if (atoms.tail < 1.0) outside_below_ = std::log1p(-atoms.tail) - error;
  // At a point p with phi = c the atoms listed have psi >= log(1 - tail), and grow by (psi(p) - psi - d L^2) / L at
  // least; those left out take away their slope from it.
  if (atoms.tail < 0.05) grows_below_ = outside_below_ - error;
  edge_slope_ = 1.1 * edge * atoms.tail_slope;

  const double cell_outside_below = outside_below_ - 0.75 * square_;
  for (int k = 0; k < kBrickCells; ++k) {
    for (int j = 0; j < kBrickCells; ++j) {
      double largest[kBrickCells], least[kBrickCells];
      bound_row(log_sums_.data() + 1 + kPlanes * ((j + 1) + kPlanes * (k + 1)), 0.75 * square_, largest, least);
      for (int i = 0; i < kBrickCells; ++i) {
        cells_[i + kBrickCells * (j + kBrickCells * k)] =
            !(largest[i] < cell_outside_below) && !(least[i] > free_above_);
      }
    }
  }
}

bool BrickTables::is_crossed(int i, int j, int k) const {
  bool any_inside = false, any_outside = false;
  for (int corner = 0; corner < 8; ++corner) {
    const double psi = *at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
    any_inside = any_inside || psi > inside_above_;
    any_outside = any_outside || psi < outside_below_;
  }
  return any_inside && any_outside;
}

bool BrickTables::is_free(int i, int j, int k, unsigned extent) const {
  const double* lowest = at(i, j, k);
  const auto all_corners = [&](const auto& is_so) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const int offset = (corner & 1 ? kStride[0] : 0) + (corner & 2 ? kStride[1] : 0) + (corner & 4 ? kStride[2] : 0);
      if ((corner & ~extent) == 0 && !is_so(corner, lowest + offset)) return false;
    }
    return true;
  };
  const double loss = 0.75 * square_;
  const auto is_above = [&](unsigned corner, const double* p) {
    double bound = *p;
    for (int n = 0; n < 3; ++n) {
      if (!(extent >> n & 1)) continue;
      const double behind = p[corner >> n & 1 ? kStride[n] : -kStride[n]];
      bound += std::min(0.0, 0.5 * (*p - behind) - loss);
    }
    return bound > free_above_;
  };
  if (*lowest > free_above_) return all_corners(is_above);
  const double below = outside_below_ - 0.25 * square_ * std::popcount(extent);
  return all_corners([&](unsigned, const double* p) { return *p < below; });
}

unsigned BrickTables::directions(int i, int j, int k, unsigned extent) const {
  const double* lowest = at(i, j, k);
  unsigned result = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(extent >> axis & 1)) continue;
    // Corners of what is cut by a plane across the axis: between them psi is larger by d a^2 / 4 at most for each of
    // the other axes.
    const int other[2] = {(axis + 1) % 3, (axis + 2) % 3};
    const int u = extent >> other[0] & 1 ? kStride[other[0]] : 0, v = extent >> other[1] & 1 ? kStride[other[1]] : 0;
    const double base = grows_below_ - 0.25 * square_ * ((u != 0) + (v != 0));
    const double limit[2] = {base - square_ - edge_slope_, base - 4.0 * square_ - 2.0 * edge_slope_};
    const auto is_below = [&](int plane, double below) {
      const double* p = lowest + plane * kStride[axis];
      return p[0] < below && p[u] < below && p[v] < below && p[u + v] < below;
    };
    const bool grows = is_below(0, limit[0]) || is_below(-1, limit[1]);
    const bool falls = is_below(1, limit[0]) || is_below(2, limit[1]);
    result |= unsigned{falls} << (2 * axis) | unsigned{grows} << (2 * axis + 1);
  }
  return result;
}

int BrickTables::steepest_axis(int i, int j, int k) const {
  const double* p = at(i, j, k);
  const int x = kStride[0], y = kStride[1], z = kStride[2];
  const double diagonals[4] = {p[x + y + z] - p[0], p[x + y] - p[z], p[x + z] - p[y], p[x] - p[y + z]};
  const double slopes[3] = {std::abs(diagonals[0] + diagonals[1] + diagonals[2] + diagonals[3]),
                            std::abs(diagonals[0] + diagonals[1] - diagonals[2] - diagonals[3]),
                            std::abs(diagonals[0] - diagonals[1] + diagonals[2] - diagonals[3])};
  return static_cast<int>(std::max_element(slopes, slopes + 3) - slopes);
}

double BrickTables::zero_on_edge(int i, int j, int k, int axis) const {
  const double* p = at(i, j, k);
  const int step = kStride[axis];
  const double before = p[-step], lo = p[0], hi = p[step], after = p[2 * step];
  if ((lo > 0.0) == (hi > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  // Newton's method from the chord, on the cubic through the four.
  const double third = (after - before) / 6.0 + 0.5 * (lo - hi), second = 0.5 * (before + hi) - lo;
  const double first = hi - lo - second - third;
  double t = lo / (lo - hi);
  for (int iteration = 0; iteration < 2; ++iteration) {
    t -= (lo + t * (first + t * (second + t * third))) / (first + t * (2.0 * second + 3.0 * t * third));
  }
  const int at_axis[3] = {i, j, k};
  return origin_[axis] + (at_axis[axis] + t) * edge_;
}

/// S / c at all crossings of planes. False where products would overflow: nothing is known of the cells then.
bool BrickTables::sum_up(const NearAtoms& atoms, double decay, const Planes& planes) {
  log_sums_.fill(0.0);
  for (std::vector<double>* buffer : {&weight_, &layer_weight_, &factor_}) buffer->resize(kBlock);
  for (Table& table : at_) table.resize(kPlanes * kBlock);
  for (std::size_t first = 0; first < atoms.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, atoms.padded() - first);
    for (std::size_t i = 0; i < count; ++i) {
      double exponent = atoms.w[first + i];
      const double p[3] = {atoms.x[first + i], atoms.y[first + i], atoms.z[first + i]};
      for (int k = 0; k < 3; ++k) {
        const double g = gap(p[k], planes[k].front(), planes[k].back());
        exponent -= decay * g * g;
      }
      if (exponent > kLargestExponent) return false;
      weight_[i] = exponent;
    }
    for (std::size_t i = 0; i < count; ++i) weight_[i] = vector_exp(weight_[i]);
    add_block(atoms, decay, planes, first, count);
  }
  return true;
}

void BrickTables::add_block(const NearAtoms& atoms, double decay, const Planes& planes, std::size_t first,
                            std::size_t count) {
  const double* centres[3] = {atoms.x.data() + first, atoms.y.data() + first, atoms.z.data() + first};
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < kPlanes; ++j) {
      fill_plane(centres[k], count, decay, planes[k].front(), planes[k].back(), planes[k][j],
                 at_[k].data() + j * kBlock);
    }
  }
  for (int k = 0; k < kPlanes; ++k) {
    multiply(weight_.data(), at_[2].data() + k * kBlock, count, layer_weight_.data());
    for (int j = 0; j < kPlanes; ++j) {
      multiply(layer_weight_.data(), at_[1].data() + j * kBlock, count, factor_.data());
      add_products(factor_.data(), at_[0].data(), count, log_sums_.data() + (j + kPlanes * k) * kPlanes);
    }
  }
}

}  // namespace gaussmesh
