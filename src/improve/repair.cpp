#include "improve/repair.h"

#include <numbers>

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;

class TriangleRepair {
 public:
  TriangleRepair(BlockMesh& mesh, SheetGuard& guard, BlockField& field, double least_sine)
      : mesh_(mesh), guard_(guard), field_(field), least_sine_(least_sine) {}

  bool is_bad(Index t) const { return mesh_.connectivity.has_triangle(t) && score(t) < 1.0; }

  /// What is tried on one triangle, until it is no longer bad.
  void repair(Index t) {
    for (int i = 0; i < 3 && is_bad(t); ++i) flip_if_better(3 * t + i);
    if (is_bad(t)) collapse_shortest(t);
    for (int i = 0; i < 3 && is_bad(t); ++i) move_corner(mesh_.connectivity.from(3 * t + i));
    if (is_bad(t)) split_longest(t);
  }

 private:
  // Lengths are in wanted edges. A collapse or a split is meant for edges that are short or long anyway, so that the
  // next round does not take it back.
  static constexpr double kShort = 0.8, kLong = 1.2, kLongestAfterCollapse = 1.7;
  static constexpr double kLeastScoreAfterCollapse = 0.8;  ///< others may come out a little bad, to be mended in turn
  static constexpr double kFirstReach = 0.15;              ///< of the search for a better place
  static constexpr int kReachHalvings = 5, kDirections = 8;
  static constexpr double kLeastGain = 1.001;  ///< less is not worth another round of the search

  /// Below 1 for a triangle to be mended.
  double score(const TriangleQuality& q) const {
    return std::min(q.min_sine / least_sine_, (1.0 + q.normal_cosine) / (1.0 + kTurnLimit));
  }
  double score(Index t) const { return score(triangle_quality(mesh_, t)); }
  double score(Index a, Index b, Index c) const { return score(triangle_quality(mesh_, a, b, c)); }
  bool is_boundary(Index h) const { return mesh_.connectivity.twin(h) == HalfEdgeMesh::kNone; }

  void flip_if_better(Index h) {
    const HalfEdgeMesh& c = mesh_.connectivity;
    if (is_boundary(h)) return;
    const Index g = c.twin(h), p = c.opposite(h), q = c.opposite(g);
    const double before = std::min(score(h / 3), score(g / 3));
    const double after = std::min(score(c.from(h), q, p), score(q, c.to(h), p));
    if (after > before) try_flip(mesh_, guard_, h);
  }

  /// Worst score round from(h) as if it were at to(h), without the triangles that hold both.
  double collapsed_score(Index h) const {
    const HalfEdgeMesh& c = mesh_.connectivity;
    double worst = 1.0;
    c.visit_star(c.from(h), [&](Index k) {
      if (k / 3 == h / 3 || k / 3 == c.twin(h) / 3) return;
      worst = std::min(worst, score(c.to(h), c.to(k), c.opposite(k)));
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
    if (is_boundary(shortest) || edge(shortest) > kShort * size) return;
    const double before = score(t);
    for (const Index h : {shortest, c.twin(shortest)}) {
      if (c.is_inner(c.from(h)) && collapsed_score(h) > std::max(before, kLeastScoreAfterCollapse) &&
          try_collapse(mesh_, guard_, h, kLongestAfterCollapse * size)) {
        return;
      }
    }
  }

  void split_longest(Index t) {
    const HalfEdgeMesh& c = mesh_.connectivity;
    Index longest = 3 * t;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      if (edge(h) > edge(longest)) longest = h;
    }
    if (is_boundary(longest) || edge(longest) < kLong * double(mesh_.size[c.from(longest)])) return;
    const Vec3 a = mesh_.at[c.from(longest)], b = mesh_.at[c.to(longest)];
    const auto middle = field_.project(0.5 * (a + b), 0.5 * length(b - a));
    const Index m = c.vertices();
    if (middle && try_split(mesh_, guard_, longest, *middle)) move_corner(m);
  }

  double edge(Index h) const {
    const HalfEdgeMesh& c = mesh_.connectivity;
    return length(mesh_.at[c.to(h)] - mesh_.at[c.from(h)]);
  }

  /// Pattern search for the place along the surface that gives the star of v its largest smallest angle.
  void move_corner(Index v) {
    if (!mesh_.connectivity.is_inner(v)) return;
    double reach = kFirstReach * double(mesh_.size[v]);
    for (int halving = 0; halving < kReachHalvings; ++halving, reach *= 0.5) {
      for (bool again = true; again;) {
        again = false;
        const Vec3 n = as_vector(mesh_.normal[v]), p = mesh_.at[v];
        const Vec3 other = std::abs(n[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 u = 1.0 / length(cross(n, other)) * cross(n, other), w = cross(n, u);
        for (int direction = 0; direction < kDirections && !again; ++direction) {
          const double angle = direction * 2.0 * std::numbers::pi / kDirections;
          const auto place = field_.project(p + reach * (std::cos(angle) * u + std::sin(angle) * w), 2.0 * reach);
          again = place && take_if_better(v, *place);
        }
      }
    }
  }

  bool take_if_better(Index v, const Place& place) {
    const Place old{mesh_.at[v], mesh_.normal[v]};
    const double before = score(star_quality(mesh_, v));
    mesh_.put(v, place);
    const double after = score(star_quality(mesh_, v));
    mesh_.put(v, old);
    return after > kLeastGain * before && try_move(mesh_, guard_, v, place, 0.0);
  }

  BlockMesh& mesh_;
  SheetGuard& guard_;
  BlockField& field_;
  double least_sine_;
};

}  // namespace

void repair_triangles(BlockMesh& mesh, SheetGuard& guard, BlockField& field, double least_angle_deg, int rounds) {
  TriangleRepair repair(mesh, guard, field, std::sin(least_angle_deg * std::numbers::pi / 180.0));
  bool any = true;
  for (int round = 0; round < rounds && any; ++round) {
    any = false;
    const Index count = mesh.connectivity.triangles();  // those that splits add have their turn in the next round
    for (Index t = 0; t < count; ++t) {
      if (!repair.is_bad(t)) continue;
      repair.repair(t);
      any = true;  // what it did may have left others bad
    }
  }
}

}  // namespace gaussmesh
