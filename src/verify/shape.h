// How well shaped the triangles of a mesh are.
#pragma once

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh::verify {

/// Measures edges, angles, ratios and their histograms, Figs. 7 and 8 of [LCL15].
///
/// A triangle of zero area has the angles 0, 0 and 180 degrees, and the ratio 0 where its corners are in one place.
///
/// @param mesh  every vertex number is there
/// @return      a MeshCheck with nothing but its shape filled in; all 0 if there is no triangle
///
/// The answer does not depend on the number of threads: sums are made by chunks of fixed size.
MeshCheck measure_shape(const TriangleMesh& mesh);

}  // namespace gaussmesh::verify
