#include "boxes/brick_tables.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/vector_exp.h"

namespace gaussmesh {
namespace {

/// Atoms that are summed up at once: their tables stay in the cache.
constexpr std::size_t kBlock = 256;

/// A sum of products of three exponentials and a weight, each with a few roundings, over up to 1e6 atoms.
constexpr double kSumError = 1e-9;

/// Weights up to e^600 and three factors down to e^-700 each: what is cut off there is below this.
constexpr double kUnderflow = 1e-30;
constexpr double kLargestExponent = 600.0;

/// result[j] += sum of weight a[j], rows of `table` for j = 0 .. 8.
GAUSSMESH_SIMD_CLONES
void add_products(const double* weight, const double* table, std::size_t n, double* result) {
  const double *t0 = table, *t1 = t0 + kBlock, *t2 = t1 + kBlock, *t3 = t2 + kBlock, *t4 = t3 + kBlock,
               *t5 = t4 + kBlock, *t6 = t5 + kBlock, *t7 = t6 + kBlock, *t8 = t7 + kBlock;
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0, s8 = 0;
#pragma omp simd reduction(+ : s0, s1, s2, s3, s4, s5, s6, s7, s8)
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
  }
  const double sums[] = {s0, s1, s2, s3, s4, s5, s6, s7, s8};
  for (int j = 0; j <= kBrickCells; ++j) result[j] += sums[j];
}

GAUSSMESH_SIMD_CLONES
void multiply(const double* a, const double* b, std::size_t n, double* result) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) result[i] = a[i] * b[i];
}

/// exp(-d (x^2 - x0^2)) for the distances x of coordinates p from a plane and x0 from the brick's interval; x >= x0.
GAUSSMESH_SIMD_CLONES
void fill_plane(const double* p, std::size_t n, double d, double brick_lo, double brick_hi, double plane, double* at) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double below = brick_lo - p[i], above = p[i] - brick_hi;
    const double outside = below > above ? below : above;
    const double x0 = outside > 0.0 ? outside : 0.0;
    const double x = p[i] - plane;
    at[i] = vector_exp(-d * (x * x - x0 * x0));
  }
}

/// The same for the least and the largest distance from the layer between two planes, from what fill_plane() gave for them.
GAUSSMESH_SIMD_CLONES
void fill_layer(const double* p, std::size_t n, double lo, double hi, const double* at_lo, const double* at_hi,
                double* nearest, double* farthest) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double more = at_lo[i] > at_hi[i] ? at_lo[i] : at_hi[i];
    farthest[i] = at_lo[i] > at_hi[i] ? at_hi[i] : at_lo[i];
    nearest[i] = ((p[i] >= lo) & (p[i] <= hi)) ? 1.0 : more;
  }
}

double gap(double p, double lo, double hi) { return std::max(0.0, std::max(lo - p, p - hi)); }

}  // namespace

void BrickTables::build(const NearAtoms& atoms, double decay, const Planes& planes) {
  cells_.fill(0xFF);
  corners_.fill(Side::kUnknown);
  constexpr std::size_t kSums = static_cast<std::size_t>(kRows) * kCorners;
  for (std::vector<double>* sums : {&upper_, &lower_, &value_}) sums->assign(kSums, 0.0);
  weight_.resize(kBlock);
  layer_weight_.resize(kBlock);
  factor_.resize(kBlock);
  for (int k = 0; k < 3; ++k) {
    for (Table* table : {&near_[k], &far_[k], &at_[k]}) table->resize(kCorners * kBlock);
  }

  // Rounding of an exponent: some ulp of the log-weight and of d times the squares of distances, in the sums below and in
  // the tables.
  double largest_sq = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double reach = std::max(std::abs(planes[k].back() - atoms.lo[k]), std::abs(atoms.hi[k] - planes[k].front()));
    largest_sq += reach * reach;
  }
  const double slack = atoms.size() > 0 ? 1e-14 * (atoms.w_size + decay * largest_sq) + 1e-12 : 0.0;
  for (std::size_t first = 0; first < atoms.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, atoms.padded() - first);
    for (std::size_t i = 0; i < count; ++i) {
      double exponent = atoms.w[first + i];
      const double p[3] = {atoms.x[first + i], atoms.y[first + i], atoms.z[first + i]};
      for (int k = 0; k < 3; ++k) {
        const double g = gap(p[k], planes[k].front(), planes[k].back());
        exponent -= decay * g * g;
      }
      if (exponent > kLargestExponent) return;  // products would overflow: nothing is known of the cells
      weight_[i] = exponent;
    }
    for (std::size_t i = 0; i < count; ++i) weight_[i] = vector_exp(weight_[i]);
    add_block(atoms, decay, planes, first, count);
  }

  const double raise = std::exp(slack) * (1.0 + kSumError), lower = std::exp(-slack) * (1.0 - kSumError);
  for (int k = 0; k < kCorners; ++k) {
    for (int j = 0; j < kCorners; ++j) {
      const int row = j + kCorners * k;
      for (int i = 0; i < kCorners; ++i) {
        const double value = value_[row * kCorners + i];
        Side& side = corners_[row * kCorners + i];
        if (value * lower - kUnderflow > 1.0) side = Side::kInside;
        if (value * raise + kUnderflow + atoms.tail < 1.0) side = Side::kOutside;
      }
      if (j == kBrickCells || k == kBrickCells) continue;
      unsigned bits = 0;
      for (int i = 0; i < kBrickCells; ++i) {
        const bool outside = upper_[row * kCorners + i] * raise + kUnderflow + atoms.tail < 1.0;
        const bool inside = lower_[row * kCorners + i] * lower - kUnderflow > 1.0;
        bits |= unsigned{!outside && !inside} << i;
      }
      cells_[j + kBrickCells * k] = static_cast<std::uint8_t>(bits);
    }
  }
}

void BrickTables::add_block(const NearAtoms& atoms, double decay, const Planes& planes, std::size_t first,
                            std::size_t count) {
  const double* centres[3] = {atoms.x.data() + first, atoms.y.data() + first, atoms.z.data() + first};
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < kCorners; ++j) {
      fill_plane(centres[k], count, decay, planes[k].front(), planes[k].back(), planes[k][j],
                 at_[k].data() + j * kBlock);
    }
    for (int j = 0; j < kBrickCells; ++j) {
      fill_layer(centres[k], count, planes[k][j], planes[k][j + 1], at_[k].data() + j * kBlock,
                 at_[k].data() + (j + 1) * kBlock, near_[k].data() + j * kBlock, far_[k].data() + j * kBlock);
    }
  }
  const auto sum_up = [&](const Table* tables, int rows, std::vector<double>& sums) {
    for (int k = 0; k < rows; ++k) {
      multiply(weight_.data(), tables[2].data() + k * kBlock, count, layer_weight_.data());
      for (int j = 0; j < rows; ++j) {
        multiply(layer_weight_.data(), tables[1].data() + j * kBlock, count, factor_.data());
        add_products(factor_.data(), tables[0].data(), count, sums.data() + (j + kCorners * k) * kCorners);
      }
    }
  };
  sum_up(near_, kBrickCells, upper_);  // the row behind the last layer is never filled nor looked at
  sum_up(far_, kBrickCells, lower_);
  sum_up(at_, kCorners, value_);
}

}  // namespace gaussmesh
