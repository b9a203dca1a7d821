#include "improve/edge_operations.h"

#include <optional>

#include "core/parallel.h"
#include "improve/surface_projector.h"

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;

TriangleQuality worse(const TriangleQuality& a, const TriangleQuality& b) {
  return {std::min(a.min_sine, b.min_sine), std::min(a.normal_cosine, b.normal_cosine)};
}

constexpr TriangleQuality kPerfect{1.0, 1.0};

/// Whether triangles may take the place of others, as far as the field goes.
bool turn_is_allowed(const TriangleQuality& before, const TriangleQuality& after) {
  return after.min_sine > 0.0 && after.normal_cosine >= std::min(kTurnLimit, before.normal_cosine) &&
         after.normal_cosine > 0.0;
}

TriangleQuality quality_of(const WorkingMesh& m, Index t) {
  const Triangle v = m.connectivity.triangle(t);
  return triangle_quality(m, v[0], v[1], v[2]);
}

double edge_length(const WorkingMesh& m, Index h) {
  return length(m.at[m.connectivity.to(h)] - m.at[m.connectivity.from(h)]);
}

double wanted_size(const WorkingMesh& m, Index h) {
  return 0.5 * (double(m.size[m.connectivity.from(h)]) + double(m.size[m.connectivity.to(h)]));
}

/// A flip for the valences' sake may leave angles down to 20 degrees; relaxation opens them again.
constexpr double kLeastSineForValence = 0.34;

/// Each edge once: by the half-edge with the smaller number.
bool names_edge(const WorkingMesh& m, Index h) {
  return m.connectivity.has_triangle(h / 3) && h < m.connectivity.twin(h);
}

}  // namespace

TriangleQuality star_quality(const WorkingMesh& mesh, std::uint32_t vertex) {
  TriangleQuality quality = kPerfect;
  mesh.connectivity.visit_star(vertex, [&](Index h) { quality = worse(quality, quality_of(mesh, h / 3)); });
  return quality;
}

bool try_flip(WorkingMesh& mesh, SheetGuard& guard, std::uint32_t h) {
  HalfEdgeMesh& c = mesh.connectivity;
  if (!c.can_flip(h)) return false;
  const Index g = c.twin(h), s = h / 3, t = g / 3;
  const Triangle first{c.from(h), c.opposite(g), c.opposite(h)}, second{c.opposite(g), c.to(h), c.opposite(h)};
  const TriangleQuality before = worse(quality_of(mesh, s), quality_of(mesh, t));
  const TriangleQuality after = worse(triangle_quality(mesh, first[0], first[1], first[2]),
                                      triangle_quality(mesh, second[0], second[1], second[2]));
  if (!turn_is_allowed(before, after)) return false;
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

bool try_collapse(WorkingMesh& mesh, SheetGuard& guard, std::uint32_t h, double longest) {
  HalfEdgeMesh& c = mesh.connectivity;
  if (!c.can_collapse(h)) return false;
  const Index u = c.from(h), v = c.to(h), s = h / 3, t = c.twin(h) / 3;
  TriangleQuality before = kPerfect, after = kPerfect;
  double longest_edge = 0.0;
  bool guarded = false;
  c.visit_star(u, [&](Index k) {
    before = worse(before, quality_of(mesh, k / 3));
    if (k / 3 == s || k / 3 == t) return;
    const Index a = c.to(k), b = c.opposite(k);
    after = worse(after, triangle_quality(mesh, v, a, b));
    longest_edge = std::max(longest_edge, length(mesh.at[a] - mesh.at[v]));
    guarded = guarded || SheetGuard::is_guarded(mesh, {v, a, b});
  });
  if (!turn_is_allowed(before, after) || longest_edge > longest) return false;
  if (after.min_sine < std::min(0.2, before.min_sine)) return false;
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

bool try_split(WorkingMesh& mesh, SheetGuard& guard, std::uint32_t h, const SurfacePoint& middle) {
  HalfEdgeMesh& c = mesh.connectivity;
  const Index g = c.twin(h), a = c.from(h), b = c.to(h), m = c.vertices(), s = h / 3, t = g / 3;
  const Triangle parts[4] = {
      {a, m, c.opposite(h)}, {m, b, c.opposite(h)}, {m, a, c.opposite(g)}, {b, m, c.opposite(g)}};
  mesh.points.push_back(middle);
  mesh.at.push_back(to_angstrom(middle.position));
  mesh.size.push_back(0.5f * (mesh.size[a] + mesh.size[b]));
  mesh.is_guarded.push_back(mesh.is_guarded[a] | mesh.is_guarded[b] | mesh.is_guarded[c.opposite(h)] |
                            mesh.is_guarded[c.opposite(g)]);
  const TriangleQuality before = worse(quality_of(mesh, s), quality_of(mesh, t));
  TriangleQuality after = kPerfect;
  for (const Triangle& p : parts) after = worse(after, triangle_quality(mesh, p[0], p[1], p[2]));
  bool allowed = turn_is_allowed(before, after);
  const bool guarded = mesh.is_guarded[m];
  if (allowed && guarded) {
    const auto ignored = [&](Index other) { return other == s || other == t; };
    for (const Triangle& p : parts) allowed = allowed && !guard.may_meet(mesh, p, ignored);
    // The four parts among themselves: neighbours that fold over have turned far from the field.
  }
  if (!allowed) {
    mesh.points.pop_back();
    mesh.at.pop_back();
    mesh.size.pop_back();
    mesh.is_guarded.pop_back();
    return false;
  }
  c.split(h);
  if (guarded) c.visit_star(m, [&](Index k) { guard.insert(mesh, k / 3); });
  return true;
}

std::size_t split_long_edges(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, double factor,
                             int threads) {
  struct Candidate {
    Index from, to, half_edge;
    std::optional<SurfacePoint> middle;
  };
  std::vector<Candidate> candidates;
  const HalfEdgeMesh& c = mesh.connectivity;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h) || edge_length(mesh, h) <= factor * wanted_size(mesh, h)) continue;
    candidates.push_back({c.from(h), c.to(h), h, {}});
  }
  constexpr std::size_t kBlock = 256;
  parallel_for((candidates.size() + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    SurfaceProjector projector(field);
    for (std::size_t i = block * kBlock; i < std::min(candidates.size(), (block + 1) * kBlock); ++i) {
      const Vec3 a = mesh.at[candidates[i].from], b = mesh.at[candidates[i].to];
      candidates[i].middle = projector.project(0.5 * (a + b), 0.5 * length(b - a));
    }
  });
  std::size_t made = 0;
  for (const Candidate& candidate : candidates) {
    const Index h = candidate.half_edge;
    if (c.from(h) != candidate.from || c.to(h) != candidate.to || !candidate.middle) continue;
    made += try_split(mesh, guard, h, *candidate.middle);
  }
  return made;
}

