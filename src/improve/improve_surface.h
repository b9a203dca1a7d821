// Triangles that a solver can trust: the traced mesh, made over.
#pragma once

#include <functional>
#include <vector>

#include "field/gaussian_field.h"
#include "gaussmesh/triangle_mesh.h"
#include "improve/bad_places.h"
#include "improve/sheet_guard.h"
#include "improve/size_field.h"

namespace gaussmesh {

/// A mesh of the surface with the field's normals at its vertices.
struct SurfaceMesh {
  TriangleMesh mesh;  ///< coordinates are whole units
  std::vector<Normal> normals;
};

/// What was not mended.
struct LeftBad {
  std::size_t corners = 0;  ///< of triangles with an angle below 30 degrees
  /// Where the next trace should be finer: places_round() these triangles, or round all that is bad where
  /// ManyBad::kLeave left it.
  std::vector<BadPlace> places;
};

/// What improvement made of a mesh.
struct ImprovedSurface {
  SurfaceMesh surface;
  LeftBad left;
};

/// Many bad vertices, as part of all, after the sweeps over the whole mesh or after one in boxes: mostly the trace has
/// bridged what is finer than its cells. A trace of finer cells is then mended in a fraction of the time.
/// Of a small mesh that may be few, which are mended at once.
inline constexpr double kManyBad = 0.08;
inline constexpr std::size_t kLeastMany = 50;

/// What to do with them. In either case work ends where many stay bad whatever is done.
enum class ManyBad {
  kLeave,  ///< to a finer trace; so are fewer of them that only become more
  kMend,   ///< as long as it helps
};

/// Makes the triangles of `traced` nearly equilateral with edges of about the spacing, smaller where the surface
/// curves more: rounds of splits, collapses, Delaunay flips and relaxation along the surface [Botsch, Kobbelt
/// 2004], then repairs of the worst triangles one by one. Every vertex stays on the surface; topology and
/// orientation are kept by vetoes on every operation, and triangles are kept apart by exact signs. The work is done
/// in blocks of space whose planes lie elsewhere in each sweep (mesh_blocks.h), the last of them again while triangles
/// are not even, and then in boxes round triangles that are still bad (bad_places.h): the same bits for any number of
/// threads.
///
/// @param traced       closed, oriented, embedded
/// @param field        whose surface it is
/// @param targets      spacing at most kLargestSpacing; `largest_factor` is found here
/// @param guarding     which triangles are kept apart by exact signs
/// @param many_bad     what to do where many are bad
/// @param threads      at least 1
/// @param on_progress  called after each block, on any thread; what it throws comes out
/// @return the mesh, and what is left bad in it; nothing where all angles are kLeastAngleDeg at least
/// Cost: about twenty sums over the atoms nearby for each vertex.
ImprovedSurface improve_surface(SurfaceMesh traced, const GaussianField& field, const SizeTargets& targets,
                                Guarding guarding, ManyBad many_bad, int threads,
                                const std::function<void(double share_done)>& on_progress = {});

/// A; beyond it coordinates of neighbouring triangles differ by more than exact signs allow for
/// (core/exact_space.h).
inline constexpr double kLargestSpacing = 200.0;

}  // namespace gaussmesh
