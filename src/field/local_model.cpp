#include "field/local_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simd.h"
#include "core/vector_exp.h"
#include "field/point_value.h"

namespace gaussmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct FirstMoments {
  double total = 0.0, ux = 0.0, uy = 0.0, uz = 0.0;
};

GAUSSMESH_SIMD_CLONES
FirstMoments first_moments(const double* x, const double* y, const double* z, const double* w, double* weight,
                           std::size_t n, double d, const double* m, double shift) {
  const double mx = m[0], my = m[1], mz = m[2];
  double total = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
#pragma omp simd reduction(+ : total, sx, sy, sz)
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = mx - x[i], uy = my - y[i], uz = mz - z[i];
    const double a = vector_exp(w[i] - d * (ux * ux + uy * uy + uz * uz) - shift);
    weight[i] = a;
    total += a;
    sx += a * ux;
    sy += a * uy;
    sz += a * uz;
  }
  return {total, sx, sy, sz};
}

struct CentralMoments {
  double second[6]{};
  double third[10]{};
  double growth = 0.0;
  double remainder = 0.0;
  Vec3 remainder_slope{};
};

/// Moments of y_i = -2 d (centre - x_i), centre = m - v.
GAUSSMESH_SIMD_CLONES
CentralMoments central_moments(const double* x, const double* y, const double* z, const double* weight, std::size_t n,
                               double d, const double* centre, const double* half) {
  const double hx = half[0], hy = half[1], hz = half[2];
  const double cx = centre[0], cy = centre[1], cz = centre[2], f = 2.0 * d;
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  double xxx = 0, yyy = 0, zzz = 0, xxy = 0, xxz = 0, yyx = 0, yyz = 0, zzx = 0, zzy = 0, xyz = 0;
  double growth = 0, remainder = 0, rx = 0, ry = 0, rz = 0;
#pragma omp simd reduction(+ : xx, yy, zz, xy, xz, yz, xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz) \
    reduction(+ : growth, remainder, rx, ry, rz)
  for (std::size_t i = 0; i < n; ++i) {
    const double px = f * (x[i] - cx), py = f * (y[i] - cy), pz = f * (z[i] - cz);
    const double a = weight[i];
    const double ax = a * px, ay = a * py, az = a * pz;
    const double axx = ax * px, ayy = ay * py, azz = az * pz, axy = ax * py;
    xx += axx;
    yy += ayy;
    zz += azz;
    xy += axy;
    xz += ax * pz;
    yz += ay * pz;
    xxx += axx * px;
    yyy += ayy * py;
    zzz += azz * pz;
    xxy += axx * py;
    xxz += axx * pz;
    yyx += ayy * px;
    yyz += ayy * pz;
    zzx += azz * px;
    zzy += azz * py;
    xyz += axy * pz;
    const double sx = std::abs(px), sy = std::abs(py), sz = std::abs(pz);
    const double t = sx * hx + sy * hy + sz * hz;
    const double e = vector_exp(t), upto_second = 1.0 + t * (1.0 + 0.5 * t);
    growth += a * e;
    const double beyond_second = a * (e - upto_second);
    remainder += beyond_second - a * (t * t * t * (1.0 / 6.0));
    rx += beyond_second * sx;
    ry += beyond_second * sy;
    rz += beyond_second * sz;
  }
  return {{xx, yy, zz, xy, xz, yz}, {xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz}, growth, remainder,
          {rx, ry, rz}};
}

/// Half the width of an interval, rounded up to cover it from its rounded middle. Flat is flat: no slack is needed.
double half_width(double lo, double hi, double middle) {
  return lo == hi ? 0.0 : 0.5 * (hi - lo) * (1.0 + 1e-12) + 4e-16 * std::abs(middle);
}

/// Index of the third moment jkl in the order of LocalModel::third_.
constexpr int kThird[3][3][3] = {{{0, 3, 4}, {3, 5, 9}, {4, 9, 7}},
                                 {{3, 5, 9}, {5, 1, 6}, {9, 6, 8}},
                                 {{4, 9, 7}, {9, 6, 8}, {7, 8, 2}}};
