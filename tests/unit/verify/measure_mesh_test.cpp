#include "gaussmesh/measure_mesh.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using shapes::cube;
using shapes::icosphere;
using shapes::moved;
using shapes::together;
using shapes::turned;

namespace {

double distance_between(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

std::vector<Point> random_points(std::mt19937& engine, int count, double box) {
  std::uniform_real_distribution<double> place(-box, box);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back({place(engine), place(engine), place(engine)});
  return points;
}

}  // namespace

TEST_CASE("a sphere round one atom is as far from it as their radii say") {
  const AtomMeasures found = measure_by_atoms(moved(icosphere(3, 2.5), {10, 20, 30}), {{10, 20, 30, 2.0, 0}});
  REQUIRE(found.vdw_distance);
  CHECK(*found.vdw_distance == Approx(0.25));
}

TEST_CASE("the relative distance is that from the nearest sphere, found among all") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> radius(0.1, 2);
  std::vector<Atom> atoms;
  for (const Point& p : random_points(engine, 300, 10))
    atoms.push_back({p[0], p[1], p[2], atoms.size() % 5 == 0 ? 0.0 : radius(engine), 0});
  const TriangleMesh mesh{random_points(engine, 200, 15), {}};
  double sum = 0.0;
  for (const Point& v : mesh.vertices) {
    double least = 1e300;
    for (const Atom& a : atoms)
      if (a.radius > 0) least = std::min(least, distance_between(v, {a.x, a.y, a.z}) / a.radius);
    sum += least - 1;
  }
  CHECK(*measure_by_atoms(mesh, atoms).vdw_distance == Approx(sum / 200));
}

TEST_CASE("there is no relative distance without a radius or a vertex") {
  CHECK_FALSE(measure_by_atoms(cube(1), {{0, 0, 0, 0, 0}}).vdw_distance);
  CHECK_FALSE(measure_by_atoms({}, {{0, 0, 0, 1, 0}}).vdw_distance);
  CHECK_THROWS_AS(measure_by_atoms(cube(1), {}), OptionError);
}

TEST_CASE("the area goes to the nearest atoms, all of it") {
  const TriangleMesh mesh = together(moved(icosphere(2, 2), {-5, 0, 0}), moved(icosphere(2, 1), {5, 0, 0}));
  const MeshCheck check = check_mesh(mesh);
  const AtomMeasures found = measure_by_atoms(mesh, {{5, 0, 0, 1, 0}, {0, 100, 0, 1, 0}, {-5, 0, 0, 2, 0}});
  REQUIRE(found.areas.size() == 3);
  CHECK(found.areas[0] == Approx(check.components[1].area));
  CHECK(found.areas[1] == 0.0);
  CHECK(found.areas[2] == Approx(check.components[0].area));
}

TEST_CASE("charges are inside, outside, in a cavity, and in a solid inside a cavity") {
  const TriangleMesh mesh = together(together(icosphere(2, 6), turned(icosphere(2, 4))), icosphere(2, 2));
  const MeshCheck check = check_mesh(mesh);
  REQUIRE(check.fit_for_solver());
  const std::vector<Atom> atoms{{0, 5, 0, 1, 1},   {0, 0, 3, 1, -1},  {0.5, 0, 0, 1, 1},
                                {7, 0, 0, 1, 0.5}, {9, 0, 0, 1, 0},   {0, 0, 0, 0, 1},
                                {-5, 0, 0, 0, 1},  {0, 0, -60, 1, 1}, {0, 0, 1e-300, 1, 1}};
  CHECK(find_charges_outside(mesh, check, atoms) == std::vector<std::uint32_t>{1, 3, 7});
  // A component with a hole encloses nothing.
  TriangleMesh open = mesh;
  open.triangles.erase(open.triangles.begin() + 20 * 16 * 2);
  CHECK(find_charges_outside(open, check_mesh(open), {{0, 0, 0, 1, 1}, {0, 5, 0, 1, 1}}) ==
        std::vector<std::uint32_t>{0});
}

TEST_CASE("a charge right below a vertex or an edge is inside once, not twice or never") {
  const TriangleMesh mesh = cube(1);
  const std::vector<Atom> atoms{{0, 0, 0, 1, 1}, {0.5, 0.5, 0, 1, 1}, {1.5, 1.5, 0, 1, 1}, {0.25, -0.25, 0.5, 1, 1}};
  CHECK(find_charges_outside(mesh, check_mesh(mesh), atoms) == std::vector<std::uint32_t>{2});
}

TEST_CASE("triangles that could not be judged enclose nothing and break nothing") {
  TriangleMesh mesh = cube(1);
  mesh.triangles.push_back({0, 0, 1});
  CHECK(find_charges_outside(mesh, check_mesh(mesh), {{0, 0, 0, 1, 1}}).empty());
}

TEST_CASE("near vertices are those that all pairs give") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const TriangleMesh mesh{random_points(engine, 400, 1), {}};
  for (const double distance : {0.01, 0.1, 0.4, 5.0}) {
    std::size_t pairs = 0;
    std::vector<std::array<std::uint32_t, 2>> first;
    for (std::uint32_t i = 0; i < 400; ++i)
      for (std::uint32_t j = i + 1; j < 400; ++j)
        if (distance_between(mesh.vertices[i], mesh.vertices[j]) < distance) {
          ++pairs;
          if (first.size() < 10) first.push_back({i, j});
        }
    const NearVertices found = find_near_vertices(mesh, distance);
    CHECK(found.pairs == pairs);
    CHECK(found.examples == first);
    CHECK(found.short_edges == 0);
  }
}

TEST_CASE("vertices are crowded where their triangles are slivers, and not where these are small") {
  CHECK(find_near_vertices(cube(0.01), 0.05).pairs == 28);
  CHECK(find_near_vertices(cube(0.01), 0.05).crowded == 0);
  TriangleMesh needle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.02}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  CHECK(find_near_vertices(needle, 0.05).crowded == 1);
  CHECK(find_near_vertices(needle, 0.01).crowded == 0);
  needle.vertices.push_back({1, 0, 0.03});  // of no triangle, beside one
  CHECK(find_near_vertices(needle, 0.05).crowded == 2);
}

TEST_CASE("short edges are counted once each") {
  TriangleMesh mesh = cube(1);  // 12 edges of length 2, 6 diagonals
  CHECK(find_near_vertices(mesh, 1.9).short_edges == 0);
  CHECK(find_near_vertices(mesh, 2.1).short_edges == 12);
  CHECK(find_near_vertices(mesh, 2.1).pairs == 12);
  CHECK(find_near_vertices(mesh, 3.0).short_edges == 18);
  CHECK(find_near_vertices(mesh, 3.0).pairs == 24);  // the other diagonals of the faces too
  CHECK(find_near_vertices(mesh, 3.0).crowded == 0);
  CHECK_THROWS_WITH(find_near_vertices(mesh, -1e-9), "distance: expected a number > 0, got '-1e-09'");
  CHECK_THROWS_AS(find_near_vertices(mesh, 0.0), OptionError);
  CHECK_THROWS_AS(find_near_vertices(mesh, std::nan("")), OptionError);
}
