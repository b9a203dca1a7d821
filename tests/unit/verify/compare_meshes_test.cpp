#include "gaussmesh/compare_meshes.h"

#include <cmath>
#include <random>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "support/threads.h"
#include "verify/nearest_triangle.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;
using shapes::cube;
using shapes::icosphere;
using shapes::moved;
using shapes::together;

namespace {

Point random_point(std::mt19937& engine, double box) {
  std::uniform_real_distribution<double> place(-box, box);
  return {place(engine), place(engine), place(engine)};
}

/// The distance from a triangle, by looking at many of its points: too large by at most the distance between these.
double sampled_distance(const Point& p, const Point& a, const Point& b, const Point& c) {
  constexpr int kCuts = 300;
  double least = 1e300;
  for (int i = 0; i <= kCuts; ++i)
    for (int j = 0; i + j <= kCuts; ++j) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) {
        const double x = a[k] + (i * (b[k] - a[k]) + j * (c[k] - a[k])) / kCuts;
        sum += (x - p[k]) * (x - p[k]);
      }
      least = std::min(least, std::sqrt(sum));
    }
  return least;
}

}  // namespace

TEST_CASE("the distance from a triangle is that from the nearest of its points") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  for (int i = 0; i < 60; ++i) {
    const Point p = random_point(engine, 2), a = random_point(engine, 1), b = random_point(engine, 1);
    const Point c = i % 10 == 0   ? b
                    : i % 10 == 1 ? Point{2 * b[0] - a[0], 2 * b[1] - a[1], 2 * b[2] - a[2]}
                                  : random_point(engine, 1);
    const double exact = std::sqrt(distance_sq_to_triangle(p, a, b, c));
    const double sampled = sampled_distance(p, a, b, c);
    CHECK(exact <= sampled + 1e-12);
    CHECK(exact >= sampled - 0.02);
  }
  CHECK(distance_sq_to_triangle({0.2, 0.2, 3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}) == Approx(9));
  CHECK(distance_sq_to_triangle({-3, -4, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}) == Approx(25));
  CHECK(distance_sq_to_triangle({1, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}) == Approx(0.5));
}

TEST_CASE("the nearest triangle is the nearest of all, whatever is guessed") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const TriangleMesh mesh = moved(together(icosphere(3, 1), moved(icosphere(2, 0.5), {2, 0, 0})), {500, -300, 200});
  const TriangleTree tree(mesh);
  std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(mesh.triangles.size() - 1));
  for (int i = 0; i < 300; ++i) {
    Point p = random_point(engine, i % 3 == 0 ? 30 : 2);
    p = {p[0] + 500, p[1] - 300, p[2] + 200};
    double least = 1e300;
    for (const auto& [a, b, c] : mesh.triangles)
      least = std::min(least, distance_sq_to_triangle(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
    CHECK(find_nearest_triangle(p, mesh, tree, any(engine)).distance_sq == least);
  }
}

TEST_CASE("a mesh is at no distance from itself, or from itself cut finer") {
  const MeshComparison same = compare_meshes(cube(1), cube(1));
  CHECK(same.hausdorff() < 1e-15);
  CHECK(same.first_to_second.samples >= 24 * 25);
  CHECK(same.hausdorff_bound() > 0.0);
}

TEST_CASE("concentric cubes and spheres are as far apart as their sizes say") {
  // From the inner cube to the outer all points are as far; back, corners are farther.
  const MeshComparison cubes = compare_meshes(cube(1), cube(1.5), {100.0});
  CHECK(cubes.first_to_second.max == Approx(0.5));
  CHECK(cubes.first_to_second.mean == Approx(0.5));
  CHECK(cubes.first_to_second.rms == Approx(0.5));
  CHECK(cubes.second_to_first.max == Approx(0.5 * std::sqrt(3)));
  CHECK(cubes.second_to_first.mean > 0.5);
  CHECK(cubes.second_to_first.rms > cubes.second_to_first.mean);
  CHECK(cubes.hausdorff() == Approx(0.5 * std::sqrt(3)));
  CHECK(cubes.hausdorff_bound() >= cubes.hausdorff());
  const MeshComparison spheres = compare_meshes(icosphere(4, 3), icosphere(4, 3.25));
  CHECK(spheres.hausdorff() == Approx(0.25).epsilon(0.02));
  CHECK(spheres.second_to_first.mean == Approx(0.25).epsilon(0.02));
}

TEST_CASE("a piece that only one mesh has is far from the other, one way alone") {
  const TriangleMesh more = together(cube(1), moved(cube(0.1), {11, 0, 0}));
  const MeshComparison found = compare_meshes(cube(1), more);
  CHECK(found.first_to_second.max < 1e-15);
  CHECK(found.second_to_first.max == Approx(10.1));
  CHECK(std::abs(found.second_to_first.farthest[0]) == Approx(11.1));
}

TEST_CASE("no point exceeds the bound, however coarse the samples") {
  std::mt19937 engine(11);
  const TriangleMesh plane{{{-9, -9, 0}, {9, -9, 0}, {0, 12, 0}}, {{0, 1, 2}}};
  for (const double density : {0.01, 1.0, 100.0}) {
    for (int i = 0; i < 20; ++i) {
      TriangleMesh tilted{{random_point(engine, 2), random_point(engine, 2), random_point(engine, 2)}, {{0, 1, 2}}};
      double highest = 0.0;  // over the plane: at a corner
      for (const Point& p : tilted.vertices) highest = std::max(highest, std::abs(p[2]));
      const OneSidedDistance found = compare_meshes(tilted, plane, {density}).first_to_second;
      CHECK(found.max == Approx(highest));
      CHECK(found.max_bound >= highest - 1e-12);
    }
  }
}

TEST_CASE("what cannot be compared is refused") {
  TriangleMesh bad = cube(1);
  CHECK_THROWS_AS(compare_meshes({}, bad), InputError);
  CHECK_THROWS_AS(compare_meshes(bad, bad, {0.0}), OptionError);
  CHECK_THROWS_WITH(compare_meshes(bad, bad, {-1e-30}), "samples per A^2: expected a number > 0, got '-1e-30'");
  CHECK_THROWS_WITH(
      compare_meshes(bad, bad, {1e30}),
      "samples per A^2: expected at most 2^20 samples in a triangle, got '1e+30' and a triangle of 2 A^2");
  bad.triangles[3][1] = 99;
  CHECK_THROWS_AS(compare_meshes(cube(1), bad), InputError);
  bad = cube(1);
  bad.vertices[2][1] = std::nan("");
  CHECK_THROWS_AS(compare_meshes(bad, cube(1)), InputError);
  bad.vertices[2][1] = 1e300;
  CHECK_THROWS_WITH(compare_meshes(bad, cube(1)),
                    Catch::Matchers::ContainsSubstring("within 1e60 A, got '1e+300' for"));
}

TEST_CASE("comparisons are the same to the last bit for any number of threads") {
  const TriangleMesh a = icosphere(4, 3), b = moved(icosphere(3, 3.1), {0.1, 0.2, 0});
  const auto alone = testing::on_threads(1, [&] { return compare_meshes(a, b); });
  const auto shared = testing::on_threads(3, [&] { return compare_meshes(a, b); });
  CHECK(alone.first_to_second.mean == shared.first_to_second.mean);
  CHECK(alone.first_to_second.rms == shared.first_to_second.rms);
  CHECK(alone.first_to_second.farthest == shared.first_to_second.farthest);
  CHECK(alone.second_to_first.max_bound == shared.second_to_first.max_bound);
}
