// The field in a block: derivatives against differences, and projection onto spheres known in closed form.
#include "improve/block_field.h"

#include <cmath>

#include "catch2.h"

using namespace gaussmesh;

namespace {

const std::vector<Atom> kAtoms{
    {0, 0, 0, 1.7, 0}, {1.5, 0.3, -0.2, 1.2, 0}, {-0.4, 1.9, 0.8, 1.5, 0}, {3, 3, 3, 1.8, 0}};
const Box kBox{{-5, -5, -5}, {7, 7, 7}};

}  // namespace

TEST_CASE("gradient and Hessian are the derivatives of log phi") {
  const double d = 0.6, step = 1e-4;
  const GaussianField field(kAtoms, d, 1.7);
  BlockField block(field, kBox);
  const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (const Vec3& p : {Vec3{1.9, 0.4, 0.6}, Vec3{-1.1, -0.7, 1.4}, Vec3{0.9, 2.2, 2.1}}) {
    double sum = 0.0;
    for (const Atom& a : kAtoms) {
      const double dx = p[0] - a.x, dy = p[1] - a.y, dz = p[2] - a.z;
      sum += std::exp(-d * (dx * dx + dy * dy + dz * dz - a.radius * a.radius));
    }
    const FieldJet jet = block.jet(p);
    CHECK(jet.value == Approx(std::log(sum / 1.7)).margin(1e-10));
    for (int k = 0; k < 3; ++k) {
      Vec3 before = p, after = p;
      before[k] -= step;
      after[k] += step;
      const FieldJet b = block.jet(before), a = block.jet(after);
      CHECK(jet.gradient[k] == Approx((a.value - b.value) / (2 * step)).margin(1e-6));
      for (int i = 0; i < 6; ++i) {
        if (pairs[i][1] != k) continue;
        CHECK(jet.hessian[i] ==
              Approx((a.gradient[pairs[i][0]] - b.gradient[pairs[i][0]]) / (2 * step)).margin(1e-6));
      }
    }
  }
}

TEST_CASE("the surface of one atom is a sphere: its curvature, and the way to it") {
  const double d = 0.6, c = 1.7, r = 2.0;
  const GaussianField field({{0.5, -0.25, 1.0, r, 0}}, d, c);
  const double radius = std::sqrt(r * r - std::log(c) / d);  // |x|^2 = r^2 - ln(c) / d
  BlockField block(field, kBox);
  for (const Vec3& p : {Vec3{2.4, 0.1, 1.3}, Vec3{0.3, 1.7, 0.2}, Vec3{0.5, -0.25, 2.5}}) {
    const auto place = block.project(p, 1.0);
    REQUIRE(place);
    const Vec3 out = place->at - Vec3{0.5, -0.25, 1.0};
    CHECK(length(out) == Approx(radius).margin(2e-9));
    for (int k = 0; k < 3; ++k) {
      CHECK(double(place->normal[k]) == Approx(out[k] / radius).margin(1e-6));
      CHECK(place->at[k] == to_angstrom(std::llround(place->at[k] * kUnitsPerAngstrom)));
    }
    CHECK(largest_curvature(block.jet(place->at)) == Approx(1.0 / radius).epsilon(1e-6));
  }
  CHECK_FALSE(block.project({3.5, -0.25, 1.0}, 0.1));  // the surface is farther than allowed
}

TEST_CASE("two spheres that touch: the neck curves more than either") {
  const GaussianField field({{-1.9, 0, 0, 1.6, 0}, {1.9, 0, 0, 1.6, 0}}, 0.6, 0.98);
  BlockField block(field, kBox);
  const auto waist = block.project({0, 0.6, 0}, 1.0);
  const auto pole = block.project({-3.6, 0, 0}, 1.0);
  REQUIRE(waist);
  REQUIRE(pole);
  CHECK(largest_curvature(block.jet(waist->at)) > largest_curvature(block.jet(pole->at)));
}
