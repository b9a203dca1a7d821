#include "trace/face_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/lattice_degenerate.h"
#include "field/point_value.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

/// A rectangle is not cut below this (units): ten times the distance at which roots are told apart.
constexpr Coord kSmallestRect = 100;

/// Roots of different edges whose distance across a slanted direction is below this (units) may be in another order
/// than they seem: a thousand times what they are rounded by.
constexpr Coord kClosestAcross = 1000;

/// Slanted directions that are tried for a face.
constexpr int kMostDirections = 6;

/// Rounds of refinement before polygons that still cross count as a failure; each halves every piece.
constexpr int kMaxRefinements = 8;

}  // namespace

PlanePoint FaceTracer::plane(int point) const {
  const CoordPoint& p = points_[point].point.position;
  return {p[first_axis(axis_)], p[second_axis(axis_)]};
}

bool FaceTracer::is_plain(const Rect& rect) const {
  const int a = first_axis(axis_);
  return is_plain_ && rect.hi[a] - rect.lo[a] == face_.hi[a] - face_.lo[a];
}

const FaceCurves& FaceTracer::trace(int axis, const CoordPoint& lo, const CoordPoint& hi, FaceCertificate certificate,
                                    std::span<const FaceRoot> roots, unsigned fold_axes) {
  curves_.links.clear();
  curves_.points.clear();
  if (certificate != kFaceUncertified && roots.empty()) return curves_;
  if (is_one_chord(certificate, roots) && fold_axes == 0) {
    const bool first_starts = starts_curve(roots[0].boundary_side, roots[0].rise);
    curves_.links.push_back(first_starts ? Link{roots[0].vertex, roots[1].vertex}
                                         : Link{roots[1].vertex, roots[0].vertex});
    return curves_;
  }
  axis_ = axis;
  fold_axes_ = fold_axes;
  face_ = {lo, hi};
  atoms_.move_to({to_angstrom(lo), to_angstrom(hi)}, around_);
  points_.clear();
  pieces_.clear();
  chains_.clear();

  std::vector<RectRoot> rect_roots;
  for (const FaceRoot& root : roots) {
    rect_roots.push_back({static_cast<int>(points_.size()), root.boundary_side});
    points_.push_back({{root.position, {}, 0}, root.vertex, root.rise, true, -1, -1});
  }
  trace_rect(face_, certificate, std::move(rect_roots));
  collect_chains(roots);
  bool straight = true;
  for (const Chain& chain : chains_) {
    choose_points(chain);
    for (int k = 0; k < 3; ++k) {
      if (fold_axes >> k & 1) keep_fold_points(chain, k);
    }
    straight = straight && length_of(chain) == 2;
  }
  // Chords between different edges of a rectangle cannot cross when the curves do not; polygons can.
  for (int round = 0; !straight && polygons_cross(); ++round) {
    if (round == kMaxRefinements) throw LatticeDegenerate(to_angstrom(face_.lo));
    refine_all();
  }
  emit();
  return curves_;
}

bool FaceTracer::is_one_chord(FaceCertificate certificate, std::span<const FaceRoot> roots) {
  if (!(certificate & (kFaceAlongFirst | kFaceAlongSecond | kFaceNoClosedCurve)) || roots.size() != 2) return false;
  const FaceRoot &p = roots[0], &q = roots[1];
  return p.boundary_side != q.boundary_side &&
         starts_curve(p.boundary_side, p.rise) != starts_curve(q.boundary_side, q.rise);
}

bool FaceTracer::starts_curve(int side, int rise) {
  // Walking counter-clockwise, a curve with the molecule on its left begins where the boundary leaves the molecule.
  return side < 2 ? rise < 0 : rise > 0;
}

bool FaceTracer::starts_curve(const RectRoot& root) const { return starts_curve(root.side, points_[root.point].rise); }

