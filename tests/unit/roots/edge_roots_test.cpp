#include "roots/edge_roots.h"

#include <algorithm>

#include "catch2.h"
#include "core/lattice_degenerate.h"
#include "field/point_value.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

const Lattice kLattice = lattice_of(0.5);

/// The roots on the edge from `start` along an axis to coordinate `end`.
std::vector<EdgeRoot> find_roots(const GaussianField& field, const Vec3& start, int axis, double end) {
  const CoordPoint lo = to_coord(start);
  CoordPoint hi = lo;
  hi[axis] = to_coord(end);
  const Box box{to_angstrom(lo), to_angstrom(hi)};
  NearAtoms near;
  field.collect_near(box, near);
  EdgeRootFinder finder(field, kLattice);
  const auto roots = finder.find(near, LocalModel(near, field.decay(), box), axis, lo, hi[axis]);
  return {roots.begin(), roots.end()};
}

std::vector<double> positions(const std::vector<EdgeRoot>& roots, int axis) {
  std::vector<double> result;
  for (const EdgeRoot& root : roots) result.push_back(to_angstrom(root.point.position[axis]));
  return result;
}

void check_positions(const std::vector<EdgeRoot>& roots, int axis, const std::vector<double>& expected) {
  const std::vector<double> found = positions(roots, axis);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 1e-9);
}

void check_sides(const std::vector<EdgeRoot>& roots, bool starts_inside) {
  int side = starts_inside ? -1 : 1;
  for (const EdgeRoot& root : roots) {
    CHECK(int{root.rise} == side);
    side = -side;
  }
}

}  // namespace

TEST_CASE("a line through one sphere has the two ends of a chord") {
  const std::uint64_t seed = 51;
  CAPTURE(seed);
  Random random(seed);
  int hit = 0, missed = 0;
  for (int i = 0; i < 500; ++i) {
    const double decay = random.logarithmic(0.1, 10.0), isovalue = random.logarithmic(0.3, 3.0);
    const double r = random.uniform(1.5, 4.0), radius = sphere_radius(r, decay, isovalue);
    if (!(radius > 0.0)) continue;
    const int axis = static_cast<int>(random.integer(0, 2)), b = (axis + 1) % 3, c = (axis + 2) % 3;
    const Vec3 centre = random_point(random, box_around({0, 0, 0}, 3.0));
    Vec3 start = centre;
    start[axis] -= 9.0;
    start[b] += random.uniform(-1.1, 1.1) * radius;
    start[c] += random.uniform(-1.1, 1.1) * radius;
    start = to_angstrom(to_coord(start));
    const GaussianField field({{centre[0], centre[1], centre[2], r, 0}}, decay, isovalue);
    const auto roots = find_roots(field, start, axis, centre[axis] + 9.0);
    const double half_sq = radius * radius - (start[b] - centre[b]) * (start[b] - centre[b]) -
                           (start[c] - centre[c]) * (start[c] - centre[c]);
    CAPTURE(decay, isovalue, r, half_sq);
    if (half_sq < 0.0) {
      CHECK(roots.empty());
      ++missed;
      continue;
    }
    const double half = std::sqrt(half_sq);
    check_positions(roots, axis, {centre[axis] - half, centre[axis] + half});
    check_sides(roots, false);
    for (const EdgeRoot& root : roots) {
      for (int k = 0; k < 3; ++k) {
        const double outward = (to_angstrom(root.point.position[k]) - centre[k]) / radius;
        CHECK(static_cast<double>(root.point.normal[k]) == Approx(outward).margin(1e-6));
        if (k != axis) CHECK(root.point.position[k] == to_coord(start)[k]);
      }
    }
    ++hit;
  }
  CHECK(hit > 100);
  CHECK(missed > 20);
}

