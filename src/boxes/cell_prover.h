// The certificate of a cell: the surface in it is a graph along one direction.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/direction.h"
#include "field/lazy_model.h"
#include "field/near_atoms.h"

namespace gaussmesh {

/// Along `direction` phi passes c in one sense only, everywhere in the cell: {phi = c} is single-valued along it. Most
/// cells have an axis for it; where the surface is bent more, a slanted direction in its midst serves as well.
struct CellCertificate {
  enum class Kind : std::int8_t {
    kExcluded,     ///< proven: no surface in the closed cell
    kMonotone,     ///< proven: the derivative along `direction` has its sign wherever phi = c in the closed cell
    kUncertified,  ///< no direction could be proven
  };
  Kind kind = Kind::kUncertified;
  Direction direction{};
  unsigned single_axes = 0;  ///< bit k: the same is proven of axis k; others have not all been looked at
};

/// What is known of a cell before one looks at it.
struct KnownOfCell {
  bool is_crossed = false;           ///< the surface passes through it
  unsigned directions = 0;           ///< proven: bit 2 k + 1 is growth along axis k, bit 2 k fall
  std::optional<int> steepest_axis;  ///< along which phi changes most
};

/// Proves directions of cells, looking closer through sub-boxes where the cell as a whole does not show one.
class CellProver {
 public:
  explicit CellProver(double decay) : decay_(decay) {}

  /// `model` is over the whole cell, and is not asked for where the steepest axis is among the directions known;
  /// `atoms` were collected for a box around it.
  /// @param depth  how often the cell is halved before it counts as unproven
  CellCertificate certify(const NearAtoms& atoms, const LazyModel& model, int depth, const KnownOfCell& known = {});

  /// Sub-boxes that have had models of their own so far, by how often the cell was halved for them.
  const std::vector<std::size_t>& boxes_by_depth() const { return boxes_by_depth_; }

 private:
  /// What a model shows of a box; bits as in KnownOfCell.
  struct Part {
    unsigned proven = 0;   ///< all bits where there is no surface
    unsigned refuted = 0;  ///< the surface is surely here, and phi passes c the other way
  };
  static Part part_of(unsigned directions, bool is_surely_crossed);

  struct Eighth {
    Part part;
    LocalModel model;  ///< where not all directions are proven
  };

  /// By what phi does in the middle of the cell: those along which it changes most come first.
  struct SortedAxes {
    Vec3 gradient{};
    std::array<int, 3> number{};
  };
  static SortedAxes sort_axes(const Vec3& gradient);

  /// Where the cell as a whole shows nothing: what its eighths have in common, and parts of them. @return as certify()
  CellCertificate certify_by_eighths(const NearAtoms& atoms, const LocalModel& model, const SortedAxes& axes);

  /// Axes with their signs, numbered as bits, that no eighth refutes: those that fewest leave open come first.
  static std::vector<int> promising_directions(const std::array<Eighth, 8>& eighths, const SortedAxes& axes);

  /// Where no axis serves the surface bends too far. A direction in the midst of its gradients may do, and where it
  /// does not, one nearer to the gradient that was against it.
  CellCertificate certify_aslant(const std::array<Eighth, 8>& eighths);

  /// Looks for a part of the cell where phi may pass c against the direction, given what tells at once of an eighth
  /// that there is none. @return the gradient there; nothing: the direction is proven
  template <typename Look>
  std::optional<Vec3> find_counterexample(const std::array<Eighth, 8>& eighths, const Direction& direction,
                                          const Look& holds_at_a_look);

  /// The same through the parts of the model's box. @param depth  how often it may be halved
  std::optional<Vec3> find_counterexample_in_parts(const LocalModel& model, const Direction& direction, int depth);

  void count_box(int depth) { ++boxes_by_depth_[std::min<std::size_t>(15, depth_ - depth + 1)]; }

  double decay_;
  int depth_ = 0;         ///< of the cell that is being looked at
  NearAtoms cell_atoms_;  ///< that count in it
  std::vector<std::size_t> boxes_by_depth_ = std::vector<std::size_t>(16, 0);
};

/// One of the eight parts of a box; bit k of `child` chooses the upper half along axis k.
Box child_box(const Box& box, int child);

}  // namespace gaussmesh
