#include "boxes/cell_prover.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "boxes/gradient_cone.h"

namespace gaussmesh {
namespace {

int proven_sign(const Range& slope) { return slope.lo > 0.0 ? 1 : slope.hi < 0.0 ? -1 : 0; }

bool is_excluded(const Range& value) { return value.hi < 0.0 || value.lo > 0.0; }

/// Slanted directions that are tried for a cell.
constexpr int kMostDirections = 8;

using Eighths = std::array<Box, 8>;

Eighths eighths_of(const Box& box) {
  Eighths eighths;
  for (int child = 0; child < 8; ++child) eighths[child] = child_box(box, child);
  return eighths;
}

}  // namespace

Box child_box(const Box& box, int child) {
  Box result = box;
  for (int k = 0; k < 3; ++k) (child >> k & 1 ? result.lo : result.hi)[k] = 0.5 * (box.lo[k] + box.hi[k]);
  return result;
}

CellCertificate CellProver::certify(const NearAtoms& atoms, const LazyModel& lazy_model, int depth,
                                    const KnownOfCell& known) {
  using Kind = CellCertificate::Kind;
  depth_ = depth;
  ++boxes_by_depth_[0];
  // Of both directions, which means that there is no surface, either does.
  const auto known_sign = [&](int axis) {
    const unsigned both = known.directions >> (2 * axis) & 3u;
    return both == 0 ? 0 : both == 1 ? -1 : 1;
  };
  if (known.steepest_axis >= 0) {
    const int sign = known_sign(known.steepest_axis);
    if (sign != 0) return {Kind::kMonotone, along_axis(known.steepest_axis, sign), axes_of(known.directions)};
  }
  const LocalModel& model = lazy_model.get();
  const LocalModel::View view = model.over_all();
  if (!known.is_crossed && is_excluded(view.value())) return {Kind::kExcluded, {}, 0};

  const Vec3 gradient = view.middle_gradient();
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return std::abs(gradient[a]) > std::abs(gradient[b]); });
  CellCertificate whole;
  for (int axis : axes) {
    const int sign = known_sign(axis) != 0 ? known_sign(axis) : proven_sign(view.slope(axis));
    if (sign == 0) continue;
    if (whole.kind != Kind::kMonotone) whole = {Kind::kMonotone, along_axis(axis, sign), 0};
    whole.single_axes |= 1u << axis;
  }
  if (whole.kind == Kind::kMonotone) return whole;
  if (depth_ == 0) return {Kind::kUncertified, {}, 0};

  // What is known of each eighth of the cell is found once for all directions: by the cell's own model, which takes
  // no sums over atoms, and where that leaves all directions open in some eighth, by a model of each.
  const Eighths eighths = eighths_of(model.box());
  const PartProofs proofs = model.prove(eighths);
  Part parts[8];
  unsigned common = kAllDirections;
  for (int child = 0; child < 8; ++child) {
    parts[child] = part_of(proofs.directions[child], proofs.is_surely_crossed[child]);
    common &= parts[child].proven;
  }
  if (common == kAllDirections) return {Kind::kExcluded, {}, 0};
  if (common != 0) {
    for (const int axis : axes) {
      for (const int sign : {1, -1}) {
        if (common >> (2 * axis + (sign > 0)) & 1) return {Kind::kMonotone, along_axis(axis, sign), axes_of(common)};
      }
    }
  }
  // Directions that fewest eighths leave open are looked at more closely first.
  cell_atoms_.restrict_from(atoms, model.box(), decay_, atoms.cut);
  LocalModel models[8];
  int open_parts[6] = {};
  bool refuted[6] = {};
  for (int child = 0; child < 8; ++child) {
    Part& part = parts[child];
    if (part.proven != kAllDirections) {
      count_box(depth_);
      models[child] = LocalModel(cell_atoms_, decay_, eighths[child]);
      const LocalModel::View view_of_child = models[child].over_all();
      const Part closer = part_of(view_of_child.directions(), view_of_child.is_surely_crossed());
      part = {part.proven | closer.proven, part.refuted | closer.refuted};
    }
    for (int direction = 0; direction < 6; ++direction) {
      open_parts[direction] += !(part.proven >> direction & 1);
      refuted[direction] = refuted[direction] || (part.refuted >> direction & 1);
    }
  }
  if (std::all_of(parts, parts + 8, [](const Part& part) { return part.proven == kAllDirections; })) {
    return {Kind::kExcluded, {}, 0};
  }
  // The gradient in the middle says little of a surface that only grazes the cell: the other signs come last.
  int order[6];
  for (int i = 0; i < 3; ++i) {
    order[i] = 2 * axes[i] + (gradient[axes[i]] > 0.0);
    order[i + 3] = order[i] ^ 1;
  }
  std::stable_sort(order, order + 6, [&](int a, int b) { return open_parts[a] < open_parts[b]; });
  // Whether a direction is proven for the cell, given what tells at once that it is for an eighth.
  const auto is_proven = [&](const Direction& direction, const auto& holds_in) {
    for (int child = 0; child < 8; ++child) {
      if (holds_in(child)) continue;
      if (depth_ <= 1 || !prove_parts(cell_atoms_, models[child], direction, depth_ - 1)) return false;
    }
    return true;
  };
  for (const int direction : order) {
    if (refuted[direction]) continue;
    const int axis = direction / 2, sign = direction % 2 == 1 ? 1 : -1;
    const auto holds_in = [&](int child) { return parts[child].proven >> direction & 1; };
    if (is_proven(along_axis(axis, sign), holds_in)) return {Kind::kMonotone, along_axis(axis, sign), 1u << axis};
  }
  // No axis: the surface bends too far. A direction in the midst of its gradients may do, and where it does not, one
  // nearer to the gradient that was against it.
  GradientCone cone;
  for (int child = 0; child < 8; ++child) {
    if (parts[child].proven != kAllDirections) cone.add(models[child].over_all().middle_gradient());
  }
  for (int attempt = 0; attempt < kMostDirections; ++attempt) {
    const Direction slanted = nearest_direction(cone.middle());
    if (!slanted.is_slanted()) break;
    const auto holds_in = [&](int child) {
      if (parts[child].proven == kAllDirections) return true;
      const LocalModel::View whole_eighth = models[child].over_all();
      refuting_gradient_ = whole_eighth.middle_gradient();  // unless parts of it tell better
      return whole_eighth.proves(slanted);
    };
    if (is_proven(slanted, holds_in)) return {Kind::kMonotone, slanted, 0};
    cone.add(refuting_gradient_);
  }
  return {Kind::kUncertified, {}, 0};
}

CellProver::Part CellProver::part_of(unsigned directions, bool is_surely_crossed) {
  Part part{directions, 0};
  if (directions == kAllDirections || !is_surely_crossed) return part;
  for (int direction = 0; direction < 6; ++direction) {
    if (directions >> (direction ^ 1) & 1) part.refuted |= 1u << direction;
  }
  return part;
}

bool CellProver::prove_parts(const NearAtoms& atoms, const LocalModel& model, const Direction& direction, int depth) {
  const Eighths eighths = eighths_of(model.box());
  const unsigned proven = model.prove_along(eighths, direction);
  for (int child = 0; child < 8; ++child) {
    if (proven >> child & 1) continue;
    count_box(depth);
    const LocalModel closer(atoms, decay_, eighths[child]);
    const LocalModel::View view = closer.over_all();
    if (view.proves(direction)) continue;
    const bool is_refuted = proven_sign(view.slope(direction)) == -direction.sign && view.is_surely_crossed();
    if (depth <= 1 || is_refuted) {
      refuting_gradient_ = view.middle_gradient();
      return false;
    }
    if (!prove_parts(atoms, closer, direction, depth - 1)) return false;
  }
  return true;
}

}  // namespace gaussmesh
