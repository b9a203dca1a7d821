#include "improve/relax.h"

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;

/// The mean of the places that would make the triangles round a vertex equilateral on their opposite sides.
Vec3 ideal_place(const BlockMesh& mesh, Index v) {
  const HalfEdgeMesh& c = mesh.connectivity;
  const Vec3 p = mesh.at[v];
  Vec3 sum{};
  double total = 0.0;
  c.visit_star(v, [&](Index h) {
    const Vec3 a = mesh.at[c.to(h)], b = mesh.at[c.opposite(h)];
    const Vec3 e = b - a, u = p - a;
    const double ee = dot(e, e), weight = 1.0 / ee;
    const Vec3 across = u - dot(u, e) * weight * e;  // from the side to p, across it
    const Vec3 ideal = 0.5 * (a + b) + 0.8660254 * std::sqrt(ee / dot(across, across)) * across;
    sum = sum + weight * (ideal - p);
    total += weight;
  });
  const Vec3 move = 1.0 / total * sum;
  return p + (move - dot(move, mesh.normal[v]) * as_vector(mesh.normal[v]));
}

}  // namespace

std::size_t relax_vertices(BlockMesh& mesh, SheetGuard& guard, BlockField& field, Accuracy accuracy) {
  constexpr double kLeastSineToMove = 0.3;
  constexpr double kLeastMove = 0.01;  // times the wanted size; less does not show
  const HalfEdgeMesh& c = mesh.connectivity;
  std::size_t moved = 0;
  for (Index v = 0; v < c.vertices(); ++v) {
    if (!mesh.is_active[v] || !c.has_vertex(v) || !c.is_inner(v)) continue;
    const Vec3 ideal = ideal_place(mesh, v), move = ideal - mesh.at[v];
    const double size = double(mesh.size[v]);
    if (dot(move, move) < kLeastMove * size * kLeastMove * size) continue;
    const auto place = field.project(ideal, 0.5 * size, accuracy);
    if (place && place->at != mesh.at[v]) moved += try_move(mesh, guard, v, *place, kLeastSineToMove);
  }
  return moved;
}

void settle_vertices(BlockMesh& mesh, BlockField& field) {
  for (Index v = 0; v < mesh.at.size(); ++v) {
    if (!mesh.contains(mesh.at[v])) continue;
    const auto place = field.project(mesh.at[v], 0.5 * double(mesh.size[v]));
    if (place) mesh.put(v, *place);
  }
}

}  // namespace gaussmesh
