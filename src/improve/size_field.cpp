#include "improve/size_field.h"

#include "core/parallel.h"
#include "improve/surface_projector.h"

namespace gaussmesh {

std::vector<float> wanted_sizes(const WorkingMesh& mesh, const GaussianField& field, double spacing, int threads) {
  constexpr std::size_t kBlock = 512;
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<float> size(c.vertices(), static_cast<float>(spacing));
  parallel_for((c.vertices() + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    SurfaceProjector projector(field);
    for (std::size_t v = block * kBlock; v < std::min<std::size_t>(c.vertices(), (block + 1) * kBlock); ++v) {
      if (!c.has_vertex(static_cast<std::uint32_t>(v))) continue;
      const double curvature = projector.curvature(mesh.at[v]);
      size[v] = static_cast<float>(std::clamp(kTurnPerEdge / curvature, kLeastSize * spacing, spacing));
    }
  });
  // Sizes grow slowly away from small ones: sweeps until nothing changes, few of them since sizes span a factor of 4.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t h = 0; h < c.half_edges(); ++h) {
      if (!c.has_triangle(h / 3)) continue;
      const std::uint32_t u = c.from(h), v = c.to(h);
      const auto most = static_cast<float>(double(size[u]) + kGrowth * length(mesh.at[v] - mesh.at[u]));
      if (size[v] > most * 1.0001f) {
        size[v] = most;
        changed = true;
      }
    }
  }
  return size;
}

}  // namespace gaussmesh
