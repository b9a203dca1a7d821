// A triangle mesh that can be changed: split, collapse and flip of edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// Connectivity of an oriented 2-manifold of triangles, with or without boundary. Geometry is the caller's.
///
/// Half-edge 3 t + i runs from corner i of triangle t to corner i + 1. A vertex is inner if the triangles round it
/// are a closed fan. Operations keep the mesh a manifold of the same topology, and its boundary as it is, where
/// can_flip() or can_collapse() allowed them; they do not look at that themselves.
class HalfEdgeMesh {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = 0xFFFFFFFFu;

  /// @param triangles  part of a closed, oriented manifold; vertices are 0 .. vertex_count - 1. Cost: O(n)
  HalfEdgeMesh(std::span<const Triangle> triangles, std::size_t vertex_count);

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// kNone on the boundary.
  Index twin(Index h) const { return twin_[h]; }
  /// The vertices at the beginning and the end of a half-edge, and the one across from it in its triangle.
  Index from(Index h) const { return corners_[h]; }
  Index to(Index h) const { return corners_[next(h)]; }
  Index opposite(Index h) const { return corners_[previous(h)]; }
  Triangle triangle(Index t) const { return {corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]}; }
  bool has_triangle(Index t) const { return corners_[3 * t] != kNone; }
  bool has_vertex(Index v) const { return out_[v] != kNone; }
  bool is_inner(Index v) const { return inner_[v]; }

  Index half_edges() const { return static_cast<Index>(corners_.size()); }
  Index triangles() const { return static_cast<Index>(corners_.size() / 3); }
  Index vertices() const { return static_cast<Index>(out_.size()); }

  /// Calls visit(h) for every half-edge that leaves v, clockwise. For inner vertices.
  template <typename Visit>
  void visit_star(Index v, const Visit& visit) const {
    const Index start = out_[v];
    Index h = start;
    do {
      visit(h);
      h = twin_[previous(h)];
    } while (h != start);
  }
  /// Of an inner vertex.
  int valence(Index v) const;
  /// u is inner.
  bool are_neighbours(Index u, Index v) const;

  /// Whether the edge, not on the boundary, may turn within its two triangles: the other diagonal is not an edge
  /// yet, and no valence falls below 3. Refused where the fans that tell are not all here.
  bool can_flip(Index h) const;
  /// @param h  can_flip(h)
  void flip(Index h);

  /// Link condition: the ends have exactly two neighbours in common, and those keep a valence of 3 at least. Refused
  /// unless all four are inner.
  bool can_collapse(Index h) const;
  /// Moves from(h) into to(h): the vertex from(h) and two triangles are gone. @param h  can_collapse(h)
  void collapse(Index h);

  /// Puts a new vertex in an edge that is not on the boundary. @return its number, the next one: vertices() before
  /// the call
  Index split(Index h);

 private:
  void set_triangle(Index t, Index a, Index b, Index c);
  void link(Index h, Index g);
  void remove_triangle(Index t);

  std::vector<Index> corners_;
  std::vector<Index> twin_;
  std::vector<Index> out_;  ///< a half-edge that leaves the vertex
  std::vector<std::uint8_t> inner_;
};

}  // namespace gaussmesh
