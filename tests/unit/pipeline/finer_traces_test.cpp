// A finer trace is demanded where triangles are bad, as long as that leads on.
#include "pipeline/finer_traces.h"

#include "catch2.h"

using namespace gaussmesh;

namespace {

LeftBad left(std::size_t corners, double size) {
  return {corners, {{{1.0, 2.0, 3.0}, 2.0 * size}, {{1.0, 2.0, 4.0}, size}}};
}

TraceDemands demands_with(double spacing) {
  TraceDemands demands;
  demands.spacing = spacing;
  return demands;
}

constexpr std::size_t kVertices = 1000;

}  // namespace

TEST_CASE("where nothing is bad no finer trace is demanded") {
  TraceDemands demands = demands_with(0.5);
  CHECK_FALSE(FinerTraces().demand({}, kVertices, demands));
  CHECK(demands.fine_places.empty());
}

TEST_CASE("cells are small enough for the wanted edges, and smaller in the second trace in any case") {
  TraceDemands demands = demands_with(0.5);
  FinerTraces traces;
  const LeftBad bad = {3, {{{0, 0, 0}, 0.5}, {{1, 0, 0}, 0.01}, {{0, 1, 0}, 1e-9}}};
  REQUIRE(traces.demand(bad, kVertices, demands));
  REQUIRE(demands.fine_places.size() == 3);
  CHECK(demands.fine_places[0].level == 3);
  CHECK(demands.fine_places[1].level == 5);  // 0.5 / 2^5 < 0.02
  CHECK(demands.fine_places[2].level == 15);
  CHECK(demands.fine_places[1].at == Vec3{1, 0, 0});
  REQUIRE(traces.demand({3, {bad.places.front()}}, kVertices, demands));
  REQUIRE(demands.fine_places.size() == 4);
  CHECK(demands.fine_places[3].level == 5);
}

TEST_CASE("where most vertices are bad all cells are made smaller, until triangles are to be larger than they are") {
  TraceDemands demands = demands_with(50.0);
  FinerTraces traces;
  for (const double spacing : {12.5, 3.125}) {
    CHECK(traces.demand(left(700, 5.0), kVertices, demands));
    CHECK(demands.spacing == spacing);
    CHECK(demands.fine_places.empty());
  }
  CHECK_FALSE(traces.demand(left(700, 5.0), kVertices, demands));
  CHECK(FinerTraces().demand(left(700, 5.0), kVertices, demands));
  CHECK(demands.spacing == 3.125);
  CHECK_FALSE(demands.fine_places.empty());
}

TEST_CASE("many bad places that are neither fewer nor finer are given up, few after another trace") {
  TraceDemands demands = demands_with(0.5);
  FinerTraces many, few;
  CHECK(many.demand(left(300, 0.1), kVertices, demands));
  CHECK_FALSE(many.demand(left(290, 0.09), kVertices, demands));
  CHECK(few.demand(left(20, 0.1), kVertices, demands));
  CHECK(few.demand(left(20, 0.1), kVertices, demands));
  CHECK_FALSE(few.demand(left(20, 0.1), kVertices, demands));
}

TEST_CASE("as long as bad places become fewer or finer there is another trace, up to three") {
  TraceDemands demands = demands_with(0.5);
  FinerTraces fewer, finer;
  CHECK(fewer.demand(left(400, 0.1), kVertices, demands));
  CHECK(fewer.demand(left(290, 0.1), kVertices, demands));
  CHECK(fewer.demand(left(200, 0.1), kVertices, demands));
  CHECK_FALSE(fewer.demand(left(100, 0.1), kVertices, demands));
  CHECK(finer.demand(left(300, 0.1), kVertices, demands));
  CHECK(finer.demand(left(300, 0.04), kVertices, demands));
  CHECK_FALSE(finer.demand(left(300, 0.03), kVertices, demands));
}
