#include "improve/sheet_guard.h"

#include "improve/close_sheets.h"

namespace gaussmesh {
namespace {

constexpr double kLeastWidth = 1e-6;  ///< A, of the cube

/// Marks the corners of the triangles that have a vertex with another sheet near.
void mark_close_sheets(BlockMesh& mesh) {
  const HalfEdgeMesh& c = mesh.connectivity;
  const std::vector<std::uint8_t> marks = find_close_sheets(mesh);
  mesh.is_guarded = marks;
  const auto spread = [&](const Triangle& t) {
    if (!marks[t[0]] && !marks[t[1]] && !marks[t[2]]) return;
    for (const std::uint32_t v : t) mesh.is_guarded[v] = 1;
  };
  for (std::uint32_t t = 0; t < c.triangles(); ++t) {
    if (c.has_triangle(t)) spread(c.triangle(t));
  }
  for (const Triangle& t : mesh.fixed) spread(t);
}

}  // namespace

SheetGuard::SheetGuard(BlockMesh& mesh, Guarding guarding) : guarding_(guarding) {
  find_cube(mesh);
  if (guarding == Guarding::kEverywhere) {
    std::fill(mesh.is_guarded.begin(), mesh.is_guarded.end(), std::uint8_t{1});
  } else {
    mark_close_sheets(mesh);
  }
  for (std::uint32_t t = 0; t < mesh.connectivity.triangles(); ++t) {
    if (mesh.connectivity.has_triangle(t)) insert(mesh, t);
  }
  for (std::uint32_t i = 0; i < mesh.fixed.size(); ++i) {
    if (is_guarded(mesh, mesh.fixed[i])) enter(mesh, mesh.fixed[i], kFirstFixed + i);
  }
}

void SheetGuard::find_cube(const BlockMesh& mesh) {
  Vec3 lo = mesh.box.hi, hi = mesh.box.lo;
  for (const Vec3& p : mesh.at) {
    if (!mesh.contains(p)) continue;
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  lo_ = lo;
  width_ = static_cast<float>(std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2], kLeastWidth}));
}

SheetTree::Item SheetGuard::item_of(const BlockMesh& mesh, const Triangle& t) const {
  SheetTree::Item item{};
  for (int k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax({mesh.at[t[0]][k], mesh.at[t[1]][k], mesh.at[t[2]][k]});
    // Rounding keeps the order of numbers, so boxes that meet still do.
    item.box.lo[k] = static_cast<float>(least - lo_[k]);
    item.box.hi[k] = static_cast<float>(most - lo_[k]);
  }
  if (guarding_ == Guarding::kEverywhere) return item;
  for (const std::uint32_t v : t) {
    for (int k = 0; k < 3; ++k) item.normal[k] += mesh.normal[v][k] * (1.0f / 3.0f);
  }
  return item;
}

bool SheetGuard::pair_may_meet(const BlockMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto name = [&](const Triangle& u) {
    return NamedTriangle{u, {to_units(mesh.at[u[0]]), to_units(mesh.at[u[1]]), to_units(mesh.at[u[2]])}};
  };
  return triangles_may_meet(name(s), name(t));
}

void SheetGuard::insert(const BlockMesh& mesh, std::uint32_t triangle) {
  const Triangle t = mesh.connectivity.triangle(triangle);
  if (!is_guarded(mesh, t)) return;
  if (entry_of_.size() <= triangle) entry_of_.resize(mesh.connectivity.triangles(), kNoEntry);
  if (entry_of_[triangle] != kNoEntry) return tree_->change(entry_of_[triangle], item_of(mesh, t));
  entry_of_[triangle] = static_cast<std::uint32_t>(triangle_of_.size());
  enter(mesh, t, triangle);
}

void SheetGuard::enter(const BlockMesh& mesh, const Triangle& corners, std::uint32_t triangle) {
  if (!tree_) tree_.emplace(width_);
  tree_->add(item_of(mesh, corners));
  triangle_of_.push_back(triangle);
}

}  // namespace gaussmesh
