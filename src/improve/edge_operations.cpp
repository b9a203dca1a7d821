#include "improve/edge_operations.h"

#include <optional>
#include <span>

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;

double edge_length_sq(const BlockMesh& m, Index h) {
  const Vec3 e = m.at[m.connectivity.to(h)] - m.at[m.connectivity.from(h)];
  return dot(e, e);
}

double wanted_size(const BlockMesh& m, Index h) {
  return 0.5 * (double(m.size[m.connectivity.from(h)]) + double(m.size[m.connectivity.to(h)]));
}

/// A flip for the valences' sake may leave angles down to 20 degrees; relaxation opens them again.
constexpr double kLeastSineForValence = 0.34;

/// The same of collapses, to 12 degrees.
constexpr double kLeastSineAfterCollapse = 0.2;

/// Where triangles lead over a rim of the surface, from one side to the other, splits lead out of that; but the
/// first parts may be turned by more than the whole was. Then they are well-shaped, or no worse than the whole was, and
/// kept from their neighbours by exact signs.
constexpr double kTurnLimitOnRims = 0.1, kLeastSineOnRims = 0.2;

/// Each edge to be worked on that is not on the boundary once: by the half-edge with the smaller number.
inline bool names_edge(const BlockMesh& m, Index h) {
  const HalfEdgeMesh& c = m.connectivity;
  const Index twin = c.twin(h);  // none either where the triangle is gone
  return h < twin && twin != HalfEdgeMesh::kNone && (m.is_active[c.from(h)] || m.is_active[c.to(h)]);
}

/// Whether any of the four parts of triangles s and t, split in their common edge, may meet a neighbour of theirs.
bool meets_stars(const BlockMesh& mesh, Index s, Index t, std::span<const Triangle> parts) {
  const HalfEdgeMesh& c = mesh.connectivity;
  bool meets = false;
  for (const Index old : {s, t}) {
    for (const Index v : c.triangle(old)) {
      if (!c.is_inner(v)) return true;  // its neighbours are not all here
      c.visit_star(v, [&](Index h) {
        const Index other = h / 3;
        if (other == s || other == t) return;
        for (const Triangle& part : parts) meets = meets || SheetGuard::pair_may_meet(mesh, part, c.triangle(other));
      });
    }
  }
  return meets;
}

}  // namespace

bool try_flip(BlockMesh& mesh, SheetGuard& guard, std::uint32_t h) {
  HalfEdgeMesh& c = mesh.connectivity;
  const Index g = c.twin(h), s = h / 3, t = g / 3;
  const Triangle first{c.from(h), c.opposite(g), c.opposite(h)}, second{c.opposite(g), c.to(h), c.opposite(h)};
  const TriangleQuality before = worse(triangle_quality(mesh, s), triangle_quality(mesh, t));
  const TriangleQuality after = worse(triangle_quality(mesh, first[0], first[1], first[2]),
                                      triangle_quality(mesh, second[0], second[1], second[2]));
  if (!turn_is_allowed(before, after) || !c.can_flip(h)) return false;
  const bool guarded = SheetGuard::is_guarded(mesh, first) || SheetGuard::is_guarded(mesh, second);
  if (guarded) {
    const auto ignored = [&](Index other) { return other == s || other == t; };
    if (guard.may_meet(mesh, first, ignored) || guard.may_meet(mesh, second, ignored)) return false;
  }
  c.flip(h);
  if (guarded) {
    guard.insert(mesh, s);
    guard.insert(mesh, t);
  }
  return true;
}

