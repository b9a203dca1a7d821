// How large triangles should be where.
#pragma once

#include "improve/block_mesh.h"

namespace gaussmesh {

/// What is asked of the sizes of triangles.
struct SizeTargets {
  double spacing = 0.5;         ///< A: the wanted mean edge
  double tolerance = 0.0;       ///< A: farthest that triangles may be from the surface; 0: no limit
  double cell = 0.5;            ///< A: the cells that the surface was traced with
  double largest_factor = 1.0;  ///< spacings: the wanted edge where nothing asks for less

  double largest() const { return largest_factor * spacing; }
};

/// Angle (radians) between the normals at the ends of an edge of the wanted size, at most, by the curvature at
/// either. On a cylinder of radius R equilateral triangles of edge s turn by up to 2 asin(0.87 s / 2 R) against
/// each other.
inline constexpr double kTurnPerEdge = 1.2;

/// The same by the normals at both ends: between them the surface may curve more than at either.
inline constexpr double kTurnBetweenEnds = 1.0;

/// Largest slope of the wanted size along the surface. The sides of a triangle differ by a quarter at most where
/// sizes grow this fast: more would show in the mean ratio of shortest to longest edge, less in the number of
/// triangles.
inline constexpr double kGrowth = 0.25;

/// No edge is wanted shorter than this part of the spacing for the curvature's sake, which would make many triangles
/// along creases ...
inline constexpr double kLeastSize = 0.01;

/// ... but where the surface curves in both directions, as where it nearly pinches off: there are few of such
/// places, and they are small.
inline constexpr double kLeastSizeOfAll = 1e-6;

/// The wanted edge (A) at a place by its curvatures (1/A) alone: it turns the normal by no more than kTurnPerEdge, a
/// triangle of that edge stays within the tolerance, and it is no longer than targets.largest(). Lower limits are as
/// above.
double wanted_size(const Curvatures& curvatures, const SizeTargets& targets);

/// Wanted edges (A) at the block's active vertices: wanted_size(), and growing by no more than kGrowth per A from where
/// it is less. Sizes of vertices outside the block are taken as they are.
/// Cost: one sum over the atoms nearby for each vertex whose curvature is not known.
void find_wanted_sizes(BlockMesh& mesh, BlockField& field, const SizeTargets& targets);

/// The corners of neighbours that turn_sharply() against each other, in rising order.
std::vector<std::uint32_t> corners_at_sharp_edges(const BlockMesh& mesh);

/// Asks for smaller triangles at some vertices, by a fifth.
void refine(BlockMesh& mesh, const std::vector<std::uint32_t>& vertices);

}  // namespace gaussmesh
