// Exact signs for points of one plane in whole-number coordinates.
#pragma once

#include <cstddef>
#include <span>

#include "core/lattice.h"

namespace gaussmesh {

/// A point of a plane, in units.
struct PlanePoint {
  Coord a = 0;
  Coord b = 0;
  bool operator==(const PlanePoint&) const = default;
};

/// Sign of the area of the triangle p q r: +1 when it turns counter-clockwise. Exact while coordinates differ by less
/// than 2^62.
inline int turn(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) {
  __extension__ using Wide = __int128;
  const Wide area = static_cast<Wide>(q.a - p.a) * (r.b - p.b) - static_cast<Wide>(q.b - p.b) * (r.a - p.a);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// Whether r, known to be on the line through p and q, is on the closed segment between them.
inline bool within(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) {
  const auto between = [](Coord x, Coord y, Coord z) { return (x <= z && z <= y) || (y <= z && z <= x); };
  return between(p.a, q.a, r.a) && between(p.b, q.b, r.b);
}

/// Whether two closed segments have a point in common. Exact.
inline bool segments_meet(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r, const PlanePoint& s) {
  const int r_side = turn(p, q, r), s_side = turn(p, q, s), p_side = turn(r, s, p), q_side = turn(r, s, q);
  if (r_side * s_side < 0 && p_side * q_side < 0) return true;
  return (r_side == 0 && within(p, q, r)) || (s_side == 0 && within(p, q, s)) || (p_side == 0 && within(r, s, p)) ||
         (q_side == 0 && within(r, s, q));
}

/// Whether two segments from a common end p overlap beyond it: same direction. Exact.
inline bool segments_overlap(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) {
  return turn(p, q, r) == 0 && (within(p, q, r) || within(p, r, q));
}

/// A side of a polygon whose corners have numbers.
struct PolygonSide {
  PlanePoint p, q;
  int from = 0, to = 0;
};

/// Whether a side is a point, or two of them have more in common than a corner in which one follows the other. Exact.
/// Cost: O(n^2).
inline bool sides_meet(std::span<const PolygonSide> sides) {
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].p == sides[i].q) return true;
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const PolygonSide &s = sides[i], &t = sides[j];
      const bool meet = s.to == t.from   ? segments_overlap(s.q, s.p, t.q)
                        : t.to == s.from ? segments_overlap(t.q, t.p, s.q)
                                         : segments_meet(s.p, s.q, t.p, t.q);
      if (meet) return true;
    }
  }
  return false;
}

}  // namespace gaussmesh
