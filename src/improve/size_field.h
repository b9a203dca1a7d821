// How large triangles should be where.
#pragma once

#include <vector>

#include "field/gaussian_field.h"
#include "improve/working_mesh.h"

namespace gaussmesh {

/// Wanted edges (A) by vertex: `spacing`, less where the curvature asks for it - an edge may turn the normal by no
/// more than kTurnPerEdge - and growing by no more than kGrowth per A from there.
std::vector<float> wanted_sizes(const WorkingMesh& mesh, const GaussianField& field, double spacing, int threads);

/// Angle (radians) between the normals at the ends of an edge of the wanted size.
inline constexpr double kTurnPerEdge = 1.2;

/// Largest slope of the wanted size along the surface: neighbours differ by less than a factor of 2.
inline constexpr double kGrowth = 0.4;

/// No edge is wanted shorter than this part of the spacing.
inline constexpr double kLeastSize = 0.3;

}  // namespace gaussmesh
