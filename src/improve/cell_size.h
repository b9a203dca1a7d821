// What can be known of the triangles to come before anything is traced: from their sizes at a few hundred places.
#pragma once

#include <numbers>
#include <vector>

#include "field/gaussian_field.h"
#include "improve/size_field.h"

namespace gaussmesh {

/// So many equilateral triangles of an edge (A) cover an area (A^2).
inline double triangles_on(double area, double edge) { return area / (0.25 * std::numbers::sqrt3 * edge * edge); }

/// Area (A^2) of the spheres of the atoms, each alone: more than that of the surface but for necks.
double area_of_spheres(const GaussianField& field);

/// Places that are spread evenly over the surface, more or less.
struct SizeSamples {
  std::vector<double> sizes;  ///< wanted edges there (A), in rising order; none where no place was found
  double radius = 0.0;        ///< A: median of those of the spheres that the atoms there have alone
  double area = 0.0;          ///< of the surface (A^2), to a third, and rather too small
};

/// Cost: a few milliseconds, and a pass over the atoms.
SizeSamples sample_sizes(const GaussianField& field, const SizeTargets& targets);

/// Edge (A) of cells that suit the wanted triangles: the spacing (A), or less where the curvature or the tolerance
/// makes most triangles smaller, or where there are creases between atoms. Cells that are much too large cost more: they
/// are split for the proof, and improvement has to make most of the triangles. Nothing but cost hangs on it.
double suitable_cell_size(const SizeSamples& samples, double spacing);

/// A number of triangles that will not be much fewer: by the sizes that some part of the surface does not exceed.
/// Where sizes differ much there are many more.
double least_triangle_count(const SizeSamples& samples);

}  // namespace gaussmesh
