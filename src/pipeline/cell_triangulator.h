// Triangles in all cells, again and again where cells are split.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "pipeline/cell_patcher.h"

namespace gaussmesh {

/// Makes loops of the curves round every cell and triangles of the loops, and again where curves have changed since.
class CellTriangulator {
 public:
  /// @param demands  lives as long as this; cells that are too coarse for them fail also
  CellTriangulator(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                   const TraceDemands& demands)
      : field_(field), lattice_(lattice), store_(store), demands_(demands), fine_cells_(lattice, demands.fine_places) {}

  /// Triangulates all cells in the first call, and then those that the last call of split.split() changed.
  /// @return those without an embedded triangulation, or too coarse, which must be split
  std::vector<CellKey> triangulate(const SplitLattice& split, const FoldCellMap& folds, const TracedVertices& vertices,
                                   int threads);

  /// Cells that are cut along folds.
  std::size_t fold_cells() const;

  /// The triangles from all calls, by brick, then by split cell: those of the whole surface when the last call had no
  /// cells left to be split.
  std::deque<PatchedCells> release() && { return std::move(patched_); }

 private:
  PatchedCells patch_brick(std::uint32_t brick, CellPatcher& patcher) const;
  PatchedCells patch_brick_again(std::uint32_t brick, const std::vector<CellStore::Place>& changed,
                                 CellPatcher& patcher) const;

  const GaussianField& field_;
  const Lattice& lattice_;
  const CellStore& store_;
  const TraceDemands& demands_;
  FineCells fine_cells_;
  std::deque<PatchedCells> patched_;  ///< by brick, then by split cell
};

}  // namespace gaussmesh
