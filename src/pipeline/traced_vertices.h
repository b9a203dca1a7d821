// All vertices of the trace but those inside cells, by number.
#pragma once

#include <span>
#include <vector>

#include "pipeline/cell_store.h"

namespace gaussmesh {

/// The roots on edges of level 0, which have the first numbers, and what is added to them: numbers never change.
class TracedVertices {
 public:
  explicit TracedVertices(const CellStore& store) : store_(store), first_(store.root_vertices()) {}

  const SurfacePoint& operator[](std::uint32_t vertex) const {
    return vertex < first_ ? store_.root(vertex) : points_[vertex - first_];
  }
  /// EdgeRoot::rise of a root.
  int rise(std::uint32_t vertex) const { return vertex < first_ ? store_.rise(vertex) : rises_[vertex - first_]; }

  VertexRange add(std::span<const EdgeRoot> roots) {
    const VertexRange range{next(), static_cast<std::uint32_t>(roots.size())};
    for (const EdgeRoot& root : roots) {
      points_.push_back(root.point);
      rises_.push_back(root.rise);
    }
    return range;
  }

  /// Vertices that are no roots.
  VertexRange add(std::span<const SurfacePoint> points) {
    const VertexRange range{next(), static_cast<std::uint32_t>(points.size())};
    points_.insert(points_.end(), points.begin(), points.end());
    rises_.resize(points_.size(), 0);
    return range;
  }

  /// Nothing names these vertices any more.
  void drop(const VertexRange& range) {
    for (std::uint32_t v = range.first; v < range.first + range.count; ++v) dropped_.push_back(v);
  }

  /// Those that are not in the store; they are not here any more afterwards.
  std::vector<SurfacePoint> release_added() { return std::move(points_); }
  const std::vector<std::uint32_t>& dropped() const { return dropped_; }

 private:
  std::uint32_t next() const { return vertex_number(first_ + points_.size()); }

  const CellStore& store_;
  std::uint32_t first_;
  std::vector<SurfacePoint> points_;
  std::vector<std::int8_t> rises_;
  std::vector<std::uint32_t> dropped_;
};

}  // namespace gaussmesh
