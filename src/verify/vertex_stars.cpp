#include "verify/vertex_stars.h"

#include <omp.h>

#include <numeric>

namespace gaussmesh::verify {
namespace {

/// The vertices that a thread counts the triangles of: every thread goes through all triangles, and writes to its
/// own.
struct VertexRange {
  std::uint32_t begin = 0;
  std::uint32_t size = 0;

  bool contains(std::uint32_t vertex) const { return vertex - begin < size; }
};

VertexRange range_of_thread(std::size_t vertices) {
  const auto threads = static_cast<std::size_t>(omp_get_num_threads());
  const auto thread = static_cast<std::size_t>(omp_get_thread_num());
  const std::size_t begin = vertices * thread / threads;
  return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(vertices * (thread + 1) / threads - begin)};
}

}  // namespace

VertexStars::VertexStars(const TriangleMesh& mesh)
    : start_(mesh.vertices.size() + 1),
      triangles_(std::make_unique_for_overwrite<std::uint32_t[]>(3 * mesh.triangles.size())) {
#pragma omp parallel
  {
    const VertexRange mine = range_of_thread(mesh.vertices.size());
    for (const Triangle& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle)
        if (mine.contains(vertex)) ++start_[vertex];
  }
  std::inclusive_scan(start_.begin(), start_.end(), start_.begin());
#pragma omp parallel
  {
    const VertexRange mine = range_of_thread(mesh.vertices.size());
    for (std::size_t t = mesh.triangles.size(); t-- > 0;)  // backwards, so that each star is in rising order
      for (const std::uint32_t vertex : mesh.triangles[t])
        if (mine.contains(vertex)) triangles_[--start_[vertex]] = static_cast<std::uint32_t>(t);
  }
}

}  // namespace gaussmesh::verify
