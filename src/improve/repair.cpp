#include "improve/repair.h"

#include <numbers>

#include "improve/edge_operations.h"
#include "improve/surface_projector.h"

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;

class TriangleRepair {
 public:
  TriangleRepair(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, double least_sine)
      : mesh_(mesh), guard_(guard), projector_(field), least_sine_(least_sine) {}

  bool is_bad(Index t) const { return mesh_.connectivity.has_triangle(t) && sine(t) < least_sine_; }

  void repair(Index t) {
    for (int i = 0; i < 3 && is_bad(t); ++i) flip_if_better(3 * t + i);
    if (is_bad(t)) collapse_shortest(t);
    for (int i = 0; i < 3 && is_bad(t); ++i) move_corner(mesh_.connectivity.from(3 * t + i));
    if (is_bad(t)) split_longest(t);
  }

 private:
  double sine(Index t) const {
    const Triangle v = mesh_.connectivity.triangle(t);
    return triangle_quality(mesh_, v[0], v[1], v[2]).min_sine;
  }

  void flip_if_better(Index h) {
    const HalfEdgeMesh& c = mesh_.connectivity;
    const Index g = c.twin(h), p = c.opposite(h), q = c.opposite(g);
    const double before = std::min(sine(h / 3), sine(g / 3));
    const double after = std::min(triangle_quality(mesh_, c.from(h), q, p).min_sine,
                                  triangle_quality(mesh_, q, c.to(h), p).min_sine);
    if (after > before) try_flip(mesh_, guard_, h);
  }

  /// Worst sine round `v` as if it were at `u`'s place, without the triangles that hold both.
  double collapsed_sine(Index h) const {
    const HalfEdgeMesh& c = mesh_.connectivity;
    double worst = 1.0;
    c.visit_star(c.from(h), [&](Index k) {
      if (k / 3 == h / 3 || k / 3 == c.twin(h) / 3) return;
      worst = std::min(worst, triangle_quality(mesh_, c.to(h), c.to(k), c.opposite(k)).min_sine);
    });
    return worst;
  }

  void collapse_shortest(Index t) {
    const HalfEdgeMesh& c = mesh_.connectivity;
    Index shortest = 3 * t;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (edge(h) < edge(shortest)) shortest = h;
    }
    const double size = double(mesh_.size[c.from(shortest)]);
    if (edge(shortest) > 0.8 * size) return;
    const double before = sine(t);
    for (const Index h : {shortest, c.twin(shortest)}) {
      if (collapsed_sine(h) > std::max(before, 0.8 * least_sine_) && try_collapse(mesh_, guard_, h, 1.7 * size)) return;
    }
  }

  void split_longest(Index t) {
    const HalfEdgeMesh& c = mesh_.connectivity;
    Index longest = 3 * t;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (edge(h) > edge(longest)) longest = h;
    }
    if (edge(longest) < 1.2 * double(mesh_.size[c.from(longest)])) return;
    const Vec3 a = mesh_.at[c.from(longest)], b = mesh_.at[c.to(longest)];
    const auto middle = projector_.project(0.5 * (a + b), 0.5 * length(b - a));
    const Index m = c.vertices();
    if (middle && try_split(mesh_, guard_, longest, *middle)) move_corner(m);
  }

  double edge(Index h) const {
    const HalfEdgeMesh& c = mesh_.connectivity;
    return length(mesh_.at[c.to(h)] - mesh_.at[c.from(h)]);
  }

  /// Pattern search for the place along the surface that gives the star of v its largest smallest angle.
  void move_corner(Index v) {
    double reach = 0.15 * double(mesh_.size[v]);
    TriangleQuality best = star_quality(mesh_, v);
    const TriangleQuality start = best;
    for (int halving = 0; halving < 5; ++halving, reach *= 0.5) {
      for (bool again = true; again;) {
        again = false;
        const Vec3 n = as_vector(mesh_.points[v].normal), p = mesh_.at[v];
        const Vec3 other = std::abs(n[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 u = 1.0 / length(cross(n, other)) * cross(n, other), w = cross(n, u);
        for (int direction = 0; direction < 8 && !again; ++direction) {
          const double angle = direction * std::numbers::pi / 4.0;
          const auto place = projector_.project(p + reach * (std::cos(angle) * u + std::sin(angle) * w), 2.0 * reach);
          again = place && take_if_better(v, *place, best, start);
        }
      }
    }
  }

  bool take_if_better(Index v, const SurfacePoint& place, TriangleQuality& best, const TriangleQuality& start) {
    const SurfacePoint old = mesh_.points[v];
    put(v, place);
    const TriangleQuality now = star_quality(mesh_, v);
    bool better = now.min_sine > best.min_sine * 1.001 && now.normal_cosine >= std::min(kTurnLimit, start.normal_cosine);
    if (better && mesh_.is_guarded[v]) {
      const HalfEdgeMesh& c = mesh_.connectivity;
      const auto ignored = [&](Index other) {
        const Triangle w = c.triangle(other);
        return w[0] == v || w[1] == v || w[2] == v;
      };
      c.visit_star(v, [&](Index h) { better = better && !guard_.may_meet(mesh_, c.triangle(h / 3), ignored); });
      if (better) c.visit_star(v, [&](Index h) { guard_.insert(mesh_, h / 3); });
    }
    if (!better) {
      put(v, old);
      return false;
    }
    best = now;
    return true;
  }

  void put(Index v, const SurfacePoint& place) {
    mesh_.points[v] = place;
    mesh_.at[v] = to_angstrom(place.position);
  }

  WorkingMesh& mesh_;
  SheetGuard& guard_;
  SurfaceProjector projector_;
  double least_sine_;
};

}  // namespace

std::size_t repair_triangles(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, double least_angle_deg,
                             int rounds) {
  TriangleRepair repair(mesh, guard, field, std::sin(least_angle_deg * std::numbers::pi / 180.0));
  std::size_t left = 0;
  for (int round = 0; round < rounds; ++round) {
    left = 0;
    const Index count = mesh.connectivity.triangles();  // those that splits add have their turn in the next round
    for (Index t = 0; t < count; ++t) {
      if (!repair.is_bad(t)) continue;
      repair.repair(t);
      left += repair.is_bad(t);
    }
    if (left == 0) break;
  }
  return left;
}

}  // namespace gaussmesh
