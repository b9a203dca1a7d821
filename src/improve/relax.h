// Moving vertices along the surface.
#pragma once

#include "improve/edge_operations.h"

namespace gaussmesh {

/// Moves every active inner vertex along the surface to the mean of the places that would make the triangles round
/// it equilateral, one after the other, and puts it back on the surface. Vertices whose triangles would turn from
/// the field, fold, or meet others stay where they are.
/// @return the vertices that moved
std::size_t relax_vertices(BlockMesh& mesh, SheetGuard& guard, BlockField& field, Accuracy accuracy);

/// Puts all vertices in the block's box exactly on the surface, after rough relaxation.
void settle_vertices(BlockMesh& mesh, BlockField& field);

}  // namespace gaussmesh
