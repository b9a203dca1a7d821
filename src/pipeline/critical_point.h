// Where the field is (nearly) singular.
#pragma once

#include "field/gaussian_field.h"

namespace gaussmesh {

/// A critical point of phi near a place, and phi / c there.
struct CriticalPoint {
  Vec3 point{};
  double relative_value = 0.0;
  bool converged = false;  ///< false: Newton's method went astray, and `point` is where it began
};

/// Newton's method on grad log phi = 0 from `place`, within a third of the width of a Gaussian; where it goes astray the place
/// itself is the answer. For a message, not for a proof.
CriticalPoint find_critical_point(const GaussianField& field, const Vec3& place);

}  // namespace gaussmesh
