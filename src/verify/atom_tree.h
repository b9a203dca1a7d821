// A tree of boxes over atoms, to find those that count at a place in a sum of Gaussians.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "gaussmesh/atom.h"
#include "gaussmesh/triangle_mesh.h"
#include "verify/bounding_box.h"

namespace gaussmesh::verify {

/// Atoms sorted along a Morton curve, and boxes over groups of them, over groups of groups, and so on.
///
/// An atom's exponent at x is r^2 - |x - x_i|^2: its share of phi is exp(decay * exponent). Large and small radii
/// may be mixed at will. Memory is in proportion to the atoms, wherever they lie. Reading it is thread-safe.
class AtomTree {
 public:
  /// @param atoms  at least one, at finite places
  explicit AtomTree(const std::vector<Atom>& atoms);

  std::size_t atom_count() const { return atoms_.size(); }

  /// The number, in the list that the tree was made of, of the atom with the largest exponent at `point`; of
  /// several one, always the same.
  std::uint32_t nearest(const Point& point) const;

  /// The smallest |point - x_i| / r_i of all atoms, of which those of radius 0 do not count; infinite if none does.
  double least_relative_distance(const Point& point) const;

  /// Calls visit(atom) for every atom whose exponent is, at some point of `place`, less than `range` below the
  /// largest exponent at that point; and for some others.
  template <class Visit>
  void for_each_near(const BoundingBox& place, double range, const Visit& visit) const {
    visit_below(levels_.size(), 0, place, least_largest_exponent(place) - range, visit);
  }

  /// Calls visit(atoms), with some neighbours at a time, so that every atom is visited whose exponent is at least
  /// `least` at some point of `place`, and some others; and for all that are not visited leave_out(exponent,
  /// count): so many atoms at most, whose exponents are nowhere in `place` larger than that. Where many are left out
  /// at once, they are as far below `least` as makes all of them count like few, with this decay.
  template <class Visit, class LeaveOut>
  void for_each_group_reaching(const BoundingBox& place, double least, double decay, const Visit& visit,
                               const LeaveOut& leave_out) const {
    const double below_per_level = std::log(static_cast<double>(kFanOut)) / decay;
    visit_groups_below(levels_.size(), 0, place, least, below_per_level, visit, leave_out);
  }

 private:
  /// A box round the centres, and the largest radius.
  struct Group {
    BoundingBox box;
    double radius_sq = 0.0;

    void include(const Group& group) {
      box.include(group.box);
      radius_sq = std::max(radius_sq, group.radius_sq);
    }
  };

  /// The atom of the largest exponent so far.
  struct Best {
    double exponent = -std::numeric_limits<double>::infinity();
    std::size_t atom = 0;
  };

  static constexpr std::size_t kFanOut = 4;  // atoms in a group of the lowest level, groups in one of the next

  static Group group_of(const Atom& atom);

  /// An upper bound, met by a single atom, of the exponents of the group's atoms at the points of `place`.
  static double largest_exponent(const Group& group, const BoundingBox& place) {
    double distance_sq = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double gap = std::max({0.0, group.box.low[k] - place.high[k], place.low[k] - group.box.high[k]});
      distance_sq += gap * gap;
    }
    return group.radius_sq - distance_sq;
  }

  static std::vector<Group> group(const std::vector<Group>& members);

  Best best_below(std::size_t level, std::size_t index, const BoundingBox& place, Best best) const;
  double least_largest_exponent(const BoundingBox& place) const;
  double relative_distance_sq_below(std::size_t level, std::size_t index, const Point& point, double least) const;

  /// Level 0 is the atoms themselves, level k is levels_[k - 1].
  Group group_at(std::size_t level, std::size_t index) const {
    return level == 0 ? group_of(atoms_[index]) : levels_[level - 1][index];
  }

  std::size_t size_of(std::size_t level) const { return level == 0 ? atoms_.size() : levels_[level - 1].size(); }

  template <class Visit>
  void visit_below(std::size_t level, std::size_t index, const BoundingBox& place, double least,
                   const Visit& visit) const {
    if (largest_exponent(group_at(level, index), place) < least) return;
    if (level == 0) {
      visit(atoms_[index]);
      return;
    }
    const std::size_t end = std::min((index + 1) * kFanOut, size_of(level - 1));
    for (std::size_t child = index * kFanOut; child < end; ++child) visit_below(level - 1, child, place, least, visit);
  }

  template <class Visit, class LeaveOut>
  void visit_groups_below(std::size_t level, std::size_t index, const BoundingBox& place, double least,
                          double below_per_level, const Visit& visit, const LeaveOut& leave_out) const {
    constexpr std::size_t kVisited = 2;                       // the level whose groups are visited whole
    const std::size_t under = std::size_t{1} << (2 * level);  // 4^level atoms
    const double largest = largest_exponent(levels_[level - 1][index], place);
    const double levels_above = level > kVisited ? static_cast<double>(level - kVisited) : 0.0;
    if (largest < least - levels_above * below_per_level) {
      leave_out(largest, under);
    } else if (level <= kVisited) {
      visit(std::span(atoms_).subspan(index * under, std::min(under, atoms_.size() - index * under)));
    } else {
      const std::size_t end = std::min((index + 1) * kFanOut, size_of(level - 1));
      for (std::size_t child = index * kFanOut; child < end; ++child)
        visit_groups_below(level - 1, child, place, least, below_per_level, visit, leave_out);
    }
  }

  std::vector<std::uint32_t> order_;        // numbers of the atoms along the curve
  std::vector<Atom> atoms_;                 // in that order
  std::vector<std::vector<Group>> levels_;  // the last has one group, of all
};

}  // namespace gaussmesh::verify
