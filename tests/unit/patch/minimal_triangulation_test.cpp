#include "patch/minimal_triangulation.h"

#include <array>
#include <map>
#include <numeric>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;
using testing::Random;

namespace {

using Corners = std::array<int, 3>;
using Triangulation = std::vector<Corners>;

/// All triangulations of the corners i .. k of a convex polygon.
std::vector<Triangulation> all_triangulations(int i, int k) {
  if (k - i < 2) return {{}};
  std::vector<Triangulation> result;
  for (int j = i + 1; j < k; ++j) {
    for (const Triangulation& left : all_triangulations(i, j)) {
      for (const Triangulation& right : all_triangulations(j, k)) {
        Triangulation& whole = result.emplace_back(left);
        whole.insert(whole.end(), right.begin(), right.end());
        whole.push_back({i, j, k});
      }
    }
  }
  return result;
}

const auto kAnyDiagonal = [](int, int) { return true; };
const auto kUnitCost = [](int, int, int) { return 1.0; };

Triangulation visited(const MinimalTriangulation& minimal) {
  Triangulation result;
  minimal.visit([&](int i, int j, int k) { result.push_back({i, j, k}); });
  return result;
}

/// Sides of the polygon once and forwards, diagonals once each way.
void check_covers_polygon(const Triangulation& triangles, int n) {
  std::map<std::pair<int, int>, int> directed;
  for (const auto& [i, j, k] : triangles) {
    CHECK(i < j);
    CHECK(j < k);
    for (const auto& edge : {std::pair(i, j), std::pair(j, k), std::pair(k, i)}) ++directed[edge];
  }
  for (const auto& [edge, count] : directed) {
    CHECK(count == 1);
    const bool is_side = edge.second == (edge.first + 1) % n;
    CHECK(directed.contains({edge.second, edge.first}) == !is_side);
  }
}

}  // namespace

TEST_CASE("a polygon with n corners has n - 2 triangles") {
  MinimalTriangulation minimal;
  for (int n = 3; n <= 40; ++n) {
    CHECK(minimal.solve(n, kAnyDiagonal, kUnitCost) == n - 2);
    const Triangulation triangles = visited(minimal);
    CHECK(static_cast<int>(triangles.size()) == n - 2);
    check_covers_polygon(triangles, n);
  }
}

TEST_CASE("the cheapest of all triangulations is found, for random costs and forbidden diagonals") {
  const std::uint64_t seed = 71;
  CAPTURE(seed);
  Random random(seed);
  constexpr std::size_t kCatalan[] = {1, 1, 2, 5, 14, 42, 132, 429};
  int impossible = 0;
  MinimalTriangulation minimal;
  for (int n = 3; n <= 9; ++n) {
    const auto all = all_triangulations(0, n - 1);
    REQUIRE(all.size() == kCatalan[n - 2]);
    for (int trial = 0; trial < 50; ++trial) {
      std::map<Corners, double> costs;
      std::map<std::pair<int, int>, bool> free;
      for (int i = 0; i < n; ++i) {
        for (int j = i + 1; j < n; ++j) {
          free[{i, j}] = random.uniform(0.0, 1.0) < 0.8;
          for (int k = j + 1; k < n; ++k) {
            costs[{i, j, k}] = random.uniform(0.0, 1.0) < 0.1 ? kImpossible : random.uniform(0.0, 1.0);
          }
        }
      }
      double least = kImpossible;
      for (const Triangulation& triangulation : all) {
        double cost = 0.0;
        for (const Corners& t : triangulation) {
          cost += costs[t];
          for (const auto& [i, j] : {std::pair(t[0], t[1]), std::pair(t[1], t[2]), std::pair(t[0], t[2])}) {
            if (j - i > 1 && j - i < n - 1 && !free[{i, j}]) cost = kImpossible;
          }
        }
        least = std::min(least, cost);
      }
      const double found = minimal.solve(
          n,
          [&](int i, int j) {
            return free.at({i, j});
          },
          [&](int i, int j, int k) {
            return costs.at({i, j, k});
          });
      if (least == kImpossible) {
        CHECK(found == kImpossible);
        ++impossible;
        continue;
      }
      CHECK(found == Approx(least));
      double visited_cost = 0.0;
      for (const Corners& t : visited(minimal)) visited_cost += costs.at(t);
      CHECK(visited_cost == Approx(found));
    }
  }
  CHECK(impossible > 10);
}

TEST_CASE("a triangulator can be used again for a smaller polygon") {
  MinimalTriangulation minimal;
  minimal.solve(12, kAnyDiagonal, kUnitCost);
  CHECK(minimal.solve(4, kAnyDiagonal, kUnitCost) == 2.0);
  CHECK(visited(minimal).size() == 2);
}

TEST_CASE("two corners have no triangulation") {
  MinimalTriangulation minimal;
  CHECK(minimal.solve(2, kAnyDiagonal, kUnitCost) == kImpossible);
}
