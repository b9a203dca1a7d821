#include "pipeline/find_fold_cells.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "core/parallel.h"
#include "pipeline/cell_surface.h"
#include "pipeline/loop_collector.h"

namespace gaussmesh {
namespace {

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

/// Looks for the largest cells that can keep their size, in a lattice that is split until all cells have certificates.
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
