// Why there was no proof: a critical value next to the level, or cells that are too coarse.
#pragma once

#include <string>
#include <vector>

#include "gaussmesh/mesh_surface.h"
#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// The critical points with values near c at the places where the proof gave up; several places have one in common.
/// @return none where cells are too coarse for the surface, and the level is not the reason
std::vector<CriticalPlace> critical_places(const GaussianField& field, const std::vector<UncertifiedPlace>& uncertified,
                                           double isovalue);

/// Says so, for the user; there is at least one place.
/// @param smallest_part  edge of the boxes (A) at which the proof gave up; 0 if it was something else that failed
std::string critical_message(const std::vector<CriticalPlace>& places, double isovalue, double smallest_part);

/// The same where there is no critical point.
std::string coarse_message(const std::vector<UncertifiedPlace>& places);

}  // namespace gaussmesh
