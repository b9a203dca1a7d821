// What a local model says of parts of its box: of one, or of several side by side.
//
// The formulas are local_series.h; how the model is made is local_model.cpp.
#include <algorithm>
#include <cmath>

#include "field/local_series.h"

namespace gaussmesh {
namespace {

/// Below this log(phi / c) of the atoms listed is negative with all others too: it is no more than log(1 - tail).
double outside_below(const LocalModelTerms& m) { return m.tail < 0.5 ? -m.tail * (1.0 + m.tail) - 1e-15 : -kInfinity; }

/// Parts of a box in lanes.
struct PartQuad {
  Quad lo[3], hi[3];

  /// @param first  of the parts; lanes beyond the last repeat that
  PartQuad(std::span<const Box> parts, std::size_t first) {
    for (int lane = 0; lane < kQuadLanes; ++lane) {
      const Box& part = parts[std::min(first + static_cast<std::size_t>(lane), parts.size() - 1)];
      for (int k = 0; k < 3; ++k) {
        lo[k][lane] = part.lo[k];
        hi[k][lane] = part.hi[k];
      }
    }
  }

  GAUSSMESH_SIMD_INLINE LocalSeries<Quad> series(const LocalModelTerms& m) const {
    LocalSeries<Quad> q;
    const Quad lambda = place_series(m, lo, hi, q);
    move_series(m, q);
    measure_series(m, lambda, q);
    return q;
  }
};

GAUSSMESH_SIMD_INLINE QuadBits is_free(const Ranges<Quad>& listed, double outside) {
  return (listed.lo > 0.0) | (listed.hi < outside);
}

/// Bits of directions, and -1 where a part is surely crossed.
GAUSSMESH_SIMD_CLONES
void prove_quad(const LocalModelTerms& m, const PartQuad& parts, double outside, QuadBits& directions,
                QuadBits& is_surely_crossed) {
  const LocalSeries<Quad> q = parts.series(m);
  QuadBits proven{};
  for (int axis = 0; axis < 3; ++axis) {
    const Ranges<Quad> slope = slope_of(m, q, AlongAxis{axis});
    proven |= (slope.lo > 0.0) & (std::int64_t{2} << (2 * axis));
    proven |= (slope.hi < 0.0) & (std::int64_t{1} << (2 * axis));
  }
  directions = proven | (is_free(range_of_listed(m, q), outside) & std::int64_t{kAllDirections});
  is_surely_crossed = crosses_inner_half(m, q);
}

/// -1 where a part is free of surface or phi grows along the vector.
GAUSSMESH_SIMD_CLONES
void prove_quad_along(const LocalModelTerms& m, const PartQuad& parts, double outside, const AlongVector& along,
                      QuadBits& is_proven) {
  const LocalSeries<Quad> q = parts.series(m);
  is_proven = is_free(range_of_listed(m, q), outside) | (slope_of(m, q, along).lo > 0.0);
}

}  // namespace

PartProofs LocalModel::prove(std::span<const Box> parts) const {
  PartProofs proofs;
  if (!terms_.usable || !has_slopes(terms_)) {
    for (std::size_t i = 0; i < parts.size(); ++i) proofs.directions[i] = over(parts[i]).directions();
    return proofs;
  }
  const double outside = outside_below(terms_);
  for (std::size_t first = 0; first < parts.size(); first += kQuadLanes) {
    QuadBits directions, is_surely_crossed;
    prove_quad(terms_, PartQuad(parts, first), outside, directions, is_surely_crossed);
    for (std::size_t i = first; i < std::min(first + kQuadLanes, parts.size()); ++i) {
      proofs.directions[i] = static_cast<unsigned>(directions[i - first]);
      proofs.is_surely_crossed[i] = is_surely_crossed[i - first] != 0;
    }
  }
  return proofs;
}

unsigned LocalModel::prove_along(std::span<const Box> parts, const Direction& direction) const {
  unsigned proven = 0;
  if (!terms_.usable || !has_slopes(terms_)) {
    for (std::size_t i = 0; i < parts.size(); ++i) proven |= unsigned{over(parts[i]).proves(direction)} << i;
    return proven;
  }
  AlongVector along{direction.vector()};
  for (double& part : along.n) part *= direction.sign;
  const double outside = outside_below(terms_);
  for (std::size_t first = 0; first < parts.size(); first += kQuadLanes) {
    QuadBits is_proven;
    prove_quad_along(terms_, PartQuad(parts, first), outside, along, is_proven);
    for (std::size_t i = first; i < std::min(first + kQuadLanes, parts.size()); ++i) {
      proven |= unsigned{is_proven[i - first] != 0} << i;
    }
  }
  return proven;
}

LocalModel::View LocalModel::over(const Box& part) const { return View(*this, part); }
LocalModel::View LocalModel::over_all() const { return View(*this, box_); }

LocalModel::View::View(const LocalModel& model, const Box& part) : terms_(model.terms_) {
  const double lambda = place_series(terms_, part.lo.data(), part.hi.data(), series_);
  if (series_.t[0] != 0.0 || series_.t[1] != 0.0 || series_.t[2] != 0.0) move_series(terms_, series_);
  measure_series(terms_, lambda, series_);
}

double LocalModel::View::middle_value() const { return middle_of(terms_, series_, series_.g > 0.0 ? series_.g : 1.0); }

Vec3 LocalModel::View::middle_gradient() const {
  Vec3 gradient;
  for (int k = 0; k < 3; ++k) gradient[k] = middle_slope(terms_, series_, 1.0 / series_.g, k);
  return gradient;
}

double LocalModel::View::middle_curvature(int axis) const {
  const double slope = series_.g1[axis] / series_.g;
  return series_.g2[axis] / series_.g - slope * slope - 2.0 * terms_.decay;
}

double LocalModel::View::middle_third(int axis) const {
  const double slope = series_.g1[axis] / series_.g;
  return terms_.third[axis] / series_.g - slope * (3.0 * series_.g2[axis] / series_.g - 2.0 * slope * slope);
}

Range LocalModel::View::value() const {
  if (terms_.empty) return {-kInfinity, std::log(terms_.tail) + 1e-15};
  if (!terms_.usable) return {-kInfinity, kInfinity};
  const Ranges<double> listed = range_of_listed(terms_, series_);
  Range range{listed.lo, listed.hi};
  // Atoms left out add up to `tail` to phi / c, which raises its logarithm by no more than tail where phi > c, and by
  // no more than tail / p where phi > p c.
  if (terms_.tail > 0.0) {
    const double hi = range.hi;
    range.hi = hi > 0.0      ? hi + terms_.tail
               : hi > -0.125 ? hi + 1.134 * terms_.tail
                             : std::log(std::exp(hi) + terms_.tail) + 1e-15;
  }
  return range;
}

template <typename Along>
Range LocalModel::View::slope_along(const Along& along) const {
  if (!has_slopes(terms_)) return {-kInfinity, kInfinity};
  const Ranges<double> range =
      terms_.usable ? slope_of(terms_, series_, along) : one_sided_slope(terms_, series_, along);
  return {range.lo, range.hi};
}

Range LocalModel::View::slope(int axis) const { return slope_along(AlongAxis{axis}); }

Range LocalModel::View::slope(const Direction& direction) const {
  return direction.is_slanted() ? slope_along(AlongVector{direction.vector()}) : slope(direction.axis);
}

unsigned LocalModel::View::directions() const {
  const Range range = value();
  if (range.hi < 0.0 || range.lo > 0.0) return kAllDirections;
  unsigned proven = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Range change = slope(axis);
    proven |= (change.lo > 0.0 ? 2u : 0u) << (2 * axis) | (change.hi < 0.0 ? 1u : 0u) << (2 * axis);
  }
  return proven;
}

bool LocalModel::View::proves(const Direction& direction) const {
  const Range range = value();
  if (range.hi < 0.0 || range.lo > 0.0) return true;
  const Range change = slope(direction);
  return direction.sign > 0 ? change.lo > 0.0 : change.hi < 0.0;
}

bool LocalModel::View::is_surely_crossed() const { return crosses_inner_half(terms_, series_); }

}  // namespace gaussmesh
