// What is said of the surface in cells without a certificate: closed formulas for spheres, and the Euler number.
#include "pipeline/find_fold_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "catch2.h"
#include "core/vectors.h"
#include "support/exact_field.h"
#include "support/meshing.h"
#include "support/random.h"
#include "support/traced_molecule.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// Whether a loop goes round surface, and not round a hole in it: seen against the direction along which phi grows.
bool goes_round_surface(const Direction& direction, const Loop& loop) {
  const Vec3 along = direction.vector();
  Vec3 area{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto& next = loop[(i + 1) % loop.size()];
    area = area + cross(to_angstrom(loop[i].point.position), to_angstrom(next.point.position));
  }
  return dot(area, along) * direction.sign < 0.0;  // the solvent lies against the growth of phi
}

/// Euler number of the whole surface: the curves between the cells as a graph, and what is said of the surface in each
/// cell. In a certified one every loop is the rim of a piece, or that of a hole in one.
std::int64_t euler_number(const TracedMolecule& molecule) {
  std::set<std::uint32_t> vertices;
  std::int64_t sides = 0, pieces = 0;
  molecule.visit_cells([&](const CellKey& key, const Direction& direction, std::span<const Loop> loops) {
    for (const Loop& loop : loops) {
      sides += std::int64_t(loop.size());
      for (const LoopVertex& v : loop) vertices.insert(v.vertex);
    }
    if (direction.sign != 0) {
      for (const Loop& loop : loops) pieces += goes_round_surface(direction, loop) ? 1 : -1;
    } else {
      for (const FoldComponent& component : molecule.search.folds.at(key).components) pieces += component.chi;
    }
  });
  return std::int64_t(vertices.size()) - sides / 2 + pieces;
}

/// Checks what holds of every component, and that its loops are those round its cell.
void check_components(const TracedMolecule& molecule, const ExactField& exact) {
  for (const auto& [key, cell] : molecule.search.folds) {
    CHECK(cell.key == key);
    CHECK_FALSE(cell.components.empty());
    const CoordPoint lo = molecule.lattice.point(key.lo), hi = molecule.lattice.point(cell_hi(key));
    for (const FoldComponent& component : cell.components) {
      CHECK(component.boundary_loops >= 1);
      CHECK(component.chi <= 2 - component.boundary_loops);  // chi = 2 - 2 genus - loops
      CHECK((component.chi + component.boundary_loops) % 2 == 0);
      CHECK_FALSE(component.roots.empty());
      for (const CoordPoint& root : component.roots) {
        CHECK(std::popcount(unsigned(faces_of(root, lo, hi))) >= 2);  // on an edge of the cell
        CHECK(std::abs(double(exact.psi(to_angstrom(root)))) < 1e-7);
      }
    }
  }
  molecule.visit_cells([&](const CellKey& key, const Direction& direction, std::span<const Loop> loops) {
    if (direction.sign != 0) return;
    int boundary_loops = 0, least_folds = 0;
    std::array<int, 3> folds{};  // by axis: the fold points on the loops
    for (const FoldComponent& component : molecule.search.folds.at(key).components) {
      boundary_loops += component.boundary_loops;
      if (component.fold_axis) least_folds += 2 * component.boundary_loops;
    }
    for (const Loop& loop : loops) {
      for (const LoopVertex& v : loop) {
        for (int k = 0; k < 3; ++k) folds[k] += v.point.fold_axes >> k & 1;
      }
    }
    CHECK(boundary_loops == int(loops.size()));
    CHECK(folds[0] + folds[1] + folds[2] >= least_folds);  // so that each loop can be cut
  });
}

}  // namespace

TEST_CASE("where all cells have certificates nothing is looked for") {
  const TracedMolecule molecule({{0.1, 0.2, 0.3, 2.0, 0}}, 0.6, 1.0, 0.4);
  CHECK(molecule.search.folds.empty());
  CHECK(molecule.search.to_split.empty());
  CHECK(molecule.search.uncertified.empty());
  CHECK(molecule.search.finest_level == 0);
}

TEST_CASE("each cell without a certificate either keeps its size or is to be split") {
  std::size_t without = 0, folds = 0;
  int finest_level = 0;
  for (std::uint64_t seed = 60; seed < 64; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TracedMolecule molecule(random_cloud(random, {20, 6.0, 0.8, 2.2, 0.1}), 0.6, 1.2, 3.0);
    REQUIRE(molecule.search.uncertified.empty());
    for (const CellKey& key : molecule.level_0_cells()) {
      const bool is_certified = molecule.store.cell(*molecule.store.find(key.lo)).direction.sign != 0;
      const bool is_fold = molecule.search.folds.contains(key);
      const auto& to_split = molecule.search.to_split;
      const bool is_to_split = std::find(to_split.begin(), to_split.end(), key) != to_split.end();
      CHECK(int(is_certified) + int(is_fold) + int(is_to_split) == 1);
      without += !is_certified;
      folds += is_fold;
    }
    finest_level = std::max(finest_level, molecule.search.finest_level);
  }
  CHECK(without > 5);
  CHECK(folds > 3);
  CHECK(finest_level >= 1);
}

