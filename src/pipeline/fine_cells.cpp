#include "pipeline/fine_cells.h"

#include <cmath>

namespace gaussmesh {

FineCells::FineCells(const Lattice& lattice, std::span<const FinePlace> places) {
  for (const FinePlace& place : places) {
    FineIndex around;
    for (int k = 0; k < 3; ++k) {
      const double units = place.at[k] * kUnitsPerAngstrom - static_cast<double>(lattice.offset[k]);
      around[k] = static_cast<std::int64_t>(std::floor(units / static_cast<double>(lattice.step)));
    }
    add(around, place.level);
  }
}

void FineCells::add(const FineIndex& around, int level) {
  const std::int64_t reach = fine_size(level);
  for (int larger = 0; larger < level; ++larger) {
    const std::int64_t size = fine_size(larger);
    FineIndex lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = round_down(around[k] - reach, size);
      hi[k] = round_down(around[k] + reach, size);
    }
    FineIndex n;
    for (n[0] = lo[0]; n[0] <= hi[0]; n[0] += size) {
      for (n[1] = lo[1]; n[1] <= hi[1]; n[1] += size) {
        for (n[2] = lo[2]; n[2] <= hi[2]; n[2] += size) cells_.insert({n, larger});
      }
    }
  }
}

}  // namespace gaussmesh
