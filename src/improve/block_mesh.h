// One block of the mesh while it is improved: connectivity, places on the surface, and how large triangles should
// be.
#pragma once

#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "core/vectors.h"
#include "improve/block_field.h"
#include "improve/half_edge_mesh.h"

namespace gaussmesh {

/// Whether a half-open box holds a point.
inline bool is_in(const Box& box, const Vec3& p) {
  for (int k = 0; k < 3; ++k) {
    if (!(p[k] >= box.lo[k] && p[k] < box.hi[k])) return false;
  }
  return true;
}

/// Keeps the first entries of an array alone and makes room for others behind them, `count` in all: where few are kept,
/// what they need is given back first.
template <typename T>
void resize_beyond(std::vector<T>& array, std::size_t kept, std::size_t count, int threads) {
  array.resize(kept);
  if (kept < array.capacity() / 2) array.shrink_to_fit();
  resize_in_parallel(array, count, threads);
}

/// What is known of vertices, as arrays that are numbered alike.
struct MeshVertices {
  std::vector<Vec3> at;  ///< A, whole units
  std::vector<Normal> normal;
  std::vector<float> size;        ///< wanted edge (A)
  std::vector<float> curvature;   ///< what of it counts for the size (1/A), as size_field.cpp says; negative: unknown
  std::vector<float> refinement;  ///< factor of the size where neighbouring triangles turned too far

  /// Calls visit(array) for each of them.
  template <typename Visit>
  void visit_arrays(const Visit& visit) {
    visit(at);
    visit(normal);
    visit(size);
    visit(curvature);
    visit(refinement);
  }
  /// Calls visit(array, the same one of `other`) for each of them.
  template <typename Visit>
  void visit_arrays(const MeshVertices& other, const Visit& visit) {
    visit(at, other.at);
    visit(normal, other.normal);
    visit(size, other.size);
    visit(curvature, other.curvature);
    visit(refinement, other.refinement);
  }

  void reserve(std::size_t count) {
    visit_arrays([&](auto& array) { array.reserve(count); });
  }
  void resize(std::size_t count) {
    visit_arrays([&](auto& array) { array.resize(count); });
  }
  void append(const MeshVertices& from, std::size_t v) {
    visit_arrays(from, [&](auto& array, const auto& others) { array.push_back(others[v]); });
  }
  /// Keeps the first ones alone and makes room for others behind them, `count` in all.
  void resize_beyond(std::size_t kept, std::size_t count, int threads) {
    visit_arrays([&](auto& array) { gaussmesh::resize_beyond(array, kept, count, threads); });
  }
  void move(std::size_t from, std::size_t to) {
    visit_arrays([&](auto& array) { array[to] = array[from]; });
  }
  /// Overwrites those from `first` on by all of `from`.
  void replace(std::size_t first, const MeshVertices& from) {
    visit_arrays(from, [&](auto& array, const auto& others) {
      std::copy(others.begin(), others.end(), array.begin() + static_cast<std::ptrdiff_t>(first));
    });
  }
};

/// Vertices: first those of the block, then those outside of it that fixed triangles have, then the new ones.
struct BlockMesh : MeshVertices {
  HalfEdgeMesh connectivity;             ///< of the triangles that lie in the block
  std::vector<Triangle> fixed;           ///< those that only reach into it, and stay as they are
  std::vector<std::uint8_t> is_active;   ///< to be worked on
  std::vector<std::uint8_t> is_guarded;  ///< another sheet is near: triangles are kept apart by exact signs
  Box box;                               ///< vertices stay inside

