#include "patch/patch_triangulator.h"

#include <algorithm>
#include <cmath>

#include "patch/triangle_shape.h"

namespace gaussmesh {
namespace {

/// Twice the area of a polygon, for its sign and rough size only.
double doubled_area(const auto& polygon) {
  double area = 0.0;
  const PlanePoint o = polygon[0].at;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const PlanePoint p = polygon[i].at, q = polygon[i + 1].at;
    area += static_cast<double>(p.a - o.a) * static_cast<double>(q.b - o.b) -
            static_cast<double>(p.b - o.b) * static_cast<double>(q.a - o.a);
  }
  return area;
}

/// Whether p is strictly inside the polygon. Exact; boundary points are not inside.
bool strictly_inside(const auto& polygon, const PlanePoint& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint &q = polygon[i].at, &r = polygon[(i + 1) % polygon.size()].at;
    const int side = turn(q, r, p);
    if (side == 0 && within(q, r, p)) return false;
    if ((q.b > p.b) != (r.b > p.b) && (side > 0) == (r.b > q.b)) inside = !inside;
  }
  return inside;
}

}  // namespace

std::uint8_t faces_of(const CoordPoint& point, const CoordPoint& lo, const CoordPoint& hi) {
  unsigned faces = 0;
  for (int k = 0; k < 3; ++k) {
    if (point[k] == lo[k]) faces |= 1u << (2 * k);
    if (point[k] == hi[k]) faces |= 2u << (2 * k);
  }
  return static_cast<std::uint8_t>(faces);
}

PlanePoint PatchTriangulator::project(const CoordPoint& p) const {
  const PlanePoint seen = direction_.project(p);
  // Seen from the solvent, so that loops turn counter-clockwise.
  return direction_.sign < 0 ? seen : PlanePoint{seen.b, seen.a};
}

const Patch& PatchTriangulator::triangulate(const CoordPoint& lo, const CoordPoint& hi, const Direction& direction,
                                            std::span<const Loop> loops) {
  lo_ = lo;
  hi_ = hi;
  direction_ = direction;
  atoms_loaded_ = false;
  patch_.triangles.clear();
  patch_.points.clear();
  patch_.complete = make_polygons(loops) && join_holes();
  for (std::size_t i = 0; patch_.complete && i < polygons_.size(); ++i) {
    patch_.complete = triangulate_polygon(polygons_[i]);
  }
  return patch_;
}

bool PatchTriangulator::make_polygons(std::span<const Loop> loops) {
  vertices_.clear();
  polygons_.clear();
  holes_.clear();
  on_outline_ = !direction_.is_slanted();
  const unsigned sides = 0x3Fu & ~(3u << (2 * direction_.axis));
  for (const Loop& loop : loops) {
    if (loop.size() < 3) return false;
    Polygon polygon;
    for (const LoopVertex& v : loop) {
      on_outline_ = on_outline_ && (v.faces & sides) != 0;
      polygon.push_back({project(v.point.position), static_cast<int>(vertices_.size())});
      vertices_.push_back(v);
    }
    const bool positive = doubled_area(polygon) > 0.0;
    // A loop on the sides, which are seen as lines, is an outer boundary, whatever its chords seem.
    const auto on_side = [&](const LoopVertex& v) { return (v.faces & sides) != 0; };
    if (!positive && std::any_of(loop.begin(), loop.end(), on_side)) return false;
    (positive ? polygons_ : holes_).push_back(std::move(polygon));
  }
  // Which of several outer boundaries a hole is in is a question of the curves, and chords may tell another tale.
  if (!holes_.empty() && polygons_.size() != 1) return false;
  if (on_outline_) return holes_.empty();
  return boundaries_are_disjoint() && (!direction_.is_slanted() || are_separate_discs());
}

/// Seen aslant, chords may turn another way than curves that bend far, but a polygon that turns as an outer boundary is
/// one. A loop on faces of the near side alone, or of the far side, moves to its chords within them, and these are seen
/// as they are. One that goes round the outline is an outer boundary whatever it seems: lines near the outline are
/// short, so that surface is there only between the branches of the loop. Where one seems a hole, or discs seem to
/// overlap, nothing is known.
bool PatchTriangulator::are_separate_discs() const {
  return holes_.empty() && std::none_of(polygons_.begin(), polygons_.end(), [&](const Polygon& polygon) {
           return std::any_of(polygons_.begin(), polygons_.end(),
                              [&](const Polygon& other) { return strictly_inside(polygon, other[0].at); });
         });
}

