// Flips, splits and collapses keep a closed mesh closed, and are refused where they would not.
#include "improve/half_edge_mesh.h"

#include <random>
#include <set>

#include "catch2.h"

using namespace gaussmesh;

namespace {

using Index = HalfEdgeMesh::Index;

const std::vector<Triangle> kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
const std::vector<Triangle> kOctahedron{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

/// Every half-edge has a twin that runs the other way, no edge is there twice, and V - E + F is as it was.
void require_closed(const HalfEdgeMesh& m, long chi) {
  std::set<std::pair<Index, Index>> edges;
  long triangles = 0;
  std::set<Index> vertices;
  for (Index t = 0; t < m.triangles(); ++t) {
    if (!m.has_triangle(t)) continue;
    ++triangles;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      REQUIRE(m.twin(h) != HalfEdgeMesh::kNone);
      REQUIRE(m.twin(m.twin(h)) == h);
      REQUIRE(m.from(m.twin(h)) == m.to(h));
      REQUIRE(m.to(m.twin(h)) == m.from(h));
      REQUIRE(edges.insert({m.from(h), m.to(h)}).second);
      vertices.insert(m.from(h));
    }
  }
  REQUIRE(static_cast<long>(vertices.size()) - triangles / 2 == chi);
  for (const Index v : vertices) {
    REQUIRE(m.has_vertex(v));
    std::size_t around = 0;
    for (const auto& e : edges) around += e.first == v;
    REQUIRE(static_cast<std::size_t>(m.valence(v)) == around);
  }
}

}  // namespace

TEST_CASE("a flip turns the edge, and back again") {
  HalfEdgeMesh m(kOctahedron, 6);
  require_closed(m, 2);
  const Index u = m.from(0), v = m.to(0), p = m.opposite(0), q = m.opposite(m.twin(0));
  REQUIRE(m.can_flip(0));
  m.flip(0);
  require_closed(m, 2);
  CHECK_FALSE(m.are_neighbours(u, v));
  CHECK(m.are_neighbours(p, q));
}

TEST_CASE("a tetrahedron has no edge to flip or to collapse") {
  const HalfEdgeMesh m(kTetrahedron, 4);
  for (Index h = 0; h < m.half_edges(); ++h) {
    CHECK_FALSE(m.can_flip(h));
    CHECK_FALSE(m.can_collapse(h));
  }
}

TEST_CASE("an edge whose ends have a third neighbour in common is not collapsed") {
  // A triangle of edges 0-1-2 round the waist of a double pyramid with apexes 3 and 4: no waist edge may go, since
  // the third corner of the waist is a neighbour of both ends without a triangle there.
  const HalfEdgeMesh m(std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}}, 5);
  for (Index h = 0; h < m.half_edges(); ++h) {
    if (m.from(h) < 3 && m.to(h) < 3) CHECK_FALSE(m.can_collapse(h));
  }
}

TEST_CASE("what was split can be collapsed again") {
  HalfEdgeMesh m(kOctahedron, 6);
  const Index middle = m.split(0);
  CHECK(middle == 6);
  require_closed(m, 2);
  CHECK(m.valence(middle) == 4);
  Index out = HalfEdgeMesh::kNone;
  m.visit_star(middle, [&](Index h) {
    if (m.can_collapse(h)) out = h;
  });
  REQUIRE(out != HalfEdgeMesh::kNone);
  m.collapse(out);
  require_closed(m, 2);
  CHECK_FALSE(m.has_vertex(middle));
}

TEST_CASE("ten thousand operations at random leave a closed sphere") {
  HalfEdgeMesh m(kOctahedron, 6);
  std::mt19937 random(7);
  int flips = 0, splits = 0, collapses = 0;
  for (int i = 0; i < 10000; ++i) {
    const Index h = static_cast<Index>(random() % m.half_edges());
    if (!m.has_triangle(h / 3)) continue;
    switch (random() % 5) {
      case 0:
        if (m.vertices() < 2000) m.split(h), ++splits;
        break;
      case 1:
        if (m.can_collapse(h)) m.collapse(h), ++collapses;
        break;
      default:
        if (m.can_flip(h)) m.flip(h), ++flips;
    }
  }
  require_closed(m, 2);
  CHECK(flips > 1000);
  CHECK(splits > 300);
  CHECK(collapses > 300);
}

TEST_CASE("at a boundary nothing is changed that is not all there") {
  // A hexagon round vertex 0: only 0 is inner.
  HalfEdgeMesh m(std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}}, 7);
  CHECK(m.is_inner(0));
  for (Index v = 1; v < 7; ++v) CHECK_FALSE(m.is_inner(v));
  for (Index h = 0; h < m.half_edges(); ++h) {
    if (m.twin(h) == HalfEdgeMesh::kNone) continue;
    CHECK_FALSE(m.can_flip(h));
    CHECK_FALSE(m.can_collapse(h));
  }
  const Index middle = m.split(0);  // the edge from 0 to 1
  CHECK(m.is_inner(middle));
  CHECK(m.valence(middle) == 4);
  CHECK(m.valence(0) == 6);
}
