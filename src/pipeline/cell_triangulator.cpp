#include "pipeline/cell_triangulator.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"

namespace gaussmesh {
namespace {

/// Takes over what an earlier call made of cells that have not changed, cell after cell.
class CellCopier {
 public:
  explicit CellCopier(const PatchedCells& from) : from_(from) {}

  void skip() {
    first_point_ += points_of_cell();
    first_triangle_ += from_.counts[cell_++];
  }

  void copy(bool is_fold_cell, PatchedCells& result) {
    const std::uint16_t triangles = from_.counts[cell_];
    const auto shift = static_cast<std::uint32_t>(result.points.size()) - first_point_;
    for (std::uint32_t t = first_triangle_; t < first_triangle_ + triangles; ++t) {
      Triangle triangle = from_.triangles[t];
      for (std::uint32_t& v : triangle) v = v >= kLocalVertex ? v + shift : v;
      result.triangles.push_back(triangle);
    }
    const auto points = from_.points.begin() + first_point_;
    result.points.insert(result.points.end(), points, points + points_of_cell());
    result.counts.push_back(triangles);
    result.fold_cells += is_fold_cell && triangles > 0;
    skip();
  }

 private:
  /// How many vertices inside itself the cell has: each of them is a corner of its triangles.
  std::uint32_t points_of_cell() const {
    std::uint32_t end = kLocalVertex + first_point_;
    for (std::uint32_t t = first_triangle_; t < first_triangle_ + from_.counts[cell_]; ++t) {
      for (const std::uint32_t v : from_.triangles[t]) end = std::max(end, v + 1);
    }
    return end - kLocalVertex - first_point_;
  }

  const PatchedCells& from_;
  std::size_t cell_ = 0;
  std::uint32_t first_triangle_ = 0, first_point_ = 0;
};

/// The bricks of cells that are in order.
std::vector<std::size_t> bricks_of(const std::vector<CellStore::Place>& cells) {
  std::vector<std::size_t> bricks;
  for (const CellStore::Place& place : cells) {
    if (bricks.empty() || bricks.back() != place.brick) bricks.push_back(place.brick);
  }
  return bricks;
}

}  // namespace

std::vector<CellKey> CellTriangulator::triangulate(const SplitLattice& split, const FoldCellMap& folds,
                                                   const TracedVertices& vertices, int threads) {
  const std::size_t all_bricks = store_.bricks().size();
  const bool is_first = patched_.empty();
  const std::vector<CellStore::Place> changed = is_first ? std::vector<CellStore::Place>() : split.changed_places();
  patched_.resize(all_bricks + split.cells().size());
  std::vector<std::size_t> tasks = bricks_of(changed);  // entries of patched_
  if (is_first) {
    tasks.resize(all_bricks);
    std::iota(tasks.begin(), tasks.end(), std::size_t{0});
  }
  for (const std::uint32_t cell : split.changed_cells()) tasks.push_back(all_bricks + cell);
  const TracedCells cells{store_, split, folds, vertices};
  parallel_for_workers(tasks.size(), threads, 1, [&] {
    return [&, patcher = CellPatcher(field_, lattice_, cells, demands_, fine_cells_)](std::size_t i) mutable {
      PatchedCells result;
      if (tasks[i] >= all_bricks) {
        for (const LeafCell& leaf : split.cells()[tasks[i] - all_bricks].leaves) patcher.patch_leaf(leaf, result);
      } else {
        const auto brick = static_cast<std::uint32_t>(tasks[i]);
        result = is_first ? patch_brick(brick, patcher) : patch_brick_again(brick, changed, patcher);
      }
      result.triangles.shrink_to_fit();
      patched_[tasks[i]] = std::move(result);
    };
  });
  std::vector<CellKey> failed;
  for (const std::size_t task : tasks) {
    failed.insert(failed.end(), patched_[task].failed.begin(), patched_[task].failed.end());
  }
  return failed;
}

PatchedCells CellTriangulator::patch_brick(std::uint32_t brick, CellPatcher& patcher) const {
  PatchedCells result;
  const auto cells = static_cast<std::uint32_t>(store_.bricks()[brick].cells.size());
  result.counts.reserve(cells);
  for (std::uint32_t c = 0; c < cells; ++c) patcher.patch_cell({brick, c}, result);
  return result;
}

PatchedCells CellTriangulator::patch_brick_again(std::uint32_t brick, const std::vector<CellStore::Place>& changed,
                                                 CellPatcher& patcher) const {
  PatchedCells result;
  const auto cells = static_cast<std::uint32_t>(store_.bricks()[brick].cells.size());
  result.counts.reserve(cells);
  CellCopier before(patched_[brick]);
  for (std::uint32_t c = 0; c < cells; ++c) {
    const CellStore::Place place{brick, c};
    if (std::binary_search(changed.begin(), changed.end(), place)) {
      patcher.patch_cell(place, result);
      before.skip();
    } else {
      before.copy(store_.cell(place).direction.sign == 0, result);
    }
  }
  return result;
}

std::size_t CellTriangulator::fold_cells() const {
  std::size_t count = 0;
  for (const PatchedCells& cells : patched_) count += cells.fold_cells;
  return count;
}

}  // namespace gaussmesh
