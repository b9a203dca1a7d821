// From pieces of curves that are linked to polygons of as few points as will do.
//
// Which roots belong together is face_tracer.cpp.
#include <algorithm>
#include <cmath>

#include "core/lattice_degenerate.h"
#include "trace/face_tracer.h"

namespace gaussmesh {

PlanePoint FaceTracer::plane(int point) const {
  const CoordPoint& p = points_[point].point.position;
  return {p[first_axis(axis_)], p[second_axis(axis_)]};
}

void FaceTracer::collect_chains(std::span<const FaceRoot> roots) {
  std::vector<bool> seen(points_.size(), false);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (!starts_curve({static_cast<int>(i), roots[i].boundary_side})) continue;
    chains_.push_back({static_cast<int>(i), false});
    for (int p = static_cast<int>(i); p != kEnd; p = points_[p].next) seen[p] = true;
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (seen[i]) continue;
    chains_.push_back({static_cast<int>(i), true});
    for (int p = static_cast<int>(i); !seen[p]; p = points_[p].next) {
      if (points_[p].next == kEnd) throw LatticeDegenerate(to_angstrom(points_[p].point.position));
      seen[p] = true;
    }
  }
}

int FaceTracer::length_of(const Chain& chain) const {
  int count = points_[chain.first].kept;
  for (int p = points_[chain.first].next; p != kEnd && p != chain.first; p = points_[p].next) count += points_[p].kept;
  return count;
}

void FaceTracer::choose_points(const Chain& chain) {
  if (chain.closed) {
    if (points_[points_[chain.first].next].next == chain.first) {  // two points: both halves are arcs
      const int second = points_[chain.first].next;
      insert_middle(chain.first);
      insert_middle(second);
    }
    // The extremes in both directions.
    int extreme[4] = {chain.first, chain.first, chain.first, chain.first};
    for (int p = points_[chain.first].next; p != chain.first; p = points_[p].next) {
      const PlanePoint q = plane(p);
      if (q.a < plane(extreme[0]).a) extreme[0] = p;
      if (q.a > plane(extreme[1]).a) extreme[1] = p;
      if (q.b < plane(extreme[2]).b) extreme[2] = p;
      if (q.b > plane(extreme[3]).b) extreme[3] = p;
    }
    for (int p : extreme) points_[p].kept = true;
    while (length_of(chain) < 3) refine_all();
    return;
  }
  int last = chain.first;
  while (points_[last].next != kEnd) last = points_[last].next;
  const PlanePoint p = plane(chain.first), q = plane(last);
  const int a = first_axis(axis_), b = second_axis(axis_);
  const bool same_a = p.a == q.a && (p.a == face_.lo[a] || p.a == face_.hi[a]);
  const bool same_b = p.b == q.b && (p.b == face_.lo[b] || p.b == face_.hi[b]);
  if (!same_a && !same_b) return;
  // Both ends on one edge: keep the point farthest from it, the fold point.
  if (points_[chain.first].next == last) {
    points_[insert_turning_point(chain.first)].kept = true;
    return;
  }
  int farthest = points_[chain.first].next;
  const auto distance = [&](int i) { return same_a ? std::abs(plane(i).a - p.a) : std::abs(plane(i).b - p.b); };
  for (int i = farthest; i != last; i = points_[i].next) {
    if (distance(i) > distance(farthest)) farthest = i;
  }
  points_[farthest].kept = true;
}

void FaceTracer::keep_fold_points(const Chain& chain, int axis) {
  const NearAtoms& atoms = root_atoms_of(face_);
  for (int p = chain.first; p >= 0;) {
    if (points_[p].vertex != kLocalVertex) {
      const PointValue value = evaluate(atoms, field_.decay(), to_angstrom(points_[p].point.position));
      points_[p].point.normal = outward_normal(value.gradient);
    }
    const int next = points_[p].next;
    if (next == kEnd || next == chain.first) break;
    p = next;
  }
  for (int p = chain.first; points_[p].next != kEnd;) {
    const int next = points_[p].next;
    insert_fold_points(p, axis);
    p = next;
    if (p == chain.first) break;
  }
}

void FaceTracer::insert_fold_points(int from, int axis) {
  constexpr int kSamples = 4;  // parts of a piece that are looked at for a change of sign
  const int to = points_[from].next;
  Piece& piece = pieces_[points_[from].piece];
  const int over = first_axis(axis_) == piece.along ? second_axis(axis_) : first_axis(axis_);
  const double a = to_angstrom(points_[from].point.position[over]), b = to_angstrom(points_[to].point.position[over]);
  if (std::abs(b - a) < 1e-6) return;
  double lo = a;
  float lo_slope = points_[from].point.normal[axis];
  for (int i = 1; i <= kSamples; ++i) {
    const double hi = i == kSamples ? b : a + (b - a) * i / kSamples;
    const float hi_slope = i == kSamples ? points_[to].point.normal[axis] : solve_on_piece(piece, hi).normal[axis];
    if (lo_slope * hi_slope < 0.0f) {
      from = insert_between(from, find_fold_point(piece, axis, lo, hi, lo_slope, hi_slope));
      points_[from].kept = true;
      points_[from].point.fold_axes = static_cast<std::uint8_t>(1u << axis);
    }
    lo = hi;
    lo_slope = hi_slope;
  }
}

