// How finely the surface is to be traced.
#pragma once

#include <vector>

#include "pipeline/fine_cells.h"

namespace gaussmesh {

struct TraceDemands {
  double spacing = 0.5;  ///< A: the size of the cells
  /// Cells are split also where triangles are turned or thin in ways that improvement cannot mend.
  bool for_improvement = false;
  std::vector<FinePlace> fine_places{};  ///< cells are split there also
};

}  // namespace gaussmesh
