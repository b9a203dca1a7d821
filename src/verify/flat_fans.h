// Fans of triangles that lie side by side when looked at along an axis: nothing in them can meet.
#pragma once

#include <cstdint>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/edge_topology.h"
#include "verify/vertex_stars.h"

namespace gaussmesh::verify {

/// How a triangle turns seen along the three axes: bit k counter-clockwise, bit 3 + k clockwise, seen from the far
/// end of axis k. No bit: it has zero area.
using Turns = std::uint8_t;

/// What was found out of the fans of a mesh.
struct FanFacts {
  std::vector<Turns> turns;  ///< of each triangle
  /// For each vertex 1 if its triangles are one closed fan that is unfolded seen along some axis: all turn the same
  /// way, and once round. Then no two of them meet in more than what their common vertices span, since each is the
  /// only thing over its sector, and over the ray between two sectors is the common edge. Else 0: nothing is known.
  std::vector<std::uint8_t> is_flat;
};

/// Finds turns and flat fans, exactly. Most fans of a mesh of a smooth surface are flat.
///
/// @param mesh  every triangle has three different vertices, all there, with exact coordinates
/// (is_exact_coordinate)
///
/// Cost: a few operations a triangle, 1 byte a triangle and a vertex. The answer does not depend on the number of
/// threads.
FanFacts find_flat_fans(const TriangleMesh& mesh, const VertexStars& stars, const EdgeTopology& topology);

}  // namespace gaussmesh::verify
