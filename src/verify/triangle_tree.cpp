#include "verify/triangle_tree.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "verify/lanes.h"
#include "verify/morton_order.h"

namespace gaussmesh::verify {
namespace {

typedef float Sides __attribute__((vector_size(64)));
typedef std::int32_t WideAnswers __attribute__((vector_size(64)));
typedef std::uint8_t NarrowAnswers __attribute__((vector_size(16)));

static_assert(sizeof(Sides) == TriangleTree::kPatchBlocks * sizeof(float));

/// low, high: those of the query, x, y, z; boxes: the blocks' lows, then their highs, x, y, z each.
GAUSSMESH_LANE_CLONES
void compare_boxes(const float* boxes, const float* low, const float* high, std::uint8_t* answers) {
  WideAnswers meet = ~WideAnswers{};
  for (int k = 0; k < 3; ++k) {
    Sides block_low, block_high;
    std::memcpy(&block_low, boxes + k * TriangleTree::kPatchBlocks, sizeof block_low);
    std::memcpy(&block_high, boxes + (3 + k) * TriangleTree::kPatchBlocks, sizeof block_high);
    meet &= (block_low <= Sides{} + high[k]) & (Sides{} + low[k] <= block_high);
  }
  const NarrowAnswers narrow = __builtin_convertvector(meet & 1, NarrowAnswers);
  std::memcpy(answers, &narrow, sizeof narrow);
}

std::vector<BoundingBox> boxes_of_groups(const std::vector<BoundingBox>& below, std::size_t fan_out) {
  std::vector<BoundingBox> boxes((below.size() + fan_out - 1) / fan_out);
  for (std::size_t i = 0; i < below.size(); ++i) boxes[i / fan_out].include(below[i]);
  return boxes;
}

}  // namespace

void TriangleTree::find_meeting_blocks(const BlockBoxes& boxes, const BoundingBox& query, Answers& answers) {
  const float low[] = {static_cast<float>(query.low[0]), static_cast<float>(query.low[1]),
                       static_cast<float>(query.low[2])};
  const float high[] = {static_cast<float>(query.high[0]), static_cast<float>(query.high[1]),
                        static_cast<float>(query.high[2])};
  static_assert(sizeof boxes == 6 * kPatchBlocks * sizeof(float));
  compare_boxes(boxes.low[0].data(), low, high, answers.data());
}

std::array<double, TriangleTree::kPatchBlocks> TriangleTree::distances_sq_to_blocks(const BlockBoxes& boxes,
                                                                                    const Point& point) {
  constexpr double kRounded = 0x1p-23;  // of a coordinate; half of that and what comes out of it by rounding here
  std::array<double, kPatchBlocks> distances_sq{};
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < kPatchBlocks; ++i) {
      const double low = boxes.low[k][i], high = boxes.high[k][i];
      const double below = low - std::abs(low) * kRounded - point[k];
      const double above = point[k] - high - std::abs(high) * kRounded;
      const double gap = std::max(0.0, std::max(below, above));
      distances_sq[i] += gap * gap;
    }
  return distances_sq;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  order_ = morton_order(mesh.triangles.size(), [&mesh](std::uint32_t number) {
    const auto& [a, b, c] = mesh.triangles[number];
    Point sum{};
    for (int k = 0; k < 3; ++k) sum[k] = mesh.vertices[a][k] + mesh.vertices[b][k] + mesh.vertices[c][k];
    return sum;
  });
  const std::size_t patches = (block_count() + kPatchBlocks - 1) / kPatchBlocks;
  levels_.emplace_back(patches);
  block_boxes_.resize(patches);
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < patches; ++p)
    for (std::size_t i = 0; i < kPatchBlocks; ++i) {
      const std::size_t block = p * kPatchBlocks + i;
      BoundingBox box;
      if (block < block_count())
        for (const std::uint32_t number : blocks(block, block + 1)) box.include(box_of(mesh, mesh.triangles[number]));
      for (int k = 0; k < 3; ++k) {
        block_boxes_[p].low[k][i] = static_cast<float>(box.low[k]);
        block_boxes_[p].high[k][i] = static_cast<float>(box.high[k]);
      }
      levels_.front()[p].include(box);
    }
  while (levels_.back().size() > kFanOut) levels_.push_back(boxes_of_groups(levels_.back(), kFanOut));
}

}  // namespace gaussmesh::verify
