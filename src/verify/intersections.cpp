#include "verify/intersections.h"

#include <algorithm>
#include <span>

#include "verify/coarse_boxes.h"
#include "verify/parallel.h"
#include "verify/triangle_pair.h"

namespace gaussmesh::verify {
namespace {

using NumberPair = std::array<std::uint32_t, 2>;

constexpr std::size_t kExamples = 10;        // of intersecting pairs that are kept
constexpr std::size_t kPatchesInChunk = 16;  // one chunk is one thread's work; each has its own result

void keep_first(std::vector<NumberPair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  if (pairs.size() > kExamples) pairs.resize(kExamples);
}

void append(Intersections& found, std::uint32_t a, std::uint32_t b) {
  ++found.pairs;
  found.examples.push_back({std::min(a, b), std::max(a, b)});
  if (found.examples.size() >= 8 * kExamples) keep_first(found.examples);
}

/// The triangles of one patch, set against each other and against those of later patches.
class PatchTester {
 public:
  PatchTester(const TriangleMesh& mesh, const TriangleTree& tree, const FanFacts& facts)
      : mesh_(mesh), tree_(tree), facts_(facts) {}

  /// @param begin, end  the blocks of the patch
  void find_all(std::size_t begin, std::size_t end, Intersections& found) {
    BoundingBox patch;
    for (const std::uint32_t number : tree_.blocks(begin, end)) patch.include(box_of(mesh_, mesh_.triangles[number]));
    boxes_.start(patch);
    triangles_.clear();
    for (const std::uint32_t number : tree_.blocks(begin, end)) list(number);
    const std::size_t own = triangles_.size();
    tree_.for_each_block_meeting(patch, end, [&](std::span<const std::uint32_t> block) {
      for (const std::uint32_t number : block) list(number);
    });
    boxes_.finish();
    place_.assign(triangles_.size(), kNone);
    placed_.clear();
    for (std::size_t i = 0; i < own; ++i) {
      const FlatFans fans = flat_fans_of(triangles_[i]);
      boxes_.for_each_meeting(i, [&](std::size_t j) {
        if (are_in_one(fans, triangles_[j])) return;
        const std::uint32_t s = place(i), t = place(j);
        if (meet_beyond_shared(placed_[s], placed_[t])) append(found, triangles_[i].number(), triangles_[j].number());
      });
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;  // no vertex, or not in placed_

  typedef std::uint32_t Numbers __attribute__((vector_size(16)));

  /// The numbers of its corners, and last its own.
  struct Listed {
    Numbers numbers;

    std::uint32_t number() const { return numbers[3]; }
  };

  /// For each corner of a triangle its number in all places, or kNone if its fan is not flat.
  struct FlatFans {
    Numbers numbers[3];
  };

  /// Lists a triangle, if it has an area.
  void list(std::uint32_t number) {
    if (facts_.turns[number] == 0) return;
    const auto& [a, b, c] = mesh_.triangles[number];
    triangles_.push_back(Listed{Numbers{a, b, c, number}});
    boxes_.append(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
  }

  FlatFans flat_fans_of(const Listed& triangle) const {
    FlatFans fans{};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle.numbers[k];
      fans.numbers[k] = Numbers{} + (facts_.is_flat[vertex] != 0 ? vertex : kNone);
    }
    return fans;
  }

  /// Whether a corner has one of the fans. Without branches: most answers are yes, but for any of nine reasons.
  static bool are_in_one(const FlatFans& fans, const Listed& t) {
    const auto shared =
        (t.numbers == fans.numbers[0]) | (t.numbers == fans.numbers[1]) | (t.numbers == fans.numbers[2]);
    return (shared[0] | shared[1] | shared[2]) != 0;
  }

  /// Where a triangle is in placed_.
  std::uint32_t place(std::size_t i) {
    if (place_[i] == kNone) {
      place_[i] = static_cast<std::uint32_t>(placed_.size());
      placed_.emplace_back(mesh_, mesh_.triangles[triangles_[i].number()]);
    }
    return place_[i];
  }

  const TriangleMesh& mesh_;
  const TriangleTree& tree_;
  const FanFacts& facts_;
  std::vector<Listed> triangles_;       // the patch's, then those of later ones that come near it
  CoarseBoxes boxes_;                   // of triangles_
  std::vector<PlacedTriangle> placed_;  // those of triangles_ that were asked for
  std::vector<std::uint32_t> place_;    // by triangle, where it is in placed_
};

}  // namespace

Intersections find_intersections(const TriangleMesh& mesh, const TriangleTree& tree, const FanFacts& facts) {
  constexpr std::size_t kBlocksInChunk = TriangleTree::kPatchBlocks * kPatchesInChunk;
  std::vector<Intersections> found(chunk_count(tree.block_count(), kBlocksInChunk));
  parallel_for_workers(found.size(), [&] {
    return [&, tester = PatchTester(mesh, tree, facts)](std::size_t chunk) mutable {
      const std::size_t end = std::min((chunk + 1) * kBlocksInChunk, tree.block_count());
      for (std::size_t first = chunk * kBlocksInChunk; first < end; first += TriangleTree::kPatchBlocks)
        tester.find_all(first, std::min(first + TriangleTree::kPatchBlocks, end), found[chunk]);
    };
  });
  Intersections all;
  for (const Intersections& part : found) {
    all.pairs += part.pairs;
    all.examples.insert(all.examples.end(), part.examples.begin(), part.examples.end());
  }
  keep_first(all.examples);
  return all;
}

}  // namespace gaussmesh::verify
