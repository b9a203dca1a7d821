// What a block of the mesh has, for comparisons.
#pragma once

#include <vector>

#include "improve/block_mesh.h"

namespace gaussmesh::testing {

/// All triangles by their numbers, also those that are gone.
inline std::vector<Triangle> triangles_of(const BlockMesh& mesh) {
  std::vector<Triangle> triangles;
  for (HalfEdgeMesh::Index t = 0; t < mesh.connectivity.triangles(); ++t)
    triangles.push_back(mesh.connectivity.triangle(t));
  return triangles;
}

}  // namespace gaussmesh::testing
