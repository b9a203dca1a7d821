#include "gaussmesh/check_mesh.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "catch2.h"
#include "support/threads.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using shapes::cube;
using shapes::icosphere;
using shapes::moved;
using shapes::tetrahedron;
using shapes::together;
using shapes::torus;
using shapes::turned;

namespace {

/// What is wrong with a mesh, by the names in MeshCheck; all that is not named must be 0.
struct Wrong {
  std::size_t bad_indices = 0, bad_coordinates = 0, boundary_edges = 0, nonmanifold_edges = 0, misoriented_edges = 0,
              nonmanifold_vertices = 0, isolated_vertices = 0, duplicate_vertices = 0, degenerate_triangles = 0,
              intersecting_pairs = 0, inverted_components = 0;
};

void check_defects(const MeshCheck& check, const Wrong& wrong) {
  CHECK(check.bad_indices == wrong.bad_indices);
  CHECK(check.bad_coordinates == wrong.bad_coordinates);
  CHECK(check.boundary_edges == wrong.boundary_edges);
  CHECK(check.nonmanifold_edges == wrong.nonmanifold_edges);
  CHECK(check.misoriented_edges == wrong.misoriented_edges);
  CHECK(check.nonmanifold_vertices == wrong.nonmanifold_vertices);
  CHECK(check.isolated_vertices == wrong.isolated_vertices);
  CHECK(check.duplicate_vertices == wrong.duplicate_vertices);
  CHECK(check.degenerate_triangles == wrong.degenerate_triangles);
  CHECK(check.intersecting_pairs == wrong.intersecting_pairs);
  CHECK(check.inverted_components == wrong.inverted_components);
  CHECK_FALSE(check.fit_for_solver());
}

/// Vertex numbers of `mesh` changed so that `from` is `to`; vertex `from` stays, unused.
TriangleMesh welded(TriangleMesh mesh, std::uint32_t from, std::uint32_t to) {
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), from, to);
  return mesh;
}

/// Two strips that share an edge: x from 0 to 1, and from 1 to `end`, at the height `lift` there.
TriangleMesh two_strips(double end, double lift) {
  return {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {end, 0, lift}, {end, 1, lift}},
          {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}}};
}

}  // namespace

TEST_CASE("a tetrahedron") {
  const MeshCheck check = check_mesh(tetrahedron());
  CHECK(check.fit_for_solver());
  CHECK(check.vertices == 4);
  CHECK(check.triangles == 4);
  REQUIRE(check.components.size() == 1);
  CHECK(check.components[0].closed);
  CHECK(check.components[0].genus == 0);
  CHECK(check.chi == 2);
  CHECK(check.volume == Approx(1.0 / 6));
  CHECK(check.area == Approx(1.5 + std::sqrt(3.0) / 2));
}

TEST_CASE("a sphere: area and volume tend to the formula, shape is known") {
  const double radius = 3;
  const MeshCheck check = check_mesh(moved(icosphere(5, radius), {1e5, -2e5, 3e5}));
  CHECK(check.fit_for_solver());
  CHECK(check.chi == 2);
  CHECK(check.area == Approx(4 * std::numbers::pi * radius * radius).epsilon(2e-3));
  CHECK(check.volume == Approx(4 * std::numbers::pi / 3 * std::pow(radius, 3)).epsilon(2e-3));
  const MeshCheck here = check_mesh(icosphere(5, radius));
  CHECK(check.volume == Approx(here.volume).epsilon(1e-10));  // from an origin far away it would be good to 1e-4
}

TEST_CASE("a torus has a handle") {
  const MeshCheck check = check_mesh(torus(40, 16, 5, 2));
  CHECK(check.fit_for_solver());
  CHECK(check.chi == 0);
  REQUIRE(check.components.size() == 1);
  CHECK(check.components[0].genus == 1);
  CHECK(check.components[0].vertices == 640);
}

