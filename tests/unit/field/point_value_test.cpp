#include "field/point_value.h"

#include "catch2.h"
#include "field/gaussian_field.h"
#include "support/fields.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

constexpr double kAllAtoms = 1e9;  // a cut that leaves nothing out

}  // namespace

TEST_CASE("the value at a point is good to the error that it states") {
  for_each_field(21, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random_point(random, sample.room);
      NearAtoms near;
      field.collect_near({p, p}, near, kAllAtoms);
      const PointValue value = evaluate(near, field.decay(), p);
      const double error = static_cast<double>(std::abs(exact.psi(p) - value.value));
      REQUIRE(error <= value.error);
    }
  });
}

TEST_CASE("stated errors are small: 1e-13 for usual radii") {
  Random random(22);
  const GaussianField field(random_cloud(random, {20, 6.0, 0.8, 2.2, 0.1}), 0.6, 1.7);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random_point(random, box_around({0, 0, 0}, 4.0));
    NearAtoms near;
    field.collect_near({p, p}, near);
    CHECK(evaluate(near, 0.6, p).error < 2e-13);
  }
}

TEST_CASE("the gradient agrees with the formula and with differences of the value") {
  for_each_field(23, kDecays, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    if (sample.what == "at 10^6 A" || sample.what == "radii of 1000 A") return;  // differences are not worth much
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = random_point(random, sample.room);
      NearAtoms near;
      field.collect_near({p, p}, near, kAllAtoms);
      const PointValue value = evaluate(near, field.decay(), p);
      const auto gradient = exact.gradient(p);
      for (int k = 0; k < 3; ++k) {
        CHECK(value.gradient[k] == Approx(static_cast<double>(gradient[k])).margin(1e-10));
        Vec3 before = p, after = p;
        before[k] -= 1e-5;
        after[k] += 1e-5;
        const double difference =
            (evaluate(near, field.decay(), after).value - evaluate(near, field.decay(), before).value) /
            (after[k] - before[k]);
        CHECK(value.gradient[k] == Approx(difference).margin(1e-4));
      }
    }
  });
}

TEST_CASE("side_of: what it claims is so, and it claims it at all but a sliver of points") {
  for_each_field(24, {0.6}, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    int unknown = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = random_point(random, sample.room);
      NearAtoms near;
      field.collect_near({p, p}, near, random.uniform(0.0, 25.0));
      const Side side = side_of(evaluate(near, 0.6, p), near);
      if (side == Side::kInside) REQUIRE(exact.psi(p) >= 0.0L);
      if (side == Side::kOutside) REQUIRE(exact.psi(p) < 0.0L);
      unknown += side == Side::kUnknown;
    }
    CHECK(unknown < 300);  // a cut of 0 leaves out atoms that count
  });
}

TEST_CASE("next to the surface the side is still told, a hundred roundings away") {
  const double radius = sphere_radius(2.0, 0.6, 1.7);
  NearAtoms near = list_of({{0.0}, {0.0}, {0.0}, {0.6 * 4.0 - std::log(1.7)}});
  CHECK(side_of(evaluate(near, 0.6, {radius - 1e-12, 0, 0}), near) == Side::kInside);
  CHECK(side_of(evaluate(near, 0.6, {radius + 1e-12, 0, 0}), near) == Side::kOutside);
  CHECK(side_of(evaluate(near, 0.6, {radius, 0, 0}), near) == Side::kUnknown);
  near.tail = 1e-6;  // atoms left out might bring the point inside
  CHECK(side_of(evaluate(near, 0.6, {radius + 1e-12, 0, 0}), near) == Side::kUnknown);
  CHECK(side_of(evaluate(near, 0.6, {radius + 1e-4, 0, 0}), near) == Side::kOutside);
}

TEST_CASE("far from every atom a point is outside") {
  const NearAtoms none;
  CHECK(side_of(evaluate(none, 0.6, {0, 0, 0}), none) == Side::kOutside);
  NearAtoms one = list_of({{0.0}, {0.0}, {0.0}, {1.0}});
  CHECK(side_of(evaluate(one, 0.6, {1e6, 0, 0}), one) == Side::kOutside);
}

TEST_CASE("deep inside a sphere of 1000 A nothing overflows") {
  NearAtoms one = list_of({{0.0}, {0.0}, {0.0}, {2.0 * 1e6}});
  const PointValue value = evaluate(one, 2.0, {0.5, 0, 0});
  CHECK(value.value == Approx(2e6));
  CHECK(value.gradient[0] == Approx(-2.0));
  CHECK(side_of(value, one) == Side::kInside);
}
