// Where the surface can be: bricks of cells, found from the atoms and not from the bounding box.
#pragma once

#include <array>
#include <vector>

#include "field/gaussian_field.h"

namespace gaussmesh {

/// Cells along the edge of a brick.
inline constexpr int kBrickCells = 8;

/// Position of a brick, in bricks.
using BrickIndex = std::array<std::int64_t, 3>;

/// The cell of level 0 with the lowest corner of a brick.
inline FineIndex brick_origin(const BrickIndex& brick) {
  return {brick[0] * kBrickCells * kFinePerCell, brick[1] * kBrickCells * kFinePerCell,
          brick[2] * kBrickCells * kFinePerCell};
}

/// All bricks that bounds do not show to be free of surface, in lexicographic order.
///
/// Halves a cube around all atoms again and again and drops the parts where phi < c or phi > c is proven: work and
/// memory grow with the surface and the atoms.
std::vector<BrickIndex> find_bricks(const GaussianField& field, const Lattice& lattice, int threads = 1);

}  // namespace gaussmesh
