#include "field/point_value.h"

#include <cmath>
#include <limits>

#include "core/simd.h"
#include "core/vector_exp.h"

namespace gaussmesh {
namespace {

/// log(phi / c) where no atom counts.
constexpr double kNothing = -700.0;

/// Sums of exp(e_i - e_max), and of that times the offset of the point from the atom.
struct WeightSums {
  double total = 0.0;
  double ux = 0.0, uy = 0.0, uz = 0.0;
};

/// The same, and those of the products of the offsets with that along an axis, and with its square.
struct WeightSumsAlong {
  WeightSums sums;
  Vec3 once{}, twice{};
};

GAUSSMESH_SIMD_CLONES
double largest_of(const double* x, const double* y, const double* z, const double* w, std::size_t n, double d,
                  double px, double py, double pz) {
  double largest = -1e300;
#pragma omp simd reduction(max : largest)
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = px - x[i], uy = py - y[i], uz = pz - z[i];
    const double e = w[i] - d * (ux * ux + uy * uy + uz * uz);
    largest = e > largest ? e : largest;
  }
  return largest;
}

/// Both kinds of sums, by one loop: those along an axis cost a third more.
template <bool kAlong>
[[gnu::always_inline]] inline WeightSumsAlong sum_weights(const double* x, const double* y, const double* z,
                                                          const double* w, std::size_t n, double d, double px,
                                                          double py, double pz, double shift, const double* along,
                                                          double p_along) {
  double total = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
  double once_x = 0.0, once_y = 0.0, once_z = 0.0, twice_x = 0.0, twice_y = 0.0, twice_z = 0.0;
#pragma omp simd reduction(+ : total, sx, sy, sz, once_x, once_y, once_z, twice_x, twice_y, twice_z)
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = px - x[i], uy = py - y[i], uz = pz - z[i];
    const double a = vector_exp(w[i] - d * (ux * ux + uy * uy + uz * uz) - shift);
    total += a;
    sx += a * ux;
    sy += a * uy;
    sz += a * uz;
    if constexpr (kAlong) {
      const double u = p_along - along[i], au = a * u, auu = au * u;
      once_x += au * ux;
      once_y += au * uy;
      once_z += au * uz;
      twice_x += auu * ux;
      twice_y += auu * uy;
      twice_z += auu * uz;
    }
  }
  return {{total, sx, sy, sz}, {once_x, once_y, once_z}, {twice_x, twice_y, twice_z}};
}

GAUSSMESH_SIMD_CLONES
WeightSums weight_sums(const double* x, const double* y, const double* z, const double* w, std::size_t n, double d,
                       double px, double py, double pz, double shift) {
  return sum_weights<false>(x, y, z, w, n, d, px, py, pz, shift, nullptr, 0.0).sums;
}

GAUSSMESH_SIMD_CLONES
WeightSumsAlong weight_sums_along(const double* x, const double* y, const double* z, const double* w, std::size_t n,
                                  double d, double px, double py, double pz, double shift, const double* along,
                                  double p_along) {
  return sum_weights<true>(x, y, z, w, n, d, px, py, pz, shift, along, p_along);
}

/// Whether sums of weights relative to c are numbers: not so far from the surface.
bool is_in_range(const WeightSums& sums) { return sums.total > 1e-100 && sums.total < 1e100; }

/// @param shift  what the exponents of the sums were lowered by
PointValue value_of(const WeightSums& s, double shift, const NearAtoms& atoms, double decay) {
  PointValue result;
  result.value = shift + std::log(s.total);
  const double factor = -2.0 * decay / s.total;
  result.gradient = {factor * s.ux, factor * s.uy, factor * s.uz};
  // The atoms that weigh anything have exponents near the value: w_i and d |u_i|^2 differ by about that. The largest
  // log-weight bounds both.
  const double exponent_size = 2.0 * atoms.w_size + std::abs(result.value) + kFineTruncation;
  const double log_error = 4e-16 * (std::abs(result.value) + 1.0);
  result.error = 1.001 * weight_error(exponent_size, atoms.size()) + log_error;
  return result;
}

}  // namespace

double weight_error(double exponent_size, std::size_t n) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  return 4.0 * kEpsilon * exponent_size + kVectorExpError + kEpsilon * static_cast<double>(n + 4);
}

double largest_exponent(const NearAtoms& atoms, double decay, const Vec3& p) {
  return largest_of(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(), atoms.padded(), decay, p[0], p[1],
                    p[2]);
}

PointValue evaluate(const NearAtoms& atoms, double decay, const Vec3& p) {
  if (atoms.size() == 0) return {kNothing, 0.0, {}};
  const auto sums_with = [&](double shift) {
    return weight_sums(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(), atoms.padded(), decay, p[0],
                       p[1], p[2], shift);
  };
  const WeightSums sums = sums_with(0.0);
  if (is_in_range(sums)) return value_of(sums, 0.0, atoms, decay);
  const double shift = largest_exponent(atoms, decay, p);
  return value_of(sums_with(shift), shift, atoms, decay);
}

LineValue evaluate_along(const NearAtoms& atoms, double decay, const Vec3& p, int axis) {
  LineValue line;
  if (atoms.size() == 0) {
    line.point.value = kNothing;
    return line;
  }
  const double* along = axis == 0 ? atoms.x.data() : axis == 1 ? atoms.y.data() : atoms.z.data();
  const auto sums_with = [&](double shift) {
    return weight_sums_along(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(), atoms.padded(), decay,
                             p[0], p[1], p[2], shift, along, p[axis]);
  };
  double shift = 0.0;
  WeightSumsAlong s = sums_with(shift);
  if (!is_in_range(s.sums)) {
    shift = largest_exponent(atoms, decay, p);
    s = sums_with(shift);
  }
  line.point = value_of(s.sums, shift, atoms, decay);
  // The gradient is the mean of y = -2 d u, and its derivatives are second and third central moments of y.
  const double f = 1.0 / s.sums.total, d = -2.0 * decay;
  const Vec3 mean{f * s.sums.ux, f * s.sums.uy, f * s.sums.uz};
  const double along_mean = mean[axis], along_sq = f * s.once[axis];
  for (int k = 0; k < 3; ++k) {
    const double product = f * s.once[k];
    line.gradient_slope[k] = d * d * (product - along_mean * mean[k]);
    line.gradient_curvature[k] =
        d * d * d * (f * s.twice[k] - 2.0 * along_mean * (product - along_mean * mean[k]) - along_sq * mean[k]);
  }
  line.gradient_slope[axis] -= 2.0 * decay;
  return line;
}

Side side_of(const PointValue& value, const NearAtoms& atoms) {
  if (value.value > value.error) return Side::kInside;
  return std::exp(value.value + value.error) + atoms.tail < 1.0 ? Side::kOutside : Side::kUnknown;
}

}  // namespace gaussmesh
