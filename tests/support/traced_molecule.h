// A molecule up to the curves round its cells, as pipeline/trace_surface.cpp does it: what loops are made of.
#pragma once

#include <vector>

#include "pipeline/find_fold_cells.h"
#include "pipeline/loop_collector.h"
#include "pipeline/trace_bricks.h"
#include "support/lattices.h"

namespace gaussmesh::testing {

struct TracedMolecule {
  TracedMolecule(const std::vector<Atom>& atoms, double decay, double isovalue, double spacing)
      : field(atoms, decay, isovalue),
        lattice(lattice_of(spacing)),
        store(field, lattice, 2),
        search(find_and_mark_folds(field, lattice, store)),
        vertices(store),
        split(field, lattice, store, search.folds, vertices) {}

  /// Splits the cells that need it, and some others if that is wanted; follows all curves.
  void trace(const std::vector<CellKey>& more_to_split = {}) {
    std::vector<CellKey> cells = search.to_split;
    cells.insert(cells.end(), more_to_split.begin(), more_to_split.end());
    split.split(cells, 2);
    split.mark_cells(store);
    trace_bricks(field, lattice, store, vertices, 2);
  }

  std::vector<CellKey> level_0_cells() const {
    std::vector<CellKey> cells;
    for (std::uint32_t b = 0; b < store.bricks().size(); ++b) {
      for (std::uint32_t c = 0; c < store.bricks()[b].cells.size(); ++c) {
        cells.push_back({store.lowest_corner({b, c}), 0});
      }
    }
    return cells;
  }

  /// Calls visit(key, direction, loops) for every cell that is not split; no direction: it is cut along folds.
  template <typename Visit>
  void visit_cells(const Visit& visit) const {
    LoopCollector collector(lattice, store, split, vertices);
    for (std::uint32_t b = 0; b < store.bricks().size(); ++b) {
      for (std::uint32_t c = 0; c < store.bricks()[b].cells.size(); ++c) {
        const SurfaceCell& cell = store.cell({b, c});
        if (cell.split) continue;
        const CellKey key{store.lowest_corner({b, c}), 0};
        visit(key, cell.direction, collector.collect(key, b));
      }
    }
    for (const SplitCell& cell : split.cells()) {
      for (const LeafCell& leaf : cell.leaves) {
        visit(leaf.key, leaf.direction, collector.collect(leaf.key, 0, leaf.empty_faces));
      }
    }
  }

  static FoldSearchResult find_and_mark_folds(const GaussianField& field, const Lattice& lattice, CellStore& store) {
    FoldSearchResult found = find_fold_cells(field, lattice, store, 2);
    mark_folds(found.folds, store);
    return found;
  }

  GaussianField field;
  Lattice lattice;
  CellStore store;
  FoldSearchResult search;
  TracedVertices vertices;
  SplitLattice split;
};

}  // namespace gaussmesh::testing
