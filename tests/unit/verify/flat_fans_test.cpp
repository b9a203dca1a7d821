#include "verify/flat_fans.h"

#include <cmath>
#include <numbers>

#include "catch2.h"
#include "verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::verify;

namespace {

/// A closed fan round vertex 0: `count` triangles that go `rounds` times round it, the rim at the heights `lift`
/// gives.
template <class Lift>
TriangleMesh fan(std::uint32_t count, int rounds, const Lift& lift) {
  TriangleMesh mesh{{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * rounds * (i + 0.1) / count;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), lift(i)});
    mesh.triangles.push_back({0, i + 1, (i + 1) % count + 1});
  }
  return mesh;
}

FanFacts facts_of(const TriangleMesh& mesh) {
  const VertexStars stars(mesh);
  return find_flat_fans(mesh, stars, find_edge_topology(mesh, stars));
}

/// The same seen from elsewhere: x, y, z become y, z, x.
TriangleMesh rotated(TriangleMesh mesh) {
  for (Point& p : mesh.vertices) p = {p[2], p[0], p[1]};
  return mesh;
}

}  // namespace

TEST_CASE("a fan that lies side by side is flat, whichever way it turns and looks") {
  TriangleMesh mesh = fan(7, 1, [](std::uint32_t i) { return i % 2 == 0 ? 0.3 : -0.4; });
  for (int axis = 0; axis < 3; ++axis, mesh = rotated(mesh)) {
    CHECK(facts_of(mesh).is_flat[0] == 1);
    CHECK(facts_of(shapes::turned(mesh)).is_flat[0] == 1);
  }
  CHECK(facts_of(mesh).is_flat[1] == 0);  // on the rim: not closed
}

TEST_CASE("a fan that goes round twice is not flat") {
  const auto helix = [](std::uint32_t i) { return i < 7 ? 0.1 * i : 0.1 * (13 - i); };
  TriangleMesh mesh = fan(13, 2, helix);
  for (int axis = 0; axis < 3; ++axis, mesh = rotated(mesh)) CHECK(facts_of(mesh).is_flat[0] == 0);
}

TEST_CASE("a fan with a triangle folded over another is not flat") {
  TriangleMesh mesh = fan(6, 1, [](std::uint32_t) { return 0.0; });
  mesh.vertices[2] = {0.9 * mesh.vertices[4][0], 0.9 * mesh.vertices[4][1], 0.0};
  CHECK(facts_of(mesh).is_flat[0] == 0);
}

TEST_CASE("a triangle of zero area turns no way, and its fans are not flat") {
  TriangleMesh mesh = fan(6, 1, [](std::uint32_t) { return 0.0; });
  mesh.vertices[2] = {2 * mesh.vertices[1][0], 2 * mesh.vertices[1][1], 0.0};
  const FanFacts facts = facts_of(mesh);
  CHECK(facts.turns[0] == 0);
  CHECK(facts.turns[3] != 0);
  CHECK(facts.is_flat[0] == 0);
}

TEST_CASE("the turns are those seen along each axis") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 1}, {0, 2, 3}, {0, 3, 1}}};
  const FanFacts facts = facts_of(mesh);
  CHECK(int{facts.turns[0]} == 0b000100);
  CHECK(int{facts.turns[1]} == 0b100000);
  CHECK(int{facts.turns[2]} == 0b000001);
  CHECK(int{facts.turns[3]} == 0b000010);
}
