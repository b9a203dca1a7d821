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
  if (known.steepest_axis) {
    const int sign = known_sign(*known.steepest_axis);
    if (sign != 0) return {Kind::kMonotone, along_axis(*known.steepest_axis, sign), axes_of(known.directions)};
  }
  const LocalModel& model = lazy_model.get();
  const LocalModel::View view = model.over_all();
  if (!known.is_crossed && is_excluded(view.value())) return {Kind::kExcluded, {}, 0};

  const SortedAxes axes = sort_axes(view.middle_gradient());
  CellCertificate whole;
  for (const int axis : axes.number) {
    const int sign = known_sign(axis) != 0 ? known_sign(axis) : proven_sign(view.slope(axis));
    if (sign == 0) continue;
    if (whole.kind != Kind::kMonotone) whole = {Kind::kMonotone, along_axis(axis, sign), 0};
    whole.single_axes |= 1u << axis;
  }
  if (whole.kind == Kind::kMonotone) return whole;
  return depth_ == 0 ? CellCertificate{} : certify_by_eighths(atoms, model, axes);
}

CellCertificate CellProver::certify_by_eighths(const NearAtoms& atoms, const LocalModel& model,
                                               const SortedAxes& axes) {
  using Kind = CellCertificate::Kind;
  // What is known of each eighth of the cell is found once for all directions: by the cell's own model, which takes
  // no sums over atoms, and where that leaves all directions open in some eighth, by a model of each.
  const Eighths boxes = eighths_of(model.box());
  const PartProofs proofs = model.prove(boxes);
  std::array<Eighth, 8> eighths;
  unsigned common = kAllDirections;
  for (int child = 0; child < 8; ++child) {
    eighths[child].part = part_of(proofs.directions[child], proofs.is_surely_crossed[child]);
    common &= eighths[child].part.proven;
  }
  if (common == kAllDirections) return {Kind::kExcluded, {}, 0};
  if (common != 0) {
    for (const int axis : axes.number) {
      for (const int sign : {1, -1}) {
        if (common >> (2 * axis + (sign > 0)) & 1) return {Kind::kMonotone, along_axis(axis, sign), axes_of(common)};
      }
    }
  }
  cell_atoms_.restrict_from(atoms, model.box(), decay_, atoms.cut);
  bool is_free = true;
  for (int child = 0; child < 8; ++child) {
    Part& part = eighths[child].part;
    if (part.proven != kAllDirections) {
      count_box(depth_);
      eighths[child].model = LocalModel(cell_atoms_, decay_, boxes[child]);
      const LocalModel::View view = eighths[child].model.over_all();
      const Part closer = part_of(view.directions(), view.is_surely_crossed());
      part = {part.proven | closer.proven, part.refuted | closer.refuted};
    }
    is_free = is_free && part.proven == kAllDirections;
  }
  if (is_free) return {Kind::kExcluded, {}, 0};
  for (const int direction : promising_directions(eighths, axes)) {
    const int axis = direction / 2, sign = direction % 2 == 1 ? 1 : -1;
    const auto look = [&](const Eighth& eighth) { return (eighth.part.proven >> direction & 1) != 0; };
    if (!find_counterexample(eighths, along_axis(axis, sign), look))
      return {Kind::kMonotone, along_axis(axis, sign), 1u << axis};
  }
  return certify_aslant(eighths);
}

std::vector<int> CellProver::promising_directions(const std::array<Eighth, 8>& eighths, const SortedAxes& axes) {
  int open_parts[6] = {};
  bool refuted[6] = {};
  for (const Eighth& eighth : eighths) {
    for (int direction = 0; direction < 6; ++direction) {
      open_parts[direction] += !(eighth.part.proven >> direction & 1);
      refuted[direction] = refuted[direction] || (eighth.part.refuted >> direction & 1);
    }
  }
  // The gradient in the middle says little of a surface that only grazes the cell: the other signs come last.
  std::vector<int> order;
  for (const int against : {0, 1}) {
    for (const int axis : axes.number) {
      const int direction = 2 * axis + ((axes.gradient[axis] > 0.0) != (against == 1));
      if (!refuted[direction]) order.push_back(direction);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return open_parts[a] < open_parts[b]; });
  return order;
}

CellCertificate CellProver::certify_aslant(const std::array<Eighth, 8>& eighths) {
  GradientCone cone;
  for (const Eighth& eighth : eighths) {
    if (eighth.part.proven != kAllDirections) cone.add(eighth.model.over_all().middle_gradient());
  }
  for (int attempt = 0; attempt < kMostDirections; ++attempt) {
    const Direction slanted = nearest_direction(cone.middle());
    if (!slanted.is_slanted()) break;
    const auto look = [&](const Eighth& eighth) {
      return eighth.part.proven == kAllDirections || eighth.model.over_all().proves(slanted);
    };
    const std::optional<Vec3> against = find_counterexample(eighths, slanted, look);
    if (!against) return {CellCertificate::Kind::kMonotone, slanted, 0};
    cone.add(*against);
  }
  return {};
}

template <typename Look>
std::optional<Vec3> CellProver::find_counterexample(const std::array<Eighth, 8>& eighths, const Direction& direction,
                                                    const Look& holds_at_a_look) {
  for (const Eighth& eighth : eighths) {
    if (holds_at_a_look(eighth)) continue;
    const std::optional<Vec3> against = depth_ <= 1 ? eighth.model.over_all().middle_gradient()
                                                    : find_counterexample_in_parts(eighth.model, direction, depth_ - 1);
    if (against) return against;
  }
  return std::nullopt;
}

CellProver::SortedAxes CellProver::sort_axes(const Vec3& gradient) {
  SortedAxes axes{gradient, {0, 1, 2}};
  std::sort(axes.number.begin(), axes.number.end(),
            [&](int a, int b) { return std::abs(gradient[a]) > std::abs(gradient[b]); });
  return axes;
}

CellProver::Part CellProver::part_of(unsigned directions, bool is_surely_crossed) {
  Part part{directions, 0};
  if (directions == kAllDirections || !is_surely_crossed) return part;
  for (int direction = 0; direction < 6; ++direction) {
    if (directions >> (direction ^ 1) & 1) part.refuted |= 1u << direction;
  }
  return part;
}

std::optional<Vec3> CellProver::find_counterexample_in_parts(const LocalModel& model, const Direction& direction,
                                                             int depth) {
  const Eighths eighths = eighths_of(model.box());
  const unsigned proven = model.prove_along(eighths, direction);
  for (int child = 0; child < 8; ++child) {
    if (proven >> child & 1) continue;
    count_box(depth);
    const LocalModel closer(cell_atoms_, decay_, eighths[child]);
    const LocalModel::View view = closer.over_all();
    if (view.proves(direction)) continue;
    const bool is_refuted = proven_sign(view.slope(direction)) == -direction.sign && view.is_surely_crossed();
    if (depth <= 1 || is_refuted) return view.middle_gradient();
    if (const std::optional<Vec3> against = find_counterexample_in_parts(closer, direction, depth - 1)) return against;
  }
  return std::nullopt;
}

}  // namespace gaussmesh
