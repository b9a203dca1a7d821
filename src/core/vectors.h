// Arithmetic of points and directions.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/lattice.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// Distance of a coordinate from an interval, zero inside.
inline double gap(double p, double lo, double hi) { return std::max(0.0, std::max(lo - p, p - hi)); }

inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator*(double f, const Vec3& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double dot(const Vec3& a, const Normal& b) {
  return a[0] * double(b[0]) + a[1] * double(b[1]) + a[2] * double(b[2]);
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 as_vector(const Normal& n) { return {double(n[0]), double(n[1]), double(n[2])}; }

/// A box with `by` (A) more on every side.
inline Box widened(Box box, double by) {
  for (int k = 0; k < 3; ++k) {
    box.lo[k] -= by;
    box.hi[k] += by;
  }
  return box;
}

/// The nearest place that has whole units as coordinates.
inline CoordPoint to_units(const Vec3& p) {
  return {std::llround(p[0] * kUnitsPerAngstrom), std::llround(p[1] * kUnitsPerAngstrom),
          std::llround(p[2] * kUnitsPerAngstrom)};
}

/// The same as the double that a reader of the decimals gets. Halves go to even.
inline Vec3 round_to_units(const Vec3& p) {
  constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves no place for a fraction
  Vec3 result;
  for (int k = 0; k < 3; ++k) result[k] = (p[k] * kUnitsPerAngstrom + kWhole - kWhole) / kUnitsPerAngstrom;
  return result;
}

}  // namespace gaussmesh
