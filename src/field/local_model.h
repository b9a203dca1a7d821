// Bounds of the field over a box and its parts: the proof's one source of truth.
#pragma once

#include <array>
#include <span>

#include "core/direction.h"
#include "core/quad.h"
#include "field/near_atoms.h"

namespace gaussmesh {

/// An interval that contains the exact value.
struct Range {
  double lo = 0.0;
  double hi = 0.0;
};

/// The numbers of a local model: the field around the middle m of a box, with a proven remainder.
///
/// With a_i the weight of atom i at m, u_i = m - x_i, v = E[u] the mean under the weights and y_i = -2 d (u_i - v),
///
///     psi(m + t) = log(phi / c) = psi(m) + log g(t) - 2 d v.t - d |t|^2,       g(t) = E[exp(y.t)].
///
/// g has g(0) = 1, no linear term (E[y] = 0) and g >= 1 (Jensen), so it is well described by its moments of second and
/// third order. With z_i = sup y_i.t over the box, what is left out is at most E[exp(z) - 1 - z - z^2/2 - z^3/6], and
/// its derivative along axis k at most E[|y_k| (exp(z) - 1 - z - z^2/2)]; over a part of the box that lies within
/// lambda times the box around m, lambda^4 and lambda^3 times that. Exponents are relative to the mean, so that a
/// radius of 1000 A makes no larger numbers than one of 1 A. Rounding and truncation are in the ranges.
struct LocalModelTerms {
  double decay = 0.0;
  Vec3 middle{};           ///< m
  Vec3 half{};             ///< half widths of the box (A)
  bool empty = true;       ///< no atom counts: only the tail is there
  bool usable = false;     ///< false: the moments say nothing, the box is too large for the atoms
  double psi = 0.0;        ///< log(phi / c) at the middle
  Vec3 mean_offset{};      ///< v (A)
  double second[6]{};      ///< E[y y]: xx yy zz xy xz yz (1/A^2)
  double third[10]{};      ///< E[y y y]: xxx yyy zzz xxy xxz yyx yyz zzx zzy xyz (1/A^3)
  double remainder = 0.0;  ///< E[exp(z) - 1 - z - z^2/2 - z^3/6]
  Vec3 remainder_slope{};  ///< E[|y_k| (exp(z) - 1 - z - z^2/2)] (1/A)
  double growth = 1.0;     ///< E[exp(z)] >= g anywhere in the box
  double log_growth = 0.0;
  double slope_size = 0.0;  ///< no |y| is larger (1/A)
  double relative_error = 0.0;
  double tail = 0.0;
  double tail_slope = 0.0;
  Vec3 atoms_lo{}, atoms_hi{};
};

/// Half the width of an interval, rounded up to cover it from its rounded middle. Flat is flat: no slack is needed.
template <typename Real>
GAUSSMESH_SIMD_INLINE Real half_width(const Real& lo, const Real& hi, const Real& middle) {
  return select(lo < hi, 0.5 * (hi - lo) * (1.0 + 1e-12) + 4e-16 * size_of(middle), Real{});
}

/// What parts of a box are found to be, by number of the part.
struct PartProofs {
  static constexpr int kMost = 8;
  /// Along which axes phi passes c in one sense only wherever it does: bit 2 k + 1 is growth along axis k, bit 2 k is
  /// fall; kAllDirections where there is no surface.
  std::array<unsigned, kMost> directions{};
  /// By the model, the surface passes through the inner half: no proof, only a reason to stop looking for one.
  std::array<bool, kMost> is_surely_crossed{};
};

/// The model of a box; see above.
class LocalModel {
 public:
  LocalModel() = default;

  /// `atoms` were collected for `box` or for a box around it. Cost: two exponentials per atom.
  LocalModel(const NearAtoms& atoms, double decay, const Box& box);

  /// What part of the box is asked about.
  class View;
  View over(const Box& part) const;
  View over_all() const;

  /// Asks about up to PartProofs::kMost parts at once, side by side in SIMD lanes: for what two Views cost.
  PartProofs prove(std::span<const Box> parts) const;

  /// Of such parts, bit i of part i: there is no surface, or phi passes c as the direction says wherever it does.
  unsigned prove_along(std::span<const Box> parts, const Direction& direction) const;

  const Box& box() const { return box_; }

 private:
  Box box_;
  LocalModelTerms terms_;
};

/// The series of g at the middle of a part of the box, and what it leaves out: of one part, or of one in each lane.
template <typename Real>
struct LocalSeries {
  Real t[3]{};  ///< middle of the part relative to the model's (A)
  Real s[3]{};  ///< its half widths (A)
  Real g{};     ///< g and its derivatives at t
  Real g1[3]{};
  Real g2[6]{};                 ///< xx yy zz xy xz yz
  Real sum1{}, sum2{}, sum3{};  ///< sums |derivative| s^order over all index tuples
  Real remainder{};
  Real remainder_slope[3]{};
};

/// The model over one part of its box, which may be flat: a face, an edge, a point.
class LocalModel::View {
 public:
  View(const LocalModel& model, const Box& part);

  /// Range of log(phi / c) over the part.
  Range value() const;

  /// Range that has the sign of d(phi)/dx_axis wherever in the part phi = c: a positive `lo` or a negative `hi` proves
  /// it.
  Range slope(int axis) const;

  /// The same of the derivative along the vector of a direction, whatever the sign that it tells.
  Range slope(const Direction& direction) const;

  /// What PartProofs says of a part.
  unsigned directions() const;
  bool is_surely_crossed() const;

  /// Whether there is no surface in the part, or phi passes c as the direction says wherever it does.
  bool proves(const Direction& direction) const;

  /// log(phi / c) at the middle of the part, from the model, and its gradient; no bounds.
  double middle_value() const;
  Vec3 middle_gradient() const;
  double middle_curvature(int axis) const;  ///< second derivative along an axis
  double middle_third(int axis) const;      ///< third derivative along it

 private:
  template <typename Along>
  Range slope_along(const Along& along) const;

  const LocalModelTerms& terms_;
  LocalSeries<double> series_;
};

}  // namespace gaussmesh
