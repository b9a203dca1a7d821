// The atoms that count in a box, and a bound for all the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/lattice.h"

namespace gaussmesh {

inline constexpr double kEmptyLo = std::numeric_limits<double>::infinity();

/// Atoms as arrays for SIMD.
struct WeightedCentres {
  std::vector<double> x, y, z;  ///< centres (A)
  std::vector<double> w;        ///< log-weights relative to the isovalue, d r^2 - ln c
};

/// exponent[i] = w - d dist(atom, box)^2 for `count` atoms from `first` on: none has a larger one in the box.
void largest_exponents(const WeightedCentres& atoms, std::size_t first, std::size_t count, const Box& box, double decay,
                       double* exponent);

/// Atoms near a box, in an order that depends on the atoms alone.
///
/// Their field relative to the isovalue is phi(x) / c = sum_i exp(w_i - d |x - x_i|^2), w_i = d r_i^2 - ln c. The
/// atoms left out add at most `tail` to phi / c anywhere in the box, and at most `tail_slope` (1/A) to any component
/// of its gradient.
///
/// Arrays are filled up to whole SIMD vectors: entries from size() to padded() - 1 have a weight of zero.
class NearAtoms : public WeightedCentres {
 public:
  Vec3 lo{kEmptyLo, kEmptyLo, kEmptyLo};  ///< box round the centres, turned inside out while there are none
  Vec3 hi{-kEmptyLo, -kEmptyLo, -kEmptyLo};
  double w_size = 0.0;  ///< largest |w|
  double cut = 0.0;     ///< atoms with a log-weight below -cut everywhere in the box were left out
  double tail = 0.0;
  double tail_slope = 0.0;  ///< 1/A

  std::size_t size() const { return size_; }
  std::size_t padded() const { return (size_ + kLanes - 1) / kLanes * kLanes; }

  /// Becomes an empty list for this cut; nothing is left out yet.
  void clear(double new_cut);

  /// Becomes the `chosen` ones of some atoms; nothing is left out yet. Room for padded() is made in `chosen`.
  void take(const WeightedCentres& atoms, std::vector<std::uint32_t>& chosen, std::size_t count);

  /// Accounts for `count` atoms left out, each with log-weight at most `w_max` and at least `distance_sq` away.
  void add_to_tail(double count, double w_max, double distance_sq, double decay);

  /// Accounts for the atoms left out of `n` with |log-weight| at most `largest_w`: those whose largest exponents are
  /// below -cut, the one that clear() was given. The slope of one is 2 d r e^E = 2 sqrt(d (w - E)) e^E, which falls with
  /// r from w - E = 1/2 on; the sum of the slopes is at most 2 sqrt(d sum e^E sum (w - E) e^E), by Cauchy and Schwarz.
  void add_to_tail(const double* exponent, std::size_t n, double largest_w, double decay);

  /// Becomes the atoms of `parent` that count in `box`, a part of the parent's box: those with
  /// w - d dist^2 >= -new_cut. Cost: one pass over the parent's atoms, some 0.5 ns each.
  void restrict_from(const NearAtoms& parent, const Box& box, double decay, double new_cut);

 private:
  static constexpr std::size_t kLanes = 8;

  std::size_t size_ = 0;
};

/// Log-weight, relative to c, below which an atom is left out: e^-23 = 1e-10.
inline constexpr double kTruncation = 23.0;

/// The same for proofs, where the atoms left out are part of the bounds: e^-10 = 5e-5.
inline constexpr double kProofTruncation = 10.0;

/// The same where little things matter, in small cells near singular places: e^-40 = 4e-18.
inline constexpr double kFineTruncation = 40.0;

/// Whether the atoms that a list leaves out may move the surface by half of what a vertex may be off (1e-6 A), where
/// log phi has this slope (1/A).
inline bool is_tail_felt(const NearAtoms& atoms, double slope) { return !(atoms.tail <= 4e-7 * slope); }

/// Bounds of phi / c over a box from the atoms' distances alone: good for boxes larger than an atom.
struct CrudeBounds {
  double upper = 0.0;   ///< phi / c is at most this where that is below e^700: exponentials end there
  bool inside = false;  ///< one atom alone has phi_i > c everywhere in the box
};
CrudeBounds crude_bounds(const NearAtoms& atoms, const Box& box, double decay);

}  // namespace gaussmesh
