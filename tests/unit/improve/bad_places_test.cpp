// Bad triangles are found wherever they are, and boxes round them do not meet.
#include "improve/bad_places.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "catch2.h"
#include "gaussmesh/check_mesh.h"
#include "improve/size_field.h"
#include "support/meshing.h"
#include "support/whole_mesh.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// find_bad_vertices() by looking at every pair of triangles with a common edge.
std::vector<std::uint32_t> bad_vertices_by_pairs(const WholeMesh& mesh) {
  std::set<std::uint32_t> bad;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> side;
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    const Triangle& t = mesh.triangles[n];
    const double sine = triangle_quality(mesh, t[0], t[1], t[2]).min_sine;
    if (sine < std::sin(kLeastAngleDeg / 180.0 * std::numbers::pi)) bad.insert(t.begin(), t.end());
    for (int i = 0; i < 3; ++i) side[{t[i], t[(i + 1) % 3]}] = n;
  }
  for (const auto& [ends, n] : side) {
    const Triangle &s = mesh.triangles[n], &t = mesh.triangles[side.at({ends[1], ends[0]})];
    if (!turn_sharply(area_normal(mesh, s), area_normal(mesh, t))) continue;
    bad.insert(s.begin(), s.end());
    bad.insert(t.begin(), t.end());
  }
  return {bad.begin(), bad.end()};
}

}  // namespace

TEST_CASE("an improved mesh has no bad places, and one as traced has those that pairs of triangles show") {
  MeshOptions wish = options(0.6, 1.7, 0.8);
  const auto atoms = atom_ring(8, 3.0, 1.5);
  wish.improve = true;
  CHECK(find_bad_vertices(whole_mesh(mesh_surface(atoms, wish), 0.8f), 1).empty());
  wish.improve = false;
  const WholeMesh raw = whole_mesh(mesh_surface(atoms, wish), 0.8f);
  const std::vector<std::uint32_t> bad = find_bad_vertices(raw, 2);
  CHECK(bad.size() > 100);
  CHECK(bad == bad_vertices_by_pairs(raw));

  std::set<std::uint32_t> thin;
  for (const Triangle& t : raw.triangles) {
    if (triangle_quality(raw, t[0], t[1], t[2]).min_sine < 0.5) thin.insert(t.begin(), t.end());
  }
  CHECK(find_thin_vertices(raw, 2) == std::vector<std::uint32_t>(thin.begin(), thin.end()));
  CHECK(thin.size() > 100);
}

TEST_CASE("a block has the bad places of the whole mesh, each once") {
  const WholeMesh raw = whole_mesh(mesh_surface(atom_ring(8, 3.0, 1.5), options(0.6, 1.7, 0.8)), 0.8f);
  const MeshBlocks blocks(raw, std::vector<Box>{{{-100, -100, -100}, {100, 100, 100}}}, 1);
  const BlockMesh block = blocks.extract(0);
  std::vector<Vec3> places, all;
  for (const std::uint32_t v : find_bad_vertices(block, corners_at_sharp_edges(block))) places.push_back(block.at[v]);
  for (const std::uint32_t v : find_bad_vertices(raw, 1)) all.push_back(raw.at[v]);
  std::sort(places.begin(), places.end());
  std::sort(all.begin(), all.end());
  CHECK(places == all);
}

TEST_CASE("sharp edges between well-shaped triangles are bad places") {
  // A regular octahedron: its sides turn by 70.5 degrees at each edge.
  WholeMesh mesh;
  mesh.at = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3& p : mesh.at) mesh.normal.push_back({float(p[0]), float(p[1]), float(p[2])});
  mesh.size.assign(6, 1.0f);
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  CHECK(find_bad_vertices(mesh, 1).size() == 6);
  mesh.triangles.resize(2);  // one of its edges alone
  CHECK(find_bad_vertices(mesh, 1).size() == 4);
  mesh.at[1] = {-0.6, 1, 0};
  mesh.at[2] = {-1, 0, 0.6};  // now they turn by 50 degrees
  CHECK(find_bad_vertices(mesh, 1).empty());
}

TEST_CASE("boxes round bad vertices have no common points, and none is far from all of them") {
  const WholeMesh mesh = whole_mesh(mesh_surface(atom_ring(8, 3.0, 1.5), options(0.6, 1.7, 0.8)), 0.8f);
  const std::vector<std::uint32_t> bad = find_bad_vertices(mesh, 1);
  const double sizes_around = 4.0, most = 1.0;
  const auto size_of = [](std::uint32_t v) { return v % 2 == 0 ? 0.1 : 0.5; };
  std::vector<BadPlace> places;
  for (const std::uint32_t v : bad) places.push_back({mesh.at[v], size_of(v)});
  const BoxSize size{sizes_around, most};
  std::vector<Box> boxes;
  for (const BadPlace& place : take_apart(places, size)) boxes.push_back(box_round(place, size));
  for (const BadPlace& place : places) {
    CHECK(std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) { return is_in(box, place.at); }));
  }
  REQUIRE(boxes.size() > 3);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(boxes_meet(boxes[i], boxes[j]));
  }
  for (const std::uint32_t v : bad) {
    const Box around = widened({mesh.at[v], mesh.at[v]}, std::min(sizes_around * size_of(v), most));
    CHECK(std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return boxes_meet(around, box); }));
  }
}