constexpr int kSecond[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

/// What belongs to an axis, of a thing that has one value for each.
struct AlongAxis {
  int axis;

  double part(int k) const { return k == axis ? 1.0 : 0.0; }
  template <typename Values>
  double of(const Values& value) const { return value(axis); }
  /// A bound of what belongs to it, of bounds for each axis.
  template <typename Bounds>
  double sum_of(const Bounds& bound) const { return bound(axis); }
  template <typename Ranges>
  Range range_of(const Ranges& range) const { return range(axis); }
};

/// The same for a vector.
struct AlongVector {
  Vec3 n;

  double part(int k) const { return n[k]; }
  template <typename Values>
  double of(const Values& value) const { return n[0] * value(0) + n[1] * value(1) + n[2] * value(2); }
  template <typename Bounds>
  double sum_of(const Bounds& bound) const {
    return std::abs(n[0]) * bound(0) + std::abs(n[1]) * bound(1) + std::abs(n[2]) * bound(2);
  }
  template <typename Ranges>
  Range range_of(const Ranges& range) const {
    Range sum;
    for (int k = 0; k < 3; ++k) {
      const Range part = range(k);
      sum.lo += n[k] * (n[k] > 0.0 ? part.lo : part.hi);
      sum.hi += n[k] * (n[k] > 0.0 ? part.hi : part.lo);
    }
    return sum;
  }
};

/// Indices of the third moments that a second one and x, y or z make.
constexpr int kTimes[6][3] = {{0, 3, 4}, {5, 1, 6}, {7, 8, 2}, {3, 5, 9}, {4, 9, 7}, {9, 6, 8}};

}  // namespace

LocalModel::LocalModel(const NearAtoms& atoms, double decay, const Box& box)
    : decay_(decay), box_(box), tail_(atoms.tail), tail_slope_(atoms.tail_slope) {
  const std::size_t n = atoms.size();
  for (int k = 0; k < 3; ++k) {
    middle_[k] = 0.5 * (box.lo[k] + box.hi[k]);
    half_[k] = half_width(box.lo[k], box.hi[k], middle_[k]);
  }
  if (n == 0) return;
  empty_ = false;

  atoms_lo_ = atoms.lo;
  atoms_hi_ = atoms.hi;

  thread_local std::vector<double> weight;
  const std::size_t padded = atoms.padded();
  weight.resize(std::max(weight.size(), padded));
  const auto moments_with = [&](double shift) {
    return first_moments(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(), weight.data(), padded, decay,
                         middle_.data(), shift);
  };
  double shift = 0.0;
  FirstMoments first = moments_with(shift);
  if (!(first.total > 1e-100 && first.total < 1e100)) {  // far from the surface: keep the exponents in range
    shift = largest_exponent(atoms, decay, middle_);
    first = moments_with(shift);
  }
  const double inverse = 1.0 / first.total;
  psi_ = shift + std::log(first.total);
  mean_offset_ = {first.ux * inverse, first.uy * inverse, first.uz * inverse};
  const Vec3 centre = {middle_[0] - mean_offset_[0], middle_[1] - mean_offset_[1], middle_[2] - mean_offset_[2]};
  const CentralMoments moments = central_moments(atoms.x.data(), atoms.y.data(), atoms.z.data(), weight.data(), padded,
                                                 decay, centre.data(), half_.data());
  for (int i = 0; i < 6; ++i) second_[i] = moments.second[i] * inverse;
  for (int i = 0; i < 10; ++i) third_[i] = moments.third[i] * inverse;
  relative_error_ = 2.0 * weight_error(2.0 * atoms.w_size + std::abs(psi_) + kFineTruncation, n) + 1e-14;
  growth_ = std::max(1.0, moments.growth * inverse) * (1.0 + 1e-6);
  log_growth_ = std::log(growth_);
  // Rounding of exp(z) - 1 - ... is absolute: a few ulp of exp(z).
  const double lost = 16.0 * relative_error_ * growth_;
  double farthest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double far_k = std::max(std::abs(atoms_hi_[k] - centre[k]), std::abs(atoms_lo_[k] - centre[k]));
    farthest += far_k * half_[k];
    slope_size_ += 2.0 * decay * far_k;
  }
  remainder_ = moments.remainder * inverse * (1.0 + 1e-6) + lost;
  for (int k = 0; k < 3; ++k) {
    remainder_slope_[k] = moments.remainder_slope[k] * inverse * (1.0 + 1e-6) + lost * slope_size_;
  }
  // Beyond this the exponential was clamped.
  usable_ = 2.0 * decay * farthest < 600.0 && relative_error_ < 1e-3;
}

LocalModel::View LocalModel::over(const Box& part) const { return View(*this, part); }
LocalModel::View LocalModel::over_all() const { return View(*this, box_); }

