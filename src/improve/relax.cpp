#include "improve/relax.h"

#include "core/parallel.h"
#include "improve/surface_projector.h"

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;
constexpr std::size_t kBlock = 512;

template <typename Work>
void for_blocks(std::size_t count, int threads, const Work& work) {
  parallel_for((count + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    work(block * kBlock, std::min(count, (block + 1) * kBlock));
  });
}

/// Where Lloyd's iteration wants a vertex, in its tangent plane.
Vec3 wanted_place(const WorkingMesh& mesh, Index v) {
  const HalfEdgeMesh& c = mesh.connectivity;
  const Vec3 p = mesh.at[v];
  Vec3 sum{};
  double total = 0.0;
  c.visit_star(v, [&](Index h) {
    const Index a = c.to(h), b = c.opposite(h);
    const Vec3 u = mesh.at[a] - p, w = mesh.at[b] - p;
    const double size = (double(mesh.size[v]) + double(mesh.size[a]) + double(mesh.size[b])) / 3.0;
    const double weight = length(cross(u, w)) / (size * size * size * size);
    sum = sum + weight / 3.0 * (u + w);
    total += weight;
  });
  const Vec3 move = 1.0 / total * sum, n = as_vector(mesh.points[v].normal);
  return p + (move - dot(move, n) * n);
}

/// Places before and after a step, and which vertices take it.
struct Step {
  std::vector<SurfacePoint> before;
  std::vector<std::uint8_t> moves;
};

void move_back(WorkingMesh& mesh, Step& step, Index v) {
  step.moves[v] = 0;
  mesh.points[v] = step.before[v];
  mesh.at[v] = to_angstrom(step.before[v].position);
}

/// Takes back the moves of vertices whose triangles have gone bad, until none is left. @return whether it took any
bool take_back_bad_moves(WorkingMesh& mesh, Step& step, const std::vector<TriangleQuality>& before, int threads) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<std::uint8_t> is_bad(c.triangles(), 0);
  bool any = false;
  for (bool again = true; again; any = any || again) {
    again = false;
    for_blocks(c.triangles(), threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        is_bad[t] = 0;
        if (!c.has_triangle(static_cast<Index>(t))) continue;
        const Triangle v = c.triangle(static_cast<Index>(t));
        if (!step.moves[v[0]] && !step.moves[v[1]] && !step.moves[v[2]]) continue;
        const TriangleQuality q = triangle_quality(mesh, v[0], v[1], v[2]);
        is_bad[t] = !(q.min_sine >= std::min(0.3, before[t].min_sine) &&
                      q.normal_cosine >= std::min(kTurnLimit, before[t].normal_cosine));
      }
    });
    for (Index t = 0; t < c.triangles(); ++t) {
      if (!is_bad[t]) continue;
      again = true;
      for (Index v : c.triangle(t)) {
        if (step.moves[v]) move_back(mesh, step, v);
      }
    }
  }
  return any;
}

/// The same for triangles near other sheets that now meet. @return whether it took any
bool take_back_meetings(WorkingMesh& mesh, SheetGuard& guard, Step& step) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<Index> meeting;
  for (Index t = 0; t < c.triangles(); ++t) {
    if (!c.has_triangle(t)) continue;
    const Triangle v = c.triangle(t);
    if (!SheetGuard::is_guarded(mesh, v) || (!step.moves[v[0]] && !step.moves[v[1]] && !step.moves[v[2]])) continue;
    if (guard.may_meet(mesh, v, [&](Index other) { return other == t; })) meeting.push_back(t);
  }
  for (Index t : meeting) {
    for (Index v : c.triangle(t)) {
      if (step.moves[v]) move_back(mesh, step, v);
    }
  }
  return !meeting.empty();
}

}  // namespace

std::size_t relax_vertices(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, int threads) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<TriangleQuality> before(c.triangles());
  for_blocks(c.triangles(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      if (!c.has_triangle(static_cast<Index>(t))) continue;
      const Triangle v = c.triangle(static_cast<Index>(t));
      before[t] = triangle_quality(mesh, v[0], v[1], v[2]);
    }
  });
  Step step{mesh.points, std::vector<std::uint8_t>(c.vertices(), 0)};
  std::vector<SurfacePoint> after = mesh.points;
  for_blocks(c.vertices(), threads, [&](std::size_t first, std::size_t last) {
    SurfaceProjector projector(field);
    for (std::size_t v = first; v < last; ++v) {
      if (!c.has_vertex(static_cast<Index>(v))) continue;
      const auto place = projector.project(wanted_place(mesh, static_cast<Index>(v)), 0.5 * double(mesh.size[v]));
      if (!place || place->position == mesh.points[v].position) continue;
      after[v] = *place;
      step.moves[v] = 1;
    }
  });
  for (Index v = 0; v < c.vertices(); ++v) {
    if (!step.moves[v]) continue;
    mesh.points[v] = after[v];
    mesh.at[v] = to_angstrom(after[v].position);
  }
  take_back_bad_moves(mesh, step, before, threads);
  guard.rebuild(mesh);
  while (take_back_meetings(mesh, guard, step)) {
    take_back_bad_moves(mesh, step, before, threads);
    guard.rebuild(mesh);
  }
  std::size_t moved = 0;
  for (const std::uint8_t m : step.moves) moved += m;
  return moved;
}

}  // namespace gaussmesh