  void put(std::uint32_t v, const Place& place) {
    at[v] = place.at;
    normal[v] = place.normal;
  }
  bool contains(const Vec3& p) const { return is_in(box, p); }
};

/// Normal of a triangle, as long as its doubled area.
inline Vec3 area_normal(const MeshVertices& m, const Triangle& t) {
  return cross(m.at[t[1]] - m.at[t[0]], m.at[t[2]] - m.at[t[0]]);
}
inline Vec3 area_normal(const BlockMesh& m, std::uint32_t t) { return area_normal(m, m.connectivity.triangle(t)); }

/// Neighbours turn against each other by less than this (cosine; 58.7 degrees).
inline constexpr double kSharpTurn = 0.52;

/// Whether triangles with these normals, of any length, turn farther.
inline bool turn_sharply(const Vec3& m, const Vec3& n) {
  const double cosine = dot(m, n);
  return !(cosine > 0.0 && cosine * cosine >= kSharpTurn * kSharpTurn * dot(m, m) * dot(n, n));
}

/// What decides whether a triangle is good: its smallest angle, and how far it is turned from the field.
struct TriangleQuality {
  double min_sine = 0.0;        ///< sine of the smallest angle; 0: degenerate
  double normal_cosine = -1.0;  ///< least cosine between its normal and the field's at the corners
};

inline constexpr TriangleQuality kPerfect{1.0, 1.0};

inline TriangleQuality worse(const TriangleQuality& a, const TriangleQuality& b) {
  return {std::min(a.min_sine, b.min_sine), std::min(a.normal_cosine, b.normal_cosine)};
}

inline TriangleQuality triangle_quality(const Vec3& p, const Vec3& q, const Vec3& r, const Normal& np, const Normal& nq,
                                        const Normal& nr) {
  const Vec3 u = q - p, v = r - p, w = r - q;
  const Vec3 n = cross(u, v);
  const double nn = dot(n, n), uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  TriangleQuality result;
  if (!(nn > 0.0)) return result;
  // The smallest angle is opposite to the shortest side: its sine is the doubled area over the other two sides.
  const double least = std::min({uu, vv, ww});
  result.min_sine = std::sqrt(nn * least / (uu * vv * ww));
  result.normal_cosine = std::min({dot(n, np), dot(n, nq), dot(n, nr)}) / std::sqrt(nn);
  return result;
}

inline TriangleQuality triangle_quality(const MeshVertices& m, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return triangle_quality(m.at[a], m.at[b], m.at[c], m.normal[a], m.normal[b], m.normal[c]);
}

inline TriangleQuality triangle_quality(const BlockMesh& m, std::uint32_t t) {
  const Triangle v = m.connectivity.triangle(t);
  return triangle_quality(m, v[0], v[1], v[2]);
}

/// Whether a triangle has no angle with a smaller sine, and is turned by no more from the field; without roots.
inline bool is_at_least(const MeshVertices& m, const Triangle& v, const TriangleQuality& limit) {
  const Vec3 a = m.at[v[1]] - m.at[v[0]], b = m.at[v[2]] - m.at[v[0]], c = m.at[v[2]] - m.at[v[1]];
  const Vec3 n = cross(a, b);
  const double nn = dot(n, n), aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  const double least = std::min({dot(n, m.normal[v[0]]), dot(n, m.normal[v[1]]), dot(n, m.normal[v[2]])});
  return nn > 0.0 && nn * std::min({aa, bb, cc}) >= limit.min_sine * limit.min_sine * aa * bb * cc && least > 0.0 &&
         least * least >= limit.normal_cosine * limit.normal_cosine * nn;
}
inline bool is_at_least(const BlockMesh& m, std::uint32_t t, const TriangleQuality& limit) {
  return is_at_least(m, m.connectivity.triangle(t), limit);
}

/// Of the triangles round an inner vertex.
inline TriangleQuality star_quality(const BlockMesh& mesh, std::uint32_t vertex) {
  TriangleQuality quality = kPerfect;
  mesh.connectivity.visit_star(vertex,
                               [&](std::uint32_t h) { quality = worse(quality, triangle_quality(mesh, h / 3)); });
  return quality;
}

/// A triangle may be turned this far (cosine; 50 degrees) from the field's normals at its corners, or as far as
/// those that it replaces were. An equilateral triangle of edge s on a surface of curvature k is turned by k s /
/// sqrt(3).
inline constexpr double kTurnLimit = 0.64;

/// Whether triangles may take the place of others, as far as the field goes.
inline bool turn_is_allowed(const TriangleQuality& before, const TriangleQuality& after) {
  return after.min_sine > 0.0 && after.normal_cosine >= std::min(kTurnLimit, before.normal_cosine);
}

}  // namespace gaussmesh