TEST_CASE("one edge through two and through three spheres has four and six roots") {
  // So far apart (20 A) that each feels nothing of the others: exp(-0.6 * 300) is below rounding.
  const double radius = sphere_radius(2.0, 0.6, 1.7), y = 0.7, half = std::sqrt(radius * radius - y * y);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Atom> atoms;
    std::vector<double> expected;
    Vec3 start{};
    start[axis] = -10.0;
    start[(axis + 1) % 3] = y;
    for (int n = 0; n < 3; ++n) {
      Atom a{0, 0, 0, 2.0, 0};
      (axis == 0 ? a.x : axis == 1 ? a.y : a.z) = 20.0 * n;
      atoms.push_back(a);
      expected.insert(expected.end(), {20.0 * n - half, 20.0 * n + half});
      const auto roots = find_roots(GaussianField(atoms, 0.6, 1.7), start, axis, 50.0);
      check_positions(roots, axis, expected);
      check_sides(roots, false);
    }
  }
}

TEST_CASE("an edge that begins or ends inside has one root; one wholly inside or outside has none") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.7);
  const double radius = sphere_radius(2.0, 0.6, 1.7);
  const auto leaving = find_roots(field, {0.1, 0, 0}, 0, 3.0);
  check_positions(leaving, 0, {radius});
  check_sides(leaving, true);
  const auto entering = find_roots(field, {-3.0, 0, 0}, 0, 0.1);
  check_positions(entering, 0, {-radius});
  check_sides(entering, false);
  CHECK(find_roots(field, {-0.5, 0.2, 0}, 0, 0.5).empty());
  CHECK(find_roots(field, {-0.5, 3.0, 0}, 0, 0.5).empty());
}

TEST_CASE("two roots close together in one edge are found as two") {
  // A chord of half length h at distance R - h^2 / 2R from the centre.
  const double radius = 2.0;
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  for (const double half : {1e-1, 1e-2, 1e-3, 1e-4}) {
    CAPTURE(half);
    const double y = to_angstrom(to_coord(std::sqrt(radius * radius - half * half)));
    const double exact_half = std::sqrt((radius - y) * (radius + y));
    const auto roots = find_roots(field, {-0.31, y, 0}, 0, 0.27);
    REQUIRE(roots.size() == 2);
    check_sides(roots, false);
    // The line is almost tangent: an error of 1e-13 in phi moves a root by 1e-13 / half.
    const double tolerance = 1e-9 + 1e-12 / half;
    CHECK(std::abs(to_angstrom(roots[0].point.position[0]) + exact_half) < tolerance);
    CHECK(std::abs(to_angstrom(roots[1].point.position[0]) - exact_half) < tolerance);
  }
}

TEST_CASE("a line that passes the sphere closely has no root, a tangent one is reported") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  CHECK(find_roots(field, {-0.31, 2.0 + 1e-9, 0}, 0, 0.27).empty());
  CHECK_THROWS_AS(find_roots(field, {-0.31, 2.0, 0}, 0, 0.27), LatticeDegenerate);
}

TEST_CASE("an edge that nearly touches the surface is decided by all atoms, also those that its list leaves out") {
  // By symmetry the line along x is nearest to the surface at x = 0. The second atom adds some e^-14 there.
  const GaussianField field({{0, 0, 0, 2.0, 0}, {0, 7.06, 0, 1.5, 0}}, 0.6, 1.0);
  double inside = 1.9, outside = 2.1;
  for (int i = 0; i < 60; ++i) {
    const double y = 0.5 * (inside + outside);
    const double phi = std::exp(-0.6 * (y * y - 4.0)) + std::exp(-0.6 * ((y - 7.06) * (y - 7.06) - 2.25));
    (phi > 1.0 ? inside : outside) = y;
  }
  constexpr double kShortList = 12.0;
  for (const double gap : {5e-9, -5e-9}) {
    CAPTURE(gap);
    const CoordPoint lo = to_coord({-0.31, outside + gap, 0});
    const Coord hi = to_coord(0.27);
    const Box box{to_angstrom(lo), {to_angstrom(hi), to_angstrom(lo)[1], 0}};
    NearAtoms near;
    field.collect_near(box, near, kShortList);
    REQUIRE(near.size() == 1);
    EdgeRootFinder finder(field, kLattice);
    CHECK(finder.find(near, LocalModel(near, field.decay(), box), 0, lo, hi).size() == (gap > 0 ? 0 : 2));
  }
}