void FaceTracer::trace_rect(const Rect& rect, FaceCertificate certificate, std::vector<RectRoot> roots) {
  if (certificate == kFaceEmpty) {
    if (!roots.empty()) throw LatticeDegenerate(to_angstrom(rect.lo));
    return;
  }
  const auto pair_as = [&](FaceCertificate known) {
    return ((known & kFaceAlongFirst) && pair_roots(rect, along_axis(first_axis(axis_)), roots)) ||
           ((known & kFaceAlongSecond) && pair_roots(rect, along_axis(second_axis(axis_)), roots)) ||
           ((known & kFaceNoClosedCurve) && pair_only_curve(rect, roots));
  };
  if (pair_as(certificate)) return;
  const NearAtoms& atoms = proof_atoms_of(rect);
  prover_.move_to(atoms, axis_);
  const Box box{to_angstrom(rect.lo), to_angstrom(rect.hi)};
  const LocalModel model(atoms, field_.decay(), box);
  const FaceCertificate closer = certify_face(model, axis_, box);
  if (closer == kFaceEmpty) {
    if (!roots.empty()) throw LatticeDegenerate(box.lo);
    return;
  }
  if (pair_as(closer)) return;
  // Through parts of the rectangle, as cells are certified: cheaper than cutting it, which adds roots on the cuts.
  if (roots.size() <= 2 && chords_will_do(rect, roots) && prover_.has_no_closed_curve(model)) {
    pair_only_curve(rect, roots);
    return;
  }
  if (pair_along_slant(rect, model, roots)) return;
  const Vec3 gradient = model.over_all().middle_gradient();
  int axes[2] = {first_axis(axis_), second_axis(axis_)};
  if (std::abs(gradient[axes[0]]) < std::abs(gradient[axes[1]])) std::swap(axes[0], axes[1]);
  for (const int axis : axes) {
    const Direction along = along_axis(axis, gradient[axis] > 0.0 ? 1 : -1);
    if (prover_.proves(model, along) && pair_roots(rect, along, roots)) return;
  }
  split_rect(rect, roots);
}

/// Whether nobody will ask for points between the roots, which are found along an axis.
bool FaceTracer::chords_will_do(const Rect& rect, const std::vector<RectRoot>& roots) const {
  const bool is_whole = rect.lo == face_.lo && rect.hi == face_.hi;
  const bool turns_back = roots.size() == 2 && roots[0].side == roots[1].side;
  return is_whole && !turns_back && fold_axes_ == 0;
}

/// Where no curve closes, two roots are the ends of the only one, and no roots mean that there is none.
bool FaceTracer::pair_only_curve(const Rect& rect, const std::vector<RectRoot>& roots) {
  if (roots.empty()) return true;
  if (roots.size() != 2 || !chords_will_do(rect, roots)) return false;
  link(rect, roots[0], roots[1], first_axis(axis_));
  return true;
}

/// Where curves go from side to side and are single-valued along a slanted direction, all of them are chords.
bool FaceTracer::pair_along_slant(const Rect& rect, const LocalModel& model, std::vector<RectRoot>& roots) {
  if (!chords_will_do(rect, roots)) return false;
  cone_.clear();
  const auto add_to_cone = [&](Vec3 gradient) {
    gradient[axis_] = 0.0;
    cone_.add(gradient);
  };
  for (const Box& quarter : quarters_of(model.box(), axis_)) {
    const LocalModel::View view = model.over(quarter);
    const Range value = view.value();
    if (value.lo <= 0.0 && value.hi >= 0.0) add_to_cone(view.middle_gradient());
  }
  for (int attempt = 0; attempt < kMostDirections && !cone_.empty(); ++attempt) {
    const Direction along = nearest_direction(cone_.middle());
    if (along.axis == axis_) return false;  // the gradients cancel, and nothing in the face is nearest
    if (prover_.proves(model, along)) return pair_roots(rect, along, roots);
    add_to_cone(prover_.refuting_gradient());
  }
  return false;
}

bool FaceTracer::pair_roots(const Rect& rect, const Direction& along, std::vector<RectRoot>& roots) {
  if (roots.size() % 2 != 0) throw LatticeDegenerate(to_angstrom(rect.lo));
  const bool over_first = second_axis(along.axis) == axis_;
  const auto coordinate = [&](const RectRoot& r) {
    const PlanePoint seen = along.project(points_[r.point].point.position);
    return over_first ? seen.a : seen.b;
  };
  std::sort(roots.begin(), roots.end(), [&](const RectRoot& r, const RectRoot& s) {
    return coordinate(r) < coordinate(s) || (coordinate(r) == coordinate(s) && r.side < s.side);
  });
  // Rounding along an axis keeps the order but for ties; between axes it does not.
  const Coord closest = along.is_slanted() ? Direction::kSlantParts * kClosestAcross : 0;
  for (std::size_t i = 2; i < roots.size(); i += 2) {
    if (coordinate(roots[i]) - coordinate(roots[i - 1]) <= closest) return false;  // the order is not known
  }
  for (std::size_t i = 0; along.is_slanted() && i < roots.size(); i += 2) {
    if (roots[i].side == roots[i + 1].side) return false;  // needs a point between them, which is found along an axis
  }
  for (std::size_t i = 0; i < roots.size(); i += 2) link(rect, roots[i], roots[i + 1], along.axis);
  return true;
}

