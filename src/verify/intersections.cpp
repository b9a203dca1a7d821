#include "verify/intersections.h"

#include <algorithm>

#include "verify/triangle_pair.h"

namespace gaussmesh {
namespace {

using NumberPair = std::array<std::uint32_t, 2>;

constexpr std::size_t kExamples = 10;       // of intersecting pairs that are kept
constexpr std::size_t kBlocksInChunk = 64;  // one chunk is one thread's work; each has its own result

void keep_first(std::vector<NumberPair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  if (pairs.size() > kExamples) pairs.resize(kExamples);
}

void append(Intersections& found, std::uint32_t a, std::uint32_t b) {
  ++found.pairs;
  found.examples.push_back({std::min(a, b), std::max(a, b)});
  if (found.examples.size() >= 8 * kExamples) keep_first(found.examples);
}

bool has_area(const PlacedTriangle& t) { return !are_collinear(t.corners[0], t.corners[1], t.corners[2]); }

/// The triangles of one block, set against each other and against those of later blocks.
class BlockTester {
 public:
  BlockTester(const TriangleMesh& mesh, const TriangleTree& tree) : mesh_(mesh), tree_(tree) {}

  void find_all(std::size_t block, Intersections& found) {
    count_ = 0;
    for (const std::uint32_t number : tree_.block(block)) {
      const Box box = box_of(mesh_, mesh_.triangles[number]);
      test(number, box, found);
      place(number, box);
    }
    const Box& block_box = tree_.block_box(block);
    tree_.for_each_block_meeting(block_box, block + 1, [&](std::size_t later) {
      for (const std::uint32_t number : tree_.block(later)) {
        const Box box = box_of(mesh_, mesh_.triangles[number]);
        if (boxes_meet(block_box, box)) test(number, box, found);
      }
    });
  }

 private:
  void place(std::uint32_t number, const Box& box) {
    placed_[count_] = PlacedTriangle(mesh_, mesh_.triangles[number]);
    if (!has_area(placed_[count_])) return;
    numbers_[count_] = number;
    boxes_[count_++] = box;
  }

  /// Tests a triangle against those that are placed.
  void test(std::uint32_t number, const Box& box, Intersections& found) const {
    std::array<std::uint8_t, TriangleTree::kBlock> near{};
    std::size_t near_count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      near[near_count] = static_cast<std::uint8_t>(i);
      near_count += boxes_meet(boxes_[i], box);
    }
    if (near_count == 0) return;
    const PlacedTriangle triangle(mesh_, mesh_.triangles[number]);
    for (std::size_t i = 0; i < near_count; ++i)
      if (meet_beyond_shared(placed_[near[i]], triangle) && has_area(triangle))
        append(found, numbers_[near[i]], number);
  }

  const TriangleMesh& mesh_;
  const TriangleTree& tree_;
  std::array<PlacedTriangle, TriangleTree::kBlock> placed_;
  std::array<std::uint32_t, TriangleTree::kBlock> numbers_{};
  std::array<Box, TriangleTree::kBlock> boxes_;
  std::size_t count_ = 0;
};

}  // namespace

Intersections find_intersections(const TriangleMesh& mesh, const TriangleTree& tree) {
  const std::size_t chunks = (tree.block_count() + kBlocksInChunk - 1) / kBlocksInChunk;
  std::vector<Intersections> found(chunks);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t end = std::min((chunk + 1) * kBlocksInChunk, tree.block_count());
    BlockTester tester(mesh, tree);
    for (std::size_t block = chunk * kBlocksInChunk; block < end; ++block) tester.find_all(block, found[chunk]);
  }
  Intersections all;
  for (const Intersections& part : found) {
    all.pairs += part.pairs;
    all.examples.insert(all.examples.end(), part.examples.begin(), part.examples.end());
  }
  keep_first(all.examples);
  return all;
}

}  // namespace gaussmesh