TEST_CASE("edges of many sizes through clouds have the roots that a dense look along them finds") {
  const std::uint64_t seed = 52;
  CAPTURE(seed);
  Random random(seed);
  std::size_t total = 0, several = 0;
  for (int cloud = 0; cloud < 40; ++cloud) {
    const double decay = random.logarithmic(0.3, 3.0), isovalue = random.logarithmic(0.5, 2.0);
    CAPTURE(cloud, decay, isovalue);
    const std::vector<Atom> atoms = random_cloud(random, {12, 6.0, 0.8, 2.2, 0.1});
    const GaussianField field(atoms, decay, isovalue);
    const ExactField exact(atoms, decay, isovalue);
    for (int i = 0; i < 60; ++i) {
      const int axis = static_cast<int>(random.integer(0, 2));
      Vec3 start = to_angstrom(to_coord(random_point(random, box_around({0, 0, 0}, 4.0))));
      const double end = to_angstrom(to_coord(start[axis] + random.logarithmic(0.1, 8.0)));
      std::vector<double> expected;
      Vec3 before = start, after = start;
      constexpr int kSamples = 300;
      for (int n = 1; n <= kSamples; ++n) {
        after[axis] = start[axis] + (end - start[axis]) * n / kSamples;
        const bool in = exact.psi(before) >= 0.0L, out = exact.psi(after) < 0.0L;
        if (in == out)
          expected.push_back(
              (in ? surface_between(exact, before, after) : surface_between(exact, after, before))[axis]);
        before = after;
      }
      const auto roots = find_roots(field, start, axis, end);
      check_positions(roots, axis, expected);
      check_sides(roots, exact.psi(start) >= 0.0L);
      total += roots.size();
      several += roots.size() > 1;
    }
  }
  CHECK(total > 500);
  CHECK(several > 50);
}

TEST_CASE("roots are good to rounding with radii of 35 and 1000 A and at 10^6 A") {
  for_each_field(53, {0.6}, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    const double limit = sample.what == "radii of 1000 A" ? 1e-7 : 0.6e-9;
    std::size_t found = 0;
    for (int i = 0; i < 100; ++i) {
      const int axis = static_cast<int>(random.integer(0, 2));
      const Vec3 start = to_angstrom(to_coord(random_point(random, sample.room)));
      for (const EdgeRoot& root : find_roots(field, start, axis, start[axis] + 2.0)) {
        const Vec3 p = to_angstrom(root.point.position);
        const auto gradient = exact.gradient(p);
        // To first order, along the edge: half a unit of the coordinates, and what rounding of phi moves the root
        // by.
        NearAtoms near;
        field.collect_near({p, p}, near);
        const double slope = static_cast<double>(std::abs(gradient[axis]));
        const double distance = static_cast<double>(std::abs(exact.psi(p))) / slope;
        CHECK(distance < limit + evaluate(near, 0.6, p).error / slope);
        CHECK((static_cast<double>(gradient[axis]) > 0.0) == (root.rise > 0));
        ++found;
      }
    }
    CHECK(found > 10);
  });
}

TEST_CASE("roots are good to rounding on the crease between two spheres of 1000 A, where the slope turns in 0.001 A") {
  const double decay = 0.6;
  const std::vector<Atom> atoms = {{-900.0, 0.0, 0.0, 1000.0, 0}, {900.0, 0.0, 0.0, 1000.0, 0}};
  const GaussianField field(atoms, decay, 1.3);
  const ExactField exact(atoms, decay, 1.3);
  const double crease = std::sqrt(1000.0 * 1000.0 - 900.0 * 900.0);
  int found = 0;
  for (int i = 1; i <= 60; ++i) {
    for (const EdgeRoot& root : find_roots(field, {-0.5, crease + 0.0001 * i * i, 0.125}, 0, 0.4)) {
      const Vec3 p = to_angstrom(root.point.position);
      CHECK(static_cast<double>(std::abs(exact.psi(p) / exact.gradient(p)[0])) < 1e-8);
      ++found;
    }
  }
  CHECK(found > 60);
}

