// The certified trace: from the field to a mesh with the topology of the exact surface.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "improve/improve_surface.h"
#include "pipeline/split_lattice.h"
#include "pipeline/trace_demands.h"

namespace gaussmesh {

/// What the trace made, and how.
struct TraceResult {
  SurfaceMesh surface;
  std::vector<UncertifiedPlace> uncertified;  ///< not empty: no proof at the depth limit, and no surface
  std::vector<std::size_t> boxes_by_level;    ///< cells, then parts of cells, halving
  std::size_t cells = 0;
  std::size_t cells_split = 0;
  std::size_t cells_cut_by_folds = 0;
  double cell_size = 0.0;     ///< A: as demanded, but for a rounding
  double smallest_box = 0.0;  ///< A
};

/// Called at the end of each stage with its name.
using StageClock = std::function<void(const std::string&)>;

/// Traces the surface of `field`.
/// @throws LatticeDegenerate if the surface is degenerate with respect to each of a few lattices, and not for the
///         reason that c is next to a critical value; that counts as uncertified
TraceResult trace_surface(const GaussianField& field, const TraceDemands& demands, int threads,
                          const StageClock& finished);

}  // namespace gaussmesh
