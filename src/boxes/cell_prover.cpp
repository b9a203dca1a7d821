#include "boxes/cell_prover.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gaussmesh {
namespace {

int proven_sign(const Range& slope) { return slope.lo > 0.0 ? 1 : slope.hi < 0.0 ? -1 : 0; }

bool is_excluded(const Range& value) { return value.hi < 0.0 || value.lo > 0.0; }

/// Not a proof, only a reason to stop looking for one: by the model, the surface passes through the inner half.
bool surface_is_surely_near(const LocalModel::View& view, const Box& box) {
  const Vec3 g = view.middle_gradient();
  double reach = 0.0;
  for (int k = 0; k < 3; ++k) reach += 0.25 * std::abs(g[k]) * (box.hi[k] - box.lo[k]);
  return std::abs(view.middle_value()) < 0.5 * reach;
}

}  // namespace

Box child_box(const Box& box, int child) {
  Box result = box;
  for (int k = 0; k < 3; ++k) (child >> k & 1 ? result.lo : result.hi)[k] = 0.5 * (box.lo[k] + box.hi[k]);
  return result;
}

CellCertificate CellProver::certify(const NearAtoms& atoms, const LocalModel& model) {
  using Kind = CellCertificate::Kind;
  ++boxes_by_depth_[0];
  const LocalModel::View view = model.over_all();
  if (is_excluded(view.value())) return {Kind::kExcluded, 0, 0};

  const Vec3 gradient = view.middle_gradient();
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return std::abs(gradient[a]) > std::abs(gradient[b]); });
  for (int axis : axes) {
    if (const int sign = proven_sign(view.slope(axis))) return {Kind::kMonotone, axis, sign};
  }
  if (depth_ == 0) return {Kind::kUncertified, 0, 0};

  // What each eighth of the cell shows by itself is found once for all directions; those that fewest eighths leave open
  // are looked at more closely first.
  cell_atoms_.restrict_from(atoms, model.box(), decay_, atoms.cut);
  Part parts[8];
  int open_parts[6] = {};
  bool refuted[6] = {};
  for (int child = 0; child < 8; ++child) {
    parts[child] = look_at(cell_atoms_, child_box(model.box(), child), depth_);
    for (int direction = 0; direction < 6; ++direction) {
      open_parts[direction] += !(parts[child].proven >> direction & 1);
      refuted[direction] = refuted[direction] || (parts[child].refuted >> direction & 1);
    }
  }
  // The gradient in the middle says little of a surface that only grazes the cell: the other signs come last.
  int order[6];
  for (int i = 0; i < 3; ++i) {
    order[i] = 2 * axes[i] + (gradient[axes[i]] > 0.0);
    order[i + 3] = order[i] ^ 1;
  }
  std::stable_sort(order, order + 6, [&](int a, int b) { return open_parts[a] < open_parts[b]; });
  for (const int direction : order) {
    if (refuted[direction]) continue;
    const int axis = direction / 2, sign = direction % 2 == 1 ? 1 : -1;
    bool proven = true;
    for (int child = 0; proven && child < 8; ++child) {
      if (parts[child].proven >> direction & 1) continue;
      proven = depth_ > 1 && prove_monotone(cell_atoms_, child_box(model.box(), child), axis, sign, depth_ - 1);
    }
    if (proven) return {Kind::kMonotone, axis, sign};
  }
  return {Kind::kUncertified, 0, 0};
}

CellProver::Part CellProver::look_at(const NearAtoms& atoms, const Box& box, int depth) {
  ++boxes_by_depth_[std::min<std::size_t>(15, depth_ - depth + 1)];
  const LocalModel model(atoms, decay_, box);
  const LocalModel::View view = model.over_all();
  if (is_excluded(view.value())) return {0x3F, 0};
  Part part;
  for (int axis = 0; axis < 3; ++axis) {
    if (const int sign = proven_sign(view.slope(axis))) part.proven |= 1u << (2 * axis + (sign > 0));
  }
  if (part.proven != 0 && surface_is_surely_near(view, box)) {
    for (int direction = 0; direction < 6; ++direction) {
      if (part.proven >> (direction ^ 1) & 1) part.refuted |= 1u << direction;
    }
  }
  return part;
}

bool CellProver::prove_monotone(const NearAtoms& atoms, const Box& box, int axis, int sign, int depth) {
  for (int child = 0; child < 8; ++child) {
    const Box part = child_box(box, child);
    ++boxes_by_depth_[std::min<std::size_t>(15, depth_ - depth + 1)];
    const LocalModel model(atoms, decay_, part);
    const LocalModel::View view = model.over_all();
    if (is_excluded(view.value())) continue;
    const int proven = proven_sign(view.slope(axis));
    if (proven == sign) continue;
    if (depth <= 1 || (proven == -sign && surface_is_surely_near(view, part))) return false;
    if (!prove_monotone(atoms, part, axis, sign, depth - 1)) return false;
  }
  return true;
}

}  // namespace gaussmesh
