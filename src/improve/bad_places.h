// Where the whole mesh still has bad triangles, and boxes to work on them.
#pragma once

#include <numbers>
#include <vector>

#include "improve/mesh_blocks.h"

namespace gaussmesh {

/// The smallest angle that triangles are to have; a little above the 30 degrees that are wanted.
inline constexpr double kLeastAngleDeg = 31.0;
inline const double kLeastSine = std::sin(kLeastAngleDeg * std::numbers::pi / 180.0);

/// Corners of triangles with smaller angles, and of neighbours that turn_sharply() against each other, in rising order.
/// Cost: one pass over the triangles, and a second over those that are turned from the field.
std::vector<std::uint32_t> find_bad_vertices(const WholeMesh& mesh, int threads);

/// The same of one block, which knows its sharp edges. @param at_sharp_edges  corners_at_sharp_edges()
std::vector<std::uint32_t> find_bad_vertices(const BlockMesh& mesh, std::vector<std::uint32_t> at_sharp_edges);

/// Corners of triangles with an angle below 30 degrees, in rising order. Cost: one pass over the triangles.
std::vector<std::uint32_t> find_thin_vertices(const WholeMesh& mesh, int threads);

/// Where the mesh is to be worked on, and how large triangles are to be there.
struct BadPlace {
  Vec3 at;          ///< A
  double size;      ///< wanted edge (A)
  int in_vain = 0;  ///< boxes in which it was worked on without any change, one after the other, up to the last one
};

/// Those of some vertices, in their order.
std::vector<BadPlace> places_of(const MeshVertices& mesh, const std::vector<std::uint32_t>& vertices);

/// Places of bad vertices, and of all that are connected with them through edges meant to be much shorter than the
/// cells (A) of the trace: of a long crease, what was mended in this mesh may be bad in the next.
/// Cost: two passes over the triangles.
std::vector<BadPlace> places_round(const std::vector<std::uint32_t>& bad, const WholeMesh& mesh, double cell);

/// How large boxes round places are.
struct BoxSize {
  double half_in_sizes;  ///< from a place to the faces of its box, in wanted edges there
  double most;           ///< A, and no farther than this
};

/// The cube round a place.
Box box_round(const BadPlace& place, const BoxSize& size);

/// Takes places from a list, in their order, whose boxes have no point in common, and leaves out the others in these
/// boxes. @return those with boxes
std::vector<BadPlace> take_apart(std::vector<BadPlace>& places, const BoxSize& size);

}  // namespace gaussmesh
