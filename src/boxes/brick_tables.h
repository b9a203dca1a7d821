// Values and bounds of the field on all cells and corners of ONE brick, from separable tables.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "boxes/find_bricks.h"
#include "field/point_value.h"

namespace gaussmesh {

/// A Gaussian is a product of three, one for each axis: exp(w - d |x - x_i|^2) = e^w ex ey ez. On the planes of a brick
/// three short tables of exponentials for each atom give S, the sum over the atoms listed, at all corners by
/// multiplications alone. What S is between corners follows from them: log S(x) + d |x|^2 = log sum exp(linear in x) is
/// convex. With psi = log(S / c) and cells of edges a,
///
///     psi(x) <= max of psi over the corners of the cell + d (3/4) a^2,
///
/// since a convex function is at most its multilinear interpolation; and in the eighth of the cell next to a corner p,
/// with p_k the corner behind p, which a step along axis k from p into the cell leads away from,
///
///     psi(x) >= psi(p) + sum_k min(0, (psi(p) - psi(p_k)) / 2 - d (3/4) a^2),
///
/// since along a line it rises at least as fast as it did before. For that reason too phi grows along an axis wherever
/// phi = c in a cell, if on a plane across the axis before it, no farther than L from any point of the cell,
/// psi < -d L^2. Keeps buffers: one for each thread.
class BrickTables {
 public:
  /// Planes through the corners of a brick's cells, and one more on both sides of it.
  static constexpr int kPlanes = kBrickCells + 3;
  /// Coordinates of the planes, by axis (A): spaced evenly and alike; the brick goes from the second to the last but
  /// one.
  using Planes = std::array<std::array<double, kPlanes>, 3>;

  /// `atoms` were collected for the whole brick. Cost: 33 exponentials and 1500 multiplications per atom.
  void build(const NearAtoms& atoms, double decay, const Planes& planes);

  /// Whether bounds leave it open that the surface passes through the closed cell i, j, k.
  bool may_cross(int i, int j, int k) const { return cells_[i + kBrickCells * (j + kBrickCells * k)] != 0; }

  /// Whether corners of the cell are proven to be on both sides.
  bool is_crossed(int i, int j, int k) const;

  /// Of the cell, a face or an edge of it: what reaches from its lowest corner along axis n where bit n of `extent` is
  /// set. Whether there is no surface in it.
  bool is_free(int i, int j, int k, unsigned extent) const;
  /// Along which axes phi passes c in one sense only wherever it does in it: bit 2 n + 1 is growth along axis n, bit
  /// 2 n is fall.
  unsigned directions(int i, int j, int k, unsigned extent) const;

  /// The axis along which phi changes most from corner to corner of the cell.
  int steepest_axis(int i, int j, int k) const;

  /// Where psi is zero on the edge from the lowest corner of the cell along `axis` (A), by its values at four planes;
  /// no bounds. NaN if its ends are on one side.
  double zero_on_edge(int i, int j, int k, int axis) const;

  /// On which side the corner i, j, k is, each from 0 to kBrickCells.
  Side corner(int i, int j, int k) const {
    const double psi = *at(i, j, k);
    return psi > inside_above_ ? Side::kInside : psi < outside_below_ ? Side::kOutside : Side::kUnknown;
  }

 private:
  static constexpr int kRows = kPlanes * kPlanes;
  static constexpr int kStride[3] = {1, kPlanes, kRows};
  /// The exponentials of one axis for a block of atoms: [plane][atom].
  using Table = std::vector<double>;

  const double* at(int i, int j, int k) const { return &log_sums_[(i + 1) + kPlanes * (j + 1) + kRows * (k + 1)]; }
  bool sum_up(const NearAtoms& atoms, double decay, const Planes& planes);
  void add_block(const NearAtoms& atoms, double decay, const Planes& planes, std::size_t first, std::size_t count);

  std::array<std::uint8_t, kBrickCells * kBrickCells * kBrickCells> cells_{};
  std::array<double, kRows * kPlanes> log_sums_{};   ///< S / c, then psi, at all crossings of planes
  double inside_above_ = 0.0, outside_below_ = 0.0;  ///< what psi proves at a corner, errors and all
  std::array<double, 3> origin_{};                   ///< the brick's lowest corner (A)
  double edge_ = 0.0;                                ///< of the cells (A)
  double square_ = 0.0;                              ///< d a^2, rounded up
  double free_above_ = 0.0;   ///< what bounds of psi between corners prove an inside, as inside_above_
  double grows_below_ = 0.0;  ///< what psi + d L^2 must be below for directions ...
  double edge_slope_ = 0.0;   ///< ... and what the slopes of atoms left out may take from that over an edge
  std::vector<double> weight_, layer_weight_, factor_;
  Table at_[3];
};

}  // namespace gaussmesh