TEST_CASE("shape of an equilateral and of a right triangle") {
  const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}, {10, 0, 0}, {13, 0, 0}, {10, 4, 0}},
                          {{0, 1, 2}, {3, 4, 5}}};
  const MeshCheck check = check_mesh(mesh);
  CHECK(check.min_angle_deg == Approx(36.86989765));
  CHECK(check.max_angle_deg == Approx(90.0));
  CHECK(check.mean_min_angle_deg == Approx((60.0 + 36.86989765) / 2));
  CHECK(check.mean_edge_ratio == Approx((1.0 + 0.6) / 2));
  CHECK(check.min_edge == Approx(2.0));
  CHECK(check.max_edge == Approx(5.0));
  CHECK(check.mean_edge == Approx(3.0));
  CHECK(check.fraction_under_30_deg == 0.0);
  CHECK(std::accumulate(check.ratio_histogram.begin(), check.ratio_histogram.end(), std::size_t{0}) == 2);
  CHECK(check.ratio_histogram[12] + check.ratio_histogram[11] == 1);  // 0.6 is on the edge between two bins
  CHECK(std::accumulate(check.angle_histogram.begin(), check.angle_histogram.end(), std::size_t{0}) == 6);
  CHECK(check.angle_histogram[3] == 1);
  CHECK(check.angle_histogram[5] + check.angle_histogram[6] == 4);
}

TEST_CASE("needles: their angles are good to the last digits") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}}, {{0, 1, 2}}};
  const MeshCheck check = check_mesh(mesh);
  CHECK(check.min_angle_deg == Approx(2e-9 * 180 / std::numbers::pi).epsilon(1e-12));
  CHECK(check.max_angle_deg == Approx(180 - 4e-9 * 180 / std::numbers::pi).epsilon(1e-14));
  CHECK(check.fraction_under_30_deg == 1.0);
}

TEST_CASE("the shape of a triangle that is one point") {
  const MeshCheck check = check_mesh({{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}});
  CHECK(check.min_angle_deg == 0.0);
  CHECK(check.max_angle_deg == 180.0);
  CHECK(check.mean_edge_ratio == 0.0);
  CHECK(check.degenerate_triangles == 1);
}

TEST_CASE("an empty mesh is not fit") {
  CHECK_FALSE(check_mesh({}).fit_for_solver());
  check_defects(check_mesh({{{0, 0, 0}}, {}}), {.isolated_vertices = 1});
}

TEST_CASE("holes and turned faces") {
  TriangleMesh open = tetrahedron();
  open.triangles.pop_back();
  check_defects(check_mesh(open), {.boundary_edges = 3, .nonmanifold_vertices = 3});
  CHECK_FALSE(check_mesh(open).components[0].closed);
  CHECK(check_mesh(open).chi == 1);

  TriangleMesh one_turned = tetrahedron();
  std::swap(one_turned.triangles[2][0], one_turned.triangles[2][1]);
  check_defects(check_mesh(one_turned), {.misoriented_edges = 3});

  check_defects(check_mesh(turned(tetrahedron())), {.inverted_components = 1});
  CHECK(check_mesh(turned(tetrahedron())).volume == Approx(-1.0 / 6));
}

TEST_CASE("bad vertex numbers are counted and left out") {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.push_back({0, 1, 4});
  mesh.triangles.push_back({4000000000u, 1, 2});
  mesh.triangles.insert(mesh.triangles.end(), {Triangle{1, 1, 2}, {1, 2, 2}, {2, 1, 2}});
  check_defects(check_mesh(mesh), {.bad_indices = 2, .degenerate_triangles = 3});
  CHECK(check_mesh(mesh).triangles == 9);
  CHECK(check_mesh(mesh).chi == 2);
}

TEST_CASE("examples of intersections keep their numbers where triangles are left out") {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 9});
  mesh.vertices.push_back({0.1, 0.1, -1});
  mesh.vertices.push_back({0.1, 0.1, 0.1});
  mesh.vertices.push_back({0.2, 0.1, -1});
  mesh.triangles.push_back({4, 5, 6});
  const MeshCheck check = check_mesh(mesh);
  REQUIRE(check.intersecting_examples.size() == 1);
  CHECK(check.intersecting_examples[0] == std::array<std::uint32_t, 2>{1, 5});
}

