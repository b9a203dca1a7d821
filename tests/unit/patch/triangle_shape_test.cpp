#include "patch/triangle_shape.h"

#include <numbers>

#include "catch2.h"
#include "support/lattices.h"

using namespace gaussmesh;
using testing::to_coord;

namespace {

/// A surface point whose normal leans by an angle from z towards x.
SurfacePoint point(double x, double y, double lean_deg = 0.0) {
  const double angle = lean_deg * std::numbers::pi / 180.0;
  return {
      to_coord(Vec3{x, y, 0.0}), {static_cast<float>(std::sin(angle)), 0.0f, static_cast<float>(std::cos(angle))}, 0};
}

double cost(double x, double y, double lean_deg) {
  return shape_cost(point(0, 0, lean_deg), point(1, 0, lean_deg), point(x, y, lean_deg));
}

const double kHeight = 0.5 * std::numbers::sqrt3;  // of the equilateral triangle

}  // namespace

TEST_CASE("the equilateral triangle that faces as the field does costs nothing") {
  CHECK(cost(0.5, kHeight, 0.0) == Approx(0.0).margin(1e-6));
}

TEST_CASE("a triangle costs more the thinner it is") {
  double before = -1.0;
  for (const double height : {kHeight, 0.6, 0.4, 0.2, 0.1, 0.01}) {
    CHECK(cost(0.5, height, 0.0) > before);
    before = cost(0.5, height, 0.0);
  }
  CHECK(before < 1.0);
}

TEST_CASE("a triangle costs more the farther it is turned from the field") {
  double before = -1.0;
  for (double lean_deg = 0.0; lean_deg <= 180.0; lean_deg += 5.0) {
    CAPTURE(lean_deg);
    const double now = cost(0.5, kHeight, lean_deg);
    CHECK(now > before);
    before = now;
    CHECK((now >= kPoorTriangle) == (lean_deg > 60.0));
    CHECK((now >= kTurnedTriangle) == (lean_deg > 85.0));
  }
}

TEST_CASE("a triangle without area is worse than any turned one") {
  CHECK(cost(0.5, 0.0, 0.0) > kTurnedTriangle);
  CHECK(std::isfinite(cost(0.5, 0.0, 0.0)));
}

TEST_CASE("normal_cosine is the cosine of the angle to the direction") {
  const SurfacePoint p = point(0, 0), q = point(2, 0), r = point(0, 3);
  CHECK(normal_cosine(p, q, r, {0, 0, 1}) == Approx(1.0));
  CHECK(normal_cosine(p, q, r, {0, 0, -1}) == Approx(-1.0));
  CHECK(normal_cosine(p, r, q, {0, 0, 1}) == Approx(-1.0));
  CHECK(normal_cosine(p, q, r, {0.6f, 0, 0.8f}) == Approx(0.8));
}

TEST_CASE("least_normal_cosine takes the corner that is farthest off") {
  CHECK(least_normal_cosine(point(0, 0, 10.0), point(1, 0, 70.0), point(0, 1, -20.0)) ==
        Approx(std::cos(70.0 * std::numbers::pi / 180.0)));
}

TEST_CASE("longest_side has its middle, its length and the height over it, whichever side it is") {
  const SurfacePoint p = point(1, 0), q = point(5, 0), r = point(2, 0.25);
  for (const LongestSide& side : {longest_side(p, q, r), longest_side(q, r, p), longest_side(r, p, q)}) {
    CHECK(side.middle[0] == Approx(3.0));
    CHECK(side.middle[1] == Approx(0.0));
    CHECK(side.length == Approx(4.0));
    CHECK(side.height == Approx(0.25));
  }
}
