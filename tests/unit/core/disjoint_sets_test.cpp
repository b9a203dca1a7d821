#include "core/disjoint_sets.h"

#include <vector>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;

TEST_CASE("things are alone at first, and those that are added too") {
  DisjointSets sets(3);
  sets.add();
  for (std::uint32_t i = 0; i < 4; ++i) CHECK(sets.find(i) == i);
  sets.unite(3, 1);
  CHECK(sets.find(3) == sets.find(1));
  CHECK(sets.find(0) != sets.find(1));
  CHECK(sets.find(2) != sets.find(1));
}

TEST_CASE("things are in one set where a chain of unions joins them, by comparison with labels") {
  const std::uint64_t seed = 61;
  CAPTURE(seed);
  testing::Random random(seed);
  constexpr std::uint32_t kThings = 200;
  DisjointSets sets(kThings);
  std::vector<std::uint32_t> label(kThings);
  for (std::uint32_t i = 0; i < kThings; ++i) label[i] = i;
  for (int unions = 0; unions < 250; ++unions) {
    const auto a = static_cast<std::uint32_t>(random.integer(0, kThings - 1));
    const auto b = static_cast<std::uint32_t>(random.integer(0, kThings - 1));
    sets.unite(a, b);
    const std::uint32_t from = label[a], to = label[b];
    for (std::uint32_t& l : label) l = l == from ? to : l;
    if (unions % 25 != 0) continue;
    for (std::uint32_t i = 0; i < kThings; ++i) {
      for (std::uint32_t j = 0; j < i; ++j) REQUIRE((sets.find(i) == sets.find(j)) == (label[i] == label[j]));
    }
  }
}

TEST_CASE("of each set one thing stands for all, itself too, after long chains") {
  constexpr std::uint32_t kThings = 100'000;
  DisjointSets sets(kThings);
  for (std::uint32_t i = 1; i < kThings; ++i) {
    if (i % 1000 != 0) sets.unite(i - 1, i);
  }
  std::uint32_t standing = 0;
  for (std::uint32_t i = 0; i < kThings; ++i) {
    standing += sets.find(i) == i;
    REQUIRE(sets.find(sets.find(i)) == sets.find(i));
    REQUIRE(sets.find(i) / 1000 == i / 1000);
  }
  CHECK(standing == kThings / 1000);
}
