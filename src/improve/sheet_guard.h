// Keeping sheets of the surface apart: exact tests where another sheet is near.
#pragma once

#include <vector>

#include "core/exact_space.h"
#include "improve/block_mesh.h"

namespace gaussmesh {

/// How triangles are kept from meeting.
enum class Guarding {
  kCloseSheets,  ///< exact tests where another sheet of the surface is near: fast, and nearly always enough
  kEverywhere,   ///< exact tests of every change: slow, but then nothing rests on what counts as near
};

/// The triangles of a block that have another sheet near, and those that reach into it from outside, in a grid.
class SheetGuard {
 public:
  /// Marks the vertices of `mesh` that have another sheet near, or all of them.
  SheetGuard(BlockMesh& mesh, Guarding guarding);

  static bool is_guarded(const BlockMesh& mesh, const Triangle& t) {
    return mesh.is_guarded[t[0]] || mesh.is_guarded[t[1]] || mesh.is_guarded[t[2]];
  }

  /// Whether two triangles may meet beyond the corners that they share; errs on the side of true, as below.
  static bool pair_may_meet(const BlockMesh& mesh, const Triangle& s, const Triangle& t);

  /// Whether `t`, a triangle that is to be, may meet one of the block or from outside; triangles of the block of
  /// which `ignored` says so do not count. Exact in general position; errs on the side of true where points are
  /// coplanar.
  template <typename Ignored>
  bool may_meet(const BlockMesh& mesh, const Triangle& t, const Ignored& ignored) const {
    if (head_.empty()) return false;
    const SmallBox box = box_of(mesh, t);
    const Normal normal = mean_normal(mesh, t);
    return visit_cells(box, [&](std::size_t cell) {
      for (std::int32_t n = head_[cell]; n >= 0; n = nodes_[n].next) {
        if (!box.meets(nodes_[n].box)) continue;
        if (guarding_ == Guarding::kCloseSheets && are_of_one_sheet(normal, nodes_[n].normal)) continue;
        const std::uint32_t other = nodes_[n].triangle;
        if (other >= kFirstFixed) {
          if (pair_may_meet(mesh, t, mesh.fixed[other - kFirstFixed])) return true;
        } else if (mesh.connectivity.has_triangle(other) && !ignored(other) &&
                   pair_may_meet(mesh, t, mesh.connectivity.triangle(other))) {
          return true;
        }
      }
      return false;
    });
  }

  /// Enters a triangle that has come to be or has moved.
  void insert(const BlockMesh& mesh, std::uint32_t triangle);

 private:
  static constexpr std::uint32_t kFirstFixed = 0x80000000u;

  /// A box that holds a triangle, by floats rounded outwards, from a corner of the grid.
  struct SmallBox {
    std::array<float, 3> lo, hi;

    bool meets(const SmallBox& other) const {
      return lo[0] <= other.hi[0] && other.lo[0] <= hi[0] && lo[1] <= other.hi[1] && other.lo[1] <= hi[1] &&
             lo[2] <= other.hi[2] && other.lo[2] <= hi[2];
    }
  };

  struct Node {
    std::uint32_t triangle;
    std::int32_t next;
    SmallBox box;
    Normal normal;  ///< mean of the field's at the corners, not of unit length
  };

  void lay_grid(const BlockMesh& mesh);
  void enter(const BlockMesh& mesh, const Triangle& corners, std::uint32_t triangle);

  static Normal mean_normal(const BlockMesh& mesh, const Triangle& t) {
    Normal mean{};
    for (const std::uint32_t v : t) {
      for (int k = 0; k < 3; ++k) mean[k] += mesh.normal[v][k] * (1.0f / 3.0f);
    }
    return mean;
  }

  /// Triangles of one sheet are kept apart by the limit on their turn from the field.
  static bool are_of_one_sheet(const Normal& m, const Normal& n) {
    constexpr float kSameSheet = 0.4f;  // cosine, times the lengths, which are less than 1 where normals differ
    return m[0] * n[0] + m[1] * n[1] + m[2] * n[2] > kSameSheet;
  }

  SmallBox box_of(const BlockMesh& mesh, const Triangle& t) const {
    constexpr float kSlack = 1e-5f;  // relative: two roundings, and the subtraction of the corner
    SmallBox box;
    for (int k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax({mesh.at[t[0]][k], mesh.at[t[1]][k], mesh.at[t[2]][k]});
      const auto lo = static_cast<float>(least - lo_[k]), hi = static_cast<float>(most - lo_[k]);
      box.lo[k] = lo - kSlack * std::abs(lo);
      box.hi[k] = hi + kSlack * std::abs(hi);
    }
    return box;
  }

  /// Calls visit(cell) for the cells that the box meets until it says true. @return whether it did
  template <typename Visit>
  bool visit_cells(const SmallBox& box, const Visit& visit) const {
    std::array<int, 3> lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = index_of(box.lo[k]);
      hi[k] = index_of(box.hi[k]);
    }
    for (int i = lo[0]; i <= hi[0]; ++i) {
      for (int j = lo[1]; j <= hi[1]; ++j) {
        for (int k = lo[2]; k <= hi[2]; ++k) {
          if (visit(static_cast<std::size_t>((i * cells_ + j) * cells_ + k))) return true;
        }
      }
    }
    return false;
  }

  int index_of(float x) const { return slab_of(x * cells_per_angstrom_, cells_); }

  Guarding guarding_;
  Vec3 lo_;    ///< corner of the grid; what lies outside of it is in its outermost cells
  int cells_;  ///< along an axis
  float cells_per_angstrom_;
  std::vector<std::int32_t> head_;  ///< by cell: its first node; made when there is one
  std::vector<Node> nodes_;
};

}  // namespace gaussmesh
