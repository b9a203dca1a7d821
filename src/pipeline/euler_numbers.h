// What two meshes of one surface must have in common: the Euler numbers of their components.
#pragma once

#include <cstdint>
#include <vector>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// V - F / 2 of each component of a closed mesh, in rising order. Cost: O(n), 4 bytes a vertex.
std::vector<std::int64_t> euler_numbers(const TriangleMesh& mesh);

/// The same of components that were found by the judge.
std::vector<std::int64_t> euler_numbers(const std::vector<MeshComponent>& components);

}  // namespace gaussmesh
