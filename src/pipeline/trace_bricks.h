// The curves on the faces of level 0, brick by brick; those of smaller cells are split_lattice.h.
#pragma once

#include "pipeline/traced_vertices.h"

namespace gaussmesh {

/// Follows the curves on the faces of level 0 that smaller cells have not taken over: fills the links of all bricks,
/// and adds the vertices inside faces.
/// @throws LatticeDegenerate where roots and curves do not fit together to rounding
/// @throws CannotMeshError   if the surface goes through a face or brick more often than can be counted
void trace_bricks(const GaussianField& field, const Lattice& lattice, CellStore& store, TracedVertices& vertices,
                  int threads);

}  // namespace gaussmesh
