#include "roots/edge_roots.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/lattice_degenerate.h"
#include "field/point_value.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

/// Two roots closer than this are not told apart (A): ten times the unit of the coordinates.
constexpr double kClosestRoots = 1e-8;

/// Log-weight below which an atom does not matter next to rounding: e^-60 = 1e-26.
constexpr double kNoTruncation = 60.0;

/// Where segments this short (A) are not decided, the edge nearly touches the surface, and what the lists of atoms
/// leave out decides. Molecules of 1e5 atoms have several such edges.
constexpr double kNeedsAllAtoms = 1e-4;

/// Roots are found to this (A), a tenth of the unit that coordinates are rounded to.
constexpr double kRootTolerance = 1e-10;

/// Zero nearest to `x` of the parabola f + f1 s + f2 s^2 / 2; NaN where it has none.
double parabola_zero(double x, double f, double f1, double f2) {
  const double discriminant = f1 * f1 - 2.0 * f * f2;
  return x - 2.0 * f / (f1 + std::copysign(std::sqrt(discriminant), f1));
}

/// The same of the cubic with the third derivative f3 too, to third order.
double cubic_zero(double x, double f, double f1, double f2, double f3) {
  const double s = parabola_zero(x, f, f1, f2) - x;
  return x + s - f3 * s * s * s / (6.0 * (f1 + s * f2) + 3.0 * f3 * s * s);
}

}  // namespace

Normal outward_normal(const Vec3& g) {
  const double length = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  const double f = length > 0.0 ? -1.0 / length : 0.0;
  return {static_cast<float>(f * g[0]), static_cast<float>(f * g[1]), static_cast<float>(f * g[2])};
}

namespace {

/// The side of a point: proven, or unknown where |phi / c - 1| is below the rounding error.
Side proven_side(const GaussianField& field, const NearAtoms& atoms, const LazyModel& model, const Vec3& point) {
  const Range range = model.get().over({point, point}).value();
  if (range.lo > 0.0) return Side::kInside;
  if (range.hi < 0.0) return Side::kOutside;
  Side side = side_of(evaluate(atoms, field.decay(), point), atoms);
  if (side == Side::kUnknown) {
    NearAtoms all;
    field.collect_near({point, point}, all, kNoTruncation);
    side = side_of(evaluate(all, field.decay(), point), all);
  }
  return side;
}

/// The root of the sum over `atoms`, as refine_root().
LineRoot root_of_sum(const NearAtoms& atoms, double decay, const Vec3& start, int axis, double a, double b,
                     bool inside_a, double guess) {
  const double range = atoms.size() > 0 ? 2.0 * decay * (atoms.hi[axis] - atoms.lo[axis]) : 0.0;
  double x = guess > a && guess < b ? guess : 0.5 * (a + b);
  double width = b - a;
  Vec3 point = start;
  LineRoot root;
  for (int iteration = 0; iteration < 200; ++iteration) {
    point[axis] = x;
    const auto [value, gradient_slope, gradient_curvature] = evaluate_along(atoms, decay, point, axis);
    const double slope = value.gradient[axis], curvature = gradient_slope[axis], third = gradient_curvature[axis];
    // The derivatives of log phi are cumulants of y = 2 d times the atoms' positions, less 2 d in the second: the
    // fourth one is at most the range of y squared times its variance, which by the third one changes by no more than
    // a fifth over steps shorter than 0.18 / range.
    const double fourth = 1.2 * range * range * (curvature + 2.0 * decay);
    root = {x, value.gradient};
    ((value.value > 0.0) == inside_a ? a : b) = x;
    double next = cubic_zero(x, value.value, slope, curvature, third);
    if (!(next >= a && next <= b)) next = x - value.value / slope;
    if (!(next >= a && next <= b)) next = 0.5 * (a + b);
    const double by = next - x, step = std::abs(by);
    root.position = next;
    for (int k = 0; k < 3; ++k) root.gradient[k] += by * (gradient_slope[k] + 0.5 * by * gradient_curvature[k]);
    // The cubic misses by the fourth derivative times step^4 / 24, over the slope, which itself changes by no more
    // than half over the step; and the step of Newton's method to its zero, by no more than step (bend / slope)^3 /
    // 36. The gradient, corrected to second order, is good to 1e-7 then.
    const double bend = step * (std::abs(curvature) + step * (std::abs(third) + step * fourth)) / std::abs(slope);
    const bool is_near = step * range < 0.18 &&
                         step * step * step * step * fourth < 12.0 * kRootTolerance * std::abs(slope) && bend < 0.5 &&
                         step * bend * bend * bend < 18.0 * kRootTolerance &&
                         step * step * step * decay * std::sqrt(decay) < 1e-8;
    if (is_near || b - a < kRootTolerance) return root;
    if (iteration % 4 == 3) {  // four steps that have not even halved the bracket are no progress
      if (b - a > 0.5 * width) next = 0.5 * (a + b);
      width = b - a;
    }
    x = next;
  }
  throw InternalError("a bracketed root was not found in 200 steps");
}

}  // namespace

