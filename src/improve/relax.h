// Moving vertices along the surface.
#pragma once

#include "field/gaussian_field.h"
#include "improve/sheet_guard.h"
#include "improve/working_mesh.h"

namespace gaussmesh {

/// Moves every vertex along the surface towards the middle of the triangles round it, all at once (Lloyd's iteration
/// with triangles weighted by area over wanted area), and puts it back on the surface. Vertices whose triangles would
/// turn from the field, fold, or meet others stay where they are.
/// @return the vertices that moved
std::size_t relax_vertices(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, int threads);

}  // namespace gaussmesh
