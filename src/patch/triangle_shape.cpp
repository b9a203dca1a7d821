#include "patch/triangle_shape.h"

#include <algorithm>
#include <cmath>

#include "core/vectors.h"

namespace gaussmesh {
namespace {

Vec3 difference(const CoordPoint& p, const CoordPoint& q) {
  return {static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]), static_cast<double>(p[2] - q[2])};
}

/// Of vectors of any length.
double cosine_between(const Vec3& n, const Normal& direction) {
  const Vec3 d = as_vector(direction);
  return dot(n, d) / (std::sqrt(dot(n, n) * dot(d, d)) + 1e-300);
}

Vec3 area_normal(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r) {
  return cross(difference(q.position, p.position), difference(r.position, p.position));
}

/// A triangle's sides, normal and the field's normal at its corners.
struct Geometry {
  Geometry(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r) {
    const Vec3 u = difference(q.position, p.position), v = difference(r.position, p.position);
    const Vec3 w = difference(r.position, q.position);
    const Vec3 n = cross(u, v);
    Vec3 field{};
    for (int k = 0; k < 3; ++k) field[k] = double(p.normal[k]) + double(q.normal[k]) + double(r.normal[k]);
    doubled_area = std::sqrt(dot(n, n));
    edges_sq = dot(u, u) + dot(v, v) + dot(w, w);
    cosine = dot(n, field) / (doubled_area * std::sqrt(dot(field, field)) + 1e-300);
  }
  double doubled_area = 0.0;
  double edges_sq = 0.0;
  double cosine = 0.0;
};

}  // namespace

double normal_cosine(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r, const Normal& direction) {
  return cosine_between(area_normal(p, q, r), direction);
}

double least_normal_cosine(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r) {
  const Vec3 n = area_normal(p, q, r);
  return std::min({cosine_between(n, p.normal), cosine_between(n, q.normal), cosine_between(n, r.normal)});
}

LongestSide longest_side(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r) {
  double length_sq = 0.0;  // of coordinates
  LongestSide longest;
  for (const auto& [a, b] : {std::pair(&p, &q), std::pair(&q, &r), std::pair(&r, &p)}) {
    const Vec3 side = difference(b->position, a->position);
    if (dot(side, side) <= length_sq) continue;
    length_sq = dot(side, side);
    const Vec3 from = to_angstrom(a->position), to = to_angstrom(b->position);
    for (int k = 0; k < 3; ++k) longest.middle[k] = 0.5 * (from[k] + to[k]);
  }
  const Vec3 n = area_normal(p, q, r);
  longest.length = std::sqrt(length_sq) / kUnitsPerAngstrom;
  longest.height = std::sqrt(dot(n, n) / length_sq) / kUnitsPerAngstrom;
  return longest;
}

double shape_cost(const SurfacePoint& p, const SurfacePoint& q, const SurfacePoint& r) {
  const Geometry triangle(p, q, r);
  if (triangle.doubled_area == 0.0) return 10.0 * kTurnedTriangle;
  const double cosine = triangle.cosine;
  const double quality = 2.0 * std::sqrt(3.0) * triangle.doubled_area / triangle.edges_sq;
  // Within 60 degrees of the field's normal shape decides; beyond, the normal.
  if (cosine >= 0.5) return 1.0 - quality + 2.0 * (1.0 - cosine);
  constexpr double kCosineOfTurned = 0.087;
  if (cosine >= kCosineOfTurned) return 1.0 - quality + kPoorTriangle * (1.0 + 4.0 * (0.5 - cosine));
  return 1.0 - quality + kTurnedTriangle * (1.0 + (kCosineOfTurned - cosine));
}

}  // namespace gaussmesh
