// Bad triangles are mended, and good ones are left alone.
#include "improve/repair.h"

#include "catch2.h"
#include "improve/bad_places.h"
#include "improve/size_field.h"
#include "support/block_mesh.h"
#include "support/meshing.h"
#include "support/whole_mesh.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

using Index = HalfEdgeMesh::Index;

/// A sphere in good triangles, as one block.
struct Sphere {
  Sphere()
      : field({{0.1, 0.2, 0.3, 2.0, 0}}, 0.6, 1.0),
        block(MeshBlocks(whole_mesh(mesh_surface({{0.1, 0.2, 0.3, 2.0, 0}}, improved(0.6, 1.0, 0.5)), 0.5f),
                         {{{-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0}}}, 1)
                  .extract(0)),
        block_field(field, block.box) {}

  void repair() {
    SheetGuard guard(block, Guarding::kCloseSheets);
    repair_triangles(block, guard, block_field, kLeastAngleDeg, 3);
  }
  std::size_t count_bad() const {
    std::size_t bad = 0;
    for (Index t = 0; t < block.connectivity.triangles(); ++t) {
      bad += block.connectivity.has_triangle(t) && triangle_quality(block, t).min_sine < kLeastSine;
    }
    return bad;
  }

  GaussianField field;
  BlockMesh block;
  BlockField block_field;
};

}  // namespace

TEST_CASE("good triangles are left as they are") {
  Sphere sphere;
  REQUIRE(sphere.count_bad() == 0);
  const BlockMesh before = sphere.block;
  sphere.repair();
  CHECK(sphere.block.at == before.at);
  CHECK(triangles_of(sphere.block) == triangles_of(before));
}

TEST_CASE("triangles round a vertex that lies near another are mended, and no others change") {
  for (const Index v : {Index{0}, Index{17}, Index{100}}) {
    Sphere sphere;
    BlockMesh& block = sphere.block;
    std::vector<Index> round;
    block.connectivity.visit_star(v, [&](Index h) { round.push_back(block.connectivity.to(h)); });
    const auto place = sphere.block_field.project(block.at[v] + 0.7 * (block.at[round[0]] - block.at[v]), 0.5);
    REQUIRE(place);
    block.put(v, *place);
    REQUIRE(sphere.count_bad() > 0);
    const std::vector<Vec3> before = block.at;
    sphere.repair();
    CHECK(sphere.count_bad() == 0);
    for (Index u = 0; u < before.size(); ++u) {
      if (length(before[u] - place->at) > 1.5) CHECK(block.at[u] == before[u]);
    }
    for (Index u = 0; u < block.at.size(); ++u) {
      if (block.connectivity.has_vertex(u))
        CHECK(length(block.at[u] - Vec3{0.1, 0.2, 0.3}) == Approx(2.0).epsilon(1e-8));
    }
  }
}
