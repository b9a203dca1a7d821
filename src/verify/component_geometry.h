// What the components of a mesh are in space: how large, which way turned, and which lie inside which.
#pragma once

#include <cstdint>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/edge_topology.h"
#include "verify/triangle_tree.h"

namespace gaussmesh::verify {

/// One component of EdgeTopology::components.
struct ComponentGeometry {
  double area = 0.0;                  ///< Eq. (3) of [LCL15]
  double volume = 0.0;                ///< Eq. (4) of [LCL15] with its sign: positive where the triangles turn outwards
  int volume_sign = 0;                ///< exact, of the sum without rounding
  std::vector<std::uint32_t> around;  ///< closed components that it lies inside of; none for one that is not closed
};

/// The closed components that `p` lies inside of, in rising order: those that a ray from p crosses an odd number of
/// times. Exact, ties broken by moving p an infinitesimal step sideways.
///
/// @param p             with exact coordinates
/// @param component_of  of each triangle
/// @param is_closed     of each component; others are passed over
/// @param tree          of this mesh
///
/// Cost: the triangles near the ray upwards from p.
std::vector<std::uint32_t> find_components_around(const Point& p, const TriangleMesh& mesh,
                                                  const std::vector<std::uint32_t>& component_of,
                                                  const std::vector<bool>& is_closed, const TriangleTree& tree);

/// Measures every component.
///
/// The volume is summed from a vertex of the component, so that its error grows with the component's size, not
/// with where it lies. The depth is counted along a ray from one of the vertices, exactly, ties broken by moving
/// the ray an infinitesimal step; where components cross or touch each other it says where that vertex is.
///
/// @param mesh      every triangle has three different vertices, all there, with exact coordinates
///                  (is_exact_coordinate)
/// @param topology  of this mesh
/// @param tree      of this mesh
///
/// Cost: O(n), and for each closed component the triangles near and above its ray. The answer does not depend on
/// the number of threads.
std::vector<ComponentGeometry> measure_components(const TriangleMesh& mesh, const EdgeTopology& topology,
                                                  const TriangleTree& tree);

}  // namespace gaussmesh::verify
