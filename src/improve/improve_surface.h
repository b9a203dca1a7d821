// Triangles that a solver can trust: the traced mesh, made over.
#pragma once

#include <vector>

#include "field/gaussian_field.h"
#include "gaussmesh/triangle_mesh.h"
#include "roots/edge_roots.h"

namespace gaussmesh {

/// A mesh of the surface with the field's normals at its vertices.
struct SurfaceMesh {
  std::vector<SurfacePoint> points;
  std::vector<Triangle> triangles;
};

/// What was done to it.
struct ImproveCounts {
  std::size_t splits = 0;
  std::size_t collapses = 0;
  std::size_t flips = 0;
  std::size_t moves = 0;
};

struct ImproveResult {
  SurfaceMesh mesh;
  ImproveCounts counts;
};

/// Makes the triangles of `traced` nearly equilateral with edges of about `spacing` (A), smaller where the surface
/// curves more: rounds of splits, collapses, Delaunay flips and relaxation along the surface [Botsch, Kobbelt 2004],
/// then repairs of the worst triangles one by one. Every vertex stays on the surface; topology and orientation are
/// kept by vetoes on every operation, and triangles are kept apart by exact signs wherever two sheets are near.
/// The result has the same bits for any number of threads.
///
/// @param traced  closed, oriented, embedded
/// Cost: about ten sums over the atoms nearby for each vertex.
ImproveResult improve_surface(const SurfaceMesh& traced, const GaussianField& field, double spacing, int threads);

}  // namespace gaussmesh
