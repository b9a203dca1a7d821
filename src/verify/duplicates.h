// Vertices at the very place of another.
#pragma once

#include <cstddef>
#include <vector>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh::verify {

/// The number of vertices at the very place of an earlier one; those without exact coordinates do not count.
///
/// @param points  fewer than 2^32
/// Cost: O(n), 8 bytes a vertex. The answer does not depend on the number of threads.
std::size_t count_duplicates(const std::vector<Point>& points);

}  // namespace gaussmesh::verify