/// Two roots are the ends of a curve, which has an order between them along an axis, or a chord will do for it.
void FaceTracer::link(const Rect& rect, RectRoot from, RectRoot to, int axis) {
  if (starts_curve(from) == starts_curve(to)) throw LatticeDegenerate(to_angstrom(rect.lo));
  if (!starts_curve(from)) std::swap(from, to);
  points_[from.point].next = to.point;
  points_[from.point].piece = static_cast<int>(pieces_.size());
  pieces_.push_back({rect, axis, Side::kUnknown, 0.0});
}

std::vector<FaceTracer::RectRoot> FaceTracer::cut_roots(const NearAtoms& atoms, int edge_axis, const CoordPoint& lo,
                                                        Coord hi) {
  CoordPoint end = lo;
  end[edge_axis] = hi;
  const Box box{to_angstrom(lo), to_angstrom(end)};
  const LocalModel model(atoms, field_.decay(), box);
  std::vector<RectRoot> result;
  for (const EdgeRoot& root : finder_.find(atoms, model, edge_axis, lo, hi)) {
    result.push_back({static_cast<int>(points_.size()), 0});
    points_.push_back({root.point, kLocalVertex, root.side, false, -1, -1});
  }
  return result;
}

void FaceTracer::split_rect(const Rect& rect, const std::vector<RectRoot>& roots) {
  const int a = first_axis(axis_), b = second_axis(axis_);
  const bool cut_a = rect.hi[a] - rect.lo[a] > kSmallestRect, cut_b = rect.hi[b] - rect.lo[b] > kSmallestRect;
  if (!cut_a || !cut_b) throw LatticeDegenerate(to_angstrom(rect.lo));
  // An odd number of half units keeps roots, which are rounded to whole ones, off the cuts.
  const Coord ma = rect.lo[a] + (rect.hi[a] - rect.lo[a]) / 2, mb = rect.lo[b] + (rect.hi[b] - rect.lo[b]) / 2;
  CoordPoint centre = rect.lo;
  centre[a] = ma;
  centre[b] = mb;
  CoordPoint low_a = centre, low_b = centre;
  low_a[a] = rect.lo[a];
  low_b[b] = rect.lo[b];
  const NearAtoms& atoms = root_atoms_of(rect);
  const std::vector<RectRoot> left = cut_roots(atoms, a, low_a, ma), right = cut_roots(atoms, a, centre, rect.hi[a]);
  const std::vector<RectRoot> below = cut_roots(atoms, b, low_b, mb), above = cut_roots(atoms, b, centre, rect.hi[b]);

  for (int part = 0; part < 4; ++part) {
    const bool high_a = part & 1, high_b = part & 2;
    Rect sub = rect;
    (high_a ? sub.lo : sub.hi)[a] = ma;
    (high_b ? sub.lo : sub.hi)[b] = mb;
    std::vector<RectRoot> sub_roots;
    for (const RectRoot& root : roots) {
      const CoordPoint& p = points_[root.point].point.position;
      const int along = root.side % 2 == 0 ? a : b;
      const Coord cut = along == a ? ma : mb;
      if (p[along] == cut) throw LatticeDegenerate(to_angstrom(p));
      const bool on_side = root.side == 0 ? !high_b : root.side == 1 ? high_a : root.side == 2 ? high_b : !high_a;
      if (on_side && (p[along] > cut) == (along == a ? high_a : high_b)) sub_roots.push_back(root);
    }
    for (RectRoot root : high_a ? right : left) sub_roots.push_back({root.point, high_b ? 0 : 2});
    for (RectRoot root : high_b ? above : below) sub_roots.push_back({root.point, high_a ? 3 : 1});
    const Box box{to_angstrom(sub.lo), to_angstrom(sub.hi)};
    const LocalModel model(proof_atoms_of(sub), field_.decay(), box);
    trace_rect(sub, certify_face(model, axis_, box), std::move(sub_roots));
  }
}

