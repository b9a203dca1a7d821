// Directions along which the surface is a graph: along an axis, or slanted from one.
#pragma once

#include "core/exact_plane.h"

namespace gaussmesh {

/// A direction of space within 45 degrees of an axis in the planes of that axis, and how phi changes along it.
struct Direction {
  std::int8_t axis = 0;
  std::int8_t sign = 0;                ///< +1: phi grows along the direction; -1: it falls; 0: no direction
  std::array<std::int8_t, 2> slant{};  ///< steps along the first and second other axis for kSlantParts along `axis`

  static constexpr int kSlantParts = 4;

  bool operator==(const Direction&) const = default;

  bool is_slanted() const { return slant[0] != 0 || slant[1] != 0; }

  /// Along the direction; of length 1 along the axis.
  Vec3 vector() const {
    Vec3 v{};
    v[axis] = 1.0;
    v[first_axis(axis)] = double(slant[0]) / kSlantParts;
    v[second_axis(axis)] = double(slant[1]) / kSlantParts;
    return v;
  }

  /// What is seen of a point when one looks against the direction, to scale kSlantParts if it is slanted: points on one
  /// line along it are one point. Exact.
  PlanePoint project(const CoordPoint& p) const {
    const Coord a = p[first_axis(axis)], b = p[second_axis(axis)];
    if (!is_slanted()) return {a, b};
    return {kSlantParts * a - slant[0] * p[axis], kSlantParts * b - slant[1] * p[axis]};
  }
};

/// Bits of directions along axes: 2 k + 1 is growth along axis k, 2 k is fall. All of them hold where there is no
/// surface.
inline constexpr unsigned kAllDirections = 0x3F;

/// Bit k for axis k, from bits of directions along axes.
inline unsigned axes_of(unsigned directions) {
  const unsigned either = directions | directions >> 1;
  return (either & 1u) | (either >> 1 & 2u) | (either >> 2 & 4u);
}

inline Direction along_axis(int axis, int sign = 1) {
  return {static_cast<std::int8_t>(axis), static_cast<std::int8_t>(sign), {}};
}

}  // namespace gaussmesh
