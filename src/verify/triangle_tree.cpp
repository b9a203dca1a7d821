#include "verify/triangle_tree.h"

#include "verify/morton_order.h"

namespace gaussmesh {
namespace {

std::vector<Box> boxes_of_blocks(const TriangleMesh& mesh, const std::vector<std::uint32_t>& order) {
  std::vector<Box> boxes((order.size() + TriangleTree::kBlock - 1) / TriangleTree::kBlock);
  for (std::size_t i = 0; i < order.size(); ++i)
    boxes[i / TriangleTree::kBlock].include(box_of(mesh, mesh.triangles[order[i]]));
  return boxes;
}

std::vector<Box> boxes_of_groups(const std::vector<Box>& below) {
  std::vector<Box> boxes((below.size() + TriangleTree::kFanOut - 1) / TriangleTree::kFanOut);
  for (std::size_t i = 0; i < below.size(); ++i) boxes[i / TriangleTree::kFanOut].include(below[i]);
  return boxes;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  order_ = morton_order(mesh.triangles.size(), [&mesh](std::uint32_t number) {
    const Box box = box_of(mesh, mesh.triangles[number]);
    return Point{box.low[0] + box.high[0], box.low[1] + box.high[1], box.low[2] + box.high[2]};
  });
  levels_.push_back(boxes_of_blocks(mesh, order_));
  while (levels_.back().size() > kFanOut) levels_.push_back(boxes_of_groups(levels_.back()));
}

}  // namespace gaussmesh
