#include "pipeline/critical_point.h"

#include <cmath>
#include <numbers>

#include "catch2.h"

using namespace gaussmesh;

TEST_CASE("the critical point between two equal atoms is the middle, with the value of both there") {
  const double decay = 0.6, r = 1.5, isovalue = 1.3;
  const GaussianField field({{0, 0, 0, r, 0}, {3.0, 1.0, 2.0, r, 0}}, decay, isovalue);
  const double value = 2.0 * std::exp(-decay * (0.25 * 14.0 - r * r)) / isovalue;
  for (const Vec3& near : {Vec3{1.5, 0.5, 1.0}, Vec3{1.45, 0.55, 1.02}, Vec3{1.51, 0.45, 0.96}}) {
    const CriticalPoint found = find_critical_point(field, near);
    CHECK(std::hypot(found.point[0] - 1.5, found.point[1] - 0.5, found.point[2] - 1.0) < 1e-6);
    CHECK(found.relative_value == Approx(value).epsilon(1e-9));
    CHECK(found.converged);
  }
}

TEST_CASE("the maximum of one atom is its centre") {
  const GaussianField field({{1.0, 2.0, 3.0, 2.0, 0}}, 0.7, 1.0);
  const CriticalPoint found = find_critical_point(field, {1.05, 1.9, 3.02});
  CHECK(std::hypot(found.point[0] - 1.0, found.point[1] - 2.0, found.point[2] - 3.0) < 1e-6);
  CHECK(found.relative_value == Approx(std::exp(0.7 * 4.0)).epsilon(1e-9));
}

TEST_CASE("of a circle of critical points one near the place is found") {
  constexpr int kAtoms = 120;
  constexpr double kRadius = 20.0, kApart = 4.0;
  std::vector<Atom> rings;  // coaxial, halfway between them phi has a circle of saddles
  for (int i = 0; i < kAtoms; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAtoms;
    for (const double z : {0.0, kApart})
      rings.push_back({kRadius * std::cos(angle), kRadius * std::sin(angle), z, 1.5, 0});
  }
  const GaussianField field(rings, 0.6, 1.0);
  for (const double angle : {0.0, 0.3, 1.7}) {
    const double radius = kRadius + 0.03;
    const CriticalPoint found =
        find_critical_point(field, {radius * std::cos(angle), radius * std::sin(angle), 0.5 * kApart + 0.02});
    CHECK(found.converged);
    CHECK(found.point[2] == Approx(0.5 * kApart).margin(1e-6));
    CHECK(std::atan2(found.point[1], found.point[0]) == Approx(angle).margin(0.01));
  }
}

TEST_CASE("where there is no critical point nearby the place itself is the answer") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.7, 1.0);
  const CriticalPoint found = find_critical_point(field, {1.9, 0.3, 0.2});
  CHECK(found.point == Vec3{1.9, 0.3, 0.2});
  CHECK_FALSE(found.converged);
}
