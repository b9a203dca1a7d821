// Splitting, collapsing and flipping edges, under the vetoes that keep what was proven.
#pragma once

#include "field/gaussian_field.h"
#include "improve/sheet_guard.h"
#include "improve/working_mesh.h"

namespace gaussmesh {

/// An operation is refused if it breaks the link condition, turns a triangle by more than kTurnLimit (or more than
/// those it replaces) from the field, or lets triangles meet where another sheet is near. So the mesh keeps its
/// topology, its side and its embedding. Each function goes through the mesh once, in the order of its numbers, and
/// returns how many operations it made.

/// Splits edges longer than `factor` times the wanted size in the middle; new vertices are put on the surface.
std::size_t split_long_edges(WorkingMesh& mesh, SheetGuard& guard, const GaussianField& field, double factor,
                             int threads);

/// Collapses edges shorter than `factor` times the wanted size, into the end that leaves the better triangles.
std::size_t collapse_short_edges(WorkingMesh& mesh, SheetGuard& guard, double factor);

/// Flips edges whose opposite angles add up to more than 180 degrees: Delaunay's condition.
std::size_t flip_edges(WorkingMesh& mesh, SheetGuard& guard);

/// Flips edges where that brings the valences nearer to 6 [Botsch, Kobbelt 2004].
std::size_t even_out_valences(WorkingMesh& mesh, SheetGuard& guard);

/// The three of them on one edge, where they are allowed.
bool try_flip(WorkingMesh& mesh, SheetGuard& guard, std::uint32_t half_edge);
bool try_collapse(WorkingMesh& mesh, SheetGuard& guard, std::uint32_t half_edge, double longest);
bool try_split(WorkingMesh& mesh, SheetGuard& guard, std::uint32_t half_edge, const SurfacePoint& middle);

/// Smallest sine of the angles, and least cosine to the field, over the triangles round a vertex.
TriangleQuality star_quality(const WorkingMesh& mesh, std::uint32_t vertex);

}  // namespace gaussmesh