TEST_CASE("coordinates that bar exact signs are counted, with the holes they leave") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e80,
                           std::numeric_limits<double>::denorm_min()}) {
    TriangleMesh mesh = tetrahedron();
    mesh.vertices[3][1] = bad;
    check_defects(check_mesh(mesh),
                  {.bad_coordinates = 1, .boundary_edges = 3, .nonmanifold_vertices = 3, .isolated_vertices = 1});
  }
}

TEST_CASE("vertices in no triangle, vertices in one place") {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.push_back({5, 5, 5});
  mesh.vertices.push_back({5, 5, 5});
  mesh.vertices.push_back({0, -0.0, 0});
  check_defects(check_mesh(mesh), {.isolated_vertices = 3, .duplicate_vertices = 2});
}

TEST_CASE("triangles of exactly zero area") {
  TriangleMesh mesh = tetrahedron();  // its edge 1-2 is cut at a third, and the cut is a triangle
  mesh.vertices.push_back({0.75, 0.25, 0});
  mesh.triangles[2] = {1, 4, 3};
  mesh.triangles.push_back({4, 2, 3});
  mesh.triangles.push_back({1, 2, 4});
  // The two parts of the cut side meet the face across the edge along it, with no vertex there in common.
  check_defects(check_mesh(mesh), {.degenerate_triangles = 1, .intersecting_pairs = 2});
  CHECK(check_mesh(mesh).chi == 2);
  mesh.vertices[4] = {0.75, 0.25, 0x1p-60};  // now it has an area, but nothing else changes
  CHECK(check_mesh(mesh).degenerate_triangles == 0);
}

TEST_CASE("two spheres that touch") {
  const TriangleMesh one = cube(1);
  SECTION("in one vertex that they share") {
    const TriangleMesh other = moved(cube(1), {2, 2, 2});
    check_defects(check_mesh(welded(together(one, other), 8, 7)),
                  {.nonmanifold_vertices = 1, .isolated_vertices = 1, .duplicate_vertices = 1});
    CHECK(check_mesh(welded(together(one, other), 8, 7)).components.size() == 2);
    CHECK(check_mesh(welded(together(one, other), 8, 7)).chi == 4);
  }
  SECTION("in one place, with a vertex each") {
    const MeshCheck check = check_mesh(together(one, moved(cube(1), {2, 2, 2})));
    CHECK(check.duplicate_vertices == 1);
    CHECK(check.intersecting_pairs >= 9);
    CHECK(check.nonmanifold_vertices == 0);
  }
  SECTION("with a vertex on a face") {
    const TriangleMesh on_tip{{{0, 0, 1}, {1, 0, 2}, {0, 1, 2}, {-1, -1, 2}}, tetrahedron().triangles};
    CHECK(check_mesh(together(one, moved(on_tip, {0.25, 0.5, 0}))).intersecting_pairs == 3);
    CHECK(check_mesh(together(one, on_tip)).intersecting_pairs == 6);  // on the diagonal of the upper side
    CHECK(check_mesh(together(one, moved(on_tip, {0, 0, 0x1p-50}))).intersecting_pairs == 0);
  }
  SECTION("in an edge that they share") {
    TriangleMesh both = welded(welded(together(one, moved(cube(1), {2, 2, 0})), 8, 3), 12, 7);
    const MeshCheck check = check_mesh(both);
    CHECK(check.nonmanifold_edges == 1);
    CHECK(check.nonmanifold_vertices == 2);
    CHECK(check.intersecting_pairs == 0);
    CHECK(check.components.size() == 1);
    CHECK_FALSE(check.components[0].closed);
    CHECK(check.chi == 14 - 35 + 24);
  }
  SECTION("in a face") {
    CHECK(check_mesh(together(one, moved(cube(1), {2, 0.5, 0.5}))).intersecting_pairs > 0);
    CHECK(check_mesh(together(one, moved(cube(1), {2, 0, 0}))).intersecting_pairs > 0);
  }
}

