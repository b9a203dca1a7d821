// The formulas of a local model over a part of its box, written once: for one part, or for one in each SIMD lane.
//
// What they mean is local_model.h; who asks is model_view.cpp.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "core/vector_exp.h"
#include "field/local_model.h"

namespace gaussmesh {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Index of the third moment jkl in the order of LocalModelTerms::third.
inline constexpr int kThird[3][3][3] = {
    {{0, 3, 4}, {3, 5, 9}, {4, 9, 7}}, {{3, 5, 9}, {5, 1, 6}, {9, 6, 8}}, {{4, 9, 7}, {9, 6, 8}, {7, 8, 2}}};
inline constexpr int kSecond[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

/// Indices of the third moments that a second one and x, y or z make.
inline constexpr int kTimes[6][3] = {{0, 3, 4}, {5, 1, 6}, {7, 8, 2}, {3, 5, 9}, {4, 9, 7}, {9, 6, 8}};

/// A range in each lane.
template <typename Real>
struct Ranges {
  Real lo, hi;
};

/// What belongs to an axis, of a thing that has one value for each.
struct AlongAxis {
  int axis;

  GAUSSMESH_SIMD_INLINE double part(int k) const { return k == axis ? 1.0 : 0.0; }
  template <typename Values>
  GAUSSMESH_SIMD_INLINE auto of(const Values& value) const {
    return value(axis);
  }
  /// A bound of what belongs to it, of bounds for each axis.
  template <typename Bounds>
  GAUSSMESH_SIMD_INLINE auto sum_of(const Bounds& bound) const {
    return bound(axis);
  }
  template <typename RangeOf>
  GAUSSMESH_SIMD_INLINE auto range_of(const RangeOf& range) const {
    return range(axis);
  }
};

/// The same for a vector.
struct AlongVector {
  Vec3 n;

  GAUSSMESH_SIMD_INLINE double part(int k) const { return n[k]; }
  template <typename Values>
  GAUSSMESH_SIMD_INLINE auto of(const Values& value) const {
    return n[0] * value(0) + n[1] * value(1) + n[2] * value(2);
  }
  template <typename Bounds>
  GAUSSMESH_SIMD_INLINE auto sum_of(const Bounds& bound) const {
    return std::abs(n[0]) * bound(0) + std::abs(n[1]) * bound(1) + std::abs(n[2]) * bound(2);
  }
  template <typename RangeOf>
  GAUSSMESH_SIMD_INLINE auto range_of(const RangeOf& range) const {
    auto sum = range(0);
    sum = {n[0] * (n[0] > 0.0 ? sum.lo : sum.hi), n[0] * (n[0] > 0.0 ? sum.hi : sum.lo)};
    for (int k = 1; k < 3; ++k) {
      const auto part = range(k);
      sum.lo += n[k] * (n[k] > 0.0 ? part.lo : part.hi);
      sum.hi += n[k] * (n[k] > 0.0 ? part.hi : part.lo);
    }
    return sum;
  }
};

/// The natural logarithm; of four numbers it is off by up to kVectorLogError.
inline double log_of(double x) { return std::log(x); }
GAUSSMESH_SIMD_INLINE Quad log_of(const Quad& x) { return vector_log(x); }
template <typename Real>
constexpr double log_error() {
  return std::is_same_v<Real, Quad> ? kVectorLogError : 0.0;
}

/// Puts the series on the part between two corners. @return how many times the box round the model's middle holds it,
/// at most 1
template <typename Real>
GAUSSMESH_SIMD_INLINE Real place_series(const LocalModelTerms& m, const Real* lo, const Real* hi,
                                        LocalSeries<Real>& q) {
  Real lambda{};
  for (int k = 0; k < 3; ++k) {
    const Real middle = 0.5 * (lo[k] + hi[k]);
    q.t[k] = middle - m.middle[k];
    q.s[k] = half_width(lo[k], hi[k], middle);
    if (m.half[k] > 0.0) lambda = larger_of<Real>(lambda, (size_of(q.t[k]) + q.s[k]) / m.half[k]);
  }
  q.g = spread<Real>(1.0);
  for (int i = 0; i < 6; ++i) q.g2[i] = spread<Real>(m.second[i]);
  return smaller_of<Real>(lambda * (1.0 + 1e-12), spread<Real>(1.0));
}

/// Moves the series from the model's middle to t.
template <typename Real>
GAUSSMESH_SIMD_INLINE void move_series(const LocalModelTerms& m, LocalSeries<Real>& q) {
  const Real x = q.t[0], y = q.t[1], z = q.t[2];
  Real half[6], sixth[6];
  for (int i = 0; i < 6; ++i) {
    // The third moments times t, by the indices of the second ones.
    const Real third_t = m.third[kTimes[i][0]] * x + m.third[kTimes[i][1]] * y + m.third[kTimes[i][2]] * z;
    q.g2[i] += third_t;
    half[i] = m.second[i] + 0.5 * third_t;
    sixth[i] = 0.5 * m.second[i] + third_t * (1.0 / 6.0);
  }
  q.g1[0] = half[0] * x + half[3] * y + half[4] * z;
  q.g1[1] = half[3] * x + half[1] * y + half[5] * z;
  q.g1[2] = half[4] * x + half[5] * y + half[2] * z;
  q.g += sixth[0] * x * x + sixth[1] * y * y + sixth[2] * z * z +
         2.0 * (sixth[3] * x * y + sixth[4] * x * z + sixth[5] * y * z);
}

/// Adds up what the series can change by over the part, and what it leaves out there.
/// @param lambda  what place_series() said
template <typename Real>
GAUSSMESH_SIMD_INLINE void measure_series(const LocalModelTerms& m, const Real& lambda, LocalSeries<Real>& q) {
  const Real sx = q.s[0], sy = q.s[1], sz = q.s[2];
  q.sum1 = size_of(q.g1[0]) * sx + size_of(q.g1[1]) * sy + size_of(q.g1[2]) * sz;
  q.sum2 = size_of(q.g2[0]) * sx * sx + size_of(q.g2[1]) * sy * sy + size_of(q.g2[2]) * sz * sz +
           2.0 * (size_of(q.g2[3]) * sx * sy + size_of(q.g2[4]) * sx * sz + size_of(q.g2[5]) * sy * sz);
  const auto third = [&](int i) { return std::abs(m.third[i]); };
  q.sum3 = third(0) * sx * sx * sx + third(1) * sy * sy * sy + third(2) * sz * sz * sz +
           3.0 * (third(3) * sx * sx * sy + third(4) * sx * sx * sz + third(5) * sy * sy * sx +
                  third(6) * sy * sy * sz + third(7) * sz * sz * sx + third(8) * sz * sz * sy) +
           6.0 * third(9) * sx * sy * sz;
  // Rounding errors of the moments are part of the remainders; they do not shrink with the part.
  const double lost = 16.0 * m.relative_error * m.growth;
  const Real cube = lambda * lambda * lambda;
  q.remainder = cube * lambda * m.remainder + lost;
  for (int k = 0; k < 3; ++k) q.remainder_slope[k] = cube * m.remainder_slope[k] + lost * m.slope_size;
}

/// log(phi / c) at the middle of the part.
/// @param g  that of the series, or what stands for it where that is not above 0
template <typename Real>
GAUSSMESH_SIMD_INLINE Real middle_of(const LocalModelTerms& m, const LocalSeries<Real>& q, const Real& g) {
  Real value = m.psi + log_of(g);
  for (int k = 0; k < 3; ++k) value -= m.decay * q.t[k] * (2.0 * m.mean_offset[k] + q.t[k]);
  return value;
}

/// Component of its gradient there.
template <typename Real>
GAUSSMESH_SIMD_INLINE Real middle_slope(const LocalModelTerms& m, const LocalSeries<Real>& q, const Real& inverse_g,
                                        int k) {
  return q.g1[k] * inverse_g - 2.0 * m.decay * (m.mean_offset[k] + q.t[k]);
}

/// Range of log(phi / c) without the atoms that are left out, for models that are usable.
template <typename Real>
GAUSSMESH_SIMD_INLINE Ranges<Real> range_of_listed(const LocalModelTerms& m, const LocalSeries<Real>& q) {
  const double d = m.decay;
  // Jensen: g >= 1; and g <= growth. The rest is a quadratic polynomial, bounded axis by axis.
  Real plain_lo = spread<Real>(m.psi), plain_hi = spread<Real>(m.psi + m.log_growth);
  Real size = spread<Real>(std::abs(m.psi) + 1.0);
  for (int k = 0; k < 3; ++k) {
    const double v = m.mean_offset[k];
    const Real a = q.t[k] - q.s[k], b = q.t[k] + q.s[k];
    const Real at_a = -d * a * (2.0 * v + a), at_b = -d * b * (2.0 * v + b);
    plain_lo += smaller_of(at_a, at_b);
    plain_hi += select((a < -v) & (b > -v), spread<Real>(d * v * v), larger_of(at_a, at_b));
    size += size_of(at_a) + size_of(at_b);
  }
  // The series, where it is far enough from zero for its logarithm.
  constexpr double kLeast = 0.5, kMostChange = 0.7;
  const Real infinity = spread<Real>(kInfinity), zero{};
  const Real g = larger_of(q.g, spread<Real>(kLeast)), inverse = 1.0 / g;
  const Real middle = middle_of(m, q, g);
  Real linear{}, quadratic_lo{}, quadratic_hi{};
  for (int j = 0; j < 3; ++j) {
    linear += size_of<Real>(middle_slope(m, q, inverse, j)) * q.s[j];
    const Real diagonal = (0.5 * q.g2[j] * inverse - d) * q.s[j] * q.s[j];
    quadratic_lo += smaller_of(diagonal, zero);
    quadratic_hi += larger_of(diagonal, zero);
    for (int k = j + 1; k < 3; ++k) {
      const Real mixed = size_of(q.g2[kSecond[j][k]]) * inverse * q.s[j] * q.s[k];
      quadratic_lo -= mixed;
      quadratic_hi += mixed;
    }
  }
  const Real rest = (q.sum3 * (1.0 / 6.0) + q.remainder) * inverse;
  const Real change = (q.sum1 + 0.5 * q.sum2) * inverse + rest;  // |g / g(t) - 1| in the part
  // log(1 + x) >= x - x^2 / (2 (1 - |x|))
  const Real bend = 0.5 * change * change / (1.0 - smaller_of(change, spread<Real>(kMostChange)));
  const Real hi = select(q.g > kLeast, middle + linear + quadratic_hi + rest, infinity);
  const Real lo =
      select((q.g > kLeast) & (change < kMostChange), middle - linear + quadratic_lo - rest - bend, -infinity);
  // Rounding of psi, of what the mean is off by, and of the arithmetic here.
  Real far{};
  for (int k = 0; k < 3; ++k) far += size_of(q.t[k]) + q.s[k];
  const Real rounding = m.relative_error * (1.0 + m.slope_size * far) + log_error<Real>() + 1e-15 * size;
  return {larger_of(lo, plain_lo) - rounding, smaller_of(hi, plain_hi) + rounding};
}

/// Whether slopes may be asked for: atoms left out must not count where phi = c.
inline bool has_slopes(const LocalModelTerms& m) { return !m.empty && m.tail <= 0.01; }

/// What atoms left out add to |phi_k / c|, where phi of the others is at least c (1 - tail).
inline double omitted_slope(const LocalModelTerms& m) { return 1.02 * m.tail_slope; }

/// What the positions of the atoms alone tell of a slope: dpsi/dx = -2 d E[x - x_i].
template <typename Real, typename Along>
GAUSSMESH_SIMD_INLINE Ranges<Real> one_sided_slope(const LocalModelTerms& m, const LocalSeries<Real>& q,
                                                   const Along& along) {
  const double omitted = along.sum_of([&](int) { return omitted_slope(m); });
  const Ranges<Real> range = along.range_of([&](int k) {
    const Real middle = m.middle[k] + q.t[k];
    return Ranges<Real>{-2.0 * m.decay * (middle + q.s[k] - m.atoms_lo[k]),
                        -2.0 * m.decay * (middle - q.s[k] - m.atoms_hi[k])};
  });
  return {range.lo - omitted, range.hi + omitted};
}

/// Range that has the sign of the slope wherever in the part phi = c, for models that are usable and have slopes.
template <typename Real, typename Along>
GAUSSMESH_SIMD_INLINE Ranges<Real> slope_of(const LocalModelTerms& m, const LocalSeries<Real>& q, const Along& along) {
  const double d = m.decay;
  const auto centre = [&](int k) -> Real { return m.mean_offset[k] + q.t[k]; };
  const Real c = along.of(centre), reach = along.sum_of([&](int k) { return q.s[k]; });
  // Q = dg/dx - 2 d (v + x) g has the sign of dpsi/dx; its Taylor coefficients at t.
  const Real q0 = along.of([&](int k) { return q.g1[k]; }) - 2.0 * d * c * q.g;
  Real linear{}, quadratic{};
  for (int l = 0; l < 3; ++l) {
    const double part_l = along.part(l);
    const Real second = along.of([&](int k) { return q.g2[kSecond[k][l]]; });
    linear += size_of<Real>(second - 2.0 * d * (part_l * q.g + c * q.g1[l])) * q.s[l];
    for (int n = l; n < 3; ++n) {
      const double both = l == n ? 1.0 : 2.0;
      const double third = along.of([&](int k) { return m.third[kThird[k][l][n]]; });
      const Real change = third - 2.0 * d * (part_l * q.g1[n] + along.part(n) * q.g1[l] + c * q.g2[kSecond[l][n]]);
      quadratic += both * size_of(change) * q.s[l] * q.s[n];
    }
  }
  const Real far = size_of(c) + reach;
  const Real cubic = d * reach * q.sum2 + d * (1.0 / 3.0) * far * q.sum3;
  const Real rest = along.sum_of([&](int k) { return q.remainder_slope[k]; }) + 2.0 * d * far * q.remainder;
  const Real rounding = 16.0 * m.relative_error * 2.0 * d *
                        along.sum_of([&](int k) -> Real { return size_of<Real>(centre(k)) + q.s[k]; });
  const double omitted = along.sum_of([&](int) { return omitted_slope(m); }) * m.growth;
  const Real radius = linear + 0.5 * quadratic + cubic + rest + rounding + omitted;
  const Ranges<Real> one_sided = one_sided_slope(m, q, along);
  return {larger_of<Real>(q0 - radius, one_sided.lo), smaller_of<Real>(q0 + radius, one_sided.hi)};
}

/// Whether the model's value in the middle is less than what it changes by over half the part.
template <typename Real>
GAUSSMESH_SIMD_INLINE auto crosses_inner_half(const LocalModelTerms& m, const LocalSeries<Real>& q) {
  const Real g = larger_of(q.g, spread<Real>(0.5)), inverse = 1.0 / g;
  Real reach{};
  for (int k = 0; k < 3; ++k) reach += size_of<Real>(middle_slope(m, q, inverse, k)) * q.s[k];
  return size_of<Real>(middle_of(m, q, g)) < 0.25 * reach;
}

}  // namespace gaussmesh
