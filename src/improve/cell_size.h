// How large the cells of the trace should be for the triangles to come.
#pragma once

#include "field/gaussian_field.h"
#include "improve/size_field.h"

namespace gaussmesh {

/// Edge (A) of cells that suit the wanted triangles: targets.spacing, or less where the curvature or the tolerance
/// makes most triangles smaller. Cells that are much too large cost more: they are split for the proof, and
/// improvement has to make most of the triangles. A guess from sizes at a few hundred places; nothing but cost hangs
/// on it.
///
/// Cost: a few milliseconds, and a pass over the atoms.
double suitable_cell_size(const GaussianField& field, const SizeTargets& targets);

}  // namespace gaussmesh
