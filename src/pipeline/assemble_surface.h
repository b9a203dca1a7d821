// From cells with roots to the mesh: curves on faces, loops, patches.
#pragma once

#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "improve/improve_surface.h"
#include "pipeline/cell_store.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// The curves on the faces of one brick. Vertices inside faces are numbered within it, from kLocalVertex on.
struct TracedBrick {
  std::vector<Link> links;
  std::vector<SurfacePoint> points;
  std::vector<std::array<std::uint8_t, 3>> counts;   ///< links by cell and face
  std::vector<std::uint32_t> state;                  ///< what was asked of the faces, by cell
  bool is_done = false;
};

/// Follows the curves on the faces of level 0, and again where smaller cells have since taken faces over.
class LevelZeroTracer {
 public:
  LevelZeroTracer(const GaussianField& field, const Lattice& lattice, CellStore& store);

  /// Fills `links` and `face_points` of the bricks; vertices inside faces are numbered from `first_vertex` on.
  void trace(std::uint32_t first_vertex, int threads);

 private:
  const GaussianField& field_;
  const Lattice& lattice_;
  CellStore& store_;
  std::vector<TracedBrick> traced_;
};

/// What triangulating the cells gave.
struct PatchOutcome {
  SurfaceMesh surface;
  std::size_t fold_cells = 0;    ///< cells cut along folds
  std::vector<CellKey> failed;   ///< cells without an embedded triangulation: they must be split
};

/// Makes loops of the curves round every cell and triangles of the loops. All curves have been traced.
PatchOutcome triangulate_cells(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                               const SplitLattice& split, const FoldCellMap& folds, int threads);

}  // namespace gaussmesh
