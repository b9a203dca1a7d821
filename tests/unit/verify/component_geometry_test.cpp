#include "verify/component_geometry.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "catch2.h"
#include "gaussmesh/check_mesh.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;
using shapes::cube;
using shapes::icosphere;
using shapes::moved;
using shapes::tetrahedron;
using shapes::together;
using shapes::turned;

TEST_CASE("a cavity must be turned inwards, what lies in it outwards") {
  const TriangleMesh shell = together(cube(2), turned(cube(1)));
  const MeshCheck check = check_mesh(shell);
  CHECK(check.fit_for_solver());
  CHECK(check.volume == Approx(64.0 - 8.0));
  CHECK(check.chi == 4);
  REQUIRE(check.components.size() == 2);
  CHECK(check.components[0].volume == Approx(64.0));
  CHECK(check.components[1].depth == 1);
  CHECK(check_mesh(together(cube(2), cube(1))).inverted_components == 1);
  CHECK(check_mesh(turned(shell)).inverted_components == 2);
  CHECK(check_mesh(together(shell, cube(0.5))).fit_for_solver());
  CHECK(check_mesh(together(shell, turned(cube(0.5)))).inverted_components == 1);
  CHECK_FALSE(check_mesh(turned(shell)).fit_for_solver());
}

TEST_CASE("depth along rays through vertices and edges") {
  // Every ray from one cube's corners and centre lines meets edges and corners of the others.
  TriangleMesh nest = cube(16);
  for (const double half : {8.0, 4.0, 2.0, 1.0}) nest = together(turned(nest), cube(half));
  MeshCheck check = check_mesh(nest);
  CHECK(check.fit_for_solver());
  for (std::size_t i = 0; i < 5; ++i) CHECK(check.components[i].depth == i);
  CHECK_FALSE(check.components[0].parent);
  for (std::uint32_t i = 1; i < 5; ++i) CHECK(check.components[i].parent == i - 1);
  for (std::size_t t = 0; t < nest.triangles.size(); ++t)  // made from the outermost in, twelve triangles each
    CHECK(check.component_of[t] == t / 12);

  TriangleMesh beside = cube(1);
  for (const Point& by : {Point{2.5, 0, 0}, {0, 0, 2.5}, {0, 0, -2.5}, {1, 1, 5}, {-1, 0, -5}, {2.5, 2.5, 2.5}})
    beside = together(beside, moved(cube(1), by));
  CHECK(check_mesh(beside).fit_for_solver());

  const TriangleMesh pyramid{{{1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}, {0, 0, 0}},
                             {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}}};
  CHECK(check_mesh(together(moved(pyramid, {0, 0, 2}), pyramid)).fit_for_solver());
  TriangleMesh apex_first = pyramid;  // so that the ray starts there: apex over apex, a diagonal over both
  std::rotate(apex_first.triangles[0].begin(), apex_first.triangles[0].begin() + 2, apex_first.triangles[0].end());
  std::swap(apex_first.triangles[0], apex_first.triangles[5]);
  std::rotate(apex_first.triangles[0].begin(), apex_first.triangles[0].begin() + 2, apex_first.triangles[0].end());
  REQUIRE(apex_first.triangles[0][0] == 4);
  CHECK(check_mesh(together(moved(apex_first, {0, 0, 2}), apex_first)).fit_for_solver());
}

TEST_CASE("triangles that cannot be judged belong to no component") {
  TriangleMesh mesh = together(cube(1), moved(cube(2), {9, 0, 0}));
  mesh.triangles.insert(mesh.triangles.begin(), Triangle{0, 0, 1});
  const MeshCheck check = check_mesh(mesh);
  REQUIRE(check.component_of.size() == mesh.triangles.size());
  CHECK(check.component_of[0] == kNoComponent);
  CHECK(check.component_of[1] == 1);  // the smaller of the two
  CHECK(check.component_of.back() == 0);
}

TEST_CASE("the components around a point") {
  const TriangleMesh mesh = together(together(cube(4), turned(cube(2))), moved(cube(1), {20, 0, 0}));
  std::vector<std::uint32_t> component_of(mesh.triangles.size());
  for (std::size_t t = 0; t < component_of.size(); ++t) component_of[t] = static_cast<std::uint32_t>(t / 12);
  const TriangleTree tree(mesh);
  const auto around = [&](const Point& p, std::vector<bool> is_closed) {
    return find_components_around(p, mesh, component_of, is_closed, tree);
  };
  using List = std::vector<std::uint32_t>;
  CHECK(around({0, 0, 0}, {true, true, true}) == List{0, 1});
  CHECK(around({3, 3, 3}, {true, true, true}) == List{0});
  CHECK(around({20, 0, 0.5}, {true, true, true}) == List{2});
  CHECK(around({0, 0, -5}, {true, true, true}).empty());  // through two walls of each, and their diagonals
  CHECK(around({0, 0, 0}, {false, true, true}) == List{1});
}

TEST_CASE("depth of cubes placed at random in and round a sphere") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  std::uniform_int_distribution<int> step(-5, 5);
  TriangleMesh mesh = icosphere(3, 16);
  std::vector<Point> centres;
  std::vector<std::size_t> depths;
  for (int i = 0; i < 60; ++i) {  // each smaller than those before, so that those of one centre nest
    const Point centre{4.0 * step(engine), 4.0 * step(engine), 4.0 * step(engine)};
    const double distance = std::hypot(centre[0], centre[1], centre[2]);
    if (std::abs(distance - 16) < 1.5) continue;
    const auto around = static_cast<std::size_t>(std::count(centres.begin(), centres.end(), centre));
    depths.push_back(around + (distance < 16));
    centres.push_back(centre);
    mesh = together(mesh, moved(cube(0.7 - 0.01 * i), centre));
  }
  const MeshCheck check = check_mesh(mesh);
  CHECK(check.intersecting_pairs == 0);
  REQUIRE(check.components.size() == depths.size() + 1);
  CHECK(check.components[0].depth == 0);
  for (std::size_t i = 0; i < depths.size(); ++i) CHECK(check.components[i + 1].depth == depths[i]);
}

TEST_CASE("the sign of a volume that rounding could hide is settled exactly") {
  TriangleMesh flat = tetrahedron();
  for (Point& p : flat.vertices) p = {1e6 + p[0], 1e6 + p[1] / 3, 1 + p[2] * 0x1p-52};
  const auto sign = [](const TriangleMesh& mesh) {
    return measure_components(mesh, find_edge_topology(mesh, VertexStars(mesh)), TriangleTree(mesh)).at(0).volume_sign;
  };
  CHECK(sign(flat) == 1);
  CHECK(sign(turned(flat)) == -1);
  for (Point& p : flat.vertices) p[2] = 1;
  CHECK(sign(flat) == 0);
}