bool PatchTriangulator::boundaries_are_disjoint() const {
  std::vector<PolygonSide> sides;
  for (const auto* list : {&polygons_, &holes_}) {
    for (const Polygon& polygon : *list) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        sides.push_back({p.at, q.at, p.vertex, q.vertex});
      }
    }
  }
  return !sides_meet(sides);
}

bool PatchTriangulator::join_holes() {
  return std::all_of(holes_.begin(), holes_.end(), [&](const Polygon& hole) {
    return strictly_inside(polygons_.front(), hole[0].at) && bridge(polygons_.front(), hole);
  });
}

bool PatchTriangulator::bridge(Polygon& outer, const Polygon& hole) {
  double best = kImpossible;
  std::size_t best_i = 0, best_j = 0;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    for (std::size_t j = 0; j < hole.size(); ++j) {
      if (vertices_[outer[i].vertex].faces & vertices_[hole[j].vertex].faces) continue;
      const double da = static_cast<double>(outer[i].at.a - hole[j].at.a);
      const double db = static_cast<double>(outer[i].at.b - hole[j].at.b);
      const double length = da * da + db * db;
      if (length >= best || !segment_is_clear(outer, outer[i], hole[j])) continue;
      const bool clear = std::all_of(holes_.begin(), holes_.end(),
                                     [&](const Polygon& other) { return segment_is_clear(other, outer[i], hole[j]); });
      if (!clear) continue;
      best = length;
      best_i = i;
      best_j = j;
    }
  }
  if (best == kImpossible) return false;
  Polygon joined(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(best_i) + 1);
  for (std::size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(best_j + k) % hole.size()]);
  joined.insert(joined.end(), outer.begin() + static_cast<std::ptrdiff_t>(best_i), outer.end());
  outer = std::move(joined);
  return true;
}

bool PatchTriangulator::segment_is_clear(const Polygon& polygon, const Corner& p, const Corner& q) const {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &r = polygon[i], &s = polygon[(i + 1) % polygon.size()];
    const bool shares_p = r.vertex == p.vertex || s.vertex == p.vertex;
    const bool shares_q = r.vertex == q.vertex || s.vertex == q.vertex;
    if (shares_p && shares_q) return false;
    if (shares_p || shares_q) {
      const Corner &common = shares_p ? p : q, &far = shares_p ? q : p;
      const Corner& other = r.vertex == common.vertex ? s : r;
      if (segments_overlap(common.at, far.at, other.at)) return false;
    } else if (segments_meet(p.at, q.at, r.at, s.at)) {
      return false;
    }
  }
  return true;
}

bool PatchTriangulator::diagonal_is_free(const Polygon& polygon, int i, int j) const {
  const Corner &p = polygon[i], &q = polygon[j];
  if (vertices_[p.vertex].faces & vertices_[q.vertex].faces) return false;
  if (on_outline_) return true;
  if (p.vertex == q.vertex) return false;
  const int n = static_cast<int>(polygon.size());
  const auto inside_angle = [&](int at, const Corner& to) {
    const PlanePoint &here = polygon[at].at, &before = polygon[(at + n - 1) % n].at, &after = polygon[(at + 1) % n].at;
    if (before == after) return true;  // the end of a slit: segment_is_clear refuses the slit's own direction
    const bool left_of_after = turn(here, after, to.at) > 0, right_of_before = turn(here, before, to.at) < 0;
    const bool convex = turn(before, here, after) > 0;
    return convex ? left_of_after && right_of_before : left_of_after || right_of_before;
  };
  return inside_angle(i, q) && inside_angle(j, p) && segment_is_clear(polygon, p, q);
}

double PatchTriangulator::triangle_cost(const Corner& p, const Corner& q, const Corner& r) const {
  if (turn(p.at, q.at, r.at) <= 0) return kImpossible;
  const LoopVertex &u = vertices_[p.vertex], &v = vertices_[q.vertex], &w = vertices_[r.vertex];
  if (u.faces & v.faces & w.faces) return kImpossible;
  return shape_cost(u.point, v.point, w.point);
}

