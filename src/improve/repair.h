// The worst triangles, one by one.
#pragma once

#include "improve/edge_operations.h"

namespace gaussmesh {

/// Tries to mend every triangle that has an angle below `least_angle_deg`, or is turned from the field by more than
/// kTurnLimit, in up to so many rounds. In turn: flips an edge, collapses the shortest, moves a corner along the
/// surface, splits the longest. A flip, a collapse or a move is made only where the worst of the triangles concerned
/// comes out better, by its smallest angle and its turn, whichever is worse; a split wherever it is allowed.
void repair_triangles(BlockMesh& mesh, SheetGuard& guard, BlockField& field, double least_angle_deg, int rounds);

}  // namespace gaussmesh
