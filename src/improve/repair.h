// The worst triangles, one by one.
#pragma once

#include "improve/edge_operations.h"

namespace gaussmesh {

/// Tries on every triangle with an angle below `least_angle_deg` what may mend it: flipping an edge, collapsing the
/// shortest, splitting the longest, or moving a corner along the surface. What does not raise the smallest angle of
/// the triangles concerned is not done.
void repair_triangles(BlockMesh& mesh, SheetGuard& guard, BlockField& field, double least_angle_deg, int rounds);

}  // namespace gaussmesh
