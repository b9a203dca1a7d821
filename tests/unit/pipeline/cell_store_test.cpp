#include "pipeline/cell_store.h"

#include <set>

#include "catch2.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

struct Sample {
  Sample(std::uint64_t seed, double spacing)
      : random(seed),
        atoms(random_cloud(random, {20, 7.0, 0.8, 2.2, 0.1})),
        field(atoms, 0.6, 1.2),
        lattice(lattice_of(spacing)),
        store(field, lattice, 2) {}
  Random random;
  std::vector<Atom> atoms;
  GaussianField field;
  Lattice lattice;
  CellStore store;
};

template <typename Visit>
void for_each_cell(const CellStore& store, const Visit& visit) {
  for (std::uint32_t b = 0; b < store.bricks().size(); ++b) {
    for (std::uint32_t c = 0; c < store.bricks()[b].cells.size(); ++c) visit(CellStore::Place{b, c});
  }
}

}  // namespace

TEST_CASE("every cell is found again at its lowest corner, and nothing where there is none") {
  const Sample s(91, 0.6);
  std::set<FineIndex> cells;
  for_each_cell(s.store, [&](const CellStore::Place& place) {
    const FineIndex lo = s.store.lowest_corner(place);
    cells.insert(lo);
    for (const std::uint32_t hint : {std::uint32_t{0}, place.brick}) {
      const auto found = s.store.find(lo, hint);
      REQUIRE(found);
      CHECK(found->brick == place.brick);
      CHECK(found->cell == place.cell);
    }
  });
  CHECK(cells.size() > 500);
  CHECK(cells.begin()->at(0) < 0);  // below zero, too
  for (const FineIndex& lo : cells) {
    for (int k = 0; k < 3; ++k) {
      for (const std::int64_t by : {-kFinePerCell, kFinePerCell}) {
        CHECK(s.store.find(moved(lo, k, by)).has_value() == cells.contains(moved(lo, k, by)));
      }
    }
  }
}

TEST_CASE("roots of an edge: as many as the signs at its ends ask for, and numbered once each") {
  const Sample s(92, 0.5);
  const ExactField exact(s.atoms, 0.6, 1.2);
  std::set<std::uint32_t> vertices;
  std::size_t total = 0;
  for_each_cell(s.store, [&](const CellStore::Place& place) {
    const FineIndex lo = s.store.lowest_corner(place);
    for (int axis = 0; axis < 3; ++axis) {
      const auto roots = s.store.edge_roots(place, axis);
      const bool from = exact.psi(to_angstrom(s.lattice.point(lo))) >= 0.0L;
      const bool to = exact.psi(to_angstrom(s.lattice.point(moved(lo, axis, kFinePerCell)))) >= 0.0L;
      CHECK((roots.count % 2 == 1) == (from != to));
      for (std::uint32_t i = 0; i < roots.count; ++i) vertices.insert(roots.first + i);
      total += roots.count;
    }
  });
  CHECK(s.store.root_vertices() == total);
  CHECK(vertices.size() == total);
  CHECK(*vertices.rbegin() == total - 1);
  CHECK(total > 500);
}

TEST_CASE("every lattice edge that the surface crosses is in the store, outside the certified cells too") {
  const Sample s(93, 0.9);
  const ExactField exact(s.atoms, 0.6, 1.2);
  const CellKey middle = cell_at(s.lattice, {0, 0, 0});
  std::size_t crossed = 0;
  for (std::int64_t i = -7; i < 7; ++i) {
    for (std::int64_t j = -7; j < 7; ++j) {
      for (std::int64_t k = -7; k < 7; ++k) {
        const FineIndex lo = {middle.lo[0] + i * kFinePerCell, middle.lo[1] + j * kFinePerCell,
                              middle.lo[2] + k * kFinePerCell};
        const bool from = exact.psi(to_angstrom(s.lattice.point(lo))) >= 0.0L;
        for (int axis = 0; axis < 3; ++axis) {
          if (from == (exact.psi(to_angstrom(s.lattice.point(moved(lo, axis, kFinePerCell)))) >= 0.0L)) continue;
          const auto place = s.store.find(lo);
          REQUIRE(place);
          CHECK(s.store.edge_roots(*place, axis).count > 0);
          ++crossed;
        }
      }
    }
  }
  CHECK(crossed > 200);
}