LocalModel::View::View(const LocalModel& model, const Box& part) : model_(model) {
  double lambda = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double middle = 0.5 * (part.lo[k] + part.hi[k]);
    t_[k] = middle - model.middle_[k];
    s_[k] = half_width(part.lo[k], part.hi[k], middle);
    if (model.half_[k] > 0.0) lambda = std::max(lambda, (std::abs(t_[k]) + s_[k]) / model.half_[k]);
  }
  lambda = std::min(1.0, lambda * (1.0 + 1e-12));

  const double* second = model.second_;
  const double* third = model.third_;
  std::copy(second, second + 6, g2_);
  const double x = t_[0], y = t_[1], z = t_[2];
  if (x != 0.0 || y != 0.0 || z != 0.0) {
    double third_t[6];   // the third moments times t, by the indices of second_
    for (int i = 0; i < 6; ++i) third_t[i] = third[kTimes[i][0]] * x + third[kTimes[i][1]] * y + third[kTimes[i][2]] * z;
    double half[6], sixth[6];
    for (int i = 0; i < 6; ++i) {
      g2_[i] += third_t[i];
      half[i] = second[i] + 0.5 * third_t[i];
      sixth[i] = 0.5 * second[i] + third_t[i] / 6.0;
    }
    g1_ = {half[0] * x + half[3] * y + half[4] * z, half[3] * x + half[1] * y + half[5] * z,
           half[4] * x + half[5] * y + half[2] * z};
    g_ += sixth[0] * x * x + sixth[1] * y * y + sixth[2] * z * z +
          2.0 * (sixth[3] * x * y + sixth[4] * x * z + sixth[5] * y * z);
  }
  const double sx = s_[0], sy = s_[1], sz = s_[2];
  const auto size = [](double v) { return std::abs(v); };
  sum1_ = size(g1_[0]) * sx + size(g1_[1]) * sy + size(g1_[2]) * sz;
  sum2_ = size(g2_[0]) * sx * sx + size(g2_[1]) * sy * sy + size(g2_[2]) * sz * sz +
          2.0 * (size(g2_[3]) * sx * sy + size(g2_[4]) * sx * sz + size(g2_[5]) * sy * sz);
  sum3_ = size(third[0]) * sx * sx * sx + size(third[1]) * sy * sy * sy + size(third[2]) * sz * sz * sz +
          3.0 * (size(third[3]) * sx * sx * sy + size(third[4]) * sx * sx * sz + size(third[5]) * sy * sy * sx +
                 size(third[6]) * sy * sy * sz + size(third[7]) * sz * sz * sx + size(third[8]) * sz * sz * sy) +
          6.0 * size(third[9]) * sx * sy * sz;
  // Rounding errors of the moments are part of the remainders; they do not shrink with the part.
  const double lost = 16.0 * model.relative_error_ * model.growth_;
  const double cube = lambda * lambda * lambda;
  remainder_ = cube * lambda * model.remainder_ + lost;
  for (int k = 0; k < 3; ++k) remainder_slope_[k] = cube * model.remainder_slope_[k] + lost * model.slope_size_;
}

double LocalModel::View::middle_value() const {
  double value = model_.psi_ + (g_ > 0.0 && g_ != 1.0 ? std::log(g_) : 0.0);
  for (int k = 0; k < 3; ++k) value -= model_.decay_ * t_[k] * (2.0 * model_.mean_offset_[k] + t_[k]);
  return value;
}

Vec3 LocalModel::View::middle_gradient() const {
  Vec3 gradient;
  for (int k = 0; k < 3; ++k) gradient[k] = g1_[k] / g_ - 2.0 * model_.decay_ * (model_.mean_offset_[k] + t_[k]);
  return gradient;
}

double LocalModel::View::middle_curvature(int axis) const {
  const double slope = g1_[axis] / g_;
  return g2_[axis] / g_ - slope * slope - 2.0 * model_.decay_;
}

double LocalModel::View::middle_third(int axis) const {
  const double slope = g1_[axis] / g_;
  return model_.third_[axis] / g_ - slope * (3.0 * g2_[axis] / g_ - 2.0 * slope * slope);
}