void FaceTracer::collect_chains(std::span<const FaceRoot> roots) {
  std::vector<bool> seen(points_.size(), false);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (!starts_curve({static_cast<int>(i), roots[i].boundary_side})) continue;
    chains_.push_back({static_cast<int>(i), false});
    for (int p = static_cast<int>(i); p >= 0; p = points_[p].next) seen[p] = true;
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (seen[i]) continue;
    chains_.push_back({static_cast<int>(i), true});
    for (int p = static_cast<int>(i); !seen[p]; p = points_[p].next) {
      if (points_[p].next < 0) throw LatticeDegenerate(to_angstrom(points_[p].point.position));
      seen[p] = true;
    }
  }
}

int FaceTracer::length_of(const Chain& chain) const {
  int count = points_[chain.first].kept;
  for (int p = points_[chain.first].next; p >= 0 && p != chain.first; p = points_[p].next) count += points_[p].kept;
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
  while (points_[last].next >= 0) last = points_[last].next;
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
    if (next < 0 || next == chain.first) break;
    p = next;
  }
  for (int p = chain.first; points_[p].next >= 0;) {
    const int next = points_[p].next;
    insert_fold_points(p, axis);
    p = next;
    if (p == chain.first) break;
  }
}

void FaceTracer::insert_fold_points(int from, int axis) {
  constexpr int kSamples = 4;        // parts of a piece that are looked at for a change of sign
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

double FaceTracer::find_fold_point(Piece& piece, int axis, double lo, double hi, double lo_slope,
                                   double hi_slope) {
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
  result.position[over] = std::clamp<Coord>(std::llround(at * kUnitsPerAngstrom), piece.rect.lo[over] + 1,
                                            piece.rect.hi[over] - 1);
  Vec3 start = to_angstrom(result.position), end = start;
  end[along] = to_angstrom(piece.rect.hi[along]);
  if (piece.lo == Side::kUnknown) {
    const LocalModel model(atoms, field_.decay(), {start, end});
    const bool inside_lo = is_inside(field_, atoms, model, start);
    if (inside_lo == is_inside(field_, atoms, model, end)) throw LatticeDegenerate(start);
    piece.lo = inside_lo ? Side::kInside : Side::kOutside;
    piece.last = 0.5 * (start[along] + end[along]);
  }
  const LineRoot root = refine_root(atoms, field_.decay(), start, along, start[along], end[along],
                                    piece.lo == Side::kInside, piece.last);
  piece.last = root.position;
  result.position[along] = std::clamp<Coord>(std::llround(root.position * kUnitsPerAngstrom),
                                             piece.rect.lo[along] + 1, piece.rect.hi[along] - 1);
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

bool FaceTracer::polygons_cross() const {
  struct Segment {
    PlanePoint p, q;
    int from, to;
  };
  std::vector<Segment> sides;
  for (const Chain& chain : chains_) {
    int start = chain.first;
    while (!points_[start].kept) start = points_[start].next;
    int from = start;
    for (int p = points_[start].next; p >= 0; p = points_[p].next) {
      if (points_[p].kept) {
        sides.push_back({plane(from), plane(p), from, p});
        from = p;
      }
      if (p == start) break;
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].p == sides[i].q) return true;
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const Segment &s = sides[i], &t = sides[j];
      if (s.to == t.from && s.from == t.to) return true;
      if (s.to == t.from) {
        if (segments_overlap(s.q, s.p, t.q)) return true;
      } else if (t.to == s.from) {
        if (segments_overlap(t.q, t.p, s.q)) return true;
      } else if (segments_meet(s.p, s.q, t.p, t.q)) {
        return true;
      }
    }
  }
  return false;
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
    if (points_[i].next >= 0) points_[insert_middle(static_cast<int>(i))].kept = true;
  }
}

void FaceTracer::emit() {
  for (TracePoint& p : points_) {
    if (!p.kept || p.vertex != kLocalVertex) continue;
    p.vertex = kLocalVertex + static_cast<std::uint32_t>(curves_.points.size());
    curves_.points.push_back(p.point);
  }
  for (const Chain& chain : chains_) {
    int start = chain.first;
    while (!points_[start].kept) start = points_[start].next;
    int from = start;
    for (int p = points_[start].next; p >= 0; p = points_[p].next) {
      if (points_[p].kept) {
        curves_.links.push_back({points_[from].vertex, points_[p].vertex});
        from = p;
      }
      if (p == start) break;
    }
  }
}

}  // namespace gaussmesh