bool is_inside(const GaussianField& field, const NearAtoms& atoms, const LazyModel& model, const Vec3& point) {
  const Side side = proven_side(field, atoms, model, point);
  if (side == Side::kUnknown) throw LatticeDegenerate(point);
  return side == Side::kInside;
}

LineRoot refine_root(const GaussianField& field, const NearAtoms& atoms, const Vec3& start, int axis, double a,
                     double b, bool inside_a, double guess) {
  const LineRoot root = root_of_sum(atoms, field.decay(), start, axis, a, b, inside_a, guess);
  const Vec3& g = root.gradient;
  if (!is_tail_felt(atoms, std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]))) return root;
  Box line{start, start};
  line.lo[axis] = a;
  line.hi[axis] = b;
  NearAtoms more;
  field.collect_near(line, more, kFineTruncation);
  return root_of_sum(more, field.decay(), start, axis, a, b, inside_a, root.position);
}

bool EdgeRootFinder::is_free(const LazyModel& model, int axis, const CoordPoint& lo, Coord hi,
                             const EdgeEnds& ends) const {
  const bool sides_known = ends.lo != Side::kUnknown && ends.hi != Side::kUnknown;
  if (sides_known && ends.lo != ends.hi) return false;
  if (sides_known && ends.is_monotone) return true;
  Box edge{to_angstrom(lo), to_angstrom(lo)};
  edge.hi[axis] = to_angstrom(hi);
  const LocalModel::View view = model.get().over(edge);
  const Range value = view.value();
  if (value.hi < 0.0 || value.lo > 0.0) return true;
  if (!sides_known) return false;
  const Range slope = view.slope(axis);
  return slope.lo > 0.0 || slope.hi < 0.0;
}

Vec3 EdgeRootFinder::at(double x) const {
  Vec3 p = base_;
  p[axis_] = x;
  return p;
}

std::span<const EdgeRoot> EdgeRootFinder::find(const NearAtoms& atoms, const LazyModel& model, int axis,
                                               const CoordPoint& lo, Coord hi, const EdgeEnds& ends) {
  atoms_ = &atoms;
  axis_ = axis;
  lo_ = lo;
  hi_ = hi;
  base_ = to_angstrom(lo);
  roots_.clear();
  const double a = base_[axis], b = to_angstrom(hi);
  if (is_free(model, axis, lo, hi, ends)) return roots_;
  const auto inside = [&](Side known, double x) {
    return known == Side::kUnknown ? is_inside(field_, atoms, model, at(x)) : known == Side::kInside;
  };
  const Segment whole{a, b, inside(ends.lo, a), inside(ends.hi, b)};
  if (!ends.is_monotone) {
    isolate(model, whole);
  } else if (whole.inside_a != whole.inside_b) {
    refine(model, whole, ends.guess);
  }
  for (std::size_t i = 1; i < roots_.size(); ++i) {
    if (roots_[i - 1].point.position[axis_] >= roots_[i].point.position[axis_]) {
      throw LatticeDegenerate(to_angstrom(roots_[i].point.position));
    }
  }
  return roots_;
}

