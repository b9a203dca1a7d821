// Exact signs for points in space in whole-number coordinates, and whether triangles meet.
#pragma once

#include <algorithm>

#include "core/lattice.h"

namespace gaussmesh {

/// Sign of det(q - p, r - p, s - p): +1 if p, q, r turn counter-clockwise seen from s. Exact while coordinates differ
/// by less than 2^40 units (1100 A).
inline int orientation(const CoordPoint& p, const CoordPoint& q, const CoordPoint& r, const CoordPoint& s) {
  __extension__ using Wide = __int128;
  const Wide ax = q[0] - p[0], ay = q[1] - p[1], az = q[2] - p[2];
  const Wide bx = r[0] - p[0], by = r[1] - p[1], bz = r[2] - p[2];
  const Wide cx = s[0] - p[0], cy = s[1] - p[1], cz = s[2] - p[2];
  const Wide volume = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

/// Whether segment p q may meet triangle a b c. Exact in general position; where points are coplanar the answer errs
/// on the side of `true`.
inline bool segment_may_meet(const CoordPoint& p, const CoordPoint& q, const CoordPoint& a, const CoordPoint& b,
                             const CoordPoint& c) {
  const int p_side = orientation(a, b, c, p), q_side = orientation(a, b, c, q);
  if (p_side * q_side > 0) return false;
  const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// A triangle with the names of its corners, by which shared ones are known.
struct NamedTriangle {
  std::array<std::uint32_t, 3> name{};
  std::array<CoordPoint, 3> at{};
};

/// Whether two triangles may meet in more than a corner or an edge that they share by name. Errs on the side of
/// `true` where points are coplanar.
inline bool triangles_may_meet(const NamedTriangle& s, const NamedTriangle& t) {
  for (int k = 0; k < 3; ++k) {
    const auto [s_lo, s_hi] = std::minmax({s.at[0][k], s.at[1][k], s.at[2][k]});
    const auto [t_lo, t_hi] = std::minmax({t.at[0][k], t.at[1][k], t.at[2][k]});
    if (s_hi < t_lo || t_hi < s_lo) return false;
  }
  int shared = 0;
  bool s_shared[3]{}, t_shared[3]{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (s.name[i] != t.name[j]) continue;
      s_shared[i] = t_shared[j] = true;
      ++shared;
    }
  }
  if (shared == 3) return true;
  if (shared == 2) {
    const int i = !s_shared[0] ? 0 : !s_shared[1] ? 1 : 2, j = !t_shared[0] ? 0 : !t_shared[1] ? 1 : 2;
    return orientation(s.at[0], s.at[1], s.at[2], t.at[j]) == 0 && orientation(t.at[0], t.at[1], t.at[2], s.at[i]) == 0;
  }
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    if (!s_shared[i] && !s_shared[next] && segment_may_meet(s.at[i], s.at[next], t.at[0], t.at[1], t.at[2]))
      return true;
    if (!t_shared[i] && !t_shared[next] && segment_may_meet(t.at[i], t.at[next], s.at[0], s.at[1], s.at[2]))
      return true;
  }
  if (shared == 0) return false;
  // A shared corner: the edges at it lie in the other triangle only when coplanar.
  const int i = s_shared[0] ? 0 : s_shared[1] ? 1 : 2, j = t_shared[0] ? 0 : t_shared[1] ? 1 : 2;
  const int s1 = orientation(t.at[0], t.at[1], t.at[2], s.at[(i + 1) % 3]);
  const int s2 = orientation(t.at[0], t.at[1], t.at[2], s.at[(i + 2) % 3]);
  const int t1 = orientation(s.at[0], s.at[1], s.at[2], t.at[(j + 1) % 3]);
  const int t2 = orientation(s.at[0], s.at[1], s.at[2], t.at[(j + 2) % 3]);
  if (s1 * s2 > 0 || t1 * t2 > 0) return false;
  return s1 == 0 || s2 == 0 || t1 == 0 || t2 == 0;
}

}  // namespace gaussmesh