double FaceTracer::find_fold_point(Piece& piece, int axis, double lo, double hi, double lo_slope, double hi_slope) {
  constexpr int kMostSteps = 100;    // every fourth one halves the bracket
  constexpr double kClosest = 2e-9;  // A: the coordinates' own unit
  double at = lo;
  for (int step = 0; step < kMostSteps && std::abs(hi - lo) > kClosest; ++step) {
    const double last = at;
    at = step % 4 == 3 ? 0.5 * (lo + hi) : lo + (hi - lo) * (lo_slope / (lo_slope - hi_slope));
    if (std::abs(at - last) < kClosest) return at;
    const double slope = solve_on_piece(piece, at).normal[axis];
    if (slope == 0.0) return at;
    // An end that stays where it is counts half the next time (the Illinois rule).
    if (slope * lo_slope > 0.0) {
      lo = at;
      lo_slope = slope;
      hi_slope *= 0.5;
    } else {
      hi = at;
      hi_slope = slope;
      lo_slope *= 0.5;
    }
  }
  return 0.5 * (lo + hi);
}

SurfacePoint FaceTracer::solve_on_piece(Piece& piece, double at) {
  const NearAtoms& atoms = root_atoms_of(piece.rect);
  const int along = piece.along;
  const int over = first_axis(axis_) == along ? second_axis(axis_) : first_axis(axis_);
  SurfacePoint result;
  result.position = piece.rect.lo;
  result.position[over] =
      std::clamp<Coord>(std::llround(at * kUnitsPerAngstrom), piece.rect.lo[over] + 1, piece.rect.hi[over] - 1);
  Vec3 start = to_angstrom(result.position), end = start;
  end[along] = to_angstrom(piece.rect.hi[along]);
  if (piece.lo == Side::kUnknown) {
    const LocalModel model(atoms, field_.decay(), {start, end});
    const bool inside_lo = is_inside(field_, atoms, model, start);
    if (inside_lo == is_inside(field_, atoms, model, end)) throw LatticeDegenerate(start);
    piece.lo = inside_lo ? Side::kInside : Side::kOutside;
    piece.last = 0.5 * (start[along] + end[along]);
  }
  const LineRoot root =
      refine_root(field_, atoms, start, along, start[along], end[along], piece.lo == Side::kInside, piece.last);
  piece.last = root.position;
  result.position[along] = std::clamp<Coord>(std::llround(root.position * kUnitsPerAngstrom), piece.rect.lo[along] + 1,
                                             piece.rect.hi[along] - 1);
  result.normal = outward_normal(root.gradient);
  return result;
}

int FaceTracer::insert_between(int from, double at) {
  const TracePoint& before = points_[from];
  const TracePoint point{solve_on_piece(pieces_[before.piece], at), kLocalVertex, 0, false, before.next, before.piece};
  points_.push_back(point);
  return points_[from].next = static_cast<int>(points_.size()) - 1;
}

int FaceTracer::insert_middle(int from) {
  const Piece& piece = pieces_[points_[from].piece];
  const int over = first_axis(axis_) == piece.along ? second_axis(axis_) : first_axis(axis_);
  const Coord a = points_[from].point.position[over], b = points_[points_[from].next].point.position[over];
  if (std::abs(a - b) < 3) throw LatticeDegenerate(to_angstrom(points_[from].point.position));
  return insert_between(from, 0.5 * (to_angstrom(a) + to_angstrom(b)));
}

int FaceTracer::insert_turning_point(int from) {
  // The fold point is where phi has no slope along the edge that both ends are on: bisection between the ends, whose
  // slopes have opposite signs; a hundredth of the arc is near enough, the point is on the surface anyway.
  Piece& piece = pieces_[points_[from].piece];
  const int over = first_axis(axis_) == piece.along ? second_axis(axis_) : first_axis(axis_);
  Coord a = points_[from].point.position[over], b = points_[points_[from].next].point.position[over];
  if (std::abs(a - b) < 3) throw LatticeDegenerate(to_angstrom(points_[from].point.position));
  const int rising = points_[from].rise;  // slope along the edge at the end of the arc that `from` is
  double lo = to_angstrom(a), hi = to_angstrom(b);
  double middle = 0.5 * (lo + hi);
  for (int i = 0; i < 7; ++i) {
    middle = 0.5 * (lo + hi);
    const SurfacePoint p = solve_on_piece(piece, middle);
    const bool like_start = (p.normal[over] < 0.0f) == (rising > 0);  // the normal points against the gradient
    (like_start ? lo : hi) = middle;
  }
  return insert_between(from, middle);
}

template <typename Visit>
void FaceTracer::visit_sides(const Chain& chain, const Visit& visit) const {
  int start = chain.first;
  while (!points_[start].kept) start = points_[start].next;
  int from = start;
  for (int p = points_[start].next; p != kEnd; p = points_[p].next) {
    if (points_[p].kept) {
      visit(from, p);
      from = p;
    }
    if (p == start) break;
  }
}

bool FaceTracer::polygons_cross() const {
  std::vector<PolygonSide> sides;
  for (const Chain& chain : chains_) {
    visit_sides(chain, [&](int from, int to) { sides.push_back({plane(from), plane(to), from, to}); });
  }
  return sides_meet(sides);
}

void FaceTracer::refine_all() {
  // First every point that the pieces already have; then the middles of the pieces.
  bool all_kept = true;
  for (TracePoint& p : points_) {
    all_kept = all_kept && p.kept;
    p.kept = true;
  }
  if (!all_kept) return;
  const std::size_t count = points_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (points_[i].next != kEnd) points_[insert_middle(static_cast<int>(i))].kept = true;
  }
}

void FaceTracer::emit() {
  for (TracePoint& p : points_) {
    if (!p.kept || p.vertex != kLocalVertex) continue;
    p.vertex = kLocalVertex + static_cast<std::uint32_t>(curves_.points.size());
    curves_.points.push_back(p.point);
  }
  for (const Chain& chain : chains_) {
    visit_sides(chain, [&](int from, int to) { curves_.links.push_back({points_[from].vertex, points_[to].vertex}); });
  }
}

}  // namespace gaussmesh
