// The mesh that gaussmesh makes, writes and judges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gaussmesh {

using Point = std::array<double, 3>;            ///< x, y, z in A
using Normal = std::array<float, 3>;            ///< of length 1, pointing into the solvent
using Triangle = std::array<std::uint32_t, 3>;  ///< 0-based vertex numbers, counter-clockwise seen from the solvent

/// Most triangles, and most vertices, of a mesh that can be made or judged: 32-bit numbers, with room.
inline constexpr std::size_t kMostParts = std::size_t{1} << 31;

/// An indexed triangle mesh. Nothing is promised of it here: check_mesh() says what holds (check_mesh.h).
struct TriangleMesh {
  std::vector<Point> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace gaussmesh