Range LocalModel::View::value() const {
  const double d = model_.decay_;
  if (model_.empty_) return {-kInfinity, std::log(model_.tail_) + 1e-15};
  if (!model_.usable_) return {-kInfinity, kInfinity};
  // Jensen: g >= 1; and g <= growth_. The rest is a quadratic polynomial, bounded axis by axis.
  double plain_lo = model_.psi_, plain_hi = model_.psi_ + model_.log_growth_;
  double size = std::abs(model_.psi_) + 1.0;
  for (int k = 0; k < 3; ++k) {
    const double v = model_.mean_offset_[k], a = t_[k] - s_[k], b = t_[k] + s_[k];
    const double at_a = -d * a * (2.0 * v + a), at_b = -d * b * (2.0 * v + b);
    plain_lo += std::min(at_a, at_b);
    plain_hi += (a < -v && -v < b) ? d * v * v : std::max(at_a, at_b);
    size += std::abs(at_a) + std::abs(at_b);
  }
  double lo = plain_lo, hi = plain_hi;
  if (g_ > 0.5) {
    const double middle = middle_value();
    double linear = 0.0, quadratic_lo = 0.0, quadratic_hi = 0.0;
    for (int j = 0; j < 3; ++j) {
      linear += std::abs(g1_[j] / g_ - 2.0 * d * (model_.mean_offset_[j] + t_[j])) * s_[j];
      const double diagonal = (0.5 * g2_[j] / g_ - d) * s_[j] * s_[j];
      (diagonal < 0.0 ? quadratic_lo : quadratic_hi) += diagonal;
      for (int k = j + 1; k < 3; ++k) {
        const double mixed = std::abs(g2_[kSecond[j][k]]) / g_ * s_[j] * s_[k];
        quadratic_lo -= mixed;
        quadratic_hi += mixed;
      }
    }
    const double rest = (sum3_ / 6.0 + remainder_) / g_;
    const double change = (sum1_ + 0.5 * sum2_) / g_ + rest;  // |g / g(t) - 1| in the part
    hi = std::min(hi, middle + linear + quadratic_hi + rest);
    if (change < 0.7) {
      // log(1 + x) >= x - x^2 / (2 (1 - |x|))
      lo = std::max(lo, middle - linear + quadratic_lo - rest - 0.5 * change * change / (1.0 - change));
    }
  }
  const double rounding = model_.relative_error_ + 1e-15 * size;
  hi += rounding;
  // Atoms left out add up to tail_ to phi / c, which raises its logarithm by no more than tail_ where phi > c, and by no
  // more than tail_ / p where phi > p c.
  if (model_.tail_ > 0.0) {
    hi = hi > 0.0      ? hi + model_.tail_
         : hi > -0.125 ? hi + 1.134 * model_.tail_
                       : std::log(std::exp(hi) + model_.tail_) + 1e-15;
  }
  return {lo - rounding, hi};
}

template <typename Along>
Range LocalModel::View::slope_of(const Along& along) const {
  const double d = model_.decay_;
  if (model_.empty_ || model_.tail_ > 0.01) return {-kInfinity, kInfinity};
  // Atoms left out: |phi_k / c| changes by tail_slope_, and phi of the others is at least c (1 - tail_) where phi = c.
  const double omitted = along.sum_of([&](int) { return 1.02 * model_.tail_slope_; });
  // All atoms on one side: dpsi/dx = -2 d E[x - x_i].
  const auto middle = [&](int k) { return model_.middle_[k] + t_[k]; };
  Range one_sided = along.range_of([&](int k) {
    return Range{-2.0 * d * (middle(k) + s_[k] - model_.atoms_lo_[k]),
                 -2.0 * d * (middle(k) - s_[k] - model_.atoms_hi_[k])};
  });
  one_sided = {one_sided.lo - omitted, one_sided.hi + omitted};
  if (!model_.usable_) return one_sided;
  const auto centre = [&](int k) { return model_.mean_offset_[k] + t_[k]; };
  const double c = along.of(centre), reach = along.sum_of([&](int k) { return s_[k]; });
  // Q = dg/dx - 2 d (v + x) g has the sign of dpsi/dx; its Taylor coefficients at t_.
  const double q0 = along.of([&](int k) { return g1_[k]; }) - 2.0 * d * c * g_;
  double linear = 0.0, quadratic = 0.0;
  for (int l = 0; l < 3; ++l) {
    const double part_l = along.part(l);
    const double second = along.of([&](int k) { return g2_[kSecond[k][l]]; });
    linear += std::abs(second - 2.0 * d * (part_l * g_ + c * g1_[l])) * s_[l];
    for (int m = l; m < 3; ++m) {
      const double both = l == m ? 1.0 : 2.0;
      const double third = along.of([&](int k) { return model_.third_[kThird[k][l][m]]; });
      quadratic += both *
                   std::abs(third - 2.0 * d * (part_l * g1_[m] + along.part(m) * g1_[l] + c * g2_[kSecond[l][m]])) *
                   s_[l] * s_[m];
    }
  }
  const double cubic = d * reach * sum2_ + d / 3.0 * (std::abs(c) + reach) * sum3_;
  const double rest = along.sum_of([&](int k) { return remainder_slope_[k]; }) +
                      2.0 * d * (std::abs(c) + reach) * remainder_;
  const double rounding = 16.0 * model_.relative_error_ * 2.0 * d *
                          along.sum_of([&](int k) { return std::abs(centre(k)) + s_[k]; });
  const double spread = linear + 0.5 * quadratic + cubic + rest + rounding;
  Range range{q0 - spread - omitted * model_.growth_, q0 + spread + omitted * model_.growth_};
  range.lo = std::max(range.lo, one_sided.lo);
  range.hi = std::min(range.hi, one_sided.hi);
  return range;
}

Range LocalModel::View::slope(int axis) const { return slope_of(AlongAxis{axis}); }

Range LocalModel::View::slope(const Direction& direction) const {
  return direction.is_slanted() ? slope_of(AlongVector{direction.vector()}) : slope(direction.axis);
}

}  // namespace gaussmesh
