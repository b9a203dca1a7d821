// The surface in ONE cell, put together from the discs in smaller, certified cells: what FoldTriangulator has to make.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "patch/fold_triangulator.h"
#include "pipeline/traced_vertices.h"

namespace gaussmesh {

/// Joins discs where they have sides in common, and tells what pieces come out.
class CellSurface {
 public:
  explicit CellSurface(const TracedVertices& points) : points_(points) {}

  /// @param sides  of the loop round the disc, one after the other
  void add_disc(std::span<const Link> sides);

  /// The pieces, with their Euler numbers, the loops that bound them, and the axes whose fold curves cut them.
  /// @return nothing if one has no root on the edges of the cell from `lo` to `hi`, no boundary, or no axis to be cut
  /// along
  std::optional<std::vector<FoldComponent>> components(const CoordPoint& lo, const CoordPoint& hi);

 private:
  int local(std::uint32_t vertex);
  int find(int v) { return static_cast<int>(pieces_.find(static_cast<std::uint32_t>(v))); }
  void find_boundary();
  int count_boundary_loops(int root);

  /// Of the normals in a piece, along one axis.
  struct NormalRange {
    float least = 1.0f, most = -1.0f;
  };
  using NormalRanges = std::array<NormalRange, 3>;
  NormalRanges normal_ranges(int root);
  static bool have_common_axis(const NormalRanges& ranges);
  /// The axis whose fold curves cut the boundary least, and each loop of it twice on average; the more pronounced fold
  /// of equal ones.
  std::optional<int> choose_axis(int root, int boundary_loops, const NormalRanges& ranges);

  const TracedVertices& points_;
  std::unordered_map<std::uint32_t, int> index_;
  std::vector<std::uint32_t> vertices_;
  DisjointSets pieces_;  ///< of the vertices
  std::vector<std::pair<int, int>> links_;
  std::vector<int> discs_;       ///< a vertex of each
  std::map<int, int> boundary_;  ///< links that are on the boundary of the cell
};

}  // namespace gaussmesh
