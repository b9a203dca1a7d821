#include "boxes/find_bricks.h"

#include <algorithm>
#include <numbers>

#include "catch2.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

BrickIndex brick_at(const Lattice& lattice, const Vec3& p) {
  BrickIndex brick;
  for (int k = 0; k < 3; ++k) {
    const double size = kBrickCells * lattice.cell_size();
    brick[k] = static_cast<std::int64_t>(std::floor((p[k] - to_angstrom(lattice.offset[k])) / size));
  }
  return brick;
}

Vec3 random_direction(Random& random) {
  while (true) {
    const Vec3 v = random_point(random, box_around({0, 0, 0}, 1.0));
    const double length = std::hypot(v[0], v[1], v[2]);
    if (length > 0.1 && length < 1.0) return {v[0] / length, v[1] / length, v[2] / length};
  }
}

/// Points of the surface on rays: every change of sign between samples along them.
std::vector<Vec3> march(const ExactField& exact, const Vec3& from, const Vec3& direction, double length, int samples) {
  std::vector<Vec3> found;
  const auto at = [&](int i) {
    Vec3 p = from;
    for (int k = 0; k < 3; ++k) p[k] += direction[k] * length * i / samples;
    return p;
  };
  bool inside = exact.psi(from) >= 0.0L;
  for (int i = 1; i <= samples; ++i) {
    const bool next = exact.psi(at(i)) >= 0.0L;
    if (next != inside)
      found.push_back(next ? surface_between(exact, at(i), at(i - 1)) : surface_between(exact, at(i - 1), at(i)));
    inside = next;
  }
  return found;
}

std::size_t count_bricks(const std::vector<Atom>& atoms, double spacing) {
  return find_bricks(GaussianField(atoms, 0.6, 1.7), lattice_of(spacing)).size();
}

}  // namespace

TEST_CASE("every point of the surface found by marching along rays lies in a brick") {
  const std::uint64_t seed = 41;
  CAPTURE(seed);
  Random random(seed);
  std::size_t points = 0;
  for (int cloud = 0; cloud < 12; ++cloud) {
    const double decay = random.logarithmic(0.1, 10.0), isovalue = random.logarithmic(0.3, 3.0);
    const double spacing = random.logarithmic(0.2, 3.0);
    CAPTURE(decay, isovalue, spacing);
    std::vector<Atom> atoms = random_cloud(random, {20, 10.0, 0.5, 2.5, 0.2});
    if (cloud % 3 == 0)
      for (Atom& a : atoms) a.y += 900000.0;
    const Lattice lattice = lattice_of(spacing);
    const auto bricks = find_bricks(GaussianField(atoms, decay, isovalue), lattice);
    CHECK(std::is_sorted(bricks.begin(), bricks.end()));
    CHECK(std::adjacent_find(bricks.begin(), bricks.end()) == bricks.end());
    const ExactField exact(atoms, decay, isovalue);
    for (const Atom& a : atoms) {
      for (int ray = 0; ray < 10; ++ray) {
        for (const Vec3& p : march(exact, {a.x, a.y, a.z}, random_direction(random), 20.0, 200)) {
          REQUIRE(std::binary_search(bricks.begin(), bricks.end(), brick_at(lattice, p)));
          ++points;
        }
      }
    }
  }
  CHECK(points > 1000);
}

TEST_CASE("two atoms 10^6 A apart give the bricks of two spheres") {
  const std::size_t one = count_bricks({{0, 0, 0, 2.0, 0}}, 0.5);
  CHECK(one >= 1);
  for (const int axis : {0, 1, 2}) {
    Atom far{0, 0, 0, 2.0, 0};
    (axis == 0 ? far.x : axis == 1 ? far.y : far.z) = 1e6;
    const std::size_t two = count_bricks({{0, 0, 0, 2.0, 0}, far}, 0.5);
    CHECK(two > one);
    CHECK(two <= 2 * one + 8);  // a sphere elsewhere on the lattice may touch a few bricks more
  }
  CHECK(count_bricks({{-1e6, -1e6, -1e6, 2.0, 0}, {1e6, 1e6, 1e6, 2.0, 0}}, 0.5) <= 2 * one + 8);
}

TEST_CASE("the number of bricks grows with the area of a sphere, not with its volume") {
  const std::size_t small = count_bricks({{0, 0, 0, 40.0, 0}}, 0.5), large = count_bricks({{0, 0, 0, 80.0, 0}}, 0.5);
  CHECK(static_cast<double>(large) / static_cast<double>(small) == Approx(4.0).epsilon(0.1));
  // A plane of area A crosses about 1.5 A / size^2 cubes of a lattice.
  const double area = 4.0 * std::numbers::pi * 6400.0, brick_face = 16.0;
  CHECK(static_cast<double>(large) < 2.5 * area / brick_face);
}

TEST_CASE("there are no bricks where phi is below c everywhere") {
  CHECK(find_bricks(GaussianField({{0, 0, 0, 0.0, 0}}, 0.6, 1.7), lattice_of(0.5)).empty());
  CHECK(find_bricks(GaussianField({{0, 0, 0, 2.0, 0}}, 1.0, std::exp(4.0) * 1.001), lattice_of(0.5)).empty());
  CHECK_FALSE(find_bricks(GaussianField({{0, 0, 0, 2.0, 0}}, 1.0, std::exp(4.0) * 0.999), lattice_of(0.5)).empty());
}
