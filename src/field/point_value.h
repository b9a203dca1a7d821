// The field at a point, to rounding.
#pragma once

#include <cstdint>

#include "field/near_atoms.h"

namespace gaussmesh {

/// log(phi / c) and its gradient at a point. The surface is where `value` is zero; it is positive inside.
struct PointValue {
  double value = 0.0;  ///< of the atoms in the list; those left out can only add to it
  double error = 0.0;  ///< proven bound of its rounding error
  Vec3 gradient{};     ///< 1/A, of the atoms in the list
};

/// On which side of the surface a point lies, atoms left out and rounding considered.
enum class Side : std::int8_t { kOutside, kInside, kUnknown };
Side side_of(const PointValue& value, const NearAtoms& atoms);

/// Evaluates the sum over `atoms` directly; the point lies in the box that they were collected for.
/// Cost: one exponential per atom, some 100 ns near a protein.
PointValue evaluate(const NearAtoms& atoms, double decay, const Vec3& point);

/// The same with the derivatives of the gradient along an axis.
struct LineValue {
  PointValue point;
  Vec3 gradient_slope{};      ///< 1/A^2
  Vec3 gradient_curvature{};  ///< second derivatives, 1/A^3
};
LineValue evaluate_along(const NearAtoms& atoms, double decay, const Vec3& point, int axis);

/// Largest exponent w_i - d |p - x_i|^2; there is an atom.
double largest_exponent(const NearAtoms& atoms, double decay, const Vec3& point);

/// Relative rounding error of a sum of n weights exp(e), |e| assembled from terms up to `exponent_size`.
///
/// An exponent w - d |u|^2 takes 8 roundings of relative 2^-53 on terms of at most that size; the exponential has
/// kVectorExpError; adding n positive terms rounds n times more.
double weight_error(double exponent_size, std::size_t n);

}  // namespace gaussmesh
