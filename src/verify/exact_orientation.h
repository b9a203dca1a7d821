// Exact signs of orientation: on which side of a line or a plane a point lies.
//
// A filter answers nearly always: the determinant in floating point, and a bound of its error. Where the bound
// does not decide, the determinant is evaluated exactly (expansion.h). Every decision of the judge that is not
// counting stands on these signs.
#pragma once

#include <array>
#include <cmath>

#include "gaussmesh/triangle_mesh.h"
#include "verify/expansion.h"

namespace gaussmesh::verify {

using PlanePoint = std::array<double, 2>;  ///< a point projected along an axis

/// Coordinates between these sizes, or exactly 0, make exact signs: every difference of two of them is 0 or a
/// multiple of 2^-252, so that products of three neither underflow nor overflow, nor do their rounding errors.
inline constexpr double kSmallestExact = 0x1p-200;
inline constexpr double kLargestExact = 0x1p200;

/// Whether the orientation signs are exact for a point with this coordinate; false for NaN and infinity.
inline bool is_exact_coordinate(double x) {
  return x == 0.0 || (std::abs(x) >= kSmallestExact && std::abs(x) <= kLargestExact);
}

/// `point` without its coordinate `axis`; a counter-clockwise turn seen from +axis stays one.
inline PlanePoint project_along(int axis, const Point& point) { return {point[(axis + 1) % 3], point[(axis + 2) % 3]}; }

/// Sign of the area of the triangle a, b, c: +1 counter-clockwise, -1 clockwise, 0 collinear. Exact.
int orient2d(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Sign of (b - a) x (c - a) . (d - a): +1 if d is where a, b, c look counter-clockwise from, 0 if coplanar. Exact.
int orient3d(const Point& a, const Point& b, const Point& c, const Point& d);

/// The exact value of (b - a) x (c - a) . (d - a): six times the volume of the tetrahedron.
Expansion<192> exact_determinant(const Point& a, const Point& b, const Point& c, const Point& d);

/// The plane through a, b and c, made ready to tell the sides of many points: side(d) is orient3d(a, b, c, d).
class OrientedPlane {
 public:
  OrientedPlane() = default;
  OrientedPlane(const Point& a, const Point& b, const Point& c);

  int side(const Point& d) const;

 private:
  Point a_{}, b_{}, c_{};
  Point normal_{};       // (b - a) x (c - a), rounded
  Point normal_size_{};  // the same with every product taken positive: what the error is in proportion to
};

/// Share of the sum of the products' sizes that a rounded orient3d may be wrong by.
///
/// Each of the six products of three differences goes through three differences, two products, one sum inside
/// the normal and two outside it: eight roundings, each by a factor 1 + u, u = 2^-53. The sum of sizes is itself
/// rounded, by nine more. ((1 + u)^8 - 1) / (1 - u)^9 < 9u; the tenth u is to spare.
inline constexpr double kOrient3dError = 10 * 0x1p-53;

inline OrientedPlane::OrientedPlane(const Point& a, const Point& b, const Point& c) : a_(a), b_(b), c_(c) {
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3;
    const int k2 = (k + 2) % 3;
    const double plus = (b[k1] - a[k1]) * (c[k2] - a[k2]);
    const double minus = (b[k2] - a[k2]) * (c[k1] - a[k1]);
    normal_[k] = plus - minus;
    normal_size_[k] = std::abs(plus) + std::abs(minus);
  }
}

inline int OrientedPlane::side(const Point& d) const {
  const double x = d[0] - a_[0];
  const double y = d[1] - a_[1];
  const double z = d[2] - a_[2];
  const double determinant = normal_[0] * x + normal_[1] * y + normal_[2] * z;
  const double size = normal_size_[0] * std::abs(x) + normal_size_[1] * std::abs(y) + normal_size_[2] * std::abs(z);
  const double bound = kOrient3dError * size;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return size == 0.0 ? 0 : exact_determinant(a_, b_, c_, d).sign();
}

}  // namespace gaussmesh::verify
