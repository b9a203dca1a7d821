// Cutting a mesh into blocks loses nothing.
#include "improve/mesh_blocks.h"

#include <map>

#include "catch2.h"
#include "gaussmesh/check_mesh.h"
#include "support/meshing.h"
#include "support/whole_mesh.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

WholeMesh ring_mesh() { return whole_mesh(mesh_surface(atom_ring(8, 3.0, 1.5), options(0.6, 1.7, 0.5)), 0.5f); }

/// Triangles by the places of their corners, the least corner first.
std::map<std::array<Vec3, 3>, int> by_place(const WholeMesh& mesh) {
  std::map<std::array<Vec3, 3>, int> result;
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3, 3> corners{mesh.at[t[0]], mesh.at[t[1]], mesh.at[t[2]]};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    ++result[corners];
  }
  return result;
}

}  // namespace

TEST_CASE("blocks cut out and joined again are the mesh as it was") {
  const WholeMesh mesh = ring_mesh();
  for (const double edge : {1.7, 4.0, 100.0}) {
    CAPTURE(edge);
    MeshBlocks blocks(mesh, edge, {0.3, 0.3, 0.3}, 2);
    CHECK((edge > 50.0 || blocks.size() > 1));
    for (std::size_t b = blocks.size(); b-- > 0;) blocks.store(b, blocks.extract(b));
    const WholeMesh joined = std::move(blocks).join(2);
    CHECK(joined.at.size() == mesh.at.size());
    CHECK(by_place(joined) == by_place(mesh));
  }
}

TEST_CASE("boxes cut out of a mesh and put back leave it as it was, and take what lies in them") {
  const WholeMesh mesh = ring_mesh();
  std::vector<Box> boxes;
  for (const std::size_t v : {std::size_t{0}, mesh.at.size() / 3, 2 * mesh.at.size() / 3}) {
    const Box box = widened({mesh.at[v], mesh.at[v]}, boxes.empty() ? 1.0 : 0.5);
    const auto meets = [&](const Box& other) { return boxes_meet(box, other); };
    if (std::none_of(boxes.begin(), boxes.end(), meets)) boxes.push_back(box);
  }
  REQUIRE(boxes.size() > 1);
  MeshBlocks blocks(mesh, boxes, 2);
  REQUIRE(blocks.size() == boxes.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    BlockMesh block = blocks.extract(b);
    std::size_t inside = 0, reaching = 0;
    for (const Triangle& t : mesh.triangles) {
      int corners = 0;
      for (const std::uint32_t v : t) corners += is_in(boxes[b], mesh.at[v]);
      inside += corners == 3;
      reaching += corners == 1 || corners == 2;
    }
    CHECK(block.connectivity.triangles() == inside);
    CHECK(block.fixed.size() >= reaching);
    CHECK(inside > 10);
    blocks.store(b, std::move(block));
  }
  const WholeMesh joined = std::move(blocks).join(2);
  CHECK(joined.at.size() == mesh.at.size());
  CHECK(by_place(joined) == by_place(mesh));
}

TEST_CASE("a block's triangles lie in its box, and what reaches into the box is there") {
  const WholeMesh mesh = ring_mesh();
  const MeshBlocks blocks(mesh, 2.5, {0.1, 0.2, 0.3}, 1);
  std::size_t inner = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const BlockMesh block = blocks.extract(b);
    inner += block.connectivity.triangles();
    for (std::uint32_t t = 0; t < block.connectivity.triangles(); ++t) {
      for (const std::uint32_t v : block.connectivity.triangle(t)) CHECK(block.contains(block.at[v]));
    }
    for (const Triangle& t : block.fixed) {
      int inside = 0;
      for (const std::uint32_t v : t) inside += block.contains(block.at[v]);
      CHECK(inside < 3);
    }
  }
  CHECK(inner > mesh.triangles.size() / 3);
  CHECK(inner < mesh.triangles.size());
}

TEST_CASE("the order of the work has every block once, and larger ones first") {
  const MeshBlocks blocks(ring_mesh(), 2.5, {0.1, 0.2, 0.3}, 2);
  std::vector<std::uint32_t> order = blocks.largest_first();
  const auto triangles = [&](std::uint32_t b) { return blocks.extract(b).connectivity.triangles(); };
  CHECK(std::is_sorted(order.begin(), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return triangles(a) > triangles(b); }));
  CHECK(triangles(order.front()) > triangles(order.back()));
  std::sort(order.begin(), order.end());
  REQUIRE(order.size() == blocks.size());
  for (std::uint32_t b = 0; b < order.size(); ++b) CHECK(order[b] == b);
}
