// The worst triangles, one by one.
#pragma once

#include "field/gaussian_field.h"
#include "improve/sheet_guard.h"
#include "improve/working_mesh.h"

namespace gaussmesh {

/// Tries on every triangle with an angle below `least_angle_deg` what may mend it: flipping an edge, collapsing the
/// shortest, splitting the longest, or moving a corner along the surface. What does not raise the smallest angle of
/// the triangles concerned is not done. @return triangles below the angle that are left
std::size_t repair_triangles(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, double least_angle_deg,
                             int rounds);

}  // namespace gaussmesh
