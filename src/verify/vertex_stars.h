// The triangles round each vertex of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh::verify {

/// The numbers of the triangles at each vertex, in one array.
///
/// Memory: 12 bytes a triangle and 8 a vertex. Reading it is thread-safe.
class VertexStars {
 public:
  /// @param mesh  every vertex number is there
  explicit VertexStars(const TriangleMesh& mesh);

  /// In rising order; a triangle that names the vertex twice is there twice.
  std::span<const std::uint32_t> star(std::size_t vertex) const {
    return {triangles_.get() + start_[vertex], start_[vertex + 1] - start_[vertex]};
  }

  std::size_t vertex_count() const { return start_.size() - 1; }

 private:
  std::vector<std::size_t> start_;
  std::unique_ptr<std::uint32_t[]> triangles_;  // first written to by several threads, each its part
};

/// The two other vertices of a triangle, in the order in which it turns from `vertex` on.
inline std::array<std::uint32_t, 2> others(const Triangle& triangle, std::uint32_t vertex) {
  if (triangle[0] == vertex) return {triangle[1], triangle[2]};
  if (triangle[1] == vertex) return {triangle[2], triangle[0]};
  return {triangle[0], triangle[1]};
}

}  // namespace gaussmesh::verify
