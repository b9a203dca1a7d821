#include "pipeline/find_fold_cells.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "core/parallel.h"
#include "pipeline/loop_collector.h"

namespace gaussmesh {
namespace {

/// A component is not cut when all its normals found have one axis in common by at least this cosine.
constexpr float kCommonAxis = 0.1f;

/// Whether a loop of a certified cell goes round surface, and not round a hole in it: seen along the direction of the
/// certificate it turns counter-clockwise. Seen aslant, one that goes round surface may not seem to.
bool goes_round_surface(const LeafCell& leaf, const Loop& loop) {
  double area = 0.0;
  const PlanePoint o = leaf.direction.project(loop[0].point.position);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const PlanePoint p = leaf.direction.project(loop[i].point.position);
    const PlanePoint q = leaf.direction.project(loop[i + 1].point.position);
    area += double(p.a - o.a) * double(q.b - o.b) - double(p.b - o.b) * double(q.a - o.a);
  }
  return leaf.direction.sign < 0 ? area > 0.0 : area < 0.0;
}

/// The surface in one cell, put together from the discs of the smaller cells in it.
class CellSurface {
 public:
  explicit CellSurface(const TracedVertices& points) : points_(points) {}

  void add_disc(std::span<const Link> links) {
    for (const Link& link : links) {
      const int from = local(link.from), to = local(link.to);
      join(from, to);
      links_.push_back({from, to});
    }
    discs_.push_back(local(links[0].from));
  }

  /// @return nothing if a component has no root on the edges of the cell from `lo` to `hi`
  std::optional<std::vector<FoldComponent>> components(const CoordPoint& lo, const CoordPoint& hi) {
    find_boundary();
    std::map<int, FoldComponent> by_root;
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      FoldComponent& c = by_root.try_emplace(find(static_cast<int>(v)), FoldComponent{0, 0, {}, {}}).first->second;
      ++c.chi;
      const SurfacePoint& point = points_[vertices_[v]];
      const unsigned faces = faces_of(point.position, lo, hi);
      if ((faces & (faces - 1)) != 0) c.roots.push_back(point.position);
    }
    for (int disc : discs_) ++by_root.at(find(disc)).chi;
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
      if (!choose_axis(root, component)) return std::nullopt;
      result.push_back(std::move(component));
    }
    return result;
  }

 private:
  int local(std::uint32_t vertex) {
    const auto [it, is_new] = index_.try_emplace(vertex, static_cast<int>(vertices_.size()));
    if (is_new) {
      vertices_.push_back(vertex);
      parent_.push_back(it->second);
    }
    return it->second;
  }

  int find(int v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(int u, int v) { parent_[find(u)] = find(v); }

  void find_boundary() {
    std::vector<std::pair<int, int>> sorted = links_;
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [from, to] : links_) {
      if (!std::binary_search(sorted.begin(), sorted.end(), std::pair(to, from))) boundary_[from] = to;
    }
  }

  int count_boundary_loops(int root) {
    std::vector<bool> seen(vertices_.size(), false);
    int loops = 0;
    for (const auto& [start, next] : boundary_) {
      if (find(start) != root || seen[start]) continue;
      ++loops;
      for (int v = start; !seen[v]; v = boundary_.at(v)) seen[v] = true;
    }
    return loops;
  }

  /// No axis if all normals agree on one; else that which cuts the boundary least, the more pronounced fold first.
  bool choose_axis(int root, FoldComponent& component) {
    int best_crossings = 1000;
    float best_depth = 0.0f;
    for (int k = 0; k < 3; ++k) {
      float least = 1.0f, most = -1.0f;
      for (std::size_t v = 0; v < vertices_.size(); ++v) {
        if (find(static_cast<int>(v)) != root) continue;
        least = std::min(least, points_[vertices_[v]].normal[k]);
        most = std::max(most, points_[vertices_[v]].normal[k]);
      }
      if (component.chi == 1 && (least > kCommonAxis || most < -kCommonAxis)) {
        component.fold_axis.reset();
        return true;
      }
      int crossings = 0;
      for (const auto& [from, to] : boundary_) {
        if (find(from) != root) continue;
        crossings += points_[vertices_[from]].normal[k] * points_[vertices_[to]].normal[k] < 0.0f;
      }
      const float depth = std::min(-least, most);
      const bool fewer = crossings < best_crossings || (crossings == best_crossings && depth > best_depth);
      if (crossings >= 2 * component.boundary_loops && fewer) {
        component.fold_axis = k;
        best_crossings = crossings;
        best_depth = depth;
      }
    }
    return component.fold_axis.has_value();
  }

  const TracedVertices& points_;
  std::unordered_map<std::uint32_t, int> index_;
  std::vector<std::uint32_t> vertices_;
  std::vector<int> parent_;
  std::vector<std::pair<int, int>> links_;
  std::vector<int> discs_;       ///< a vertex of each
  std::map<int, int> boundary_;  ///< links that are on the boundary of the cell
};

