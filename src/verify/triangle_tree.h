// A tree of boxes over the triangles of a mesh, to find those near a place.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/box.h"

namespace gaussmesh {

/// The triangles of a mesh in blocks of neighbours, blocks in patches, and boxes over blocks, over patches, over
/// groups of patches, and so on.
///
/// Triangles are sorted along the Morton curve of their centres, so the boxes fit as tightly as the mesh allows,
/// at any scale and wherever it lies. The mesh must outlive the tree, and all its vertex numbers and coordinates
/// must be good. Reading it is thread-safe.
///
/// Memory: 4 bytes a triangle for the order, 7 for the boxes; 16 more while it is made.
class TriangleTree {
 public:
  static constexpr std::size_t kBlock = 4;         ///< triangles in a block; the last may have fewer
  static constexpr std::size_t kPatchBlocks = 16;  ///< blocks in a patch; the last may have fewer

  explicit TriangleTree(const TriangleMesh& mesh);

  std::size_t block_count() const { return (order_.size() + kBlock - 1) / kBlock; }

  /// The numbers of the triangles of the blocks begin .. end - 1.
  std::span<const std::uint32_t> blocks(std::size_t begin, std::size_t end) const {
    return std::span(order_).subspan(begin * kBlock, std::min(end * kBlock, order_.size()) - begin * kBlock);
  }

  /// Calls visit(numbers) for every block from `first` on whose box meets `query`, in rising order, and perhaps for
  /// some whose box does not quite.
  template <class Visit>
  void for_each_block_meeting(const Box& query, std::size_t first, const Visit& visit) const {
    if (order_.empty()) return;
    for (std::size_t node = 0; node < levels_.back().size(); ++node)
      visit_below(levels_.size() - 1, node, query, first, visit);
  }

 private:
  static constexpr std::size_t kFanOut = 4;  // boxes under one of the next level

  /// Boxes of the blocks of a patch, in single precision: rounding keeps the order of numbers.
  struct BlockBoxes {
    std::array<std::array<float, kPatchBlocks>, 3> low;
    std::array<std::array<float, kPatchBlocks>, 3> high;
  };

  using Answers = std::array<std::uint8_t, kPatchBlocks>;

  /// For each block of the patch whether its box meets the query; not 0 if so.
  static void find_meeting_blocks(const BlockBoxes& boxes, const Box& query, Answers& answers);

  template <class Visit>
  void visit_below(std::size_t level, std::size_t node, const Box& query, std::size_t first,
                   const Visit& visit) const {
    const std::size_t blocks_end = ((node + 1) << (2 * level)) * kPatchBlocks;  // 4^level patches lie under a node
    if (blocks_end <= first || !boxes_meet(levels_[level][node], query)) return;
    if (level == 0) {
      visit_blocks(node, query, first, visit);
      return;
    }
    const std::size_t end = std::min((node + 1) * kFanOut, levels_[level - 1].size());
    for (std::size_t child = node * kFanOut; child < end; ++child)
      visit_below(level - 1, child, query, first, visit);
  }

  template <class Visit>
  void visit_blocks(std::size_t patch, const Box& query, std::size_t first, const Visit& visit) const {
    Answers answers;
    find_meeting_blocks(block_boxes_[patch], query, answers);
    const std::size_t begin = patch * kPatchBlocks;
    for (std::size_t i = first > begin ? first - begin : 0; i < kPatchBlocks; ++i)
      if (answers[i] != 0) visit(blocks(begin + i, begin + i + 1));
  }

  std::vector<std::uint32_t> order_;      // triangle numbers along the curve
  std::vector<BlockBoxes> block_boxes_;   // of each patch
  std::vector<std::vector<Box>> levels_;  // [0]: of the patches; [k]: of kFanOut boxes of [k - 1] each
};

}  // namespace gaussmesh
