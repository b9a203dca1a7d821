#include "pipeline/assemble_surface.h"

#include <algorithm>

#include "core/give_back_memory.h"
#include "core/parallel.h"

namespace gaussmesh {
namespace {

/// Vertices that nothing names any more: those behind them move down.
class DeadVertices {
 public:
  explicit DeadVertices(std::vector<std::uint32_t> vertices) : vertices_(std::move(vertices)) {
    std::sort(vertices_.begin(), vertices_.end());
  }

  std::size_t size() const { return vertices_.size(); }

  /// How many are before this vertex, which are as many as it moves down.
  std::size_t count_before(std::uint32_t v) const {
    return static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
  }

  /// Whether the one that `before` of them are before is this vertex.
  bool is_next(std::size_t before, std::size_t v) const { return before < vertices_.size() && vertices_[before] == v; }

 private:
  std::vector<std::uint32_t> vertices_;
};

void put(const SurfacePoint& p, std::size_t at, SurfaceMesh& surface) {
  surface.mesh.vertices[at] = to_angstrom(p.position);
  surface.normals[at] = p.normal;
}

/// Fills the first vertices of the surface.
void put_traced_vertices(const std::vector<SurfacePoint>& roots, const std::vector<SurfacePoint>& added,
                         const DeadVertices& dead, SurfaceMesh& surface, int threads) {
  constexpr std::size_t kPointsAtOnce = 65536;
  parallel_for_chunks(roots.size() + added.size(), kPointsAtOnce, threads,
                      [&](std::size_t, std::size_t first, std::size_t last) {
                        std::size_t before = dead.count_before(static_cast<std::uint32_t>(first));
                        for (std::size_t v = first; v < last; ++v) {
                          if (dead.is_next(before, v)) {
                            ++before;
                          } else {
                            put(v < roots.size() ? roots[v] : added[v - roots.size()], v - before, surface);
                          }
                        }
                      });
}

/// Fills the triangles, and the vertices from `living` on; gives the cells back one by one.
void put_cells(std::deque<PatchedCells>& cells, std::size_t living, const DeadVertices& dead, SurfaceMesh& surface,
               int threads) {
  std::vector<std::size_t> first_triangle{0}, first_point{living};
  for (const PatchedCells& part : cells) {
    first_triangle.push_back(first_triangle.back() + part.triangles.size());
    first_point.push_back(first_point.back() + part.points.size());
  }
  vertex_number(first_point.back());  // the numbers of all are below
  resize_in_parallel(surface.mesh.triangles, first_triangle.back(), threads);
  parallel_for(cells.size(), threads, [&](std::size_t i) {
    PatchedCells& part = cells[i];
    const auto base = static_cast<std::uint32_t>(first_point[i]);
    const auto numbered = [&](std::uint32_t v) {
      return v >= kLocalVertex ? base + (v - kLocalVertex) : v - static_cast<std::uint32_t>(dead.count_before(v));
    };
    std::size_t at = first_triangle[i];
    for (const Triangle& t : part.triangles) {
      surface.mesh.triangles[at++] = {numbered(t[0]), numbered(t[1]), numbered(t[2])};
    }
    for (std::size_t p = 0; p < part.points.size(); ++p) put(part.points[p], base + p, surface);
    part = {};
  });
}

}  // namespace

SurfaceMesh assemble_surface(std::deque<PatchedCells> cells, CellStore& store, TracedVertices& vertices, int threads) {
  std::size_t inner_points = 0;
  for (const PatchedCells& part : cells) inner_points += part.points.size();
  std::vector<SurfacePoint> roots = store.release_roots(), added = vertices.release_added();
  give_back_memory();  // the store's cells and links
  const DeadVertices dead(vertices.dropped());
  const std::size_t living = roots.size() + added.size() - dead.size();
  SurfaceMesh surface;
  resize_in_parallel(surface.mesh.vertices, living + inner_points, threads);
  resize_in_parallel(surface.normals, living + inner_points, threads);
  put_traced_vertices(roots, added, dead, surface, threads);
  for (auto* points : {&roots, &added}) *points = std::vector<SurfacePoint>();  // before there are triangles
  put_cells(cells, living, dead, surface, threads);
  return surface;
}

}  // namespace gaussmesh
