// Splitting, collapsing and flipping edges, under the vetoes that keep what was proven.
//
// An operation is refused if it breaks the link condition, turns a triangle by more than kTurnLimit (or more than those
// it replaces) from the field, leaves the block, or lets triangles meet where another sheet is near. So the mesh keeps
// its topology, its side and its embedding. Only splits may turn their parts farther, where triangles lie over a rim,
// and then exact signs keep these from all their neighbours.
#pragma once

#include "improve/block_mesh.h"
#include "improve/sheet_guard.h"

namespace gaussmesh {

// The first four go through the block once, in the order of its numbers, and return how many operations they made.

/// Splits edges longer than `factor` times the wanted size in the middle; new vertices are put on the surface.
std::size_t split_long_edges(BlockMesh& mesh, SheetGuard& guard, BlockField& field, double factor, Accuracy accuracy);

/// Collapses edges shorter than `factor` times the wanted size, into the end of the half-edge with the smaller number,
/// or into the other one where that is refused.
std::size_t collapse_short_edges(BlockMesh& mesh, SheetGuard& guard, double factor);

/// Flips edges whose opposite angles add up to more than 180 degrees: Delaunay's condition.
std::size_t flip_edges(BlockMesh& mesh, SheetGuard& guard);

/// Flips edges where that brings the valences nearer to 6 [Botsch, Kobbelt 2004].
std::size_t even_out_valences(BlockMesh& mesh, SheetGuard& guard);

/// One of them on one edge that is not on the boundary. @return whether it was allowed, and done
bool try_flip(BlockMesh& mesh, SheetGuard& guard, std::uint32_t half_edge);
/// @param longest  no edge may come out longer (A)
bool try_collapse(BlockMesh& mesh, SheetGuard& guard, std::uint32_t half_edge, double longest);
/// @param middle  the new vertex
bool try_split(BlockMesh& mesh, SheetGuard& guard, std::uint32_t half_edge, const Place& middle);

/// Moves an inner vertex, unless that turns or meets triangles; the smallest angle round it may fall to
/// `least_sine`, or to where it was.
bool try_move(BlockMesh& mesh, SheetGuard& guard, std::uint32_t vertex, const Place& place, double least_sine);

}  // namespace gaussmesh
