#include "write/region_points.h"

#include "catch2.h"
#include "unit/verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::shapes;

namespace {

double largest_coordinate(const Point& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}); }

}  // namespace

TEST_CASE("a point in each solid and each void of nested cubes, and in none of the others") {
  TriangleMesh nest = cube(16);
  for (const double half : {8.0, 4.0, 2.0, 1.0}) nest = together(turned(nest), cube(half));
  const MeshCheck check = check_mesh(nest);
  REQUIRE(check.fit_for_solver());
  const std::vector<RegionPoint> points = find_region_points(nest, check);
  REQUIRE(points.size() == 5);
  double half = 16.0;
  for (const RegionPoint& region : points) {
    CHECK(largest_coordinate(region.point) < half);
    half /= 2.0;
    if (half >= 1.0) CHECK(largest_coordinate(region.point) > half);
  }
}

TEST_CASE("walls much thinner than the triangles are no hindrance") {
  const double wall = 1e-5;
  const TriangleMesh shell = together(cube(1.0), turned(cube(1.0 - wall)));
  const std::vector<RegionPoint> points = find_region_points(shell, check_mesh(shell));
  REQUIRE(points.size() == 2);
  CHECK(largest_coordinate(points[0].point) < 1.0);
  CHECK(largest_coordinate(points[0].point) > 1.0 - wall);
  CHECK(largest_coordinate(points[1].point) < 1.0 - wall);
}

TEST_CASE("solids beside each other have their own points") {
  const TriangleMesh pair = together(cube(1.0), moved(cube(2.0), {10.0, 0.0, 0.0}));
  const std::vector<RegionPoint> points = find_region_points(pair, check_mesh(pair));
  REQUIRE(points.size() == 2);
  CHECK(points[0].point[0] > 8.0);
  CHECK(points[1].point[0] < 1.0);
}