std::size_t collapse_short_edges(WorkingMesh& mesh, SheetGuard& guard, double factor) {
  constexpr double kLongest = 1.5;   // times the wanted size: a collapse must not make edges to be split again
  const HalfEdgeMesh& c = mesh.connectivity;
  std::size_t made = 0;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h)) continue;
    const double size = wanted_size(mesh, h);
    if (edge_length(mesh, h) >= factor * size) continue;
    if (try_collapse(mesh, guard, h, kLongest * size) || try_collapse(mesh, guard, c.twin(h), kLongest * size)) ++made;
  }
  return made;
}

std::size_t even_out_valences(WorkingMesh& mesh, SheetGuard& guard) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<int> valence(c.vertices(), 0);
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (c.has_triangle(h / 3)) ++valence[c.from(h)];
  }
  const auto excess = [](int v) { return (v - 6) * (v - 6); };
  std::size_t made = 0;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h)) continue;
    const Index g = c.twin(h), a = c.from(h), b = c.to(h), p = c.opposite(h), q = c.opposite(g);
    const int before = excess(valence[a]) + excess(valence[b]) + excess(valence[p]) + excess(valence[q]);
    const int after =
        excess(valence[a] - 1) + excess(valence[b] - 1) + excess(valence[p] + 1) + excess(valence[q] + 1);
    if (after >= before) continue;
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

std::size_t flip_edges(WorkingMesh& mesh, SheetGuard& guard) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::size_t made = 0;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!names_edge(mesh, h)) continue;
    // Delaunay: flip where the cotangents of the opposite angles add up to less than zero.
    const Vec3 &a = mesh.at[c.from(h)], &b = mesh.at[c.to(h)];
    double cotangents = 0.0;
    for (const Index v : {c.opposite(h), c.opposite(c.twin(h))}) {
      const Vec3 p = a - mesh.at[v], q = b - mesh.at[v];
      cotangents += dot(p, q) / length(cross(p, q));
    }
    if (cotangents < -1e-3) made += try_flip(mesh, guard, h);
  }
  return made;
}

}  // namespace gaussmesh
