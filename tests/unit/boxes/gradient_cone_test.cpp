#include "boxes/gradient_cone.h"

#include <cmath>

#include "catch2.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

double cosine(const Vec3& a, const Vec3& b) {
  const auto dot = [](const Vec3& p, const Vec3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
  return dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
}

}  // namespace

TEST_CASE("the nearest direction goes along with a vector, within the steps that slants are told by") {
  const std::uint64_t seed = 45;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v = random_point(random, box_around({0, 0, 0}, 1.0));
    const Direction direction = nearest_direction(v);
    Vec3 along = direction.vector();
    for (double& x : along) x *= direction.sign;
    CHECK(cosine(v, along) > std::cos(std::atan(std::sqrt(2.0) * 0.5 / Direction::kSlantParts)) - 1e-9);
  }
  CHECK(nearest_direction({0, -3, 0}) == along_axis(1, -1));
  CHECK(nearest_direction({1, 1, -1}).vector() == Vec3{1, 1, -1});
}

TEST_CASE("the middle of a cone is far from none of its gradients, however many are on one side") {
  GradientCone cone;
  CHECK(cone.empty());
  cone.add({0, 0, 0});
  CHECK(cone.empty());
  for (int i = 0; i < 9; ++i) cone.add({1, 0, 0});
  cone.add({-0.5, 1, 0});
  // The two sides are 117 degrees apart; the mean alone is 107 degrees from the second.
  const Vec3 middle = cone.middle();
  CHECK(cosine(middle, {1, 0, 0}) > 0.4);
  CHECK(cosine(middle, {-0.5, 1, 0}) > 0.4);
}

TEST_CASE("lines along a slanted direction are seen as points") {
  const std::uint64_t seed = 46;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 300; ++i) {
    const auto slant = [&] {
      return static_cast<std::int8_t>(random.integer(-Direction::kSlantParts, Direction::kSlantParts));
    };
    const Direction direction{static_cast<std::int8_t>(i % 3), 1, {slant(), slant()}};
    const CoordPoint p = to_coord(random_point(random, box_around({0, 0, 0}, 1000.0)));
    CoordPoint q = p;
    const Coord steps = random.integer(-1000000, 1000000);
    q[direction.axis] += Direction::kSlantParts * steps;
    q[first_axis(direction.axis)] += direction.slant[0] * steps;
    q[second_axis(direction.axis)] += direction.slant[1] * steps;
    CHECK(direction.project(p) == direction.project(q));
    q[first_axis(direction.axis)] += 1;
    CHECK(direction.project(p).a < direction.project(q).a);
  }
}
