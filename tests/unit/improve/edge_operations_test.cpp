// Each veto behind "keeps topology, side and embedding", on the smallest mesh that needs it.
#include "improve/edge_operations.h"

#include <algorithm>
#include <cmath>

#include "catch2.h"
#include "support/block_mesh.h"

using namespace gaussmesh;
using gaussmesh::testing::triangles_of;

namespace {

using Index = HalfEdgeMesh::Index;

constexpr int kSide = 7;  // vertices
constexpr Normal kUp{0, 0, 1}, kDown{0, 0, -1};

Index vertex(int i, int j) { return static_cast<Index>(i * kSide + j); }

/// The triangles of a square of unit cells, cut from corner (i, j) to corner (i + 1, j + 1); counter-clockwise seen
/// from above, or from below. Vertices are numbered from `first`.
std::vector<Triangle> square_triangles(Index first, bool from_above) {
  std::vector<Triangle> triangles;
  for (int i = 0; i + 1 < kSide; ++i) {
    for (int j = 0; j + 1 < kSide; ++j) {
      const Index a = first + vertex(i, j), b = first + vertex(i + 1, j), c = first + vertex(i + 1, j + 1),
                  d = first + vertex(i, j + 1);
      for (const Triangle& t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
        triangles.push_back(from_above ? t : Triangle{t[0], t[2], t[1]});
      }
    }
  }
  return triangles;
}

void add_vertex(BlockMesh& mesh, const Vec3& at, const Normal& normal) {
  mesh.at.push_back(at);
  mesh.normal.push_back(normal);
  mesh.size.push_back(1.0f);
  mesh.curvature.push_back(0.0f);
  mesh.refinement.push_back(1.0f);
  mesh.is_active.push_back(1);
  mesh.is_guarded.push_back(0);
}

/// With some unevenness, where exact signs are asked for: they err on the side of contact where triangles are coplanar.
void add_square(BlockMesh& mesh, double z, const Normal& normal, double uneven = 0.0) {
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      add_vertex(mesh, {double(i), double(j), z + uneven * std::sin(1.3 * i + 2.7 * j)}, normal);
    }
  }
}

constexpr double kLow = -1.5, kHigh = kSide + 0.5;
const Box kBox{{kLow, kLow, kLow}, {kHigh, kHigh, kHigh}};

BlockMesh flat_square() {
  BlockMesh mesh{{}, HalfEdgeMesh(square_triangles(0, true), kSide * kSide), {}, {}, {}, kBox};
  add_square(mesh, 0.0, kUp);
  return mesh;
}

/// A slab 0.3 A thick: its upper side, and below it the lower one, in the block or reaching into it from outside.
BlockMesh slab(bool is_lower_in_block) {
  std::vector<Triangle> triangles = square_triangles(0, true);
  const std::vector<Triangle> lower = square_triangles(kSide * kSide, false);
  if (is_lower_in_block) triangles.insert(triangles.end(), lower.begin(), lower.end());
  BlockMesh mesh{{}, HalfEdgeMesh(triangles, 2 * kSide * kSide), {}, {}, {}, kBox};
  if (!is_lower_in_block) mesh.fixed = lower;
  add_square(mesh, 0.3, kUp, 0.01);
  add_square(mesh, 0.0, kDown, 0.01);
  return mesh;
}

BlockMesh tetrahedron() {
  BlockMesh mesh{{},  HalfEdgeMesh(std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4), {}, {}, {},
                 kBox};
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.9, 0}, {0.5, 0.3, 0.8}};
  const Vec3 middle{0.5, 0.3, 0.2};
  for (const Vec3& p : corners) {
    const Vec3 n = (1.0 / length(p - middle)) * (p - middle);
    add_vertex(mesh, p, {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
  }
  return mesh;
}

/// The half-edge from u to v, which is there.
Index half_edge(const BlockMesh& mesh, Index u, Index v) {
  for (Index h = 0; h < mesh.connectivity.half_edges(); ++h) {
    if (mesh.connectivity.from(h) == u && mesh.connectivity.to(h) == v) return h;
  }
  FAIL("no edge from " << u << " to " << v);
  return HalfEdgeMesh::kNone;
}

}  // namespace

TEST_CASE("a flip turns an edge, but no triangle over") {
  BlockMesh mesh = flat_square();
  SheetGuard guard(mesh, Guarding::kCloseSheets);
  const Index h = half_edge(mesh, vertex(3, 3), vertex(4, 4));
  CHECK(try_flip(mesh, guard, h));
  half_edge(mesh, vertex(3, 4), vertex(4, 3));  // is there now

  BlockMesh concave = flat_square();
  concave.at[vertex(4, 4)] = {3.3, 3.4, 0.0};  // behind the other diagonal
  const std::vector<Triangle> before = triangles_of(concave);
  CHECK_FALSE(try_flip(concave, guard, half_edge(concave, vertex(3, 3), vertex(4, 4))));
  CHECK(triangles_of(concave) == before);
}

TEST_CASE("what would join two triangles or break a fan is refused") {
  BlockMesh mesh = tetrahedron();
  SheetGuard guard(mesh, Guarding::kCloseSheets);
  const std::vector<Triangle> before = triangles_of(mesh);
  for (Index h = 0; h < mesh.connectivity.half_edges(); ++h) {
    CHECK_FALSE(try_flip(mesh, guard, h));  // the other diagonal is an edge already
    CHECK_FALSE(try_collapse(mesh, guard, h, 10.0));
  }
  CHECK(triangles_of(mesh) == before);
}

