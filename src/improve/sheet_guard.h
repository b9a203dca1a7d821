// Keeping sheets of the surface apart: exact tests where another sheet is near.
#pragma once

#include <optional>
#include <vector>

#include "core/exact_space.h"
#include "improve/block_mesh.h"
#include "improve/sheet_tree.h"

namespace gaussmesh {

/// How triangles are kept from meeting.
enum class Guarding {
  kCloseSheets,  ///< exact tests where another sheet of the surface is near: fast, and nearly always enough
  kEverywhere,   ///< exact tests of every change: slow, but then nothing rests on what counts as near
};

/// The triangles of a block that have another sheet near, and those that reach into it from outside.
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
    if (!tree_) return false;
    return tree_->visit(item_of(mesh, t), [&](std::uint32_t entry) {
      const std::uint32_t other = triangle_of_[entry];
      if (other >= kFirstFixed) return pair_may_meet(mesh, t, mesh.fixed[other - kFirstFixed]);
      return mesh.connectivity.has_triangle(other) && !ignored(other) &&
             pair_may_meet(mesh, t, mesh.connectivity.triangle(other));
    });
  }

  /// Enters a triangle that has come to be or has moved.
  void insert(const BlockMesh& mesh, std::uint32_t triangle);

 private:
  static constexpr std::uint32_t kFirstFixed = 0x80000000u;

  static constexpr std::uint32_t kNoEntry = 0xFFFFFFFFu;

  /// The cube round what of the mesh is in the block.
  void find_cube(const BlockMesh& mesh);
  void enter(const BlockMesh& mesh, const Triangle& corners, std::uint32_t triangle);

  /// Where a triangle is and where it faces; nowhere where that does not count.
  SheetTree::Item item_of(const BlockMesh& mesh, const Triangle& t) const;

  Guarding guarding_;
  std::optional<SheetTree> tree_;           ///< made when there is a triangle for it
  Vec3 lo_{};                               ///< corner of the tree's cube
  float width_ = 0.0f;                      ///< and its edge (A)
  std::vector<std::uint32_t> triangle_of_;  ///< by entry of the tree; fixed ones from kFirstFixed on
  std::vector<std::uint32_t> entry_of_;     ///< by triangle of the block: in the tree
};

}  // namespace gaussmesh
