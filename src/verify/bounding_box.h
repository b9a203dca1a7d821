// Axis-parallel boxes: the cheap first question before any exact one.
#pragma once

#include <algorithm>
#include <limits>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh::verify {

/// All points with low <= x <= high; empty as made, until something is included.
struct BoundingBox {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  void include(const Point& point) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }

  void include(const BoundingBox& box) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], box.low[k]);
      high[k] = std::max(high[k], box.high[k]);
    }
  }
};

/// Whether two boxes have a point in common; touching counts. Without branches: most callers cannot predict it.
inline bool boxes_meet(const BoundingBox& a, const BoundingBox& b) {
  unsigned meet = 1;
  for (int k = 0; k < 3; ++k) meet &= unsigned{a.low[k] <= b.high[k]} & unsigned{b.low[k] <= a.high[k]};
  return meet != 0;
}

inline BoundingBox box_of(const TriangleMesh& mesh, const Triangle& triangle) {
  BoundingBox box;
  for (const std::uint32_t vertex : triangle) box.include(mesh.vertices[vertex]);
  return box;
}

}  // namespace gaussmesh::verify