TEST_CASE("a collapse makes no edge too long, turns no triangle over, and leaves the boundary alone") {
  BlockMesh mesh = flat_square();
  SheetGuard guard(mesh, Guarding::kCloseSheets);
  const Index h = half_edge(mesh, vertex(3, 3), vertex(4, 4));
  CHECK_FALSE(try_collapse(mesh, guard, h, 1.9));  // from (2, 2), (3, 2) and (2, 3) it is farther
  CHECK_FALSE(try_collapse(mesh, guard, half_edge(mesh, vertex(0, 2), vertex(1, 3)), 10.0));
  CHECK_FALSE(try_collapse(mesh, guard, half_edge(mesh, vertex(1, 3), vertex(0, 2)), 10.0));

  BlockMesh star = flat_square();
  star.at[vertex(3, 4)] = {3.0, 3.3, 0.0};  // hides (2, 3) from (4, 4)
  CHECK_FALSE(try_collapse(star, guard, half_edge(star, vertex(3, 3), vertex(4, 4)), 10.0));

  CHECK(try_collapse(mesh, guard, h, 10.0));
  CHECK_FALSE(mesh.connectivity.has_vertex(vertex(3, 3)));
}

TEST_CASE("a split takes a vertex in the block that turns no triangle far") {
  BlockMesh mesh = flat_square();
  SheetGuard guard(mesh, Guarding::kCloseSheets);
  const Index h = half_edge(mesh, vertex(3, 3), vertex(4, 4));
  CHECK_FALSE(try_split(mesh, guard, h, {{3.5, 3.5, kHigh + 1.0}, kUp}));
  CHECK_FALSE(try_split(mesh, guard, h, {{3.5, 3.5, 5.0}, kUp}));
  CHECK_FALSE(try_split(mesh, guard, h, {{4.5, 2.5, 0.0}, kUp}));  // beyond both triangles
  CHECK(mesh.at.size() == kSide * kSide);
  CHECK(try_split(mesh, guard, h, {{3.5, 3.5, 0.1}, kUp}));
  CHECK(mesh.at.size() == kSide * kSide + 1);
}

TEST_CASE("a move stays in the block, turns no triangle far and keeps the angles") {
  BlockMesh mesh = flat_square();
  SheetGuard guard(mesh, Guarding::kCloseSheets);
  const Index v = vertex(3, 3);
  const Vec3 before = mesh.at[v];
  CHECK_FALSE(try_move(mesh, guard, v, {{3.0, 3.0, kHigh + 1.0}, kUp}, 0.3));
  CHECK_FALSE(try_move(mesh, guard, v, {{3.0, 3.0, 2.0}, kUp}, 0.3));
  CHECK_FALSE(try_move(mesh, guard, v, {{4.2, 3.0, 0.0}, kUp}, 0.3));
  CHECK_FALSE(try_move(mesh, guard, v, {{3.9, 3.0, 0.0}, kUp}, 0.3));  // slivers
  CHECK(mesh.at[v] == before);
  CHECK(try_move(mesh, guard, v, {{3.1, 3.0, 0.05}, kUp}, 0.3));
}

TEST_CASE("sheets stay apart, whether the other one is in the block or reaches into it") {
  for (const bool is_in_block : {true, false}) {
    for (const Guarding guarding : {Guarding::kCloseSheets, Guarding::kEverywhere}) {
      CAPTURE(is_in_block, guarding == Guarding::kEverywhere);
      BlockMesh mesh = slab(is_in_block);
      SheetGuard guard(mesh, guarding);
      const Index v = vertex(3, 3);
      CHECK(mesh.is_guarded[v]);
      CHECK(try_move(mesh, guard, v, {{3.0, 3.0, 0.1}, kUp}, 0.3));
      CHECK_FALSE(try_move(mesh, guard, v, {{3.0, 3.0, -0.1}, kUp}, 0.3));
      CHECK_FALSE(try_split(mesh, guard, half_edge(mesh, vertex(4, 4), vertex(5, 5)), {{4.5, 4.5, -0.05}, kUp}));
      CHECK(try_split(mesh, guard, half_edge(mesh, vertex(4, 4), vertex(5, 5)), {{4.5, 4.5, 0.2}, kUp}));
    }
  }
  // Without a guard the same move goes through: the veto is the guard's alone.
  BlockMesh mesh = slab(true);
  BlockMesh alone = flat_square();
  SheetGuard nothing_near(alone, Guarding::kCloseSheets);
  CHECK(try_move(mesh, nothing_near, vertex(3, 3), {{3.0, 3.0, -0.1}, kUp}, 0.3));
}

TEST_CASE("a sheet that is far, or folds back gently, is not guarded") {
  BlockMesh mesh = flat_square();
  SheetGuard guard(mesh, Guarding::kCloseSheets);
  CHECK(std::count(mesh.is_guarded.begin(), mesh.is_guarded.end(), 1) == 0);
  BlockMesh all = flat_square();
  SheetGuard everywhere(all, Guarding::kEverywhere);
  CHECK(std::count(all.is_guarded.begin(), all.is_guarded.end(), 1) == kSide * kSide);
}
