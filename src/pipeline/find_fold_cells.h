// Which cells without a certificate can keep their size, cut along fold curves.
#pragma once

#include "pipeline/split_lattice.h"

namespace gaussmesh {

/// Puts the surface in every split cell together from the smaller, certified cells in it, and finds the largest cells
/// that FoldTriangulator may be able to mesh whole: every component is bounded by loops through the cell's edges.
///
/// @param split  all uncertified cells split, their faces traced: the proof that the result rests on
/// @return       for each cell its components with Euler number and boundary, and the axis whose fold curves cut each
FoldCellMap find_fold_cells(const Lattice& lattice, const CellStore& store, const SplitLattice& split, int threads);

}  // namespace gaussmesh
