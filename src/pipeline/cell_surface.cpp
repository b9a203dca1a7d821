#include "pipeline/cell_surface.h"

#include <algorithm>
#include <limits>

namespace gaussmesh {
namespace {

/// A component is not cut when all its normals found have one axis in common by at least this cosine.
constexpr float kCommonAxis = 0.1f;

}  // namespace

void CellSurface::add_disc(std::span<const Link> sides) {
  for (const Link& side : sides) {
    const int from = local(side.from), to = local(side.to);
    pieces_.unite(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to));
    links_.push_back({from, to});
  }
  discs_.push_back(local(sides[0].from));
}

std::optional<std::vector<FoldComponent>> CellSurface::components(const CoordPoint& lo, const CoordPoint& hi) {
  find_boundary();
  std::map<int, FoldComponent> by_root;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    FoldComponent& c = by_root.try_emplace(find(static_cast<int>(v)), FoldComponent{0, 0, {}, {}}).first->second;
    ++c.chi;
    const SurfacePoint& point = points_[vertices_[v]];
    const unsigned faces = faces_of(point.position, lo, hi);
    if ((faces & (faces - 1)) != 0) c.roots.push_back(point.position);
  }
  for (const int disc : discs_) ++by_root.at(find(disc)).chi;
  // Every inner link is there twice, once each way.
  std::map<int, int> link_count;
  for (const auto& link : links_) ++link_count[find(link.first)];
  for (const auto& [from, to] : boundary_) ++link_count[find(from)];
  for (const auto& [root, count] : link_count) by_root.at(root).chi -= count / 2;

  std::vector<FoldComponent> result;
  for (auto& [root, component] : by_root) {
    if (component.roots.empty()) return std::nullopt;
    component.boundary_loops = count_boundary_loops(root);
    if (component.boundary_loops == 0) return std::nullopt;
    const NormalRanges ranges = normal_ranges(root);
    if (component.chi != 1 || !have_common_axis(ranges)) {
      component.fold_axis = choose_axis(root, component.boundary_loops, ranges);
      if (!component.fold_axis) return std::nullopt;
    }
    result.push_back(std::move(component));
  }
  return result;
}

int CellSurface::local(std::uint32_t vertex) {
  const auto [it, is_new] = index_.try_emplace(vertex, static_cast<int>(vertices_.size()));
  if (is_new) {
    vertices_.push_back(vertex);
    pieces_.add();
  }
  return it->second;
}

void CellSurface::find_boundary() {
  std::vector<std::pair<int, int>> sorted = links_;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [from, to] : links_) {
    if (!std::binary_search(sorted.begin(), sorted.end(), std::pair(to, from))) boundary_[from] = to;
  }
}

int CellSurface::count_boundary_loops(int root) {
  std::vector<bool> seen(vertices_.size(), false);
  int loops = 0;
  for (const auto& [start, next] : boundary_) {
    if (find(start) != root || seen[start]) continue;
    ++loops;
    for (int v = start; !seen[v]; v = boundary_.at(v)) seen[v] = true;
  }
  return loops;
}

CellSurface::NormalRanges CellSurface::normal_ranges(int root) {
  NormalRanges ranges;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (find(static_cast<int>(v)) != root) continue;
    for (int k = 0; k < 3; ++k) {
      const float n = points_[vertices_[v]].normal[k];
      ranges[k].least = std::min(ranges[k].least, n);
      ranges[k].most = std::max(ranges[k].most, n);
    }
  }
  return ranges;
}

bool CellSurface::have_common_axis(const NormalRanges& ranges) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [](const NormalRange& r) { return r.least > kCommonAxis || r.most < -kCommonAxis; });
}

std::optional<int> CellSurface::choose_axis(int root, int boundary_loops, const NormalRanges& ranges) {
  std::optional<int> best;
  int best_crossings = std::numeric_limits<int>::max();
  float best_depth = 0.0f;
  for (int k = 0; k < 3; ++k) {
    int crossings = 0;
    for (const auto& [from, to] : boundary_) {
      if (find(from) != root) continue;
      crossings += points_[vertices_[from]].normal[k] * points_[vertices_[to]].normal[k] < 0.0f;
    }
    const float depth = std::min(-ranges[k].least, ranges[k].most);
    const bool is_better = crossings < best_crossings || (crossings == best_crossings && depth > best_depth);
    if (crossings >= 2 * boundary_loops && is_better) {
      best = k;
      best_crossings = crossings;
      best_depth = depth;
    }
  }
  return best;
}

}  // namespace gaussmesh