bool try_collapse(BlockMesh& mesh, SheetGuard& guard, std::uint32_t h, double longest) {
  HalfEdgeMesh& c = mesh.connectivity;
  const Index u = c.from(h), v = c.to(h), s = h / 3, t = c.twin(h) / 3;
  if (!c.is_inner(u)) return false;
  double longest_sq = 0.0;
  c.visit_star(u, [&](Index k) {
    if (k / 3 == t) return;  // an edge that is there already
    const Vec3 e = mesh.at[c.to(k)] - mesh.at[v];
    longest_sq = std::max(longest_sq, dot(e, e));
  });
  if (longest_sq > longest * longest || !c.can_collapse(h)) return false;
  TriangleQuality before = kPerfect, after = kPerfect;
  bool guarded = false;
  c.visit_star(u, [&](Index k) {
    before = worse(before, triangle_quality(mesh, k / 3));
    if (k / 3 == s || k / 3 == t) return;
    const Index a = c.to(k), b = c.opposite(k);
    after = worse(after, triangle_quality(mesh, v, a, b));
    guarded = guarded || SheetGuard::is_guarded(mesh, {v, a, b});
  });
  if (!turn_is_allowed(before, after)) return false;
  if (after.min_sine < std::min(kLeastSineAfterCollapse, before.min_sine)) return false;
  if (guarded) {
    const auto ignored = [&](Index other) {
      const Triangle w = c.triangle(other);
      return w[0] == u || w[1] == u || w[2] == u;
    };
    bool meets = false;
    c.visit_star(u, [&](Index k) {
      if (k / 3 == s || k / 3 == t || meets) return;
      meets = guard.may_meet(mesh, {v, c.to(k), c.opposite(k)}, ignored);
    });
    if (meets) return false;
  }
  c.collapse(h);
  if (guarded) c.visit_star(v, [&](Index k) { guard.insert(mesh, k / 3); });
  return true;
}

bool try_split(BlockMesh& mesh, SheetGuard& guard, std::uint32_t h, const Place& middle) {
  HalfEdgeMesh& c = mesh.connectivity;
  if (!mesh.contains(middle.at)) return false;
  const Index g = c.twin(h), a = c.from(h), b = c.to(h), m = c.vertices(), s = h / 3, t = g / 3;
  const Triangle parts[4] = {
      {a, m, c.opposite(h)}, {m, b, c.opposite(h)}, {m, a, c.opposite(g)}, {b, m, c.opposite(g)}};
  mesh.append(mesh, a);
  mesh.put(m, middle);
  mesh.size[m] = 0.5f * (mesh.size[a] + mesh.size[b]);
  mesh.curvature[m] = -1.0f;
  mesh.refinement[m] = std::min(mesh.refinement[a], mesh.refinement[b]);
  mesh.is_active.push_back(1);
  mesh.is_guarded.push_back(mesh.is_guarded[a] | mesh.is_guarded[b] | mesh.is_guarded[c.opposite(h)] |
                            mesh.is_guarded[c.opposite(g)]);
  const TriangleQuality before = worse(triangle_quality(mesh, s), triangle_quality(mesh, t));
  TriangleQuality after = kPerfect;
  for (const Triangle& p : parts) after = worse(after, triangle_quality(mesh, p[0], p[1], p[2]));
  bool allowed =
      turn_is_allowed(before, after) || (after.min_sine >= std::min(kLeastSineOnRims, before.min_sine) &&
                                         after.normal_cosine >= kTurnLimitOnRims && !meets_stars(mesh, s, t, parts));
  const bool guarded = mesh.is_guarded[m];
  if (allowed && guarded) {
    const auto ignored = [&](Index other) { return other == s || other == t; };
    for (const Triangle& p : parts) allowed = allowed && !guard.may_meet(mesh, p, ignored);
    // The four parts among themselves: neighbours that fold over have turned far from the field.
  }
  if (!allowed) {
    mesh.resize(m);
    mesh.is_active.pop_back();
    mesh.is_guarded.pop_back();
    return false;
  }
  c.split(h);
  if (guarded) c.visit_star(m, [&](Index k) { guard.insert(mesh, k / 3); });
  return true;
}

bool try_move(BlockMesh& mesh, SheetGuard& guard, std::uint32_t v, const Place& place, double least_sine) {
  if (!mesh.contains(place.at)) return false;
  const HalfEdgeMesh& c = mesh.connectivity;
  const Place old{mesh.at[v], mesh.normal[v]};
  mesh.put(v, place);
  bool allowed = true, has_guarded = mesh.is_guarded[v];
  c.visit_star(v, [&](Index h) {
    allowed = allowed && is_at_least(mesh, h / 3, {least_sine, kTurnLimit});
    has_guarded = has_guarded || mesh.is_guarded[c.to(h)];
  });
  if (!allowed) {  // as good as before is good enough
    const TriangleQuality after = star_quality(mesh, v);
    mesh.put(v, old);
    const TriangleQuality before = star_quality(mesh, v);
    allowed = after.min_sine >= std::min(least_sine, before.min_sine) && turn_is_allowed(before, after);
    mesh.put(v, place);
  }
  if (allowed && mesh.is_guarded[v]) {
    const auto ignored = [&](Index other) {
      const Triangle w = c.triangle(other);
      return w[0] == v || w[1] == v || w[2] == v;
    };
    c.visit_star(v, [&](Index h) { allowed = allowed && !guard.may_meet(mesh, c.triangle(h / 3), ignored); });
  }
  if (!allowed) {
    mesh.put(v, old);
    return false;
  }
  if (has_guarded) c.visit_star(v, [&](Index h) { guard.insert(mesh, h / 3); });
  return true;
}

