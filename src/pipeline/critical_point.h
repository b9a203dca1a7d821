// Where the field is (nearly) singular.
#pragma once

#include "field/gaussian_field.h"

namespace gaussmesh {

/// A critical point of phi near a place.
struct CriticalPoint {
  Vec3 point{};                 ///< A
  double relative_value = 0.0;  ///< phi / c there
  bool converged = false;       ///< false: Newton's method went astray, and `point` is where it began
};

/// Newton's method on grad log phi = 0 from `place` (A), within a third of the width of a Gaussian; where it goes
/// astray the place itself is the answer. For a message, not for a proof. Cost: up to 80 sums over the atoms nearby.
CriticalPoint find_critical_point(const GaussianField& field, const Vec3& place);

}  // namespace gaussmesh
