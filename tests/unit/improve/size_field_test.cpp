// Wanted sizes follow the curvature, and grow slowly along the surface.
#include "improve/size_field.h"

#include <algorithm>
#include <cmath>

#include "catch2.h"
#include "support/meshing.h"
#include "support/whole_mesh.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

constexpr double kDecay = 0.6, kIsovalue = 1.0, kSpacing = 0.5;

/// The mesh of some atoms as one block, with its wanted sizes.
BlockMesh sized_block(const std::vector<Atom>& atoms, const SizeTargets& targets) {
  const GaussianField field(atoms, kDecay, kIsovalue);
  const WholeMesh mesh =
      whole_mesh(mesh_surface(atoms, improved(kDecay, kIsovalue, kSpacing)), static_cast<float>(targets.spacing));
  BlockMesh block = MeshBlocks(mesh, {{{-20.0, -20.0, -20.0}, {20.0, 20.0, 20.0}}}, 1).extract(0);
  BlockField block_field(field, block.box);
  find_wanted_sizes(block, block_field, targets);
  return block;
}

void check_all_sizes(const BlockMesh& block, double wanted) {
  for (const float size : block.size) CHECK(double(size) == Approx(wanted).epsilon(1e-4));
}

}  // namespace

TEST_CASE("no size is below a hundredth of the spacing on a crease, but where the surface curves both ways") {
  const SizeTargets targets = {.spacing = kSpacing};
  const auto size_at = [&](double larger, double smaller) {
    return wanted_size({.larger = larger, .smaller = smaller}, targets);
  };
  const double least = kLeastSize * kSpacing;
  CHECK(size_at(1.0 / kSpacing, 0.0) == kSpacing);
  for (const double smaller : {0.0, 1e-3, 0.5}) {
    CAPTURE(smaller);
    CHECK(size_at(1e3, smaller) == Approx(least));
    CHECK(size_at(1e9, smaller) == Approx(least));
  }
  CHECK(size_at(1e4, 1e4) == Approx(kTurnPerEdge / 1e4));
  CHECK(size_at(1e5, 1e4) == Approx(kTurnPerEdge / 1e5));
  CHECK(size_at(1e9, 10.0) < 0.1 * least);         // the waist of a neck may be nearly flat ...
  CHECK(size_at(1e9, 10.0) > kTurnPerEdge / 1e9);  // ... but not so flat
  CHECK(size_at(1e9, 1e9) == Approx(kLeastSizeOfAll * kSpacing));
}

TEST_CASE("on a sphere the wanted size is what is asked for, unless the curvature or the tolerance asks for less") {
  const double radius = 2.0;
  const std::vector<Atom> sphere = {{0.1, 0.2, 0.3, radius, 0}};
  check_all_sizes(sized_block(sphere, {.spacing = kSpacing, .largest_factor = 0.6 / kSpacing}), 0.6);
  check_all_sizes(sized_block(sphere, {.spacing = kSpacing, .tolerance = 0.0, .largest_factor = 10.0 / kSpacing}),
                  kTurnPerEdge * radius);
  const double tolerance = 0.01;
  check_all_sizes(sized_block(sphere, {.spacing = kSpacing, .tolerance = tolerance, .largest_factor = 10.0 / kSpacing}),
                  std::sqrt(2.5 * tolerance * radius));
}

TEST_CASE("sizes fall towards a neck and grow by no more than a quarter of the way from it") {
  const std::vector<Atom> dumbbell = {{-2.0, 0, 0, 2.0, 0}, {2.0, 0.1, 0, 2.0, 0}};
  const BlockMesh block =
      sized_block(dumbbell, {.spacing = kSpacing, .tolerance = 0.0, .largest_factor = 10.0 / kSpacing});
  const HalfEdgeMesh& c = block.connectivity;
  for (HalfEdgeMesh::Index h = 0; h < c.half_edges(); ++h) {
    const auto u = c.from(h), v = c.to(h);
    CHECK(std::abs(double(block.size[u]) - double(block.size[v])) <=
          kGrowth * length(block.at[v] - block.at[u]) + 2e-4 * double(block.size[u]));
    const auto curvature = double(block.curvature[u]);
    CHECK(double(block.size[u]) <= 1.0001 * std::max(kTurnPerEdge / curvature, kLeastSize * kSpacing));
  }
  const auto [least, most] = std::minmax_element(block.size.begin(), block.size.end());
  CHECK(*most > 2.0f * *least);
  CHECK(std::abs(block.at[static_cast<std::size_t>(least - block.size.begin())][0]) < 0.5);  // at the neck
}
