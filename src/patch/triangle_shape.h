// How good a triangle is as a piece of the surface.
#pragma once

#include "roots/edge_roots.h"

namespace gaussmesh {

/// From here on a triangle's cost says that it is turned more than 60 degrees from the surface: see shape_cost().
inline constexpr double kPoorTriangle = 10.0;

/// From here on it says that it is turned more than 85 degrees. More than all others of a polygon can add up to, so
/// that the sum of their costs tells whether there is one.
inline constexpr double kTurnedTriangle = 1e4;

/// Cosine of the angle between the normal of the triangle p q r and a direction.
double normal_cosine(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r, const Normal& direction);

/// The least of these over the field's normals at the three corners.
double least_normal_cosine(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r);

/// The longest side of a triangle (A).
struct LongestSide {
  Vec3 middle{};
  double length = 0.0;
  double height = 0.0;  ///< of the triangle over it
};
LongestSide longest_side(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r);

/// Cost of the triangle p q r in a triangulation, >= 0, to be added up: 1 minus its quality 4 sqrt(3) area / sum of
/// squared edges, and 2 (1 - cosine) of the angle between its normal and the field's mean at its corners; much more
/// where they are far apart.
double shape_cost(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r);

}  // namespace gaussmesh
