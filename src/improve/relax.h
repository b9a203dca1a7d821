// Moving vertices along the surface.
#pragma once

#include "improve/edge_operations.h"

namespace gaussmesh {

/// Moves every active inner vertex along the surface to the middle of the triangles round it, one after the other
/// (Lloyd's iteration with triangles weighted by area over wanted area), and puts it back on the surface. Vertices
/// whose triangles would turn from the field, fold, or meet others stay where they are.
/// @return the vertices that moved
std::size_t relax_vertices(BlockMesh& mesh, SheetGuard& guard, BlockField& field);

}  // namespace gaussmesh
