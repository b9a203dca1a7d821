#include "pipeline/split_lattice.h"

#include <map>

#include "catch2.h"
#include "support/fields.h"
#include "support/lattices.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// A cloud whose every cell of level 0 is split.
struct Sample {
  explicit Sample(std::uint64_t seed)
      : random(seed),
        atoms(random_cloud(random, {20, 6.0, 0.8, 2.2, 0.1})),
        field(atoms, 0.6, 1.2),
        exact(atoms, 0.6, 1.2),
        lattice(lattice_of(0.8)),
        store(field, lattice, 2),
        vertices(store),
        split(field, lattice, store, no_folds, vertices) {
    std::vector<CellKey> cells;
    for (std::uint32_t b = 0; b < store.bricks().size(); ++b) {
      for (std::uint32_t c = 0; c < store.bricks()[b].cells.size(); ++c) {
        cells.push_back({store.lowest_corner({b, c}), 0});
      }
    }
    split.split(cells, 2);
  }

  template <typename Visit>
  void for_each_leaf(const Visit& visit) const {
    for (const SplitCell& cell : split.cells()) {
      for (const LeafCell& leaf : cell.leaves) visit(leaf);
    }
  }

  /// Lowest corner of the face of a leaf across an axis, on the low or high side.
  static FineIndex face_of(const LeafCell& leaf, int axis, int side) {
    return moved(leaf.key.lo, axis, side * fine_size(leaf.key.level));
  }

  Random random;
  std::vector<Atom> atoms;
  GaussianField field;
  ExactField exact;
  Lattice lattice;
  CellStore store;
  FoldCellMap no_folds;
  TracedVertices vertices;
  SplitLattice split;
};

}  // namespace

TEST_CASE("faces of leaves said to be empty have no surface and no curves") {
  const Sample s(94);
  REQUIRE(s.split.uncertified().empty());
  std::size_t empty = 0, others = 0;
  s.for_each_leaf([&](const LeafCell& leaf) {
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      const FineIndex lo = Sample::face_of(leaf, axis, face % 2);
      if (!(leaf.empty_faces >> face & 1)) {
        ++others;
        continue;
      }
      ++empty;
      CHECK(s.split.face_links(axis, lo, leaf.key.level).empty());
      const std::int64_t step = fine_size(leaf.key.level) / 4;
      int inside = 0;
      for (int i = 0; i <= 4; ++i) {
        for (int j = 0; j <= 4; ++j) {
          const FineIndex at = moved(moved(lo, first_axis(axis), i * step), second_axis(axis), j * step);
          inside += s.exact.psi(to_angstrom(s.lattice.point(at))) >= 0.0L;
        }
      }
      CHECK((inside == 0 || inside == 25));
    }
  });
  CHECK(empty > 500);
  CHECK(others > 2000);
}

TEST_CASE("curves on the faces of a leaf close: every vertex is left as often as it is reached") {
  const Sample s(95);
  REQUIRE(s.split.uncertified().empty());
  std::size_t links = 0;
  s.for_each_leaf([&](const LeafCell& leaf) {
    std::map<std::uint32_t, int> balance;
    for (int face = 0; face < 6; ++face) {
      const FineIndex lo = Sample::face_of(leaf, face / 2, face % 2);
      const CellKey beyond{moved(leaf.key.lo, face / 2, (face % 2 == 1 ? 1 : -1) * fine_size(leaf.key.level)),
                           leaf.key.level};
      if (s.split.is_split(beyond)) return;  // the curves are those of smaller faces
      const int way = face % 2 == 1 ? -1 : 1;
      for (const Link& link : s.split.face_links(face / 2, lo, leaf.key.level)) {
        balance[link.from] += way;
        balance[link.to] -= way;
        ++links;
      }
    }
    for (const auto& [vertex, sum] : balance) CHECK(sum == 0);
  });
  CHECK(links > 2000);
}
