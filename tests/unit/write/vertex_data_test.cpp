#include "gaussmesh/vertex_data.h"

#include "catch2.h"
#include "gaussmesh/error.h"
#include "support/random.h"
#include "unit/verify/shapes.h"

using namespace gaussmesh;

TEST_CASE("nearest atoms are those of the largest share of phi, by comparison with all") {
  const std::uint64_t seed = 11;
  CAPTURE(seed);
  testing::Random random(seed);
  const auto number = [&](double size) { return size * 1e-6 * static_cast<double>(random.integer(-1000000, 1000000)); };
  std::vector<Atom> atoms;
  for (int i = 0; i < 300; ++i) atoms.push_back({number(20), number(20), number(20), std::abs(number(3)), 0.0});
  TriangleMesh mesh;
  for (int i = 0; i < 3000; ++i) mesh.vertices.push_back({number(30), number(30), number(30)});
  const std::vector<std::uint32_t> nearest = find_nearest_atoms(mesh, atoms, 2);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto power = [&](const Atom& a) {
      const Point& p = mesh.vertices[v];
      return (p[0] - a.x) * (p[0] - a.x) + (p[1] - a.y) * (p[1] - a.y) + (p[2] - a.z) * (p[2] - a.z) -
             a.radius * a.radius;
    };
    double least = power(atoms[0]);
    for (const Atom& a : atoms) least = std::min(least, power(a));
    REQUIRE(power(atoms[nearest[v]]) == Approx(least).margin(1e-9));
  }
}

TEST_CASE("nothing is nearest where there are no atoms: that is said") {
  CHECK_THROWS_AS(find_nearest_atoms(shapes::cube(1), {}, 1), OptionError);
}

TEST_CASE("vertices are of the component of their triangles") {
  TriangleMesh mesh = shapes::together(shapes::cube(1), shapes::moved(shapes::cube(2), {9, 0, 0}));
  mesh.vertices.push_back({50, 0, 0});
  const std::vector<std::uint32_t> components = find_vertex_components(mesh, check_mesh(mesh));
  for (std::size_t v = 0; v + 1 < mesh.vertices.size(); ++v) CHECK(components[v] == (mesh.vertices[v][0] < 5 ? 1 : 0));
  CHECK(components.back() == kNoComponent);
}

TEST_CASE("averaged normals point outwards and have length 1") {
  const TriangleMesh sphere = shapes::icosphere(3, 2.0);
  const std::vector<Normal> normals = average_normals(sphere);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Point& p = sphere.vertices[v];
    const double size = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int k = 0; k < 3; ++k) CHECK(normals[v][k] == Approx(p[k] / size).margin(0.03));
  }
}
