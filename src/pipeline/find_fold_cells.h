// Which cells without a certificate can keep their size, cut along fold curves.
#pragma once

#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// What smaller cells told of the cells of level 0 that have no certificate.
struct FoldSearchResult {
  FoldCellMap folds;
  std::vector<CellKey> to_split;  ///< those of level 0 that are not in `folds`, though some in them may be
  std::vector<UncertifiedPlace> uncertified;
  int finest_level = 0;  ///< of the cells that were looked at
};

/// Puts the surface in every cell without a certificate together from smaller, certified cells in it, and finds the
/// largest cells that FoldTriangulator may be able to mesh whole: every component is bounded by loops through the
/// cell's edges. `folds` gets for each its components with Euler number and boundary, and the axis whose fold curves
/// cut it.
FoldSearchResult find_fold_cells(const GaussianField& field, const Lattice& lattice, const CellStore& store,
                                 int threads);

}  // namespace gaussmesh
