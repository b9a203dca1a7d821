// The distance of a point from a triangle, and from the nearest triangle of a mesh.
#pragma once

#include <cstdint>

#include "gaussmesh/triangle_mesh.h"
#include "verify/triangle_tree.h"

namespace gaussmesh::verify {

/// Square of the distance of `p` from the nearest point of the triangle, which may be a segment or a point.
double distance_sq_to_triangle(const Point& p, const Point& a, const Point& b, const Point& c);

/// A triangle, and the square of a point's distance from it.
struct NearestTriangle {
  std::uint32_t triangle = 0;
  double distance_sq = 0.0;
};

/// The triangle of the mesh that `p` is nearest to; of several one, and always the same for the same guess.
///
/// @param tree   of this mesh, which has a triangle
/// @param guess  any triangle; the search is the shorter the nearer that one is
NearestTriangle find_nearest_triangle(const Point& p, const TriangleMesh& mesh, const TriangleTree& tree,
                                      std::uint32_t guess);

}  // namespace gaussmesh::verify
