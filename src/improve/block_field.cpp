#include "improve/block_field.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/vector_exp.h"
#include "field/point_value.h"
#include "roots/edge_roots.h"

namespace gaussmesh {
namespace {

constexpr double kCellSize = 1.5;  // A: small beside the reach of an atom, large beside a triangle

/// Log-weights, relative to c, below which an atom is left out, for rough and exact places.
constexpr double kCuts[] = {16.0, 24.0};

/// Lists are asked for with points this much outside their cells (in cells) by way of a Newton step.
constexpr double kMargin = 0.1;

/// Sums of the weights, and of the weights times offsets of the point from the atoms and their products.
struct SecondSums {
  double total = 0.0, x = 0.0, y = 0.0, z = 0.0;
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
};

GAUSSMESH_SIMD_CLONES
SecondSums second_moments(const double* x, const double* y, const double* z, const double* w, std::size_t n,
                          double d, double px, double py, double pz) {
  double total = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
#pragma omp simd reduction(+ : total, sx, sy, sz, xx, yy, zz, xy, xz, yz)
  for (std::size_t i = 0; i < n; ++i) {
    const double ux = px - x[i], uy = py - y[i], uz = pz - z[i];
    const double a = vector_exp(w[i] - d * (ux * ux + uy * uy + uz * uz));
    const double ax = a * ux, ay = a * uy, az = a * uz;
    total += a;
    sx += ax;
    sy += ay;
    sz += az;
    xx += ax * ux;
    yy += ay * uy;
    zz += az * uz;
    xy += ax * uy;
    xz += ax * uz;
    yz += ay * uz;
  }
  return {total, sx, sy, sz, xx, yy, zz, xy, xz, yz};
}

}  // namespace

BlockField::BlockField(const GaussianField& field, const Box& box) : decay_(field.decay()), box_(box) {
  cell_size_ = kCellSize;
  for (int k = 0; k < 3; ++k) cell_size_ = std::max(cell_size_, (box.hi[k] - box.lo[k]) / kMostCells);
  Box wide = box;
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    wide.lo[k] -= kMargin * cell_size_;
    wide.hi[k] += kMargin * cell_size_;
    cells_[k] = std::max(1, static_cast<int>(std::ceil((box.hi[k] - box.lo[k]) / cell_size_ - 1e-9)));
    count *= static_cast<std::size_t>(cells_[k]);
  }
  field.collect_near(wide, atoms_, kCuts[static_cast<int>(Accuracy::kExact)]);
  for (auto& lists : lists_) lists.resize(count);
}

const NearAtoms& BlockField::atoms_at(const Vec3& point, Accuracy accuracy) {
  std::array<int, 3> index;
  for (int k = 0; k < 3; ++k) index[k] = slab_of((point[k] - box_.lo[k]) / cell_size_, cells_[k]);
  AtomList& list = lists_[static_cast<std::size_t>(accuracy)]
                         [static_cast<std::size_t>((index[0] * cells_[1] + index[1]) * cells_[2] + index[2])];
  if (list.is_made) return list.atoms;
  list.is_made = true;
  Box cell;
  for (int k = 0; k < 3; ++k) {
    cell.lo[k] = box_.lo[k] + (index[k] - kMargin) * cell_size_;
    cell.hi[k] = box_.lo[k] + (index[k] + 1 + kMargin) * cell_size_;
  }
  list.atoms.restrict_from(atoms_, cell, decay_, kCuts[static_cast<std::size_t>(accuracy)]);
  return list.atoms;
}

FieldJet BlockField::jet(const Vec3& p) {
  const NearAtoms& near = atoms_at(p, Accuracy::kExact);
  const SecondSums s = second_moments(near.x.data(), near.y.data(), near.z.data(), near.w.data(), near.padded(),
                                      decay_, p[0], p[1], p[2]);
  // grad log phi = -2 d <u>, Hessian = 4 d^2 (<u u^T> - <u> <u>^T) - 2 d, with means over the atoms weighted by
  // phi_i.
  const double f = 1.0 / s.total, d = decay_;
  const Vec3 m{f * s.x, f * s.y, f * s.z};
  FieldJet jet;
  jet.value = std::log(s.total);
  jet.gradient = -2.0 * d * m;
  const double q = 4.0 * d * d;
  jet.hessian = {q * (f * s.xx - m[0] * m[0]) - 2.0 * d, q * (f * s.yy - m[1] * m[1]) - 2.0 * d,
                 q * (f * s.zz - m[2] * m[2]) - 2.0 * d, q * (f * s.xy - m[0] * m[1]),
                 q * (f * s.xz - m[0] * m[2]),           q * (f * s.yz - m[1] * m[2])};
  return jet;
}

std::optional<Place> BlockField::project(const Vec3& point, double farthest, Accuracy accuracy) {
  // Newton's method squares the error: a step s leaves about s^2 k / 2 where the curvature is k. The first of these
  // (A) leaves less than a rounding of the result; the second grows with the triangles, since those are small where
  // k is large.
  constexpr double kGoodStep = 1e-5, kRoughStep = 1e-3, kRoughPart = 0.004;
  const double good_step =
      accuracy == Accuracy::kExact ? kGoodStep : std::clamp(kRoughPart * farthest, kGoodStep, kRoughStep);
  Vec3 p = point;
  for (int iteration = 0; iteration < 40; ++iteration) {
    const PointValue v = evaluate(atoms_at(p, accuracy), decay_, p);
    const double slope = length(v.gradient);
    if (!(slope > 0.0 && std::isfinite(v.value))) return std::nullopt;
    const double step = std::clamp(-v.value / slope, -0.5 * farthest, 0.5 * farthest);
    p = p + step / slope * v.gradient;
    const Vec3 moved = p - point;
    if (!(dot(moved, moved) <= farthest * farthest)) return std::nullopt;
    if (std::abs(step) > good_step) continue;
    return Place{round_to_units(p), outward_normal(v.gradient)};
  }
  return std::nullopt;
}

double largest_curvature(const FieldJet& jet) {
  // In an orthonormal frame (t1, t2) of the tangent plane the shape operator is the Hessian over the slope; its
  // larger eigenvalue in absolute value is |H| + sqrt(H^2 - K) of the mean and Gaussian curvature.
  const Vec3& g = jet.gradient;
  const double slope = length(g);
  const Vec3 n = 1.0 / slope * g;
  const Vec3 other = std::abs(n[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 t1 = cross(n, other);
  t1 = 1.0 / length(t1) * t1;
  const Vec3 t2 = cross(n, t1);
  const auto& h = jet.hessian;
  const auto times = [&](const Vec3& v) {
    return Vec3{h[0] * v[0] + h[3] * v[1] + h[4] * v[2], h[3] * v[0] + h[1] * v[1] + h[5] * v[2],
                h[4] * v[0] + h[5] * v[1] + h[2] * v[2]};
  };
  const Vec3 h1 = times(t1), h2 = times(t2);
  const double a = dot(t1, h1) / slope, b = dot(t1, h2) / slope, c = dot(t2, h2) / slope;
  const double mean = 0.5 * (a + c);
  return std::abs(mean) + std::sqrt(0.25 * (a - c) * (a - c) + b * b);
}

}  // namespace gaussmesh
