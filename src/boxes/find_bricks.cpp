#include "boxes/find_bricks.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace gaussmesh {
namespace {

/// Halves a few large cubes round the molecule down to bricks, and drops what bounds show to be free of surface.
class BrickSearch {
 public:
  BrickSearch(const GaussianField& field, const Lattice& lattice) : field_(field), lattice_(lattice) {}

  std::vector<BrickIndex> run(int threads) {
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
    std::vector<BrickIndex> cubes;
    for (std::int64_t i = lo[0] >> log_size; i <= hi[0] >> log_size; ++i) {
      for (std::int64_t j = lo[1] >> log_size; j <= hi[1] >> log_size; ++j) {
        for (std::int64_t k = lo[2] >> log_size; k <= hi[2] >> log_size; ++k) cubes.push_back({i, j, k});
      }
    }
    for (;; --log_size) {
      keep_crossed(cubes, log_size, threads);
      if (log_size == 0) break;
      cubes = halved(cubes);
    }
    std::sort(cubes.begin(), cubes.end());
    return cubes;
  }

 private:
  /// Drops the cubes that bounds show to be free of surface.
  void keep_crossed(std::vector<BrickIndex>& cubes, int log_size, int threads) const {
    constexpr int kChunk = 64;
    std::vector<std::uint8_t> is_free(cubes.size());
    parallel_for_workers(cubes.size(), threads, kChunk, [&] {
      return [&, near = NearAtoms()](std::size_t i) mutable {
        const std::int64_t size = kBrickCells * kFinePerCell << log_size;
        const FineIndex lo{cubes[i][0] * size, cubes[i][1] * size, cubes[i][2] * size};
        const Box box = lattice_box(lattice_, lo, {lo[0] + size, lo[1] + size, lo[2] + size});
        field_.collect_near(box, near);
        const CrudeBounds bounds = crude_bounds(near, box, field_.decay());
        is_free[i] = bounds.inside || bounds.upper < 1.0;
      };
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
      if (!is_free[i]) cubes[kept++] = cubes[i];
    }
    cubes.resize(kept);
  }

  static std::vector<BrickIndex> halved(const std::vector<BrickIndex>& cubes) {
    std::vector<BrickIndex> parts;
    parts.reserve(8 * cubes.size());
    for (const BrickIndex& cube : cubes) {
      for (int part = 0; part < 8; ++part) {
        parts.push_back({2 * cube[0] + (part & 1), 2 * cube[1] + (part >> 1 & 1), 2 * cube[2] + (part >> 2 & 1)});
      }
    }
    return parts;
  }

  const GaussianField& field_;
  const Lattice& lattice_;
};

}  // namespace

std::vector<BrickIndex> find_bricks(const GaussianField& field, const Lattice& lattice, int threads) {
  return BrickSearch(field, lattice).run(threads);
}

}  // namespace gaussmesh
