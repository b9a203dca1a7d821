// Points of boxes, for tests that look densely.
#pragma once

#include <vector>

#include "core/lattice.h"
#include "support/random.h"

namespace gaussmesh::testing {

inline Vec3 random_point(Random& random, const Box& box) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = box.lo[k] == box.hi[k] ? box.lo[k] : random.uniform(box.lo[k], box.hi[k]);
  return p;
}

/// The points of a regular grid over a box, `count` along each axis, ends included.
inline std::vector<Vec3> grid_points(const Box& box, int count) {
  const auto at = [&](int k, int i) {
    return i == count - 1 ? box.hi[k] : box.lo[k] + (box.hi[k] - box.lo[k]) * i / (count - 1);
  };
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      for (int k = 0; k < count; ++k) points.push_back({at(0, i), at(1, j), at(2, k)});
    }
  }
  return points;
}

/// A box of random size with its middle in `room`.
inline Box random_box(Random& random, const Box& room, double least_size, double largest_size) {
  const Vec3 middle = random_point(random, room);
  Box box;
  for (int k = 0; k < 3; ++k) {
    const double half = 0.5 * random.logarithmic(least_size, largest_size);
    box.lo[k] = middle[k] - half;
    box.hi[k] = middle[k] + half;
  }
  return box;
}

/// A part of a box, flat along each axis with probability `flat`.
inline Box random_part(Random& random, const Box& box, double flat) {
  Box part = box;
  for (int k = 0; k < 3; ++k) {
    double a = random.uniform(box.lo[k], box.hi[k]), b = random.uniform(box.lo[k], box.hi[k]);
    if (random.uniform(0.0, 1.0) < flat) b = a;
    if (random.uniform(0.0, 1.0) < 0.3) a = box.lo[k];  // faces of the box and the whole of it, too
    if (random.uniform(0.0, 1.0) < 0.3) b = a == b ? a : box.hi[k];
    part.lo[k] = std::min(a, b);
    part.hi[k] = std::max(a, b);
  }
  return part;
}

inline Box box_around(const Vec3& p, double half) {
  return {{p[0] - half, p[1] - half, p[2] - half}, {p[0] + half, p[1] + half, p[2] + half}};
}

}  // namespace gaussmesh::testing
