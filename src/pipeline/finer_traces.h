// Where the surface is traced anew with smaller cells, after triangles with small angles were left.
#pragma once

#include <cstddef>

#include "improve/improve_surface.h"
#include "pipeline/trace_demands.h"

namespace gaussmesh {

/// Smaller cells round bad triangles: those that bridge what is finer than they are cannot always be mended, but those
/// of a finer trace can. Sizes are known where there are vertices: each trace may find that the surface curves more
/// between them than the one before has shown. Where most triangles are bad, and cells as large as they should
/// be, all cells are made smaller.
class FinerTraces {
 public:
  /// Adds to the demands what may help against what improvement has left bad.
  /// @param vertices  how many the mesh has
  /// @return whether there is anything
  bool demand(const LeftBad& bad, std::size_t vertices, TraceDemands& demands);

 private:
  bool may_help(const LeftBad& bad, double least_size, std::size_t vertices) const;

  int traces_ = 0;  ///< demanded so far
  std::size_t last_corners_ = 0;
  double last_least_size_ = 0.0;  ///< A; wanted at any of the places; 0 where none were demanded
};

}  // namespace gaussmesh
