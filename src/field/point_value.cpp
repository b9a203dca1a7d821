#include "field/point_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simd.h"
#include "core/vector_exp.h"

namespace gaussmesh {
namespace {

/// Sums of exp(e_i - e_max), and of that times the offset of the point from the atom.
struct WeightSums {
  double total = 0.0;
  double ux = 0.0, uy = 0.0, uz = 0.0;
  double xx = 0.0, xy = 0.0, xz = 0.0;   ///< of the products of the offsets with that along an axis
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

GAUSSMESH_SIMD_CLONES
WeightSums weight_sums(const double* x, const double* y, const double* z, const double* w, std::size_t n, double d,
                       double px, double py, double pz, double shift, const double* along, double p_along) {
  double total = 0.0, sx = 0.0, sy = 0.0, sz = 0.0, sxx = 0.0, sxy = 0.0, sxz = 0.0;
#pragma omp simd reduction(+ : total, sx, sy, sz, sxx, sxy, sxz)
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = px - x[i], uy = py - y[i], uz = pz - z[i];
    const double a = vector_exp(w[i] - d * (ux * ux + uy * uy + uz * uz) - shift);
    total += a;
    sx += a * ux;
    sy += a * uy;
    sz += a * uz;
    const double au = a * (p_along - along[i]);
    sxx += au * ux;
    sxy += au * uy;
    sxz += au * uz;
  }
  return {total, sx, sy, sz, sxx, sxy, sxz};
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
  return evaluate_along(atoms, decay, p, 0).point;
}

LineValue evaluate_along(const NearAtoms& atoms, double decay, const Vec3& p, int axis) {
  const std::size_t n = atoms.size();
  LineValue line;
  PointValue& result = line.point;
  if (n == 0) {
    result.value = -700.0;
    return line;
  }
  const double* along = axis == 0 ? atoms.x.data() : axis == 1 ? atoms.y.data() : atoms.z.data();
  const auto sums_with = [&](double shift) {
    return weight_sums(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(), atoms.padded(), decay, p[0], p[1],
                       p[2], shift, along, p[axis]);
  };
  double shift = 0.0;
  WeightSums s = sums_with(shift);
  if (!(s.total > 1e-100 && s.total < 1e100)) {  // far from the surface: keep the exponents in range
    shift = largest_exponent(atoms, decay, p);
    s = sums_with(shift);
  }
  result.value = shift + std::log(s.total);
  const double factor = -2.0 * decay / s.total;
  result.gradient = {factor * s.ux, factor * s.uy, factor * s.uz};

  // The atoms that weigh anything have exponents near the value: w_i and d |u_i|^2 differ by about that. The largest
  // log-weight bounds both.
  const double exponent_size = 2.0 * atoms.w_size + std::abs(result.value) + kFineTruncation;
  const double log_error = 4e-16 * (std::abs(result.value) + 1.0);
  result.error = 1.001 * weight_error(exponent_size, n) + log_error;
  const double mean = (axis == 0 ? s.ux : axis == 1 ? s.uy : s.uz) / s.total;
  const double f = 4.0 * decay * decay / s.total;
  line.gradient_slope = {f * (s.xx - mean * s.ux), f * (s.xy - mean * s.uy), f * (s.xz - mean * s.uz)};
  line.gradient_slope[axis] -= 2.0 * decay;
  return line;
}

Side side_of(const PointValue& value, const NearAtoms& atoms) {
  if (value.value > value.error) return Side::kInside;
  return std::exp(value.value + value.error) + atoms.tail < 1.0 ? Side::kOutside : Side::kUnknown;
}

}  // namespace gaussmesh
