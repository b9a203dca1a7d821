#include "verify/morton_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "catch2.h"
#include "core/parallel.h"
#include "support/random.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;
using namespace gaussmesh::testing;

TEST_CASE("keys are sorted by cell, and equal cells keep their order, for any number of threads") {
  const std::uint64_t seed = 17;
  CAPTURE(seed);
  Random random(seed);
  for (const std::size_t count : {0u, 1u, 499u, 500u, 9999u, 40000u}) {
    CAPTURE(count);
    std::vector<MortonKey> keys(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double cells = i % 3 == 0 ? 50.0 : double(1 << 30);  // few of them, so that many are equal
      keys[i] = {static_cast<std::uint32_t>(random.uniform(0.0, cells)), static_cast<std::uint32_t>(i)};
    }
    std::vector<MortonKey> expected = keys;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const MortonKey& a, const MortonKey& b) { return a.cell < b.cell; });
    for (const int threads : {1, 2, 5}) {
      const DefaultThreads some(threads);
      std::vector<MortonKey> sorted = keys;
      sort_by_cell(sorted);
      CHECK(std::equal(sorted.begin(), sorted.end(), expected.begin(), [](const MortonKey& a, const MortonKey& b) {
        return a.cell == b.cell && a.number == b.number;
      }));
    }
  }
}

TEST_CASE("points in order have every number once, and neighbours are near: also where they crowd") {
  const std::uint64_t seed = 18;
  CAPTURE(seed);
  Random random(seed);
  std::vector<Point> points(20000);
  for (std::size_t i = 0; i < points.size(); ++i) {  // half of them in a millionth of the box's edge
    const double size = i % 2 == 0 ? 1.0 : 1e-6;
    points[i] = {random.uniform(0.0, size), random.uniform(0.0, size), random.uniform(0.0, size)};
  }
  const std::vector<std::uint32_t> order =
      morton_order(points.size(), [&](std::uint32_t number) { return points[number]; });
  std::vector<std::uint32_t> numbers = order, all(points.size());
  std::sort(numbers.begin(), numbers.end());
  std::iota(all.begin(), all.end(), 0u);
  REQUIRE(numbers == all);
  double sum = 0.0;
  std::size_t pairs = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i - 1] % 2 == 0 || order[i] % 2 == 0) continue;
    for (int k = 0; k < 3; ++k) sum += std::abs(points[order[i]][k] - points[order[i - 1]][k]);
    ++pairs;
  }
  CHECK(pairs > 9000);
  CHECK(sum / double(pairs) < 0.1e-6);  // two points anywhere in the crowd are 1e-6 apart
}
