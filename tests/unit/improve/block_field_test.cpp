// The field in a block: derivatives against differences, and projection onto spheres known in closed form.
#include "improve/block_field.h"

#include <cmath>

#include "catch2.h"

using namespace gaussmesh;

namespace {

const std::vector<Atom> kAtoms{
    {0, 0, 0, 1.7, 0}, {1.5, 0.3, -0.2, 1.2, 0}, {-0.4, 1.9, 0.8, 1.5, 0}, {3, 3, 3, 1.8, 0}};
const Box kBox{{-5, -5, -5}, {7, 7, 7}};

/// log(phi / c) by its definition.
long double log_phi(const std::vector<Atom>& atoms, double d, double c, const Vec3& p) {
  long double sum = 0.0L;
  for (const Atom& a : atoms) {
    const long double dx = static_cast<long double>(p[0]) - a.x, dy = static_cast<long double>(p[1]) - a.y,
                      dz = static_cast<long double>(p[2]) - a.z;
    sum += std::exp(-d * (dx * dx + dy * dy + dz * dz - static_cast<long double>(a.radius) * a.radius));
  }
  return std::log(sum / c);
}

}  // namespace

TEST_CASE("gradient and Hessian are the derivatives of log phi") {
  const double d = 0.6, c = 1.7, step = 1e-5;
  struct Sample {
    std::vector<Atom> atoms;
    std::vector<Vec3> points;
    double error;
  };
  const Sample samples[] = {{kAtoms, {{1.9, 0.4, 0.6}, {-1.1, -0.7, 1.4}, {0.9, 2.2, 2.1}}, 1e-5},
                            // a radius of 30 A is too large for single precision
                            {{{30, 0, 0, 30.0, 0}, {0, 1, 0, 1.5, 0}}, {{0.1, 0.4, 0.6}, {-0.9, 1.5, 0.2}}, 1e-8}};
  for (const Sample& sample : samples) {
    BlockField block(GaussianField(sample.atoms, d, c), kBox);
    for (const Vec3& p : sample.points) {
      const auto psi = [&](int i, double by_i, int k, double by_k) {
        Vec3 at = p;
        at[i] += by_i;
        at[k] += by_k;
        return log_phi(sample.atoms, d, c, at);
      };
      const FieldJet jet = block.jet(p);
      CAPTURE(sample.atoms.size(), p);
      CHECK(std::abs(jet.value - double(psi(0, 0, 0, 0))) < sample.error);
      for (int k = 0; k < 3; ++k) {
        const auto slope = static_cast<double>((psi(k, step, k, 0) - psi(k, -step, k, 0)) / (2 * step));
        CHECK(std::abs(jet.gradient[k] - slope) < sample.error + 1e-6);
      }
      const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
      for (int n = 0; n < 6; ++n) {
        const int i = pairs[n][0], k = pairs[n][1];
        const auto second = static_cast<double>(
            (psi(i, step, k, step) - psi(i, step, k, -step) - psi(i, -step, k, step) + psi(i, -step, k, -step)) /
            (4 * step * step));
        CHECK(std::abs(jet.hessian[n] - second) < sample.error + 1e-5);
      }
    }
  }
}

TEST_CASE("rough places are within some 1e-6 A of the surface, exact ones within a rounding") {
  const double d = 0.6, c = 1.7;
  BlockField block(GaussianField(kAtoms, d, c), kBox);
  std::size_t found = 0;
  for (double x = -3.0; x <= 5.0; x += 0.37) {
    for (double y = -3.0; y <= 5.0; y += 0.41) {
      const Vec3 start{x, y, 1.9};
      const auto rough = block.project(start, 0.5, Accuracy::kRough), exact = block.project(start, 0.5);
      if (!rough || !exact) continue;
      ++found;
      CHECK(std::abs(double(log_phi(kAtoms, d, c, rough->at))) < 1e-5);
      CHECK(std::abs(double(log_phi(kAtoms, d, c, exact->at))) < 5e-9);
    }
  }
  CHECK(found > 30);
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
    const Curvatures curvatures = principal_curvatures(block.jet(place->at));
    CHECK(curvatures.larger == Approx(1.0 / radius).epsilon(1e-5));
    CHECK(curvatures.smaller == Approx(1.0 / radius).epsilon(1e-5));
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
  CHECK(principal_curvatures(block.jet(waist->at)).larger > principal_curvatures(block.jet(pole->at)).larger);
}
