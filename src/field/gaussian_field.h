// The molecular Gaussian field, and which of its atoms count where.
#pragma once

#include <cstdint>
#include <vector>

#include "field/near_atoms.h"
#include "gaussmesh/atom.h"

namespace gaussmesh {

/// phi(x) = sum_i exp(-d (|x - x_i|^2 - r_i^2)), seen relative to the isovalue c: the surface is phi / c = 1.
///
/// Atoms are kept in a tree of boxes, in an order that depends on the atoms alone and not on the file: everything
/// computed from the field has the same bits for any order of the atoms in the input. Thread-safe once built.
class GaussianField {
 public:
  /// @param atoms     at least one
  /// @param decay     d, 1/A^2, > 0
  /// @param isovalue  c, > 0
  /// Cost: O(n log n).
  GaussianField(const std::vector<Atom>& atoms, double decay, double isovalue);

  double decay() const { return decay_; }
  std::size_t size() const { return atoms_.x.size(); }

  /// All atoms, in the order of the tree.
  const WeightedCentres& atoms() const { return atoms_; }

  /// A box outside which phi < c, proven.
  Box bounding_box() const { return bounds_; }

  /// Fills `near` with the atoms that count in `box`, those with w - d dist^2 >= -cut somewhere in it.
  /// Cost: O(result + log n) for a small box.
  void collect_near(const Box& box, NearAtoms& near, double cut = kTruncation) const;

 private:
  struct Node {
    Box box;  ///< of the centres
    double w_max = 0.0;
    double w_all = 0.0;       ///< log of what its atoms have together at most
    double w_size = 0.0;      ///< largest |w|
    std::uint32_t first = 0;  ///< atoms first .. last - 1
    std::uint32_t last = 0;
    std::uint32_t right = 0;  ///< the left child follows its parent; 0 in a leaf
  };
  struct WeightedCentre {
    Vec3 centre;
    double w;
  };

  std::uint32_t build(std::vector<WeightedCentre>& atoms, std::uint32_t first, std::uint32_t last);

  double decay_;
  WeightedCentres atoms_;
  std::vector<Node> nodes_;
  Box bounds_;
};

}  // namespace gaussmesh
