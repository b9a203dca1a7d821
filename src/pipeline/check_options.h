// What mesh_surface() refuses before it begins.
#pragma once

#include <vector>

#include "gaussmesh/mesh_surface.h"

namespace gaussmesh {

/// How far vertices may be from phi = c (A): the promise of mesh_surface().
inline constexpr double kVertexTolerance = 1e-6;

/// @throws OptionError  if an option is out of its range, or does not go with another
/// @throws InputError   if there are no atoms, or one with a coordinate or radius that cannot be
void check_options(const std::vector<Atom>& atoms, const MeshOptions& options);

}  // namespace gaussmesh
