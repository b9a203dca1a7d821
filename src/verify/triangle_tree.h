// A tree of boxes over the triangles of a mesh, to find those near a place.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/bounding_box.h"

namespace gaussmesh::verify {

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
  void for_each_block_meeting(const BoundingBox& query, std::size_t first, const Visit& visit) const {
    if (order_.empty()) return;
    for (std::size_t node = 0; node < levels_.back().size(); ++node)
      visit_below(levels_.size() - 1, node, query, first, visit);
  }

  /// Calls visit(numbers) for every block that may have a point whose distance from `point` squared is below
  /// `bound_sq`, which visit may lower; nearer ones mostly first.
  template <class Visit>
  void for_each_block_nearer(const Point& point, const double& bound_sq, const Visit& visit) const {
    if (!order_.empty()) approach_children(levels_.size(), 0, levels_.back().size(), point, bound_sq, visit);
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
  static void find_meeting_blocks(const BlockBoxes& boxes, const BoundingBox& query, Answers& answers);

  template <class Visit>
  void visit_below(std::size_t level, std::size_t node, const BoundingBox& query, std::size_t first,
                   const Visit& visit) const {
    const std::size_t blocks_end = ((node + 1) << (2 * level)) * kPatchBlocks;  // 4^level patches lie under a node
    if (blocks_end <= first || !boxes_meet(levels_[level][node], query)) return;
    if (level == 0) {
      visit_blocks(node, query, first, visit);
      return;
    }
    const std::size_t end = std::min((node + 1) * kFanOut, levels_[level - 1].size());
    for (std::size_t child = node * kFanOut; child < end; ++child) visit_below(level - 1, child, query, first, visit);
  }

  template <class Visit>
  void visit_blocks(std::size_t patch, const BoundingBox& query, std::size_t first, const Visit& visit) const {
    Answers answers;
    find_meeting_blocks(block_boxes_[patch], query, answers);
    const std::size_t begin = patch * kPatchBlocks;
    for (std::size_t i = first > begin ? first - begin : 0; i < kPatchBlocks; ++i)
      if (answers[i] != 0) visit(blocks(begin + i, begin + i + 1));
  }

  /// A node on the way to a point.
  struct Step {
    double distance_sq = 0.0;
    std::size_t node = 0;
  };

  static double distance_sq_to_box(const Point& point, const BoundingBox& box) {
    double distance_sq = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double gap = std::max({0.0, box.low[k] - point[k], point[k] - box.high[k]});
      distance_sq += gap * gap;
    }
    return distance_sq;
  }

  /// Goes to the nodes begin .. end - 1 of the level below `level`, at most kFanOut of them, nearest first.
  template <class Visit>
  void approach_children(std::size_t level, std::size_t begin, std::size_t end, const Point& point,
                         const double& bound_sq, const Visit& visit) const {
    std::array<Step, kFanOut> steps;
    std::size_t count = 0;
    for (std::size_t node = begin; node < end; ++node)
      steps[count++] = {distance_sq_to_box(point, levels_[level - 1][node]), node};
    std::sort(steps.begin(), steps.begin() + count,
              [](const Step& a, const Step& b) { return a.distance_sq < b.distance_sq; });
    for (std::size_t i = 0; i < count && steps[i].distance_sq < bound_sq; ++i) {
      const std::size_t node = steps[i].node;
      if (level == 1) {
        approach_blocks(node, point, bound_sq, visit);
      } else {
        const std::size_t children_end = std::min((node + 1) * kFanOut, levels_[level - 2].size());
        approach_children(level - 1, node * kFanOut, children_end, point, bound_sq, visit);
      }
    }
  }

  template <class Visit>
  void approach_blocks(std::size_t patch, const Point& point, const double& bound_sq, const Visit& visit) const {
    const std::array<double, kPatchBlocks> distances_sq = distances_sq_to_blocks(block_boxes_[patch], point);
    const std::size_t begin = patch * kPatchBlocks;
    const std::size_t count = std::min(kPatchBlocks, block_count() - begin);
    for (std::size_t i = 0; i < count; ++i)
      if (distances_sq[i] < bound_sq) visit(blocks(begin + i, begin + i + 1));
  }

  /// Squares of distances from the boxes, or a little less: what rounding took from the boxes is taken off.
  static std::array<double, kPatchBlocks> distances_sq_to_blocks(const BlockBoxes& boxes, const Point& point);

  std::vector<std::uint32_t> order_;              // triangle numbers along the curve
  std::vector<BlockBoxes> block_boxes_;           // of each patch
  std::vector<std::vector<BoundingBox>> levels_;  // [0]: of the patches; [k]: of kFanOut boxes of [k - 1] each
};

}  // namespace gaussmesh::verify
