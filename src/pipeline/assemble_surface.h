// From cells with roots to the mesh: curves on faces, loops, patches.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "improve/improve_surface.h"
#include "pipeline/cell_store.h"
#include "pipeline/fine_cells.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// Follows the curves on the faces of level 0 that smaller cells have not taken over: fills the links of all bricks,
/// and adds the vertices inside faces.
void trace_bricks(const GaussianField& field, const Lattice& lattice, CellStore& store, TracedVertices& vertices,
                  int threads);

/// Triangles of the cells of one brick, or of the leaves of one split cell, cell after cell. Vertices inside cells are
/// numbered from kLocalVertex on.
struct PatchedCells {
  std::vector<Triangle> triangles;
  std::vector<SurfacePoint> points;
  std::vector<std::uint16_t> counts;  ///< of triangles, by cell of a brick
  std::vector<CellKey> failed;
  std::size_t fold_cells = 0;
};

/// Makes loops of the curves round every cell and triangles of the loops, and again where curves have changed since.
class CellTriangulator {
 public:
  /// @param for_improvement, fine_places  as in TraceDemands: cells that are too coarse for them fail also
  CellTriangulator(const GaussianField& field, const Lattice& lattice, const CellStore& store, bool for_improvement,
                   std::span<const FinePlace> fine_places)
      : field_(field),
        lattice_(lattice),
        store_(store),
        for_improvement_(for_improvement),
        fine_cells_(lattice, fine_places) {}

  /// Triangulates all cells in the first call, and then those that the last call of split.split() changed.
  /// @return those without an embedded triangulation, which must be split; when there are none, join() makes the
  /// surface of what was kept from all calls
  std::vector<CellKey> triangulate(const SplitLattice& split, const FoldCellMap& folds, const TracedVertices& vertices,
                                   int threads);

  /// Cells that are cut along folds.
  std::size_t fold_cells() const;

  /// The surface of all cells. What `store` had is gone then.
  SurfaceMesh join(CellStore& store, TracedVertices& vertices, int threads) &&;

 private:
  const GaussianField& field_;
  const Lattice& lattice_;
  const CellStore& store_;
  bool for_improvement_;
  FineCells fine_cells_;
  std::deque<PatchedCells> patched_;  ///< by brick, then by split cell
};

}  // namespace gaussmesh