TEST_CASE("no root is on a lattice plane or at an end of its edge") {
  // Spheres whose poles are on lattice planes, as near as coordinates tell.
  for (int n = 1; n < 40; ++n) {
    const double plane = to_angstrom(kLattice.plane(0, 4 * kFinePerCell + n));
    const double centre = plane - 2.0;
    const GaussianField field({{centre, 0, 0, 2.0, 0}}, 0.6, 1.0);
    const auto roots = find_roots(field, {to_angstrom(kLattice.plane(0, 3 * kFinePerCell)), 0, 0}, 0,
                                  to_angstrom(kLattice.plane(0, 5 * kFinePerCell)));
    REQUIRE(roots.size() == 1);
    CHECK((roots[0].point.position[0] - kLattice.offset[0]) % kLattice.step != 0);
    CHECK(std::abs(to_angstrom(roots[0].point.position[0]) - plane) < 3e-9);
  }
}

TEST_CASE("a root is on the side of a lattice plane where it is by all atoms, also those that its list leaves out") {
  // The second atom adds some e^-14 and moves the pole of the sphere outwards by 350 units, over the plane.
  const double plane = to_angstrom(kLattice.plane(0, 4 * kFinePerCell + 1));
  constexpr double kShortList = 12.0;
  for (const double gap : {1e-7, 3e-7, 5e-7}) {
    CAPTURE(gap);
    const double centre = plane - gap - 2.0;
    const GaussianField field({{centre, 0, 0, 2.0, 0}, {centre + 7.06, 0, 0, 1.5, 0}}, 0.6, 1.0);
    const CoordPoint lo = to_coord({plane - 0.31, 0, 0});
    const Coord hi = to_coord(plane + 0.27);
    const Box box{to_angstrom(lo), {to_angstrom(hi), 0, 0}};
    NearAtoms near;
    field.collect_near(box, near, kShortList);
    REQUIRE(near.size() == 1);
    EdgeRootFinder finder(field, kLattice);
    const auto roots = finder.find(near, LocalModel(near, field.decay(), box), 0, lo, hi);
    REQUIRE(roots.size() == 1);
    CHECK((to_angstrom(roots[0].point.position[0]) > plane) == (gap < 3.5e-7));
  }
}

TEST_CASE("is_inside is right at every point, near the surface too") {
  for_each_field(54, {0.6}, [&](const FieldCase& c) {
    const auto& [sample, field, exact, random] = c;
    for (int i = 0; i < 300; ++i) {
      Vec3 p = random_point(random, sample.room);
      const Vec3 q = random_point(random, sample.room);
      if ((exact.psi(p) >= 0.0L) != (exact.psi(q) >= 0.0L)) {
        p = exact.psi(p) >= 0.0L ? surface_between(exact, p, q) : surface_between(exact, q, p);
        for (double& x : p) x += random.uniform(-1e-6, 1e-6);
      }
      const long double psi = exact.psi(p);
      if (std::abs(psi) < 1e-8L) continue;
      NearAtoms near;
      const Box box = box_around(p, 0.3);
      field.collect_near(box, near);
      REQUIRE(is_inside(field, near, LocalModel(near, 0.6, box), p) == (psi >= 0.0L));
    }
  });
}

TEST_CASE("a point exactly on the surface cannot be told: that is reported, not guessed") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  NearAtoms near;
  const Box box = box_around({2, 0, 0}, 0.2);
  field.collect_near(box, near);
  CHECK_THROWS_AS(is_inside(field, near, LocalModel(near, 0.6, box), {2, 0, 0}), LatticeDegenerate);
}

TEST_CASE("refine_root finds the root from any guess in the bracket") {
  const GaussianField field({{0, 0, 0, 2.0, 0}}, 0.6, 1.0);
  NearAtoms near;
  field.collect_near({{0, 0, 0}, {3, 0, 0}}, near);
  for (const double guess : {0.51, 1.0, 1.9, 1.999999, 2.4, -5.0, 7.0, std::nan("")}) {
    const LineRoot root = refine_root(field, near, {0, 0, 0}, 0, 0.5, 2.5, true, guess);
    CHECK(std::abs(root.position - 2.0) < 1e-10);
    CHECK(root.gradient[0] == Approx(-2.4).epsilon(1e-4));
  }
}
