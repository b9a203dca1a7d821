// Meshes as the improvement takes them.
#pragma once

#include "gaussmesh/mesh_surface.h"
#include "improve/mesh_blocks.h"

namespace gaussmesh::testing {

/// With wanted sizes of `size` everywhere.
inline WholeMesh whole_mesh(const MeshResult& result, float size) {
  WholeMesh mesh;
  mesh.at = result.mesh.vertices;
  mesh.normal = result.normals;
  mesh.size.assign(mesh.at.size(), size);
  mesh.curvature.assign(mesh.at.size(), -1.0f);
  mesh.refinement.assign(mesh.at.size(), 1.0f);
  mesh.triangles = result.mesh.triangles;
  return mesh;
}

}  // namespace gaussmesh::testing