std::size_t split_long_edges(BlockMesh& mesh, SheetGuard& guard, BlockField& field, double factor, Accuracy accuracy) {
  const HalfEdgeMesh& c = mesh.connectivity;
  const Index count = c.half_edges();  // new edges have their turn in the next round
  std::size_t made = 0;
  for (Index h = 0; h < count; ++h) {
    if (!names_edge(mesh, h)) continue;
    const double most = factor * wanted_size(mesh, h), length_sq = edge_length_sq(mesh, h);
    if (length_sq <= most * most) continue;
    const Vec3 middle = 0.5 * (mesh.at[c.from(h)] + mesh.at[c.to(h)]);
    const double farthest = 0.5 * std::sqrt(length_sq);
    const std::optional<Place> nearest = field.project(middle, farthest, accuracy);
    bool is_split = nearest && try_split(mesh, guard, h, *nearest);
    if (!is_split) {
      // Under a narrow ridge the nearest place may be on its other side: then the triangles' normal leads to theirs.
      const Vec3 out = area_normal(mesh, h / 3) + area_normal(mesh, c.twin(h) / 3);
      const std::optional<Place> above = field.project_along(out, middle, farthest);
      is_split = above && try_split(mesh, guard, h, *above);
    }
    made += is_split;
  }
  return made;
}

std::size_t collapse_short_edges(BlockMesh& mesh, SheetGuard& guard, double factor) {
  constexpr double kLongest = 1.5;  // times the wanted size: a collapse must not make edges to be split again
  const HalfEdgeMesh& c = mesh.connectivity;
  std::size_t made = 0;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h)) continue;
    const double size = wanted_size(mesh, h);
    if (edge_length_sq(mesh, h) >= factor * size * factor * size) continue;
    if (try_collapse(mesh, guard, h, kLongest * size) || try_collapse(mesh, guard, c.twin(h), kLongest * size)) ++made;
  }
  return made;
}

std::size_t even_out_valences(BlockMesh& mesh, SheetGuard& guard) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<int> valence(c.vertices(), 0);
  for (Index h = 0; h < c.half_edges(); ++h) {
    const Index v = c.from(h);  // none where the triangle is gone
    if (v != HalfEdgeMesh::kNone) ++valence[v];
  }
  std::size_t made = 0;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h)) continue;
    const Index g = c.twin(h), a = c.from(h), b = c.to(h), p = c.opposite(h), q = c.opposite(g);
    // A flip takes one from a and b and gives one to p and q: the sum of (valence - 6)^2 grows by this, doubled.
    if (valence[p] + valence[q] - valence[a] - valence[b] + 2 >= 0) continue;
    if (!c.is_inner(p) || !c.is_inner(q)) continue;
    const double worst_after =
        std::min(triangle_quality(mesh, a, q, p).min_sine, triangle_quality(mesh, q, b, p).min_sine);
    if (worst_after < kLeastSineForValence || !try_flip(mesh, guard, h)) continue;
    --valence[a];
    --valence[b];
    ++valence[p];
    ++valence[q];
    ++made;
  }
  return made;
}

std::size_t flip_edges(BlockMesh& mesh, SheetGuard& guard) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::size_t made = 0;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h)) continue;
    // Delaunay: flip where the cotangents of the opposite angles add up to less than zero.
    const Vec3 &a = mesh.at[c.from(h)], &b = mesh.at[c.to(h)];
    const Vec3 &v = mesh.at[c.opposite(h)], &w = mesh.at[c.opposite(c.twin(h))];
    const Vec3 av = a - v, bv = b - v, aw = a - w, bw = b - w;
    const double at_v = dot(av, bv), at_w = dot(aw, bw);
    if (at_v >= 0.0 && at_w >= 0.0) continue;
    const double cotangents = at_v / length(cross(av, bv)) + at_w / length(cross(aw, bw));
    if (cotangents < -1e-3) made += try_flip(mesh, guard, h);
  }
  return made;
}

}  // namespace gaussmesh
