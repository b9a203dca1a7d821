// From cells with roots to the mesh: curves on faces, loops, patches.
#pragma once

#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "improve/improve_surface.h"
#include "pipeline/cell_store.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// For which demands the curves on the faces of one brick were followed.
struct TracedBrick {
  std::vector<std::uint32_t> state;   ///< what was asked of the faces, by cell
  bool is_done = false;
  bool is_new = false;                ///< not what it was in the round before
};

/// Follows the curves on the faces of level 0, and again where smaller cells have since taken faces over.
class LevelZeroTracer {
 public:
  LevelZeroTracer(const GaussianField& field, const Lattice& lattice, CellStore& store);

  /// Fills `links` and `face_points` of the bricks, whose vertices are numbered from `first_vertex` on.
  void trace(std::uint32_t first_vertex, int threads);

  /// Whether the last call followed the curves of a brick again.
  bool is_new(std::uint32_t brick) const { return traced_[brick].is_new; }

 private:
  const GaussianField& field_;
  const Lattice& lattice_;
  CellStore& store_;
  std::vector<TracedBrick> traced_;
};

/// What triangulating the cells gave.
struct PatchOutcome {
  std::size_t fold_cells = 0;    ///< cells cut along folds
  std::vector<CellKey> failed;   ///< cells without an embedded triangulation: they must be split
};

/// Triangles of the cells of one brick, or of the leaves of one split cell. Vertices inside cells are numbered from kLocalVertex on.
struct PatchedCells {
  std::vector<Triangle> triangles;
  std::vector<SurfacePoint> points;
  std::size_t fold_cells = 0;
  std::vector<CellKey> failed;
};

/// Makes loops of the curves round every cell and triangles of the loops, and again where curves have changed since.
class CellTriangulator {
 public:
  /// @param least_corner_cosine  cells fail also where the normals at the corners of a triangle differ by more than
  ///                             this: they are too coarse for the surface (-1: never)
  CellTriangulator(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                   double least_corner_cosine)
      : field_(field), lattice_(lattice), store_(store), least_corner_cosine_(least_corner_cosine) {}

  /// All curves have been traced. When no cell failed, this is the last call, and join() makes the surface of what
  /// it kept.
  PatchOutcome triangulate(const SplitLattice& split, const FoldCellMap& folds, const LevelZeroTracer& faces,
                           int threads);

  /// The surface of all cells. What `store` had is gone then.
  SurfaceMesh join(CellStore& store, const SplitLattice& split, int threads) &&;

 private:
  bool sees_new_faces(const LevelZeroTracer& faces, std::uint32_t brick) const;
  void renumber_face_points(PatchedCells& cells) const;

  const GaussianField& field_;
  const Lattice& lattice_;
  const CellStore& store_;
  double least_corner_cosine_;
  std::vector<PatchedCells> patched_;           ///< by brick, then by split cell
  std::vector<std::uint32_t> face_vertices_;    ///< first_face_vertex of the bricks, as numbered in `patched_`
};

}  // namespace gaussmesh