class FoldSearch {
 public:
  FoldSearch(const Lattice& lattice, const CellStore& store, const SplitLattice& split, const TracedVertices& vertices)
      : lattice_(lattice), store_(store), split_(split), vertices_(vertices) {
    for (const SplitCell& cell : split.cells()) {
      for (const LeafCell& leaf : cell.leaves) leaves_.emplace(leaf.key, &leaf);
    }
  }

  /// The largest cells in `key` that can keep their size.
  void search(const CellKey& key, std::vector<FoldCell>& found) const {
    if (auto cell = analyse(key)) {
      found.push_back(std::move(*cell));
      return;
    }
    for (int c = 0; c < 8; ++c) {
      const CellKey child = child_cell(key, c);
      if (split_.is_split(child)) search(child, found);
    }
  }

 private:
  std::optional<FoldCell> analyse(const CellKey& key) const {
    CellSurface surface(vertices_);
    LoopCollector collector(lattice_, store_, split_, vertices_);
    if (!add_leaves(key, collector, surface)) return std::nullopt;
    auto components = surface.components(lattice_.point(key.lo), lattice_.point(cell_hi(key)));
    if (!components) return std::nullopt;
    return FoldCell{key, std::move(*components)};
  }

  bool add_leaves(const CellKey& key, LoopCollector& collector, CellSurface& surface) const {
    for (int c = 0; c < 8; ++c) {
      const CellKey child = child_cell(key, c);
      if (split_.is_split(child)) {
        if (!add_leaves(child, collector, surface)) return false;
        continue;
      }
      const auto leaf = leaves_.find(child);
      if (leaf == leaves_.end()) continue;
      for (const Loop& loop : collector.collect(child, 0, leaf->second->empty_faces)) {
        if (!goes_round_surface(*leaf->second, loop)) return false;
        std::vector<Link> links;
        for (std::size_t i = 0; i < loop.size(); ++i) {
          links.push_back({loop[i].vertex, loop[(i + 1) % loop.size()].vertex});
        }
        surface.add_disc(links);
      }
    }
    return true;
  }

  const Lattice& lattice_;
  const CellStore& store_;
  const SplitLattice& split_;
  const TracedVertices& vertices_;
  std::unordered_map<CellKey, const LeafCell*, CellKeyHash> leaves_;
};

/// Cells that are looked at together: those next to each other share edges and faces.
constexpr std::size_t kBatch = 32;

/// What was found in one batch.
struct BatchResult {
  std::vector<FoldCell> folds;
  std::vector<UncertifiedPlace> uncertified;
  int finest_level = 0;
};

BatchResult search_batch(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                         std::span<const CellKey> cells) {
  BatchResult result;
  const FoldCellMap none;
  TracedVertices vertices(store);
  SplitLattice split(field, lattice, store, none, vertices);
  split.split(cells, 1);
  for (const SplitCell& cell : split.cells()) {
    for (const LeafCell& leaf : cell.leaves) result.finest_level = std::max(result.finest_level, leaf.key.level);
  }
  result.uncertified = split.uncertified();
  if (!result.uncertified.empty()) return result;
  const FoldSearch search(lattice, store, split, vertices);
  for (const CellKey& cell : cells) search.search(cell, result.folds);
  return result;
}

}  // namespace

FoldSearchResult find_fold_cells(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                                 int threads) {
  std::vector<CellKey> cells;
  for (std::uint32_t b = 0; b < store.bricks().size(); ++b) {
    const auto& in_brick = store.bricks()[b].cells;
    for (std::uint32_t i = 0; i < in_brick.size(); ++i) {
      if (in_brick[i].direction.sign == 0) cells.push_back({store.lowest_corner({b, i}), 0});
    }
  }
  std::vector<BatchResult> found((cells.size() + kBatch - 1) / kBatch);
  parallel_for(found.size(), threads, [&](std::size_t i) {
    const std::size_t first = i * kBatch, last = std::min(cells.size(), first + kBatch);
    found[i] = search_batch(field, lattice, store, std::span(cells).subspan(first, last - first));
  });
  FoldSearchResult result;
  for (BatchResult& batch : found) {
    for (FoldCell& cell : batch.folds) {
      const CellKey key = cell.key;
      result.folds.emplace(key, std::move(cell));
    }
    result.uncertified.insert(result.uncertified.end(), batch.uncertified.begin(), batch.uncertified.end());
    result.finest_level = std::max(result.finest_level, batch.finest_level);
  }
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(result.to_split),
               [&](const CellKey& key) { return !result.folds.contains(key); });
  return result;
}

}  // namespace gaussmesh
