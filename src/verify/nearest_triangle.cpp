#include "verify/nearest_triangle.h"

#include <algorithm>

#include "verify/vector3.h"

namespace gaussmesh::verify {
namespace {

double distance_sq_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = difference(b, a);
  const Point arm = difference(p, a);
  const double length_sq = dot(along, along);
  const double place = length_sq > 0.0 ? std::clamp(dot(arm, along) / length_sq, 0.0, 1.0) : 0.0;
  Point rest{};
  for (int k = 0; k < 3; ++k) rest[k] = arm[k] - place * along[k];
  return dot(rest, rest);
}

double distance_sq_to_number(const Point& p, const TriangleMesh& mesh, std::uint32_t number) {
  const auto& [a, b, c] = mesh.triangles[number];
  return distance_sq_to_triangle(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
}

}  // namespace

double distance_sq_to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = difference(b, a);
  const Point ac = difference(c, a);
  const Point ap = difference(p, a);
  const Point normal = cross(ab, ac);
  const double size_sq = dot(normal, normal);
  if (size_sq > 0.0) {  // over the inside if the barycentric coordinates of the foot are not negative
    const double at_b = dot(cross(ap, ac), normal);
    const double at_c = dot(cross(ab, ap), normal);
    if (at_b >= 0.0 && at_c >= 0.0 && at_b + at_c <= size_sq) {
      const double height = dot(ap, normal);
      return height * height / size_sq;
    }
  }
  return std::min({distance_sq_to_segment(p, a, b), distance_sq_to_segment(p, b, c), distance_sq_to_segment(p, c, a)});
}

NearestTriangle find_nearest_triangle(const Point& p, const TriangleMesh& mesh, const TriangleTree& tree,
                                      std::uint32_t guess) {
  NearestTriangle best{guess, distance_sq_to_number(p, mesh, guess)};
  tree.for_each_block_nearer(p, best.distance_sq, [&](std::span<const std::uint32_t> block) {
    for (const std::uint32_t number : block) {
      const double distance_sq = distance_sq_to_number(p, mesh, number);
      if (distance_sq < best.distance_sq) best = {number, distance_sq};
    }
  });
  return best;
}

}  // namespace gaussmesh::verify
