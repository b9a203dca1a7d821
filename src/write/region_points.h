// A point inside each solid and each cavity of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// A point of the region that a closed component bounds from outside.
struct RegionPoint {
  std::uint32_t component = 0;  ///< place in MeshCheck::components
  Point point{};
};

/// One point for each closed component: inside it, and in none of those inside of it. So the point is in the solid
/// of an outside, and in the void of a cavity.
///
/// The points lie under large triangles, a little way along the normal, and each is proven by exact signs to be in
/// its component and in those that this one lies in, and in no other.
///
/// @param check  of `mesh`, in which no triangle is without a component
/// @throws CannotMeshError if no such point is found under the component's triangles: it is thinner than 1e-6 of
/// them
///
/// Cost: O(n) for the search tree, and one ray for each component and try.
std::vector<RegionPoint> find_region_points(const TriangleMesh& mesh, const MeshCheck& check);

}  // namespace gaussmesh
