// The mesh while it is improved: connectivity, places on the surface, and how large triangles should be where.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "improve/half_edge_mesh.h"
#include "roots/edge_roots.h"

namespace gaussmesh {

/// Data of all stages of the improvement; vertices of all arrays are numbered alike.
struct WorkingMesh {
  HalfEdgeMesh connectivity;
  std::vector<SurfacePoint> points;
  std::vector<Vec3> at;                  ///< points in A
  std::vector<float> size;               ///< wanted edge (A)
  std::vector<std::uint8_t> is_guarded;  ///< another sheet of the surface is near: triangles are kept apart by exact signs
};

inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator*(double f, const Vec3& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 as_vector(const std::array<float, 3>& n) { return {n[0], n[1], n[2]}; }

/// What decides whether a triangle is good: its smallest angle, and how far it is turned from the field.
struct TriangleQuality {
  double min_sine = 0.0;      ///< sine of the smallest angle (of the angle nearest to 0 or 180 degrees); 0: degenerate
  double normal_cosine = -1.0;  ///< least cosine between its normal and the field's at the corners
};

inline TriangleQuality triangle_quality(const Vec3& p, const Vec3& q, const Vec3& r, const std::array<float, 3>& np,
                                        const std::array<float, 3>& nq, const std::array<float, 3>& nr) {
  const Vec3 u = q - p, v = r - p, w = r - q;
  const Vec3 n = cross(u, v);
  const double area = length(n), uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  TriangleQuality result;
  if (!(area > 0.0)) return result;
  // The smallest angle is opposite to the shortest side: its sine is the doubled area over the other two sides.
  const double least = std::min({uu, vv, ww});
  result.min_sine = area * std::sqrt(least / (uu * vv * ww));
  result.normal_cosine = std::min({dot(n, as_vector(np)), dot(n, as_vector(nq)), dot(n, as_vector(nr))}) / area;
  return result;
}

inline TriangleQuality triangle_quality(const WorkingMesh& m, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return triangle_quality(m.at[a], m.at[b], m.at[c], m.points[a].normal, m.points[b].normal, m.points[c].normal);
}

/// A triangle may be turned this far (cosine) from the field's normals at its corners, or as far as those that it
/// replaces were. 60 degrees: then neighbours on smooth surface stay well within 60 degrees of each other.
inline constexpr double kTurnLimit = 0.5;

}  // namespace gaussmesh
