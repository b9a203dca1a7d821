// Vector algebra in rounded arithmetic: for measures, never for signs that decide.
#pragma once

#include <cmath>

#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh::verify {

inline Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

}  // namespace gaussmesh::verify
