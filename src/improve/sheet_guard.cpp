#include "improve/sheet_guard.h"

#include "improve/close_sheets.h"

namespace gaussmesh {
namespace {

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
  lay_grid(mesh);
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

/// Round what of the mesh is in the block, with cells of about the size of the mean triangle where the surface crosses
/// it once.
void SheetGuard::lay_grid(const BlockMesh& mesh) {
  constexpr int kLeastCells = 4, kMostCells = 48;
  Vec3 lo = mesh.box.hi, hi = mesh.box.lo;
  for (const Vec3& p : mesh.at) {
    if (!mesh.contains(p)) continue;
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  const double width = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  const double across = std::sqrt(0.5 * mesh.connectivity.triangles());
  lo_ = lo;
  cells_ = static_cast<int>(std::clamp(across, double(kLeastCells), double(kMostCells)));
  cells_per_angstrom_ = width > 0.0 ? static_cast<float>(cells_ / width) : 1.0f;
}

bool SheetGuard::pair_may_meet(const BlockMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto name = [&](const Triangle& u) {
    return NamedTriangle{u, {to_units(mesh.at[u[0]]), to_units(mesh.at[u[1]]), to_units(mesh.at[u[2]])}};
  };
  return triangles_may_meet(name(s), name(t));
}

void SheetGuard::insert(const BlockMesh& mesh, std::uint32_t triangle) {
  const Triangle t = mesh.connectivity.triangle(triangle);
  if (is_guarded(mesh, t)) enter(mesh, t, triangle);
}

void SheetGuard::enter(const BlockMesh& mesh, const Triangle& corners, std::uint32_t triangle) {
  if (head_.empty()) head_.assign(static_cast<std::size_t>(cells_ * cells_ * cells_), -1);
  const SmallBox box = box_of(mesh, corners);
  const Normal normal = mean_normal(mesh, corners);
  visit_cells(box, [&](std::size_t cell) {
    for (std::int32_t n = head_[cell]; n >= 0; n = nodes_[n].next) {
      if (nodes_[n].triangle != triangle) continue;
      nodes_[n].box = box;
      nodes_[n].normal = normal;
      return false;
    }
    nodes_.push_back({triangle, head_[cell], box, normal});
    head_[cell] = static_cast<std::int32_t>(nodes_.size()) - 1;
    return false;
  });
}

}  // namespace gaussmesh