double PatchTriangulator::best_triangulation(const Polygon& polygon) {
  return minimal_.solve(
      static_cast<int>(polygon.size()), [&](int i, int j) { return diagonal_is_free(polygon, i, j); },
      [&](int i, int j, int k) { return triangle_cost(polygon[i], polygon[j], polygon[k]); });
}

bool PatchTriangulator::triangulate_polygon(const Polygon& polygon) {
  const double cost = best_triangulation(polygon);
  const auto n = static_cast<double>(polygon.size());
  if (cost < kPoorTriangle + n) {
    take_triangles(polygon);
    return true;
  }
  // None, or one with a triangle turned far from the surface: a point inside the cell gives more freedom.
  Polygon richer = polygon;
  if (add_inner_corner(richer)) {
    if (best_triangulation(richer) < cost) {
      take_triangles(richer);
      return true;
    }
    drop_last_point();
  }
  if (cost == kImpossible) return false;
  best_triangulation(polygon);
  take_triangles(polygon);
  return true;
}

void PatchTriangulator::take_triangles(const Polygon& polygon) {
  minimal_.visit([&](int i, int j, int k) {
    patch_.triangles.push_back({vertices_[polygon[i].vertex].vertex, vertices_[polygon[j].vertex].vertex,
                                vertices_[polygon[k].vertex].vertex});
  });
}

bool PatchTriangulator::add_inner_corner(Polygon& polygon) {
  if (direction_.is_slanted()) return false;
  // Candidates: the middle of all corners, and the middles between corners that are not neighbours.
  std::vector<PlanePoint> candidates;
  PlanePoint sum;
  const auto n = static_cast<Coord>(polygon.size());
  const PlanePoint origin = polygon[0].at;
  for (const Corner& c : polygon) sum = {sum.a + (c.at.a - origin.a), sum.b + (c.at.b - origin.b)};
  candidates.push_back({origin.a + sum.a / n, origin.b + sum.b / n});
  for (Coord i = 0; i < n; ++i) {
    for (Coord j = i + 2; j < n && candidates.size() < 40; ++j) {
      const PlanePoint &p = polygon[i].at, &q = polygon[j].at;
      candidates.push_back({p.a + (q.a - p.a) / 2, p.b + (q.b - p.b) / 2});
    }
  }
  for (const PlanePoint& at : candidates) {
    if (!strictly_inside(polygon, at)) continue;
    const auto vertex = lift(at);
    if (!vertex) continue;
    on_outline_ = false;
    const Corner inner{at, *vertex};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (!segment_is_clear(polygon, polygon[i], inner)) continue;
      // A slit from corner i to the inner corner and back.
      const Corner end = polygon[i];
      polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, {inner, end});
      return true;
    }
    drop_last_point();
  }
  return false;
}

void PatchTriangulator::drop_last_point() {
  vertices_.pop_back();
  patch_.points.pop_back();
}

std::optional<int> PatchTriangulator::lift(const PlanePoint& at) {
  const int axis = direction_.axis;
  CoordPoint p = lo_;
  p[first_axis(axis)] = direction_.sign < 0 ? at.a : at.b;
  p[second_axis(axis)] = direction_.sign < 0 ? at.b : at.a;
  const Vec3 start = to_angstrom(p);
  Vec3 end = start;
  end[axis] = to_angstrom(hi_[axis]);
  if (!atoms_loaded_) field_.collect_near({to_angstrom(lo_), to_angstrom(hi_)}, atoms_);
  atoms_loaded_ = true;
  const LocalModel model(atoms_, field_.decay(), {start, end});
  const bool inside_lo = is_inside(field_, atoms_, model, start);
  if (inside_lo == is_inside(field_, atoms_, model, end)) return std::nullopt;
  const LineRoot root =
      refine_root(field_, atoms_, start, axis, start[axis], end[axis], inside_lo, 0.5 * (start[axis] + end[axis]));
  p[axis] = std::clamp<Coord>(std::llround(root.position * kUnitsPerAngstrom), lo_[axis] + 1, hi_[axis] - 1);
  LoopVertex v;
  v.vertex = kLocalVertex + static_cast<std::uint32_t>(patch_.points.size());
  v.point = {p, outward_normal(root.gradient), 0};
  patch_.points.push_back(v.point);
  vertices_.push_back(v);
  return static_cast<int>(vertices_.size()) - 1;
}

}  // namespace gaussmesh
