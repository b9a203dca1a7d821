// What cells have in them once they are triangulated: made by cell_patcher.h, kept by cell_triangulator.h, joined by
// assemble_surface.h.
#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.h"
#include "gaussmesh/triangle_mesh.h"
#include "roots/edge_roots.h"

namespace gaussmesh {

/// Triangles of the cells of one brick, or of the leaves of one split cell, cell after cell. Vertices inside cells are
/// numbered from kLocalVertex on.
struct PatchedCells {
  std::vector<Triangle> triangles;
  std::vector<SurfacePoint> points;
  std::vector<std::uint16_t> counts;  ///< of triangles, by cell of a brick
  std::vector<CellKey> failed;
  std::size_t fold_cells = 0;
};

}  // namespace gaussmesh
