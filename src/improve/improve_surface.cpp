#include "improve/improve_surface.h"


#include "improve/edge_operations.h"
#include "improve/relax.h"
#include "improve/repair.h"
#include "improve/size_field.h"

namespace gaussmesh {
namespace {

/// Edges beyond these factors of the wanted size are split or collapsed. Their geometric mean and the relaxation
/// between make the mean edge what is wanted.
constexpr double kSplitFactor = 1.35;
constexpr double kCollapseFactor = 0.7;

constexpr int kRounds = 6;
constexpr int kFinalRelaxations = 4;
constexpr double kLeastAngle = 31.0;   // degrees; a little above what is promised
constexpr int kRepairRounds = 6;

WorkingMesh start_with(const SurfaceMesh& traced) {
  WorkingMesh mesh{HalfEdgeMesh(traced.triangles, traced.points.size()), traced.points, {}, {}, {}};
  mesh.at.reserve(traced.points.size());
  for (const SurfacePoint& p : traced.points) mesh.at.push_back(to_angstrom(p.position));
  mesh.size.assign(traced.points.size(), 0.0f);
  mesh.is_guarded.assign(traced.points.size(), 0);
  return mesh;
}

SurfaceMesh finish(const WorkingMesh& mesh) {
  SurfaceMesh result;
  std::vector<std::uint32_t> number(mesh.points.size(), HalfEdgeMesh::kNone);
  result.triangles = mesh.connectivity.live_triangles();
  for (Triangle& t : result.triangles) {
    for (std::uint32_t& v : t) {
      if (number[v] == HalfEdgeMesh::kNone) {
        number[v] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh.points[v]);
      }
      v = number[v];
    }
  }
  return result;
}

}  // namespace

ImproveResult improve_surface(const SurfaceMesh& traced, const GaussianField& field, double spacing, int threads) {
  WorkingMesh mesh = start_with(traced);
  mesh.size = wanted_sizes(mesh, field, spacing, threads);
  mesh.is_guarded = mark_close_sheets(mesh, 1.2 * spacing);
  SheetGuard guard(mesh, spacing);
  ImproveResult result;
  ImproveCounts& counts = result.counts;
  for (int round = 0; round < kRounds; ++round) {
    counts.splits += split_long_edges(mesh, guard, field, kSplitFactor, threads);
    counts.collapses += collapse_short_edges(mesh, guard, kCollapseFactor);
    counts.flips += flip_edges(mesh, guard);
    counts.flips += even_out_valences(mesh, guard);
    counts.moves += relax_vertices(mesh, guard, field, threads);
  }
  for (int i = 0; i < kFinalRelaxations; ++i) {
    counts.flips += flip_edges(mesh, guard);
    counts.moves += relax_vertices(mesh, guard, field, threads);
  }
  repair_triangles(mesh, guard, field, kLeastAngle, kRepairRounds);
  result.mesh = finish(mesh);
  return result;
}

}  // namespace gaussmesh
