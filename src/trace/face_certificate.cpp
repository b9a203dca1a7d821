#include "trace/face_certificate.h"

#include <algorithm>
#include <utility>

namespace gaussmesh {
namespace {

/// Ways along the two axes of a face, a bit each.
constexpr int kWays = 4;
constexpr unsigned kAllWays = 15;

/// Ways that are looked at closer until one is found missed: the third and fourth hardly ever are.
constexpr int kMostWays = 2;

FaceCertificate certificate_from(unsigned directions, int axis) {
  return directions == kAllDirections ? kFaceEmpty : certificate_in_face(axes_of(directions), axis);
}

/// Which ways the gradient in a part of a face across `axis` does not point where phi = c: down and up the first axis,
/// down and up the second, in the order of the bits.
/// @param directions  as in PartProofs
unsigned missed_by_gradient(unsigned directions, int axis) {
  if (directions == kAllDirections) return kAllWays;
  const unsigned along_first = directions >> (2 * first_axis(axis)) & 3u;
  const unsigned along_second = directions >> (2 * second_axis(axis)) & 3u;
  // What has a slope along the one axis does not point along the other; what falls along an axis does not point up it.
  const auto missed = [](unsigned own, unsigned other) { return other != 0 ? 3u : own == 0 ? 0u : own ^ 3u; };
  return missed(along_first, along_second) | missed(along_second, along_first) << 2;
}

}  // namespace

Quarters quarters_of(const Box& face, int axis) {
  const int a = first_axis(axis), b = second_axis(axis);
  Quarters quarters;
  for (int part = 0; part < 4; ++part) {
    quarters[part] = face;
    (part & 1 ? quarters[part].lo : quarters[part].hi)[a] = 0.5 * (face.lo[a] + face.hi[a]);
    (part & 2 ? quarters[part].lo : quarters[part].hi)[b] = 0.5 * (face.lo[b] + face.hi[b]);
  }
  return quarters;
}

FaceCertificate certify_face(const LocalModel& model, int axis, const Box& face) {
  const FaceCertificate whole = certificate_from(model.over(face).directions(), axis);
  if (whole != kFaceUncertified) return whole;
  // Quarters of it may all be empty or single-valued along the same axis.
  const PartProofs quarters = model.prove(quarters_of(face, axis));
  unsigned axes = 7, missed = kAllWays;
  bool is_empty = true;
  for (int part = 0; part < 4; ++part) {
    missed &= missed_by_gradient(quarters.directions[part], axis);
    if (quarters.directions[part] == kAllDirections) continue;
    is_empty = false;
    axes &= axes_of(quarters.directions[part]);
  }
  if (is_empty) return kFaceEmpty;
  const FaceCertificate along = certificate_in_face(axes, axis);
  return along != kFaceUncertified ? along : missed != 0 ? kFaceNoClosedCurve : kFaceUncertified;
}

bool FaceProver::proves(const LocalModel& model, const Direction& along, int depth) {
  const Quarters quarters = quarters_of(model.box(), axis_);
  const unsigned proven = model.prove_along(quarters, along);
  for (int part = 0; part < 4; ++part) {
    if (proven >> part & 1) continue;
    const LocalModel closer(*atoms_, decay_, quarters[part]);
    const LocalModel::View view = closer.over_all();
    if (view.proves(along)) continue;
    const Range slope = view.slope(along);
    if (depth <= 1 || (along.sign > 0 ? slope.hi < 0.0 : slope.lo > 0.0)) {
      refuting_gradient_ = view.middle_gradient();
      return false;
    }
    if (!proves(closer, along, depth - 1)) return false;
  }
  return true;
}

bool FaceProver::has_no_closed_curve(const LocalModel& model) const {
  const Quarters quarters = quarters_of(model.box(), axis_);
  const PartProofs proofs = model.prove(quarters);
  int parts_that_miss[kWays] = {};
  for (int part = 0; part < 4; ++part) {
    const unsigned missed = missed_by_gradient(proofs.directions[part], axis_);
    for (int way = 0; way < kWays; ++way) parts_that_miss[way] += missed >> way & 1;
  }
  // Of ways that as many parts miss, the one most against the gradient in the middle comes first.
  const Vec3 gradient = model.over_all().middle_gradient();
  const double first = gradient[first_axis(axis_)], second = gradient[second_axis(axis_)];
  const double along[kWays] = {-first, first, -second, second};
  int order[kWays] = {0, 1, 2, 3};
  std::sort(order, order + kWays, [&](int v, int w) {
    return std::pair(-parts_that_miss[v], along[v]) < std::pair(-parts_that_miss[w], along[w]);
  });
  for (int i = 0; i < kMostWays; ++i) {
    if (is_missed(quarters, proofs, 1u << order[i], kHalvings)) return true;
  }
  return false;
}

bool FaceProver::is_missed(const Quarters& quarters, const PartProofs& proofs, unsigned way, int depth) const {
  for (int part = 0; part < 4; ++part) {
    if (missed_by_gradient(proofs.directions[part], axis_) & way) continue;
    const LocalModel closer(*atoms_, decay_, quarters[part]);
    if (missed_by_gradient(closer.over_all().directions(), axis_) & way) continue;
    if (depth <= 1) return false;
    const Quarters smaller = quarters_of(quarters[part], axis_);
    if (!is_missed(smaller, closer.prove(smaller), way, depth - 1)) return false;
  }
  return true;
}

}  // namespace gaussmesh
