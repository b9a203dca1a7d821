#include "core/key_index.h"

#include <map>
#include <vector>

#include "catch2.h"
#include "core/lattice.h"
#include "support/random.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

TEST_CASE("keys get numbers in the order in which they come, and keep them") {
  const std::uint64_t seed = 71;
  CAPTURE(seed);
  Random random(seed);
  KeyIndex<CellKey, CellKeyHash> index;
  std::map<std::vector<std::int64_t>, std::uint32_t> expected;
  const auto some_key = [&] {
    CellKey key;
    key.level = static_cast<int>(random.uniform(0.0, 4.0));
    for (std::int64_t& n : key.lo) n = static_cast<std::int64_t>(random.uniform(-8.0, 8.0)) * fine_size(key.level);
    return key;
  };
  for (int i = 0; i < 5000; ++i) {
    const CellKey key = some_key();
    const auto [it, is_new] =
        expected.try_emplace({key.lo[0], key.lo[1], key.lo[2], key.level}, static_cast<std::uint32_t>(expected.size()));
    CHECK(index.insert(key) == std::pair(it->second, is_new));
    CHECK(index[it->second] == key);
    const CellKey other = some_key();
    const auto known = expected.find({other.lo[0], other.lo[1], other.lo[2], other.level});
    CHECK(index.find(other) == (known == expected.end() ? std::nullopt : std::optional(known->second)));
  }
  CHECK(index.size() == expected.size());
  CHECK(index.size() > 1000);
}

TEST_CASE("an index without keys finds none") {
  const KeyIndex<CellKey, CellKeyHash> index;
  CHECK_FALSE(index.contains({{0, 0, 0}, 0}));
  CHECK(index.size() == 0);
}

TEST_CASE("an index that was cleared counts from 0 again") {
  KeyIndex<CellKey, CellKeyHash> index;
  for (int n = 0; n < 100; ++n) index.insert({{n * kFinePerCell, 0, 0}, 0});
  index.clear();
  CHECK(index.size() == 0);
  CHECK_FALSE(index.contains({{3 * kFinePerCell, 0, 0}, 0}));
  CHECK(index.insert({{3 * kFinePerCell, 0, 0}, 0}) == std::pair(std::uint32_t{0}, true));
  CHECK(index.contains({{3 * kFinePerCell, 0, 0}, 0}));
}
