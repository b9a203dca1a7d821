#include "boxes/find_bricks.h"

#include <algorithm>
#include <cmath>

namespace gaussmesh {
namespace {

class BrickSearch {
 public:
  BrickSearch(const GaussianField& field, const Lattice& lattice) : field_(field), lattice_(lattice) {}

  std::vector<BrickIndex> run() {
    const Box bounds = field_.bounding_box();
    const double brick_size = kBrickCells * lattice_.cell_size();
    BrickIndex lo, hi;
    for (int k = 0; k < 3; ++k) {
      const double origin = to_angstrom(lattice_.offset[k]);
      lo[k] = static_cast<std::int64_t>(std::floor((bounds.lo[k] - origin) / brick_size)) - 1;
      hi[k] = static_cast<std::int64_t>(std::floor((bounds.hi[k] - origin) / brick_size)) + 1;
    }
    // The cubes of bricks aligned to their size; at most two of the right size lie side by side along each axis.
    int log_size = 0;
    for (int k = 0; k < 3; ++k) {
      while ((hi[k] >> log_size) - (lo[k] >> log_size) > 1) ++log_size;
    }
    for (std::int64_t i = lo[0] >> log_size; i <= hi[0] >> log_size; ++i) {
      for (std::int64_t j = lo[1] >> log_size; j <= hi[1] >> log_size; ++j) {
        for (std::int64_t k = lo[2] >> log_size; k <= hi[2] >> log_size; ++k) search({i, j, k}, log_size);
      }
    }
    std::sort(bricks_.begin(), bricks_.end());
    return std::move(bricks_);
  }

 private:
  void search(const BrickIndex& cube, int log_size) {
    const std::int64_t size = kBrickCells * kFinePerCell << log_size;
    const FineIndex lo{cube[0] * size, cube[1] * size, cube[2] * size};
    const Box box = lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size});
    field_.collect_near(box, near_);
    const CrudeBounds bounds = crude_bounds(near_, box, field_.decay());
    if (bounds.inside || bounds.upper < 1.0) return;
    if (log_size == 0) {
      bricks_.push_back(cube);
      return;
    }
    for (int child = 0; child < 8; ++child) {
      search({2 * cube[0] + (child & 1), 2 * cube[1] + (child >> 1 & 1), 2 * cube[2] + (child >> 2 & 1)},
             log_size - 1);
    }
  }

  const GaussianField& field_;
  const Lattice& lattice_;
  NearAtoms near_;
  std::vector<BrickIndex> bricks_;
};

}  // namespace

std::vector<BrickIndex> find_bricks(const GaussianField& field, const Lattice& lattice) {
  return BrickSearch(field, lattice).run();
}

}  // namespace gaussmesh
