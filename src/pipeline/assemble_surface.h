// From cells with roots to the mesh: curves on faces, loops, patches.
#pragma once

#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "pipeline/cell_store.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// The mesh as the trace makes it: vertices with their normals.
struct TracedSurface {
  std::vector<SurfacePoint> points;
  std::vector<Triangle> triangles;
};

/// Follows the curves on all faces of level 0 that smaller cells have not taken over. Fills `links` and `face_points`
/// of the bricks; vertices inside faces are numbered from `first_vertex` on.
void trace_level_zero_faces(const GaussianField& field, const Lattice& lattice, CellStore& store,
                            std::uint32_t first_vertex, int threads);

/// What triangulating the cells gave.
struct PatchOutcome {
  TracedSurface surface;
  std::size_t fold_cells = 0;    ///< cells cut along folds
  std::vector<CellKey> failed;   ///< cells without an embedded triangulation: they must be split
};

/// Makes loops of the curves round every cell and triangles of the loops. All curves have been traced.
PatchOutcome triangulate_cells(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                               const SplitLattice& split, const FoldCellMap& folds, int threads);

}  // namespace gaussmesh
