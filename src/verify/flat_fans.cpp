#include "verify/flat_fans.h"

#include <span>

#include "verify/exact_orientation.h"

namespace gaussmesh::verify {
namespace {

enum class Turn { kCounterClockwise, kClockwise };

Turns turns_of(const Point& a, const Point& b, const Point& c) {
  Turns turns = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = orient2d(project_along(axis, a), project_along(axis, b), project_along(axis, c));
    turns |= static_cast<Turns>((turn > 0) << axis | (turn < 0) << (3 + axis));
  }
  return turns;
}

/// Whether the direction from `centre` to `point`, seen along `axis`, is in [0, pi), and not in [pi, 2 pi).
bool is_in_upper_half(int axis, const Point& centre, const Point& point) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return point[v] != centre[v] ? point[v] > centre[v] : point[u] > centre[u];
}

/// Whether triangles round a vertex that are a closed fan, and all turn the same way by more than 0 and less than
/// pi, go round once: whether only one of them runs over the direction 0.
bool goes_round_once(const TriangleMesh& mesh, std::span<const std::uint32_t> star, std::uint32_t vertex, int axis,
                     Turn turn) {
  const Point& centre = mesh.vertices[vertex];
  int rounds = 0;
  for (const std::uint32_t t : star) {
    const auto [next, last] = others(mesh.triangles[t], vertex);
    const bool next_is_upper = is_in_upper_half(axis, centre, mesh.vertices[next]);
    const bool last_is_upper = is_in_upper_half(axis, centre, mesh.vertices[last]);
    rounds += next_is_upper != last_is_upper && next_is_upper == (turn == Turn::kClockwise);
  }
  return rounds == 1;
}

bool is_flat(const TriangleMesh& mesh, std::span<const std::uint32_t> star, std::uint32_t vertex,
             const std::vector<Turns>& turns) {
  unsigned common = 0x3F;
  for (const std::uint32_t t : star) common &= turns[t];
  for (int bit = 0; bit < 6; ++bit) {
    const Turn turn = bit < 3 ? Turn::kCounterClockwise : Turn::kClockwise;
    if ((common >> bit & 1) != 0 && goes_round_once(mesh, star, vertex, bit % 3, turn)) return true;
  }
  return false;
}

std::vector<Turns> find_turns(const TriangleMesh& mesh) {
  std::vector<Turns> turns(mesh.triangles.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    turns[t] = turns_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  return turns;
}

}  // namespace

FanFacts find_flat_fans(const TriangleMesh& mesh, const VertexStars& stars, const EdgeTopology& topology) {
  FanFacts facts{find_turns(mesh), std::vector<std::uint8_t>(stars.vertex_count())};
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < stars.vertex_count(); ++v)
    facts.is_flat[v] =
        !stars.star(v).empty() && is_flat(mesh, stars.star(v), static_cast<std::uint32_t>(v), facts.turns);
  for (const std::uint32_t vertex : topology.nonmanifold) facts.is_flat[vertex] = 0;
  return facts;
}

}  // namespace gaussmesh::verify
