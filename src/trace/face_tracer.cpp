#include "trace/face_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/lattice_degenerate.h"

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

bool FaceTracer::starts_curve(const RectRoot& root) const {
  return starts_curve(root.boundary_side, points_[root.point].rise);
}

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
  if (roots.size() <= 2 && chords_will_do(rect, roots) && prover_.has_no_closed_curve(model) &&
      pair_only_curve(rect, roots)) {
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
  const bool turns_back = roots.size() == 2 && roots[0].boundary_side == roots[1].boundary_side;
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
    return coordinate(r) < coordinate(s) || (coordinate(r) == coordinate(s) && r.boundary_side < s.boundary_side);
  });
  // Rounding along an axis keeps the order but for ties; between axes it does not.
  const Coord closest = along.is_slanted() ? Direction::kSlantParts * kClosestAcross : 0;
  for (std::size_t i = 2; i < roots.size(); i += 2) {
    if (coordinate(roots[i]) - coordinate(roots[i - 1]) <= closest) return false;  // the order is not known
  }
  for (std::size_t i = 0; along.is_slanted() && i < roots.size(); i += 2) {
    if (roots[i].boundary_side == roots[i + 1].boundary_side)
      return false;  // needs a point between them, which is found along an axis
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
    points_.push_back({root.point, kLocalVertex, root.rise, false, -1, -1});
  }
  return result;
}

void FaceTracer::split_rect(const Rect& rect, const std::vector<RectRoot>& roots) {
  const int a = first_axis(axis_), b = second_axis(axis_);
  const bool cut_a = rect.hi[a] - rect.lo[a] > kSmallestRect, cut_b = rect.hi[b] - rect.lo[b] > kSmallestRect;
  if (!cut_a || !cut_b) throw LatticeDegenerate(to_angstrom(rect.lo));
  // A root may be rounded onto a cut: its side is then not known, and this lattice will not do.
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
      const int along = root.boundary_side % 2 == 0 ? a : b;
      const Coord cut = along == a ? ma : mb;
      if (p[along] == cut) throw LatticeDegenerate(to_angstrom(p));
      const bool on_side = root.boundary_side == 0   ? !high_b
                           : root.boundary_side == 1 ? high_a
                           : root.boundary_side == 2 ? high_b
                                                     : !high_a;
      if (on_side && (p[along] > cut) == (along == a ? high_a : high_b)) sub_roots.push_back(root);
    }
    for (RectRoot root : high_a ? right : left) sub_roots.push_back({root.point, high_b ? 0 : 2});
    for (RectRoot root : high_b ? above : below) sub_roots.push_back({root.point, high_a ? 3 : 1});
    const Box box{to_angstrom(sub.lo), to_angstrom(sub.hi)};
    const LocalModel model(proof_atoms_of(sub), field_.decay(), box);
    trace_rect(sub, certify_face(model, axis_, box), std::move(sub_roots));
  }
}

}  // namespace gaussmesh
