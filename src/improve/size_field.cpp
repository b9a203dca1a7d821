#include "improve/size_field.h"

#include "core/sort_and_unite.h"

namespace gaussmesh {
namespace {

using Index = HalfEdgeMesh::Index;

/// What counts of the curvature: no more than asks for kLeastSize, unless the surface curves in both directions. The
/// waist of a neck that is about to pinch off may be flat, between large atoms that hardly overlap: halfway between two
/// at a distance D the curvatures are to each other as d D^2 / 2 - 1 to 1.
double curvature_that_counts(const Curvatures& c, const SizeTargets& targets) {
  constexpr double kFlattest = 300.0;  // some 1600 edges round a waist
  return std::min(c.larger, std::max(kFlattest * c.smaller, kTurnPerEdge / (kLeastSize * targets.spacing)));
}

/// Lower limit of wanted sizes where such a curvature was found.
double least_size(double curvature, const SizeTargets& targets) {
  return std::max(std::min(kLeastSize * targets.spacing, kTurnPerEdge / curvature), kLeastSizeOfAll * targets.spacing);
}

/// Wanted edge where such a curvature was found.
double size_at(double curvature, const SizeTargets& targets) {
  const double size = std::max(std::min(kTurnPerEdge / curvature, targets.largest()), least_size(curvature, targets));
  if (targets.tolerance == 0.0) return size;
  // The middle of an equilateral triangle of edge s is s / sqrt(3) from its corners, and s^2 k / 6 below the
  // surface; edges may be up to half as long again as wanted.
  return std::min(size, std::max(std::sqrt(2.5 * targets.tolerance / curvature), kLeastSizeOfAll * targets.spacing));
}

/// Each edge once; those on the boundary, whose other half is kNone, have one only.
inline bool is_first_half(const HalfEdgeMesh& c, Index h) { return h < c.twin(h) && c.has_triangle(h / 3); }

/// Lowers sizes until none grows faster than kGrowth along an edge.
class GrowthLimit {
 public:
  explicit GrowthLimit(BlockMesh& mesh) : mesh_(mesh), is_waiting_(mesh.at.size(), 0) {}

  void apply() {
    const HalfEdgeMesh& c = mesh_.connectivity;
    for (const Triangle& t : mesh_.fixed) {
      for (int i = 0; i < 3; ++i) at_boundary_.push_back({t[i], t[(i + 1) % 3]});
    }
    for (Index h = 0; h < c.half_edges(); ++h) {
      if (!is_first_half(c, h)) continue;
      const Index u = c.from(h), v = c.to(h);
      limit(u, v);
      if (!c.is_inner(u) || !c.is_inner(v)) at_boundary_.push_back({u, v});
    }
    do {
      has_lowered_boundary_ = false;
      for (const auto& [u, v] : at_boundary_) limit(u, v);
      spread();
    } while (has_lowered_boundary_);
  }

 private:
  /// On from the inner vertices that have been lowered.
  void spread() {
    const HalfEdgeMesh& c = mesh_.connectivity;
    for (std::size_t i = 0; i < lowered_.size(); ++i) {
      const Index v = lowered_[i];
      is_waiting_[v] = 0;
      c.visit_star(v, [&](Index h) { limit(v, c.to(h)); });
    }
    lowered_.clear();
  }

  void limit(Index u, Index v) {
    if (mesh_.size[u] == mesh_.size[v]) return;
    if (mesh_.size[u] > mesh_.size[v]) std::swap(u, v);
    const double more = double(mesh_.size[v]) - double(mesh_.size[u]);
    const Vec3 edge = mesh_.at[v] - mesh_.at[u];
    if (more * more <= kGrowth * kGrowth * dot(edge, edge)) return;
    const auto most = static_cast<float>(double(mesh_.size[u]) + kGrowth * length(edge));
    if (!(mesh_.size[v] > most * 1.0001f)) return;
    mesh_.size[v] = most;
    if (!mesh_.connectivity.is_inner(v)) {
      has_lowered_boundary_ = true;
    } else if (!is_waiting_[v]) {
      is_waiting_[v] = 1;
      lowered_.push_back(v);
    }
  }

  BlockMesh& mesh_;
  std::vector<std::array<Index, 2>> at_boundary_;  ///< edges whose ends are not both inner, some of them twice
  std::vector<Index> lowered_;                     ///< inner vertices whose edges are to be looked at
  std::vector<std::uint8_t> is_waiting_;           ///< whether a vertex is among them
  bool has_lowered_boundary_ = false;
};

}  // namespace

double wanted_size(const Curvatures& curvatures, const SizeTargets& targets) {
  return size_at(curvature_that_counts(curvatures, targets), targets);
}

void find_wanted_sizes(BlockMesh& mesh, BlockField& field, const SizeTargets& targets) {
  const HalfEdgeMesh& c = mesh.connectivity;
  for (Index v = 0; v < c.vertices(); ++v) {
    if (!mesh.is_active[v] || !c.has_vertex(v)) continue;
    if (mesh.curvature[v] < 0.0f) {
      const Curvatures curvatures = principal_curvatures(field.jet(mesh.at[v]));
      mesh.curvature[v] = static_cast<float>(curvature_that_counts(curvatures, targets));
    }
    mesh.size[v] = mesh.refinement[v] * static_cast<float>(size_at(double(mesh.curvature[v]), targets));
  }
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!is_first_half(c, h)) continue;
    const Index u = c.from(h), v = c.to(h);
    const Vec3 turn = as_vector(mesh.normal[v]) - as_vector(mesh.normal[u]);
    if (dot(turn, turn) <= kTurnBetweenEnds * kTurnBetweenEnds) continue;
    const auto curvature = double(std::max(mesh.curvature[u], mesh.curvature[v]));  // none known outside the block
    const double most = std::max(kTurnBetweenEnds / length(turn) * length(mesh.at[v] - mesh.at[u]),
                                 least_size(std::max(curvature, 0.0), targets));
    mesh.size[u] = std::min(mesh.size[u], static_cast<float>(most));
    mesh.size[v] = std::min(mesh.size[v], static_cast<float>(most));
  }
  GrowthLimit(mesh).apply();
}

std::vector<Index> corners_at_sharp_edges(const BlockMesh& mesh) {
  const HalfEdgeMesh& c = mesh.connectivity;
  std::vector<Index> sharp;
  for (Index h = 0; h < c.half_edges(); ++h) {
    if (!c.has_triangle(h / 3) || c.twin(h) < h || !c.is_inner(c.from(h)) || !c.is_inner(c.to(h))) continue;
    if (!turn_sharply(area_normal(mesh, h / 3), area_normal(mesh, c.twin(h) / 3))) continue;
    for (const Index v : {c.from(h), c.to(h), c.opposite(h), c.opposite(c.twin(h))}) sharp.push_back(v);
  }
  sort_and_unite(sharp);
  return sharp;
}

void refine(BlockMesh& mesh, const std::vector<Index>& vertices) {
  constexpr float kSmaller = 0.8f, kLeastRefinement = 0.4f;
  for (const Index v : vertices) mesh.refinement[v] = std::max(kLeastRefinement, kSmaller * mesh.refinement[v]);
}

}  // namespace gaussmesh
