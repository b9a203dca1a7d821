// Meshes that are too large are told before they are begun.
#pragma once

#include "field/gaussian_field.h"
#include "gaussmesh/mesh_surface.h"

namespace gaussmesh {

/// @param triangles  a number that will not be much fewer
/// @throws CannotMeshError if arrays or MeshOptions::memory_bytes do not hold so many
void require_room(double triangles, const MeshOptions& options);

/// The same of a mesh as traced, by its spacing. Cost: a pass over the atoms, more only where there is reason.
void require_room_as_traced(const GaussianField& field, const MeshOptions& options);

}  // namespace gaussmesh
