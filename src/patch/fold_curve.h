// The curves along which the surface folds over, seen along an axis.
#pragma once

#include <optional>
#include <vector>

#include "field/near_atoms.h"
#include "roots/edge_roots.h"

namespace gaussmesh {

/// A fold curve { phi = c, d(phi)/dx_k = 0 } followed through a box [CTL12].
struct FoldCurve {
  std::vector<Vec3> points;  ///< from the start, which is not among them, to near the place where it leaves the box
  double length = 0.0;       ///< A
};

/// Follows the fold curve of `axis` from `start`, a point of it on the boundary of `box`, through the box. The curve
/// is followed in space, where it is smooth even at cusps of its projection, by Euler's predictor and Newton's
/// corrector. `atoms` were collected for a box around `box`.
/// @return nothing if the curve could not be followed to the boundary in a length of three box diagonals
/// Cost: some 5 sums over the atoms for each step of a sixteenth of the box.
std::optional<FoldCurve> follow_fold(const NearAtoms& atoms, double decay, const Box& box, const Vec3& start, int axis);

}  // namespace gaussmesh
