// A tree of boxes over the triangles of a mesh, to find those near a place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/box.h"

namespace gaussmesh {

/// The triangles of a mesh in blocks of neighbours, and boxes over blocks, over groups of blocks, and so on.
///
/// Triangles are sorted along the Morton curve of their centres, so the boxes fit as tightly as the mesh allows,
/// at any scale and wherever it lies. The mesh must outlive the tree, and all its vertex numbers and coordinates
/// must be good. Reading it is thread-safe.
///
/// Memory: 4 bytes a triangle for the order, 8 for the boxes; 16 more while it is made.
class TriangleTree {
 public:
  static constexpr std::size_t kBlock = 8;   ///< triangles in a block; the last may have fewer
  static constexpr std::size_t kFanOut = 4;  ///< boxes under one of the next level

  explicit TriangleTree(const TriangleMesh& mesh);

  std::size_t block_count() const { return levels_.front().size(); }
  const Box& block_box(std::size_t block) const { return levels_.front()[block]; }

  /// The numbers of the triangles of a block.
  std::span<const std::uint32_t> block(std::size_t block) const {
    const std::size_t begin = block * kBlock;
    return {order_.data() + begin, std::min(kBlock, order_.size() - begin)};
  }

  /// Calls visit(block) for every block from `first` on whose box meets `query`, in rising order.
  template <class Visit>
  void for_each_block_meeting(const Box& query, std::size_t first, const Visit& visit) const {
    for (std::size_t node = 0; node < levels_.back().size(); ++node)
      visit_below(levels_.size() - 1, node, query, first, visit);
  }

 private:
  template <class Visit>
  void visit_below(std::size_t level, std::size_t node, const Box& query, std::size_t first,
                   const Visit& visit) const {
    const bool before_first = (node + 1) << (2 * level) <= first;  // 4^level blocks lie under a node
    if (before_first || !boxes_meet(levels_[level][node], query)) return;
    if (level == 0) {
      visit(node);
      return;
    }
    const std::size_t end = std::min((node + 1) * kFanOut, levels_[level - 1].size());
    for (std::size_t child = node * kFanOut; child < end; ++child)
      visit_below(level - 1, child, query, first, visit);
  }

  std::vector<std::uint32_t> order_;      // triangle numbers along the curve
  std::vector<std::vector<Box>> levels_;  // [0]: of the blocks; [k]: of kFanOut boxes of [k - 1] each
};

}  // namespace gaussmesh