TEST_CASE("overlapping spheres, and the same sphere twice") {
  const TriangleMesh ball = icosphere(2, 1);
  CHECK(check_mesh(together(ball, moved(ball, {1, 0, 0}))).intersecting_pairs > 10);
  const MeshCheck twice = check_mesh(together(ball, ball));
  CHECK(twice.intersecting_pairs >= ball.triangles.size());
  CHECK(twice.duplicate_vertices == ball.vertices.size());
  TriangleMesh repeated = ball;
  repeated.triangles.insert(repeated.triangles.end(), ball.triangles.begin(), ball.triangles.end());
  CHECK(check_mesh(repeated).intersecting_pairs == ball.triangles.size());
  CHECK(check_mesh(repeated).nonmanifold_edges == ball.triangles.size() * 3 / 2);
}

TEST_CASE("neighbours folded over each other") {
  CHECK(check_mesh(two_strips(2, 0)).intersecting_pairs == 0);
  CHECK(check_mesh(two_strips(0.25, 0)).intersecting_pairs == 4);
  CHECK(check_mesh(two_strips(0.25, 0x1p-60)).intersecting_pairs == 0);
}

TEST_CASE("a T-junction is two boundaries that touch") {
  const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 0}, {0, -2, 0}, {2, -2, 0}},
                          {{0, 1, 2}, {0, 4, 3}, {3, 4, 5}, {3, 5, 1}}};
  const MeshCheck check = check_mesh(mesh);
  CHECK(check.boundary_edges == 3 + 3 + 2);
  CHECK(check.intersecting_pairs == 3);  // the triangle above with all that have the vertex on its side
}

TEST_CASE("the order of vertices and triangles does not matter") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const TriangleMesh mesh = together(together(torus(20, 10, 5, 1), icosphere(2, 1)), moved(icosphere(2, 1), {1, 0, 0}));
  std::vector<std::uint32_t> number(mesh.vertices.size());
  std::iota(number.begin(), number.end(), 0u);
  std::shuffle(number.begin(), number.end(), engine);
  TriangleMesh shuffled{mesh.vertices, mesh.triangles};
  for (std::size_t v = 0; v < number.size(); ++v) shuffled.vertices[number[v]] = mesh.vertices[v];
  for (Triangle& t : shuffled.triangles) {
    for (std::uint32_t& v : t) v = number[v];
    std::rotate(t.begin(), t.begin() + engine() % 3, t.end());
  }
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), engine);
  const MeshCheck a = check_mesh(mesh), b = check_mesh(shuffled);
  CHECK(a.intersecting_pairs == b.intersecting_pairs);
  CHECK(a.intersecting_pairs > 0);
  CHECK(a.chi == b.chi);
  CHECK(a.area == Approx(b.area));
  CHECK(a.volume == Approx(b.volume));
  REQUIRE(b.components.size() == 3);
  CHECK(b.components[0].genus == 1);
}

TEST_CASE("a vertex with many triangles round it") {
  TriangleMesh mesh{{{0, 0, 1}, {0, 0, -1}}, {}};
  constexpr std::uint32_t kRim = 1000;
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRim;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % kRim;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  CHECK(check_mesh(mesh).fit_for_solver());
}

TEST_CASE("the check is the same to the last bit for any number of threads") {
  const TriangleMesh mesh = together(torus(200, 100, 5, 1), moved(icosphere(4, 1), {5, 0, 0}));
  const auto alone = testing::on_threads(1, [&] { return check_mesh(mesh); });
  const auto shared = testing::on_threads(3, [&] { return check_mesh(mesh); });
  CHECK(alone.intersecting_pairs == shared.intersecting_pairs);
  CHECK(alone.intersecting_examples == shared.intersecting_examples);
  CHECK(alone.area == shared.area);
  CHECK(alone.volume == shared.volume);
  CHECK(alone.mean_min_angle_deg == shared.mean_min_angle_deg);
  CHECK(alone.mean_edge == shared.mean_edge);
  CHECK(alone.ratio_histogram == shared.ratio_histogram);
}
