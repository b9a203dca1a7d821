// All pairs of triangles of a mesh that meet where they should not.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/flat_fans.h"
#include "verify/triangle_tree.h"

namespace gaussmesh::verify {

/// How many pairs of triangles meet, and which.
struct Intersections {
  std::size_t pairs = 0;
  std::vector<std::array<std::uint32_t, 2>> examples;  ///< the first few in order of their numbers, lower one first
};

/// Finds every pair of triangles that meet in more than a shared vertex or a shared edge ((c) of a manifold mesh in
/// [LCL15]; triangle_pair.h says what that means exactly). Touching counts; so does a duplicate triangle.
///
/// @param mesh  every triangle has three different vertices, all there, with exact coordinates
///              (is_exact_coordinate)
/// @param tree   of this mesh
/// @param facts  of this mesh: triangles that share a vertex with a flat fan are not set against each other
///
/// The answer does not depend on the number of threads.
/// Cost: time in proportion to the triangles and to the pairs of triangles whose boxes meet; next to no memory.
Intersections find_intersections(const TriangleMesh& mesh, const TriangleTree& tree, const FanFacts& facts);

}  // namespace gaussmesh::verify
