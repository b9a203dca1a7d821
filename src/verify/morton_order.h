// Putting points into an order in which neighbours in the list are neighbours in space.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "verify/bounding_box.h"

namespace gaussmesh::verify {

inline constexpr std::size_t kKeysForThreads = 10000;  ///< so many are worth several threads

/// A point's number, and the cell that it lies in along the Morton (Z) curve.
struct MortonKey {
  std::uint32_t cell;
  std::uint32_t number;
};

/// The cell of `point` among 1024^3 cubes that `box` is cut into.
std::uint32_t morton_cell(const BoundingBox& box, const Point& point);

/// Sorts by cell; equal cells keep their order.
void sort_by_cell(std::span<MortonKey> keys);

/// Sorts `keys` along the Morton curve of their own box, and those that share a cell by the curve inside it, and
/// so on: two atoms 10^6 A apart are each sorted as finely as one alone.
///
/// @param point_of  the point of a number; called several times for each, and by several threads
/// Cost: O(n) for each level; more than one is needed only where many points crowd in one cell.
template <class PointOf>
void sort_along_morton_curve(std::span<MortonKey> keys, const PointOf& point_of) {
  constexpr std::size_t kEnough = 32;  // a run this short is near enough together
  BoundingBox box;
#pragma omp parallel if (keys.size() > kKeysForThreads)
  {
    BoundingBox mine;
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < keys.size(); ++i) mine.include(point_of(keys[i].number));
#pragma omp critical(gaussmesh_morton_order)
    box.include(mine);
  }
  if (box.low == box.high) return;
#pragma omp parallel for schedule(static) if (keys.size() > kKeysForThreads)
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i].cell = morton_cell(box, point_of(keys[i].number));
  sort_by_cell(keys);
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && keys[end].cell == keys[begin].cell) ++end;
    if (end - begin <= kEnough) continue;
    sort_along_morton_curve(keys.subspan(begin, end - begin), point_of);
  }
}

/// The numbers 0 .. count - 1 sorted along the Morton curve of their points; the same for any number of threads.
template <class PointOf>
std::vector<std::uint32_t> morton_order(std::size_t count, const PointOf& point_of) {
  const auto keys = std::make_unique_for_overwrite<MortonKey[]>(count);
#pragma omp parallel for schedule(static) if (count > kKeysForThreads)
  for (std::size_t i = 0; i < count; ++i) keys[i].number = static_cast<std::uint32_t>(i);
  sort_along_morton_curve({keys.get(), count}, point_of);
  std::vector<std::uint32_t> order(count);
#pragma omp parallel for schedule(static) if (count > kKeysForThreads)
  for (std::size_t i = 0; i < count; ++i) order[i] = keys[i].number;
  return order;
}

}  // namespace gaussmesh::verify