void EdgeRootFinder::isolate(const LazyModel& model, const Segment& s) {
  const Box part{at(s.a), at(s.b)};
  const LocalModel::View view = model.get().over(part);
  const bool is_crossed = s.inside_a != s.inside_b;
  if (!is_crossed) {
    const Range value = view.value();
    if (value.hi < 0.0 || value.lo > 0.0) return;
  }
  const Range slope = view.slope(axis_);
  if (slope.lo > 0.0 || slope.hi < 0.0) {
    if (is_crossed) refine(model, s, kNoGuess);
    return;
  }
  if (s.b - s.a < kClosestRoots) throw LatticeDegenerate(part.lo);
  if (s.b - s.a < kNeedsAllAtoms && atoms_ != &all_) {
    field_.collect_near(part, all_, kNoTruncation);
    const NearAtoms* const some = std::exchange(atoms_, &all_);
    isolate({all_, field_.decay(), part}, s);
    atoms_ = some;
    return;
  }
  if (model.box().lo != part.lo || model.box().hi != part.hi) {
    // A model of the edge alone is closer than one of the cell.
    isolate({*atoms_, field_.decay(), part}, s);
    return;
  }
  const double middle = 0.5 * (s.a + s.b);
  const bool inside_middle = is_inside(field_, *atoms_, model, at(middle));
  isolate(model, {s.a, middle, s.inside_a, inside_middle});
  isolate(model, {middle, s.b, inside_middle, s.inside_b});
}

void EdgeRootFinder::refine(const LazyModel& model, const Segment& s, double guess) {
  if (std::isnan(guess)) {
    // The model's own root is a guess that mostly needs one sum over the atoms.
    const double middle = 0.5 * (s.a + s.b);
    const LocalModel::View view = model.get().over({at(middle), at(middle)});
    guess = cubic_zero(middle, view.middle_value(), view.middle_gradient()[axis_], view.middle_curvature(axis_),
                       view.middle_third(axis_));
  }
  const LineRoot root = refine_root(field_, *atoms_, base_, axis_, s.a, s.b, s.inside_a, guess);
  EdgeRoot result;
  result.point.position = lo_;
  result.point.position[axis_] = snap(model, s, root);
  result.point.normal = outward_normal(root.gradient);
  result.rise = s.inside_a ? -1 : 1;
  roots_.push_back(result);
}

double EdgeRootFinder::root_error(const LineRoot& root) const {
  // log phi is off by the atoms left out and by rounding, of weights with exponents within the list's cut of zero. Its
  // second derivative is 4 d^2 times the variance of the atoms' positions, a quarter of their range squared at most,
  // less 2 d: where that cannot halve the slope within the error found so, the error is one.
  const double d = field_.decay(), range = atoms_->hi[axis_] - atoms_->lo[axis_];
  const double value_error = atoms_->tail + weight_error(2.0 * atoms_->w_size + atoms_->cut, atoms_->size());
  const double slope = std::abs(root.gradient[axis_]), bend = d * d * range * range + 2.0 * d;
  const double error = 2.0 * value_error / slope;
  if (!(error * bend <= 0.5 * slope)) return std::numeric_limits<double>::infinity();
  return kRootTolerance + error;
}

Coord EdgeRootFinder::snap(const LazyModel& model, const Segment& s, const LineRoot& root) const {
  const double at_units = root.position * kUnitsPerAngstrom;
  const double slack = std::min(root_error(root) * kUnitsPerAngstrom, double(hi_ - lo_[axis_])) + 1.0;
  const auto plane_below = [&](double x) {
    return static_cast<std::int64_t>(std::floor((x - double(lattice_.offset[axis_])) / double(lattice_.step)));
  };
  const auto is_above = [&](std::int64_t n) {
    const double plane = to_angstrom(lattice_.plane(axis_, n));
    if (plane <= s.a || plane >= s.b) return plane <= s.a;
    const Side side = proven_side(field_, *atoms_, model, at(plane));
    if (side == Side::kUnknown) return plane < root.position;
    return (side == Side::kInside) == s.inside_a;
  };
  const std::int64_t first = plane_below(at_units - slack) + 1, last = plane_below(at_units + slack);
  std::int64_t below = first - 1, above = last + 1;
  while (above - below > 1) {
    const std::int64_t n = below + (above - below) / 2;
    (is_above(n) ? below : above) = n;
  }
  Coord c = std::llround(at_units);
  if (below >= first) c = std::max(c, lattice_.plane(axis_, below) + 1);
  if (above <= last) c = std::min(c, lattice_.plane(axis_, above) - 1);
  return std::clamp(c, lo_[axis_] + 1, hi_ - 1);
}

}  // namespace gaussmesh
