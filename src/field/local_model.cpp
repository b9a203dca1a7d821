#include "field/local_model.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/vector_exp.h"
#include "field/point_value.h"

namespace gaussmesh {
namespace {

/// Sums over atoms of their weights a_i at the middle m of a box, and of a_i u_i, u_i = m - x_i.
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

/// Sums over atoms of their weights a_i, with y_i = -2 d (centre - x_i), centre = m - v, and t_i, the largest
/// y_i . (x - m) in the box.
struct CentralMoments {
  double second[6]{};      ///< a y y: xx, yy, zz, xy, xz, yz
  double third[10]{};      ///< a y y y: xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz
  double growth = 0.0;     ///< a e^t
  double remainder = 0.0;  ///< a (e^t - 1 - t - t^2 / 2 - t^3 / 6)
  Vec3 remainder_slope{};  ///< a |y| (e^t - 1 - t - t^2 / 2)
};

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
  return {
      {xx, yy, zz, xy, xz, yz}, {xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz}, growth, remainder, {rx, ry, rz}};
}

}  // namespace

LocalModel::LocalModel(const NearAtoms& atoms, double decay, const Box& box) : box_(box) {
  LocalModelTerms& m = terms_;
  m.decay = decay;
  m.tail = atoms.tail;
  m.tail_slope = atoms.tail_slope;
  const std::size_t n = atoms.size();
  for (int k = 0; k < 3; ++k) {
    m.middle[k] = 0.5 * (box.lo[k] + box.hi[k]);
    m.half[k] = half_width(box.lo[k], box.hi[k], m.middle[k]);
  }
  if (n == 0) return;
  m.empty = false;

  m.atoms_lo = atoms.lo;
  m.atoms_hi = atoms.hi;

  thread_local std::vector<double> weight;
  const std::size_t padded = atoms.padded();
  weight.resize(std::max(weight.size(), padded));
  const auto moments_with = [&](double shift) {
    return first_moments(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(), weight.data(), padded, decay,
                         m.middle.data(), shift);
  };
  double shift = 0.0;
  FirstMoments first = moments_with(shift);
  if (!(first.total > 1e-100 && first.total < 1e100)) {  // far from the surface: keep the exponents in range
    shift = largest_exponent(atoms, decay, m.middle);
    first = moments_with(shift);
  }
  const double inverse = 1.0 / first.total;
  m.psi = shift + std::log(first.total);
  m.mean_offset = {first.ux * inverse, first.uy * inverse, first.uz * inverse};
  const Vec3 centre = {m.middle[0] - m.mean_offset[0], m.middle[1] - m.mean_offset[1], m.middle[2] - m.mean_offset[2]};
  const CentralMoments moments = central_moments(atoms.x.data(), atoms.y.data(), atoms.z.data(), weight.data(), padded,
                                                 decay, centre.data(), m.half.data());
  for (int i = 0; i < 6; ++i) m.second[i] = moments.second[i] * inverse;
  for (int i = 0; i < 10; ++i) m.third[i] = moments.third[i] * inverse;
  m.relative_error = 2.0 * weight_error(2.0 * atoms.w_size + std::abs(m.psi) + kFineTruncation, n) + 1e-14;
  m.growth = std::max(1.0, moments.growth * inverse) * (1.0 + 1e-6);
  m.log_growth = std::log(m.growth);
  // Rounding of exp(z) - 1 - ... is absolute: a few ulp of exp(z). That of `centre`, 6e-11 A at 1e6 A, changes the
  // third moments only, since the first about v is zero, and by less than a millionth of the remainder and `lost`.
  const double lost = 16.0 * m.relative_error * m.growth;
  double farthest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double far_k = std::max(std::abs(m.atoms_hi[k] - centre[k]), std::abs(m.atoms_lo[k] - centre[k]));
    farthest += far_k * m.half[k];
    m.slope_size += 2.0 * decay * far_k;
  }
  m.remainder = moments.remainder * inverse * (1.0 + 1e-6) + lost;
  for (int k = 0; k < 3; ++k) {
    m.remainder_slope[k] = moments.remainder_slope[k] * inverse * (1.0 + 1e-6) + lost * m.slope_size;
  }
  // Beyond this the exponential was clamped.
  m.usable = 2.0 * decay * farthest < 600.0 && m.relative_error < 1e-3;
}

}  // namespace gaussmesh
