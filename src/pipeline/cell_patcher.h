// Triangles in ONE cell: the loops round it, a patch for them, and whether the patch is fine enough.
//
// Which cells there are, and what becomes of those that fail, is cell_triangulator.h.
#pragma once

#include "patch/fold_triangulator.h"
#include "patch/patch_triangulator.h"
#include "pipeline/loop_collector.h"
#include "pipeline/patched_cells.h"
#include "pipeline/trace_demands.h"

namespace gaussmesh {

/// All that loops are made of: cells of every size, and the curves on their faces.
struct TracedCells {
  const CellStore& store;
  const SplitLattice& split;
  const FoldCellMap& folds;
  const TracedVertices& vertices;
};

/// Gathers the loops of cells and triangulates them. Keeps buffers: one for each thread.
class CellPatcher {
 public:
  /// @param cells       do not change as long as this lives
  /// @param fine_cells  of demands.fine_places
  CellPatcher(const GaussianField& field, const Lattice& lattice, const TracedCells& cells, const TraceDemands& demands,
              const FineCells& fine_cells);

  /// Adds the triangles of a cell of level 0 to those of its brick: none if it is split. A cell without an embedded
  /// triangulation, or too coarse for what is demanded, is put among those that failed.
  /// @throws LatticeDegenerate if curves do not close
  void patch_cell(const CellStore::Place& place, PatchedCells& result);

  /// The same for a smaller cell.
  void patch_leaf(const LeafCell& leaf, PatchedCells& result);

 private:
  /// @param hint, empty_faces  as LoopCollector takes them
  void patch(const CellKey& key, const Direction& direction, std::uint32_t hint, unsigned empty_faces,
             PatchedCells& result);
  bool is_too_coarse(const Patch& patch, const CellKey& key);
  bool is_turned(const Patch& patch, const CellKey& key);
  const SurfacePoint& point(std::uint32_t vertex, const Patch& patch) const {
    return vertex >= kLocalVertex ? patch.points[vertex - kLocalVertex] : cells_.vertices[vertex];
  }

  const GaussianField& field_;
  const Lattice& lattice_;
  TracedCells cells_;
  bool for_improvement_;
  const FineCells& fine_cells_;
  NearAtoms atoms_;
  LoopCollector collector_;
  PatchTriangulator triangulator_;
  FoldTriangulator fold_triangulator_;
};

}  // namespace gaussmesh
