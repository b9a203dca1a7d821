// What the vertex numbers alone tell: edges, fans, components, Euler numbers. No coordinate is looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/vertex_stars.h"

namespace gaussmesh::verify {

/// Triangles connected through shared edges.
struct ComponentTopology {
  std::size_t triangles = 0;
  std::size_t vertices = 0;  ///< a vertex where two components touch counts in both
  std::int64_t chi = 0;      ///< V - E + F
  bool closed = true;        ///< every edge is in two triangles, which run through it in opposite directions
};

/// Conditions (a) and (b) of a manifold mesh in [LCL15], and the components.
struct EdgeTopology {
  std::size_t boundary_edges = 0;
  std::size_t nonmanifold_edges = 0;
  std::size_t misoriented_edges = 0;
  std::size_t nonmanifold_vertices = 0;
  std::size_t isolated_vertices = 0;
  std::vector<std::uint32_t> nonmanifold;     ///< the vertices counted in nonmanifold_vertices, in rising order
  std::vector<std::uint32_t> component_of;    ///< of each triangle: its place in `components`
  std::vector<ComponentTopology> components;  ///< in the order of their first triangles
};

/// Counts the defects named in MeshCheck, and numbers the components.
///
/// @param mesh   every triangle has three different vertices, all there
/// @param stars  of this mesh
///
/// Cost: O(n) time where stars have 32 triangles at most, a logarithm of the star's size more for others; 4 bytes a
/// triangle. The answer does not depend on the number of threads.
EdgeTopology find_edge_topology(const TriangleMesh& mesh, const VertexStars& stars);

}  // namespace gaussmesh::verify