TEST_CASE("spheres in large cells: Euler number 2, and folds where the great circles are") {
  Random random(62);
  std::size_t cut = 0, uncut = 0;
  for (int round = 0; round < 40; ++round) {
    const Vec3 centre{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const std::vector<Atom> atoms{{centre[0], centre[1], centre[2], random.uniform(1.2, 2.4), 0}};
    CAPTURE(round, centre[0], centre[1], centre[2], atoms[0].radius);
    TracedMolecule molecule(atoms, 0.6, 1.0, 3.0);
    REQUIRE(molecule.search.uncertified.empty());
    molecule.trace();
    CHECK(euler_number(molecule) == 2);
    check_components(molecule, ExactField(atoms, 0.6, 1.0));
    for (const auto& [key, cell] : molecule.search.folds) {
      const Box box = cell_box(molecule.lattice, key);
      for (const FoldComponent& component : cell.components) {
        if (component.fold_axis) {
          ++cut;
          const int k = *component.fold_axis;
          CHECK((box.lo[k] < centre[k] && centre[k] < box.hi[k]));
        } else {  // all normals have an axis in common
          ++uncut;
          bool is_common = false;
          for (int k = 0; k < 3; ++k) {
            const auto is_above = [&](const CoordPoint& p) { return to_angstrom(p[k]) > centre[k]; };
            const auto above = std::count_if(component.roots.begin(), component.roots.end(), is_above);
            is_common = is_common || above == 0 || above == std::ptrdiff_t(component.roots.size());
          }
          CHECK(is_common);
        }
      }
    }
  }
  CHECK(cut > 10);
  CHECK(uncut > 0);
}

TEST_CASE("rings of atoms in cells as large as the ring is thick have Euler number 0") {
  std::size_t folds = 0;
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const std::vector<Atom> atoms = atom_ring(12, 4.0, 1.6, axis);
    TracedMolecule molecule(atoms, 0.6, 1.0, 3.0);
    REQUIRE(molecule.search.uncertified.empty());
    molecule.trace();
    CHECK(euler_number(molecule) == 0);
    check_components(molecule, ExactField(atoms, 0.6, 1.0));
    folds += molecule.search.folds.size();
  }
  CHECK(folds > 10);
}

TEST_CASE("a cloud of atoms has the same Euler number in large cells as in small ones, which need no folds") {
  std::size_t folds = 0, tubes = 0;
  for (std::uint64_t seed = 60; seed < 64; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<Atom> atoms = random_cloud(random, {20, 6.0, 0.8, 2.2, 0.1});
    TracedMolecule small(atoms, 0.6, 1.2, 0.5);
    small.trace();
    CHECK(small.search.folds.empty());
    for (const double spacing : {2.4, 3.0}) {
      TracedMolecule large(atoms, 0.6, 1.2, spacing);
      large.trace();
      CHECK(euler_number(large) == euler_number(small));
      check_components(large, ExactField(atoms, 0.6, 1.2));
      for (const auto& [key, cell] : large.search.folds) {
        ++folds;
        for (const FoldComponent& component : cell.components) tubes += component.chi == 0;
      }
    }
  }
  CHECK(folds > 5);
  CHECK(tubes > 0);
}

TEST_CASE("a thin tube through faces of a cell, and not through its edges, cannot keep the cell whole") {
  const Lattice lattice = lattice_of(4.0);
  const CellKey key = cell_at(lattice, {0, 0, 0});
  const Box box = cell_box(lattice, key);
  std::vector<Atom> atoms;
  for (double x = box.lo[0] - 3.0; x < box.hi[0] + 3.0; x += 0.7) {
    atoms.push_back({x, 0.5 * (box.lo[1] + box.hi[1]), 0.5 * (box.lo[2] + box.hi[2]), 0.9, 0});
  }
  const TracedMolecule molecule(atoms, 0.6, 1.0, 4.0);
  REQUIRE(molecule.store.find(key.lo));
  CHECK_FALSE(molecule.search.folds.contains(key));
  const auto& to_split = molecule.search.to_split;
  CHECK(std::find(to_split.begin(), to_split.end(), key) != to_split.end());
}

TEST_CASE("at the value of a saddle there is no proof, and it is said where") {
  const double decay = 0.6, radius = 1.5, half = 1.6;
  const double saddle = 2.0 * std::exp(-decay * (half * half - radius * radius));
  const std::vector<Atom> atoms{{-half, 0.03, 0.02, radius, 0}, {half, 0.03, 0.02, radius, 0}};
  const TracedMolecule molecule(atoms, decay, saddle, 0.7);
  REQUIRE_FALSE(molecule.search.uncertified.empty());
  for (const UncertifiedPlace& place : molecule.search.uncertified) {
    CHECK(length(place.place - Vec3{0.0, 0.03, 0.02}) < 0.01);
    CHECK(place.size < 0.01);
  }
  const TracedMolecule above(atoms, decay, 1.01 * saddle, 0.7), below(atoms, decay, 0.99 * saddle, 0.7);
  CHECK(above.search.uncertified.empty());
  CHECK(below.search.uncertified.empty());
}

TEST_CASE("the number of threads does not matter") {
  const GaussianField field(atom_ring(12, 4.0, 1.6), 0.6, 1.0);
  const Lattice lattice = lattice_of(3.0);
  const CellStore store(field, lattice, 1);
  const FoldSearchResult one = find_fold_cells(field, lattice, store, 1);
  const FoldSearchResult four = find_fold_cells(field, lattice, store, 4);
  CHECK(one.to_split == four.to_split);
  CHECK(one.finest_level == four.finest_level);
  REQUIRE(one.folds.size() == four.folds.size());
  REQUIRE(one.folds.size() > 2);
  for (const auto& [key, cell] : one.folds) {
    REQUIRE(four.folds.contains(key));
    const auto& components = four.folds.at(key).components;
    REQUIRE(components.size() == cell.components.size());
    for (std::size_t i = 0; i < components.size(); ++i) {
      CHECK(components[i].chi == cell.components[i].chi);
      CHECK(components[i].boundary_loops == cell.components[i].boundary_loops);
      CHECK(components[i].fold_axis == cell.components[i].fold_axis);
      CHECK(components[i].roots == cell.components[i].roots);
    }
  }
}
