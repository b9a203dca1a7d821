// Bounds of the field over a box and its parts: the proof's one source of truth.
#pragma once

#include "core/direction.h"
#include "field/near_atoms.h"

namespace gaussmesh {

/// An interval that contains the exact value.
struct Range {
  double lo = 0.0;
  double hi = 0.0;
};

/// The field around the middle m of a box, with a proven remainder.
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
class LocalModel {
 public:
  LocalModel() = default;

  /// `atoms` were collected for `box` or for a box around it. Cost: two exponentials per atom.
  LocalModel(const NearAtoms& atoms, double decay, const Box& box);

  /// What part of the box is asked about.
  class View;
  View over(const Box& part) const;
  View over_all() const;

  const Box& box() const { return box_; }

 private:
  friend class View;

  double decay_ = 0.0;
  Box box_;
  Vec3 middle_{};
  Vec3 half_{};
  bool empty_ = true;          ///< no atom counts: only the tail is there
  bool usable_ = false;        ///< false: the moments say nothing, the box is too large for the atoms
  double psi_ = 0.0;           ///< log(phi / c) at the middle
  Vec3 mean_offset_{};         ///< v (A)
  double second_[6]{};         ///< E[y y]: xx yy zz xy xz yz (1/A^2)
  double third_[10]{};         ///< E[y y y]: xxx yyy zzz xxy xxz yyx yyz zzx zzy xyz (1/A^3)
  double remainder_ = 0.0;     ///< E[exp(z) - 1 - z - z^2/2 - z^3/6]
  Vec3 remainder_slope_{};     ///< E[|y_k| (exp(z) - 1 - z - z^2/2)] (1/A)
  double growth_ = 1.0;        ///< E[exp(z)] >= g anywhere in the box
  double log_growth_ = 0.0;
  double slope_size_ = 0.0;    ///< no |y| is larger (1/A)
  double relative_error_ = 0.0;
  double tail_ = 0.0;
  double tail_slope_ = 0.0;
  Vec3 atoms_lo_{}, atoms_hi_{};
};

/// The model over one part of its box, which may be flat: a face, an edge, a point.
class LocalModel::View {
 public:
  View(const LocalModel& model, const Box& part);

  /// Range of log(phi / c) over the part.
  Range value() const;

  /// Range that has the sign of d(phi)/dx_axis wherever in the part phi = c: a positive `lo` or negative `hi` proves it.
  Range slope(int axis) const;

  /// The same of the derivative along the vector of a direction, whatever the sign that it tells.
  Range slope(const Direction& direction) const;

  /// log(phi / c) at the middle of the part, from the model, and its gradient; no bounds.
  double middle_value() const;
  Vec3 middle_gradient() const;
  double middle_curvature(int axis) const;  ///< second derivative along an axis
  double middle_third(int axis) const;      ///< third derivative along it

 private:
  template <typename Along>
  Range slope_of(const Along& along) const;

  const LocalModel& model_;
  Vec3 t_{};            ///< middle of the part relative to the model's (A)
  Vec3 s_{};            ///< its half widths (A)
  double g_ = 1.0;      ///< g and its derivatives at t_
  Vec3 g1_{};
  double g2_[6]{};      ///< xx yy zz xy xz yz
  double sum1_ = 0.0, sum2_ = 0.0, sum3_ = 0.0;  ///< sums |derivative| s^order over all index tuples
  double remainder_ = 0.0;
  Vec3 remainder_slope_{};
};

}  // namespace gaussmesh
