// Whether two triangles of a mesh meet where they should not, exactly.
#pragma once

#include <array>

#include "gaussmesh/triangle_mesh.h"
#include "verify/exact_orientation.h"

namespace gaussmesh::verify {

/// A triangle with what a test against others asks for at hand. Its three vertex numbers differ.
struct PlacedTriangle {
  Triangle vertices{};
  std::array<Point, 3> corners{};
  OrientedPlane plane;

  PlacedTriangle() = default;
  PlacedTriangle(const TriangleMesh& mesh, const Triangle& triangle)
      : vertices(triangle),
        corners{mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]},
        plane(corners[0], corners[1], corners[2]) {}
};

/// Whether the triangles, as closed sets of points, meet in more than what their common vertices span.
///
/// No common vertex: whether they meet at all; touching counts. One: whether they meet anywhere but there. Two:
/// whether they meet anywhere but in the edge between them, which only coplanar ones can. Three: true.
/// Exact for every configuration. Neither may have zero area.
bool meet_beyond_shared(const PlacedTriangle& s, const PlacedTriangle& t);

}  // namespace gaussmesh::verify
