// One mesh of the triangles in all cells.
#pragma once

#include <deque>

#include "improve/improve_surface.h"
#include "pipeline/patched_cells.h"
#include "pipeline/traced_vertices.h"

namespace gaussmesh {

/// The surface of all cells: roots first, then the other vertices outside cells without those that were dropped, then
/// those inside cells. What `store` and `vertices` had is gone then, and is given back to the system on the way.
///
/// @param cells  as CellTriangulator::release() gives them
/// @throws CannotMeshError if there are more vertices than numbers
SurfaceMesh assemble_surface(std::deque<PatchedCells> cells, CellStore& store, TracedVertices& vertices, int threads);

}  // namespace gaussmesh
