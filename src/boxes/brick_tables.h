// Values and bounds of the field on all cells and corners of ONE brick, from separable tables.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "boxes/find_bricks.h"
#include "field/point_value.h"

namespace gaussmesh {

/// A Gaussian is a product of three, one for each axis: exp(w - d |x - x_i|^2) = e^w ex ey ez. On the planes of a brick
/// three short tables of exponentials for each atom give phi at every corner by multiplications alone. Tables of the
/// nearest and the farthest distance of the atom from each layer of cells give, as sums of products of nonnegative
/// bounds, an upper and a lower bound of phi for each cell. Keeps buffers: one for each thread.
class BrickTables {
 public:
  /// Coordinates of the planes of a brick, by axis (A).
  using Planes = std::array<std::array<double, kBrickCells + 1>, 3>;

  /// `atoms` were collected for the whole brick. Cost: some 27 exponentials and 2500 multiplications per atom.
  void build(const NearAtoms& atoms, double decay, const Planes& planes);

  /// Whether bounds leave it open that the surface passes through the closed cell i, j, k.
  bool may_cross(int i, int j, int k) const { return cells_[j + kBrickCells * k] >> i & 1; }

  /// On which side the corner i, j, k is, each from 0 to kBrickCells.
  Side corner(int i, int j, int k) const {
    return corners_[i + kCorners * (j + kCorners * k)];
  }

 private:
  static constexpr int kCorners = kBrickCells + 1;
  static constexpr int kRows = kCorners * kCorners;
  /// The exponentials of one axis for a block of atoms: [plane or layer][atom].
  using Table = std::vector<double>;

  void add_block(const NearAtoms& atoms, double decay, const Planes& planes, std::size_t first, std::size_t count);

  std::array<std::uint8_t, kBrickCells * kBrickCells> cells_{};   ///< a bit for each cell of a row along x
  std::array<Side, kRows * kCorners> corners_{};
  std::vector<double> upper_, lower_, value_;                     ///< sums, by row along x
  std::vector<double> weight_, layer_weight_, factor_;
  Table near_[3], far_[3], at_[3];
};

}  // namespace gaussmesh
