// Where another sheet of the surface is near.
#pragma once

#include <cstdint>
#include <vector>

#include "improve/block_mesh.h"

namespace gaussmesh {

/// Which vertices of a block have one of another sheet near: whose normal differs by more than 75 degrees, and which is
/// nearer than the larger of their wanted sizes; also those that stay where they are, since what moves is tested
/// against their triangles.
/// @return by vertex: 0 or 1
/// Cost: O(n log n), whatever the sizes, unless much of a sheet is nearer to others than its triangles are large.
std::vector<std::uint8_t> find_close_sheets(const BlockMesh& mesh);

}  // namespace gaussmesh
