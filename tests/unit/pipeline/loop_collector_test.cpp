// The loops of all cells, taken together, are the surface: what that means can be counted.
#include "pipeline/loop_collector.h"

#include <map>
#include <set>
#include <utility>

#include "catch2.h"
#include "core/lattice_degenerate.h"
#include "core/vectors.h"
#include "support/meshing.h"
#include "support/random.h"
#include "support/traced_molecule.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

const Vec3 kCentre{0.1, 0.2, 0.3};

/// A sphere of radius 2 A, in cells so small that the surface in each is a disc, or several.
TracedMolecule sphere() { return {{{kCentre[0], kCentre[1], kCentre[2], 2.0, 0}}, 0.6, 1.0, 0.5}; }

/// Every third of the certified cells of level 0, which need not be split.
std::vector<CellKey> some_cells(const TracedMolecule& molecule) {
  std::vector<CellKey> cells = molecule.level_0_cells();
  std::erase_if(cells, [&](const CellKey& key) {
    return (key.lo[0] + key.lo[1] + key.lo[2]) / kFinePerCell % 3 != 0 ||
           molecule.store.cell(*molecule.store.find(key.lo)).direction.sign == 0;
  });
  return cells;
}

/// What all loops have together.
struct LoopSums {
  std::size_t loops = 0;
  std::set<std::uint32_t> vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;  ///< from, to: in how many loops
};

LoopSums sums_of(const TracedMolecule& molecule) {
  LoopSums sums;
  molecule.visit_cells([&](const CellKey&, const Direction&, std::span<const Loop> loops) {
    sums.loops += loops.size();
    for (const Loop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        sums.vertices.insert(loop[i].vertex);
        ++sums.sides[{loop[i].vertex, loop[(i + 1) % loop.size()].vertex}];
      }
    }
  });
  return sums;
}

/// Every side is in two loops, one of which goes along it each way: the loops close up to a surface.
void check_closed(const LoopSums& sums) {
  for (const auto& [side, count] : sums.sides) {
    CHECK(count == 1);
    CHECK(sums.sides.contains({side.second, side.first}));
  }
}

std::int64_t euler_number(const LoopSums& sums) {
  return std::int64_t(sums.vertices.size()) - std::int64_t(sums.sides.size() / 2) + std::int64_t(sums.loops);
}

}  // namespace

TEST_CASE("loops of a sphere close up, and as discs they have Euler number 2, also between cells of different size") {
  for (const bool is_split : {false, true}) {
    CAPTURE(is_split);
    TracedMolecule molecule = sphere();
    REQUIRE(molecule.search.folds.empty());
    const std::vector<CellKey> more = is_split ? some_cells(molecule) : std::vector<CellKey>();
    molecule.trace(more);
    CHECK(molecule.split.split_cells() >= more.size());
    CHECK((more.size() > 20) == is_split);
    const LoopSums sums = sums_of(molecule);
    check_closed(sums);
    CHECK(euler_number(sums) == 2);
    CHECK(sums.loops > 200);
  }
}

TEST_CASE("loops of a ring of atoms have Euler number 0") {
  TracedMolecule molecule(atom_ring(12, 4.0, 1.6), 0.6, 1.0, 0.4);
  REQUIRE(molecule.search.folds.empty());
  molecule.trace(some_cells(molecule));
  const LoopSums sums = sums_of(molecule);
  check_closed(sums);
  CHECK(euler_number(sums) == 0);
}

TEST_CASE("loops of a cloud of atoms close up, with cells of every size and folds") {
  Random random(51);
  TracedMolecule molecule(random_cloud(random, {20, 6.0, 0.8, 2.2, 0.1}), 0.6, 1.2, 0.8);
  REQUIRE(molecule.search.uncertified.empty());
  molecule.trace(some_cells(molecule));
  CHECK(molecule.split.split_cells() > 100);
  check_closed(sums_of(molecule));
}

TEST_CASE("a loop goes counter-clockwise round the surface seen from outside, side by side in faces of its cell") {
  TracedMolecule molecule = sphere();
  molecule.trace(some_cells(molecule));
  molecule.visit_cells([&](const CellKey& key, const Direction&, std::span<const Loop> loops) {
    const CoordPoint lo = molecule.lattice.point(key.lo), hi = molecule.lattice.point(cell_hi(key));
    for (const Loop& loop : loops) {
      REQUIRE(loop.size() >= 3);
      Vec3 area{}, out{};
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const LoopVertex &v = loop[i], &w = loop[(i + 1) % loop.size()];
        const Vec3 p = to_angstrom(v.point.position) - kCentre, q = to_angstrom(w.point.position) - kCentre;
        area = area + cross(p, q);
        out = out + p;
        CHECK(v.point.position == molecule.vertices[v.vertex].position);
        CHECK(v.faces == faces_of(v.point.position, lo, hi));
        CHECK((v.faces & w.faces) != 0);
      }
      CHECK(dot(area, out) > 0.0);
    }
  });
}

TEST_CASE("faces that are said to be empty are not looked at, and curves that do not close are an error") {
  TracedMolecule molecule = sphere();
  molecule.trace();
  LoopCollector collector(molecule.lattice, molecule.store, molecule.split, molecule.vertices);
  std::size_t torn = 0;
  for (const CellKey& key : molecule.level_0_cells()) {
    unsigned faces = 0;
    const std::span<const Loop> loops = collector.collect(key, 0);
    for (const Loop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) faces |= loop[i].faces & loop[(i + 1) % loop.size()].faces;
    }
    if (loops.empty()) continue;
    const unsigned without = 0x3Fu & ~faces;
    const std::size_t count = loops.size();
    CHECK(collector.collect(key, 0, without).size() == count);
    CHECK(collector.collect(key, 0, 0x3F).empty());
    for (unsigned face = 0; face < 6; ++face) {
      if (!(faces >> face & 1)) continue;
      CHECK_THROWS_AS(collector.collect(key, 0, 1u << face), LatticeDegenerate);
      ++torn;
    }
  }
  CHECK(torn > 500);
}
