// Keeping sheets of the surface apart: exact tests where another sheet is near.
#pragma once

#include <unordered_map>
#include <vector>

#include "core/exact_space.h"
#include "improve/working_mesh.h"

namespace gaussmesh {

/// Marks the vertices that have a vertex of another sheet - one whose normal points away by more than 75 degrees -
/// nearer than `reach` (A), and their neighbours: only there can triangles of the improved mesh meet.
std::vector<std::uint8_t> mark_close_sheets(const WorkingMesh& mesh, double reach);

/// The triangles near other sheets, in a grid.
class SheetGuard {
 public:
  /// @param cell_size  about the size of the triangles (A)
  SheetGuard(const WorkingMesh& mesh, double cell_size);

  static bool is_guarded(const WorkingMesh& mesh, const Triangle& t) {
    return mesh.is_guarded[t[0]] || mesh.is_guarded[t[1]] || mesh.is_guarded[t[2]];
  }

  /// Whether `t`, a triangle that is to be, may meet one of the mesh; triangles of which `ignored` says so do not
  /// count. Exact in general position; errs on the side of true where points are coplanar.
  template <typename Ignored>
  bool may_meet(const WorkingMesh& mesh, const Triangle& t, const Ignored& ignored) const {
    const NamedTriangle named = name(mesh, t);
    bool met = false;
    visit_cells(named, [&](std::uint64_t key) {
      const auto it = cells_.find(key);
      if (met || it == cells_.end()) return;
      for (const std::uint32_t other : it->second) {
        if (!mesh.connectivity.has_triangle(other) || ignored(other)) continue;
        const Triangle u = mesh.connectivity.triangle(other);
        if (triangles_may_meet(named, name(mesh, u))) {
          met = true;
          return;
        }
      }
    });
    return met;
  }

  /// Starts anew with the triangles as they are now.
  void rebuild(const WorkingMesh& mesh);

  /// Enters a triangle that has come to be or has moved.
  void insert(const WorkingMesh& mesh, std::uint32_t triangle);

 private:
  static NamedTriangle name(const WorkingMesh& mesh, const Triangle& t) {
    return {t, {mesh.points[t[0]].position, mesh.points[t[1]].position, mesh.points[t[2]].position}};
  }

  template <typename Visit>
  void visit_cells(const NamedTriangle& t, const Visit& visit) const {
    std::int64_t lo[3], hi[3];
    for (int k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax({t.at[0][k], t.at[1][k], t.at[2][k]});
      lo[k] = cell_index(least);
      hi[k] = cell_index(most);
    }
    for (std::int64_t i = lo[0]; i <= hi[0]; ++i) {
      for (std::int64_t j = lo[1]; j <= hi[1]; ++j) {
        for (std::int64_t k = lo[2]; k <= hi[2]; ++k) visit(cell_key(i, j, k));
      }
    }
  }

  std::int64_t cell_index(Coord c) const { return c >= 0 ? c / cell_units_ : -((-c + cell_units_ - 1) / cell_units_); }
  static std::uint64_t cell_key(std::int64_t i, std::int64_t j, std::int64_t k) {
    // Two cells of one key only cost a few more tests.
    return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ull ^ static_cast<std::uint64_t>(j) * 0xC2B2AE3D27D4EB4Full ^
           static_cast<std::uint64_t>(k) * 0x165667B19E3779F9ull;
  }

  Coord cell_units_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace gaussmesh
