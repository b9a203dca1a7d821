// The ways from points to the Gaussian surface, eight at a time: the distances of a mesh that is on it, or near.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gaussmesh/triangle_mesh.h"
#include "verify/atom_tree.h"
#include "verify/bounding_box.h"
#include "verify/lanes.h"
#include "verify/log_field.h"

namespace gaussmesh::verify {

/// Where Newton's method along the gradient of log phi leads to from a point.
struct Foot {
  Point place{};          ///< on the surface
  double distance = 0.0;  ///< from the start to there; infinite if no way was found, and then `place` says nothing
  Point gradient{};       ///< of log phi at the start
};

/// The tree of the atoms of a surface. @throws OptionError if decay or isovalue is not positive, or there is no
/// atom
AtomTree tree_for_surface(const std::vector<Atom>& atoms, double decay, double isovalue);

/// Finds the feet of points on { phi = isovalue }, phi(x) = sum_i exp(-decay (|x - x_i|^2 - r_i^2)).
///
/// A step of Newton's method of length s is the last if s^2 times a bound of the second derivative of log phi, over
/// twice the slope, and what rounding and the atoms left out may change, is below the precision. For points within
/// 1e-4 A of the surface that is nearly always the first step: one evaluation. Those for which it does not come
/// about near the start take the slow way (LogField), with all atoms that count.
///
/// Not for several threads at once; the tree must outlive it.
class FootFinder {
 public:
  /// @param reach      how far from their starts the feet are expected (A); those farther off are found, but slowly
  /// @param precision  of the feet (A)
  FootFinder(const AtomTree& tree, double decay, double isovalue, double reach, double precision);

  /// Finds the foot of starts[i] for each i, in feet[i]. Fast where points that follow each other are near each
  /// other. A foot depends on the points of its own call only.
  void find(std::span<const Point> starts, std::span<Foot> feet);

 private:
  /// Atoms, one array for each coordinate, and room for more.
  struct AtomArrays {
    std::vector<double> x, y, z, radius_sq;
    std::size_t size = 0;

    void make_room(std::size_t count);
    void append(const Atom& atom);
  };

  void find_block(std::span<const Point> starts, const BoundingBox& box, std::span<Foot> feet);
  void find_in_lanes(std::span<const Point> starts, std::span<Foot> feet);
  void gather(const BoundingBox& place);
  void choose(const AtomArrays& from, const BoundingBox& place, AtomArrays& to);
  Foot find_slowly(const Point& start);

  const AtomTree& tree_;
  double decay_;
  double log_isovalue_;
  double reach_;
  double precision_;
  double least_share_;           // atoms of less than exp(-least_share_) of the isovalue are left out
  double left_out_ = 0.0;        // bound of the share of isovalue that the atoms not gathered have
  double rounding_ = 0.0;        // bound of the rounding error of log phi
  AtomArrays visited_;           // those that may count round a block of points
  AtomArrays near_;              // those that do
  AtomArrays chosen_;            // of these, those that count round the points in the lanes
  std::vector<double> largest_;  // exponents of atoms that are chosen from
  LogField slow_field_;
};

}  // namespace gaussmesh::verify
