#include "verify/triangle_pair.h"

#include <algorithm>

namespace gaussmesh::verify {
namespace {

using PlaneTriangle = std::array<PlanePoint, 3>;

struct Segment {
  Point from;
  Point to;
};

Segment edge_across(const PlacedTriangle& t, int corner) {
  return {t.corners[(corner + 1) % 3], t.corners[(corner + 2) % 3]};
}

bool intervals_meet(double a, double b, double c, double d) {
  return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

bool segments_meet(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r, const PlanePoint& s) {
  const int r_side = orient2d(p, q, r);
  const int s_side = orient2d(p, q, s);
  const int p_side = orient2d(r, s, p);
  const int q_side = orient2d(r, s, q);
  if (r_side == 0 && s_side == 0 && p_side == 0 && q_side == 0)  // all on one line
    return intervals_meet(p[0], q[0], r[0], s[0]) && intervals_meet(p[1], q[1], r[1], s[1]);
  return r_side * s_side <= 0 && p_side * q_side <= 0;
}

/// Whether `p` is inside `t`, which turns by the sign `turn`, or on its rim.
bool is_inside(const PlanePoint& p, const PlaneTriangle& t, int turn) {
  for (int k = 0; k < 3; ++k)
    if (orient2d(t[k], t[(k + 1) % 3], p) * turn < 0) return false;
  return true;
}

/// For a segment, which may be one point, in the plane of a triangle: projected along an axis that leaves the
/// triangle an area, and so takes its plane one to one.
bool coplanar_segment_meets_triangle(const Segment& e, const std::array<Point, 3>& corners) {
  for (int axis = 0; axis < 3; ++axis) {
    const PlaneTriangle t{project_along(axis, corners[0]), project_along(axis, corners[1]),
                          project_along(axis, corners[2])};
    const int turn = orient2d(t[0], t[1], t[2]);
    if (turn == 0) continue;
    const PlanePoint p = project_along(axis, e.from);
    const PlanePoint q = project_along(axis, e.to);
    return is_inside(p, t, turn) || segments_meet(p, q, t[0], t[1]) || segments_meet(p, q, t[1], t[2]) ||
           segments_meet(p, q, t[2], t[0]);
  }
  return false;
}

/// Whether the line through `e`, which is not in the triangle's plane, goes through the triangle.
bool line_pierces(const Segment& e, const std::array<Point, 3>& t) {
  int least = 1;
  int most = -1;
  for (int k = 0; k < 3; ++k) {
    const int turn = orient3d(e.from, e.to, t[k], t[(k + 1) % 3]);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  return least >= 0 || most <= 0;
}

bool segment_meets_triangle(const Segment& e, const PlacedTriangle& t) {
  const int from_side = t.plane.side(e.from);
  const int to_side = t.plane.side(e.to);
  if (from_side * to_side > 0) return false;
  if (from_side * to_side < 0) return line_pierces(e, t.corners);
  const Segment in_plane{from_side == 0 ? e.from : e.to, to_side == 0 ? e.to : e.from};
  return coplanar_segment_meets_triangle(in_plane, t.corners);
}

bool an_edge_meets(const PlacedTriangle& s, const PlacedTriangle& t) {
  for (int k = 0; k < 3; ++k)
    if (segment_meets_triangle(edge_across(s, k), t)) return true;
  return false;
}

/// Whether all of `s` lies strictly on one side of the plane of `t`.
bool is_on_one_side(const PlacedTriangle& s, const PlacedTriangle& t) {
  const int side = t.plane.side(s.corners[0]);
  return side != 0 && t.plane.side(s.corners[1]) == side && t.plane.side(s.corners[2]) == side;
}

/// Two triangles meet only if the rim of one meets the other.
bool meet_at_all(const PlacedTriangle& s, const PlacedTriangle& t) {
  if (is_on_one_side(s, t) || is_on_one_side(t, s)) return false;
  return an_edge_meets(s, t) || an_edge_meets(t, s);
}

/// Where both have another point than their common corner, they have the way to it from there, and all of it up to
/// where it leaves one of them: through the edge across the corner, in a point that is in the other triangle.
bool meet_beyond_corner(const PlacedTriangle& s, int s_corner, const PlacedTriangle& t, int t_corner) {
  return segment_meets_triangle(edge_across(s, s_corner), t) || segment_meets_triangle(edge_across(t, t_corner), s);
}

/// Whether they are coplanar and on the same side of the common edge; the corners given are those across it.
bool meet_beyond_edge(const PlacedTriangle& s, int s_corner, const PlacedTriangle& t, int t_corner) {
  if (s.plane.side(t.corners[t_corner]) != 0) return false;
  const Segment edge = edge_across(s, s_corner);
  for (int axis = 0; axis < 3; ++axis) {
    const PlanePoint from = project_along(axis, edge.from);
    const PlanePoint to = project_along(axis, edge.to);
    const int s_side = orient2d(from, to, project_along(axis, s.corners[s_corner]));
    if (s_side != 0) return orient2d(from, to, project_along(axis, t.corners[t_corner])) == s_side;
  }
  return false;
}

}  // namespace

bool meet_beyond_shared(const PlacedTriangle& s, const PlacedTriangle& t) {
  int shared = 0;
  int s_sum = 0;  // of the places of the shared corners: the only one, or three less the one that is left
  int t_sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s.vertices[i] == t.vertices[j]) {
        ++shared;
        s_sum += i;
        t_sum += j;
      }
  switch (shared) {
    case 0:
      return meet_at_all(s, t);
    case 1:
      return meet_beyond_corner(s, s_sum, t, t_sum);
    case 2:
      return meet_beyond_edge(s, 3 - s_sum, t, 3 - t_sum);
    default:
      return true;
  }
}

}  // namespace gaussmesh::verify
