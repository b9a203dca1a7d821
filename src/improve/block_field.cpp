#include "improve/block_field.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/vector_exp.h"
#include "roots/edge_roots.h"

namespace gaussmesh {
namespace {

constexpr double kCellSize = 1.5;  // A: small beside the reach of an atom, large beside a triangle

/// Log-weights, relative to c, below which an atom is left out, for rough and exact places.
constexpr double kRoughCut = 16.0, kExactCut = 24.0;

/// Exponents of this size are good to some 1e-6 in single precision.
constexpr double kLargestRoughWeight = 32.0;

/// Where log phi has a smaller slope (1/A), near critical points, single precision moves the surface by too much.
constexpr double kLeastRoughSlope = 0.03;

/// Rough atoms are so many at a time; those that fill up have no weight.
constexpr std::size_t kRoughLanes = 16;
constexpr float kNoWeight = -1e30f;

/// Exact lists are long, and asked for by one place after the other: more at a time are not worth their memory.
constexpr std::size_t kMostExactLists = 256;

/// Lists are asked for with points this much outside their cells (in cells) by way of a Newton step.
constexpr double kMargin = 0.1;

struct FirstSums {
  float total = 0.0f, x = 0.0f, y = 0.0f, z = 0.0f;
};

GAUSSMESH_SIMD_CLONES
FirstSums first_sums(const float* x, const float* y, const float* z, const float* w, std::size_t n, float d, float px,
                     float py, float pz) {
  float total = 0.0f, sx = 0.0f, sy = 0.0f, sz = 0.0f;
#pragma omp simd reduction(+ : total, sx, sy, sz)
  for (std::size_t i = 0; i < n; ++i) {
    const float ux = px - x[i], uy = py - y[i], uz = pz - z[i];
    const float a = vector_exp(w[i] - d * (ux * ux + uy * uy + uz * uz));
    total += a;
    sx += a * ux;
    sy += a * uy;
    sz += a * uz;
  }
  return {total, sx, sy, sz};
}

/// Sums of the weights, and of the weights times offsets of the point from the atoms and their products.
template <typename Real>
struct SecondSums {
  Real total, x, y, z, xx, yy, zz, xy, xz, yz;
};

template <typename Real>
[[gnu::always_inline]] inline SecondSums<Real> sum_up(const Real* x, const Real* y, const Real* z, const Real* w,
                                                      std::size_t n, Real d, Real px, Real py, Real pz) {
  Real total = 0, sx = 0, sy = 0, sz = 0, xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
#pragma omp simd reduction(+ : total, sx, sy, sz, xx, yy, zz, xy, xz, yz)
  for (std::size_t i = 0; i < n; ++i) {
    const Real ux = px - x[i], uy = py - y[i], uz = pz - z[i];
    const Real a = vector_exp(w[i] - d * (ux * ux + uy * uy + uz * uz));
    const Real ax = a * ux, ay = a * uy, az = a * uz;
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

GAUSSMESH_SIMD_CLONES
SecondSums<double> second_sums(const double* x, const double* y, const double* z, const double* w, std::size_t n,
                               double d, double px, double py, double pz) {
  return sum_up(x, y, z, w, n, d, px, py, pz);
}

GAUSSMESH_SIMD_CLONES
SecondSums<float> second_sums(const float* x, const float* y, const float* z, const float* w, std::size_t n, float d,
                              float px, float py, float pz) {
  return sum_up(x, y, z, w, n, d, px, py, pz);
}

/// grad log phi = -2 d <u>, Hessian = 4 d^2 (<u u^T> - <u> <u>^T) - 2 d, with means over the atoms weighted by phi_i.
template <typename Real>
FieldJet jet_of(const SecondSums<Real>& s, double d) {
  const double f = 1.0 / double(s.total), q = 4.0 * d * d;
  const Vec3 m{f * double(s.x), f * double(s.y), f * double(s.z)};
  FieldJet jet;
  jet.value = std::log(double(s.total));
  jet.gradient = -2.0 * d * m;
  jet.hessian = {q * (f * double(s.xx) - m[0] * m[0]) - 2.0 * d, q * (f * double(s.yy) - m[1] * m[1]) - 2.0 * d,
                 q * (f * double(s.zz) - m[2] * m[2]) - 2.0 * d, q * (f * double(s.xy) - m[0] * m[1]),
                 q * (f * double(s.xz) - m[0] * m[2]),           q * (f * double(s.yz) - m[1] * m[2])};
  return jet;
}

}  // namespace

BlockField::BlockField(const GaussianField& field, const Box& box) : field_(field), decay_(field.decay()), box_(box) {
  cell_size_ = kCellSize;
  for (int k = 0; k < 3; ++k) cell_size_ = std::max(cell_size_, (box.hi[k] - box.lo[k]) / kMostCells);
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    cells_[k] = std::max(1, static_cast<int>(std::ceil((box.hi[k] - box.lo[k]) / cell_size_ - 1e-9)));
    count *= static_cast<std::size_t>(cells_[k]);
  }
  field.collect_near(widened(box, kMargin * cell_size_), atoms_, kExactCut);
  is_rough_usable_ = atoms_.w_size <= kLargestRoughWeight;
  group_lists_.resize(kMostGroups * kMostGroups * kMostGroups);
  lists_.resize(count);
  rough_lists_.resize(count);
}

std::array<int, 3> BlockField::cell_of(const Vec3& point) const {
  std::array<int, 3> cell;
  for (int k = 0; k < 3; ++k) cell[k] = slab_of((point[k] - box_.lo[k]) / cell_size_, cells_[k]);
  return cell;
}

std::size_t BlockField::number_of(const std::array<int, 3>& cell) const {
  return static_cast<std::size_t>((cell[0] * cells_[1] + cell[1]) * cells_[2] + cell[2]);
}

Box BlockField::box_around(const std::array<int, 3>& cell, int cells) const {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = box_.lo[k] + (cell[k] - kMargin) * cell_size_;
    box.hi[k] = box_.lo[k] + (cell[k] + cells + kMargin) * cell_size_;
  }
  return box;
}

const NearAtoms& BlockField::atoms_around(const std::array<int, 3>& cell) {
  std::array<int, 3> first;
  std::size_t number = 0;
  for (int k = 0; k < 3; ++k) {
    first[k] = cell[k] / kGroupCells * kGroupCells;
    number = number * kMostGroups + static_cast<std::size_t>(cell[k] / kGroupCells);
  }
  NearAtoms& list = group_lists_[number];
  if (list.size() == 0) list.restrict_from(atoms_, box_around(first, kGroupCells), decay_, kExactCut);
  return list;
}

const NearAtoms& BlockField::atoms_at(const Vec3& point) {
  const std::array<int, 3> cell = cell_of(point);
  NearAtoms& list = lists_[number_of(cell)];
  if (list.size() > 0) return list;
  if (lists_made_++ == kMostExactLists) {
    for (NearAtoms& other : lists_) other = {};
    lists_made_ = 1;
  }
  list.restrict_from(atoms_around(cell), box_around(cell, 1), decay_, kExactCut);
  return list;
}

const RoughAtoms& BlockField::rough_atoms_at(const Vec3& point) {
  const std::array<int, 3> cell = cell_of(point);
  RoughAtoms& list = rough_lists_[number_of(cell)];
  if (!list.x.empty()) return list;
  const Box box = box_around(cell, 1);
  some_.restrict_from(atoms_around(cell), box, decay_, kRoughCut);
  list.origin = 0.5 * (box.lo + box.hi);
  const std::size_t padded = (some_.size() / kRoughLanes + 1) * kRoughLanes;
  const auto fill = [&](const std::vector<double>& from, double origin, std::vector<float>& to) {
    to.assign(padded, 0.0f);
    for (std::size_t i = 0; i < some_.size(); ++i) to[i] = static_cast<float>(from[i] - origin);
  };
  fill(some_.x, list.origin[0], list.x);
  fill(some_.y, list.origin[1], list.y);
  fill(some_.z, list.origin[2], list.z);
  fill(some_.w, 0.0, list.w);
  std::fill(list.w.begin() + static_cast<std::ptrdiff_t>(some_.size()), list.w.end(), kNoWeight);
  return list;
}

PointValue BlockField::evaluate_roughly(const Vec3& point) {
  const RoughAtoms& near = rough_atoms_at(point);
  const Vec3 p = point - near.origin;
  const FirstSums s =
      first_sums(near.x.data(), near.y.data(), near.z.data(), near.w.data(), near.x.size(), static_cast<float>(decay_),
                 static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  const double f = -2.0 * decay_ / double(s.total);
  return {std::log(double(s.total)), 0.0, {f * double(s.x), f * double(s.y), f * double(s.z)}};
}

PointValue BlockField::evaluate_exactly(const Vec3& point) {
  const NearAtoms& near = atoms_at(point);
  const PointValue value = evaluate(near, decay_, point);
  if (!is_tail_felt(near, length(value.gradient))) return value;
  const std::array<int, 3> cell = cell_of(point);
  if (fine_number_ != number_of(cell)) field_.collect_near(box_around(cell, 1), fine_, kFineTruncation);
  fine_number_ = number_of(cell);
  return evaluate(fine_, decay_, point);
}

FieldJet BlockField::jet(const Vec3& point) {
  if (is_rough_usable_) {
    const RoughAtoms& near = rough_atoms_at(point);
    const Vec3 p = point - near.origin;
    const FieldJet jet = jet_of(second_sums(near.x.data(), near.y.data(), near.z.data(), near.w.data(), near.x.size(),
                                            static_cast<float>(decay_), static_cast<float>(p[0]),
                                            static_cast<float>(p[1]), static_cast<float>(p[2])),
                                decay_);
    if (dot(jet.gradient, jet.gradient) > kLeastRoughSlope * kLeastRoughSlope) return jet;
  }
  const NearAtoms& near = atoms_at(point);
  return jet_of(second_sums(near.x.data(), near.y.data(), near.z.data(), near.w.data(), near.padded(), decay_, point[0],
                            point[1], point[2]),
                decay_);
}

std::optional<Place> BlockField::project(const Vec3& point, double farthest, Accuracy accuracy) {
  // Newton's method squares the error: a step s leaves about s^2 k / 2 where the curvature is k. The first of these
  // (A) leaves less than a rounding of the result; where k is large triangles are small, and so are steps.
  constexpr double kGoodStep = 1e-5, kGoodPart = 1e-3, kRoughStep = 1e-3, kRoughPart = 0.004;
  constexpr int kRoughIterations = 5;  // where these do not get there, single precision is the reason
  bool is_rough = accuracy == Accuracy::kRough && is_rough_usable_;
  Vec3 p = point;
  for (int iteration = 0; iteration < 40; ++iteration) {
    is_rough = is_rough && iteration < kRoughIterations;
    const PointValue v = is_rough ? evaluate_roughly(p) : evaluate_exactly(p);
    const double slope = length(v.gradient);
    if (is_rough && !(slope > kLeastRoughSlope)) {
      is_rough = false;
      continue;
    }
    const double good_step =
        is_rough ? std::min(kRoughStep, kRoughPart * farthest) : std::min(kGoodStep, kGoodPart * farthest);
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

std::optional<Place> BlockField::project_along(const Vec3& direction, const Vec3& point, double farthest) {
  constexpr double kGoodStep = 1e-8, kGoodPart = 1e-5;
  if (!(length(direction) > 0.0)) return std::nullopt;
  const Vec3 unit = 1.0 / length(direction) * direction;
  double at = 0.0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Vec3 p = point + at * unit;
    const PointValue v = evaluate_exactly(p);
    const double slope = dot(v.gradient, unit);
    if (!(std::abs(slope) > 0.0 && std::isfinite(v.value))) return std::nullopt;
    const double step = std::clamp(-v.value / slope, -0.25 * farthest, 0.25 * farthest);
    at += step;
    if (!(std::abs(at) <= farthest)) return std::nullopt;
    if (std::abs(step) > std::min(kGoodStep, kGoodPart * farthest)) continue;
    return Place{round_to_units(point + at * unit), outward_normal(v.gradient)};
  }
  return std::nullopt;
}

Curvatures principal_curvatures(const FieldJet& jet) {
  // In an orthonormal frame (t1, t2) of the tangent plane the shape operator is the Hessian over the slope; its
  // eigenvalues in absolute value are |H| + sqrt(H^2 - K) and ||H| - sqrt(H^2 - K)| of the mean and Gaussian
  // curvature.
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
  const double mean = 0.5 * std::abs(a + c), apart = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
  return {mean + apart, std::abs(mean - apart)};
}

}  // namespace gaussmesh
