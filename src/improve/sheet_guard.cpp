#include "improve/sheet_guard.h"

namespace gaussmesh {

std::vector<std::uint8_t> mark_close_sheets(const WorkingMesh& mesh, double reach) {
  constexpr double kOtherSheet = 0.25;  // cosine between normals
  const HalfEdgeMesh& c = mesh.connectivity;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / reach)); };
  const auto key = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ull ^ static_cast<std::uint64_t>(j) * 0xC2B2AE3D27D4EB4Full ^
           static_cast<std::uint64_t>(k) * 0x165667B19E3779F9ull;
  };
  for (std::uint32_t v = 0; v < c.vertices(); ++v) {
    if (c.has_vertex(v)) cells[key(index(mesh.at[v][0]), index(mesh.at[v][1]), index(mesh.at[v][2]))].push_back(v);
  }
  std::vector<std::uint8_t> marks(c.vertices(), 0);
  const auto has_other_sheet = [&](std::uint32_t v) {
    const Vec3 n = as_vector(mesh.points[v].normal);
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto it =
              cells.find(key(index(mesh.at[v][0]) + i, index(mesh.at[v][1]) + j, index(mesh.at[v][2]) + k));
          if (it == cells.end()) continue;
          for (const std::uint32_t w : it->second) {
            const Vec3 between = mesh.at[w] - mesh.at[v];
            if (dot(n, as_vector(mesh.points[w].normal)) < kOtherSheet && dot(between, between) < reach * reach) {
              return true;
            }
          }
        }
      }
    }
    return false;
  };
  for (std::uint32_t v = 0; v < c.vertices(); ++v) {
    if (!c.has_vertex(v) || !has_other_sheet(v)) continue;
    marks[v] = 1;
    c.visit_star(v, [&](std::uint32_t h) { marks[c.to(h)] = 1; });
  }
  return marks;
}

SheetGuard::SheetGuard(const WorkingMesh& mesh, double cell_size)
    : cell_units_(std::max<Coord>(1, std::llround(cell_size * kUnitsPerAngstrom))) {
  rebuild(mesh);
}

void SheetGuard::rebuild(const WorkingMesh& mesh) {
  cells_.clear();
  for (std::uint32_t t = 0; t < mesh.connectivity.triangles(); ++t) {
    if (mesh.connectivity.has_triangle(t)) insert(mesh, t);
  }
}

void SheetGuard::insert(const WorkingMesh& mesh, std::uint32_t triangle) {
  const Triangle t = mesh.connectivity.triangle(triangle);
  if (!is_guarded(mesh, t)) return;
  visit_cells(name(mesh, t), [&](std::uint64_t key) {
    std::vector<std::uint32_t>& cell = cells_[key];
    if (std::find(cell.begin(), cell.end(), triangle) == cell.end()) cell.push_back(triangle);
  });
}

}  // namespace gaussmesh
