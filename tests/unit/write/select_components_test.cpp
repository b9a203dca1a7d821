#include "gaussmesh/select_components.h"

#include <chrono>
#include <limits>

#include "catch2.h"
#include "unit/verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::shapes;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// By falling area: a cube (0), a cavity of 4^3 (1) with a cube in it (2), and one more cavity of 1 (3).
TriangleMesh nest() {
  TriangleMesh mesh = together(cube(5), moved(turned(cube(2)), {2, 0, 0}));
  mesh = together(mesh, moved(cube(1), {2, 0, 0}));
  return together(mesh, moved(turned(cube(0.5)), {-3, 0, 0}));
}

}  // namespace

TEST_CASE("small cavities are left out with what lies in them") {
  const MeshCheck check = check_mesh(nest());
  REQUIRE(check.fit_for_solver());
  CHECK(leave_out_cavities(check, 0.0) == ComponentList{0, 1, 2, 3});
  CHECK(leave_out_cavities(check, 0.999) == ComponentList{0, 1, 2, 3});
  CHECK(leave_out_cavities(check, 1.001) == ComponentList{0, 1, 2});
  CHECK(leave_out_cavities(check, 65.0) == ComponentList{0});
  CHECK(leave_out_cavities(check, kInfinity) == ComponentList{0});
}

TEST_CASE("outsides come before cavities") { CHECK(outsides_first(check_mesh(nest())) == ComponentList{0, 2, 1, 3}); }

TEST_CASE("extracted components are the mesh that they were, with their data") {
  const TriangleMesh mesh = nest();
  const MeshCheck check = check_mesh(mesh);
  VertexData data;
  data.normals = average_normals(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) data.atoms.push_back(v);
  const MeshFile part = extract_components(mesh, data, check, {1, 2});
  CHECK(part.mesh.vertices.size() == 16);
  CHECK(part.mesh.triangles.size() == 24);
  for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) {
    const std::uint32_t was = part.data.atoms[v];
    CHECK(part.mesh.vertices[v] == mesh.vertices[was]);
    CHECK(part.data.normals[v] == data.normals[was]);
    CHECK(part.data.components[v] == (v < 8 ? 0 : 1));
  }
  const MeshCheck of_part = check_mesh(part.mesh);
  CHECK(of_part.volume == Approx(8.0 - 64.0));
  CHECK(of_part.inverted_components == 2);  // inside out, now that nothing is round them
}

TEST_CASE("a mesh split into its components is what extracting each of them gives") {
  const TriangleMesh mesh = nest();
  const MeshCheck check = reorder_components(check_mesh(mesh), {0, 2, 1, 3});
  VertexData data;
  data.normals = average_normals(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) data.atoms.push_back(v);
  data.atom_count = 906;
  std::uint32_t next = 0;
  split_components(mesh, data, check, [&](std::uint32_t component, const MeshFile& part) {
    REQUIRE(component == next++);
    const MeshFile wanted = extract_components(mesh, data, check, {component});
    CHECK(part.mesh.vertices == wanted.mesh.vertices);
    CHECK(part.mesh.triangles == wanted.mesh.triangles);
    CHECK(part.data.normals == wanted.data.normals);
    CHECK(part.data.atoms == wanted.data.atoms);
    CHECK(part.data.components == wanted.data.components);
    CHECK(part.data.atom_count == 906);
  });
  CHECK(next == 4);
}

TEST_CASE("the time to split a mesh does not grow with the square of its components") {
  TriangleMesh mesh;
  constexpr std::uint32_t kComponents = 20000;
  for (std::uint32_t c = 0; c < kComponents; ++c) {
    for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}})
      mesh.vertices.push_back({p[0] + 2.0 * c, p[1], p[2]});
    for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}})
      mesh.triangles.push_back({t[0] + 4 * c, t[1] + 4 * c, t[2] + 4 * c});
  }
  const MeshCheck check = check_mesh(mesh);
  std::size_t triangles = 0;
  const auto begin = std::chrono::steady_clock::now();
  split_components(mesh, {}, check,
                   [&](std::uint32_t, const MeshFile& part) { triangles += part.mesh.triangles.size(); });
  CHECK(triangles == mesh.triangles.size());
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(3));  // 10 ms; one by one it takes 5 s
}
