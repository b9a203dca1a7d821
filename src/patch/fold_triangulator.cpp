#include "patch/fold_triangulator.h"

#include <algorithm>
#include <cmath>

#include "core/exact_space.h"
#include "field/point_value.h"
#include "patch/fold_curve.h"
#include "patch/triangle_shape.h"

namespace gaussmesh {
namespace {

double squared_distance(const Vec3& p, const Vec3& q) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
  return sum;
}

/// Newton along the gradient of log phi. @return nothing where it does not settle in the box
std::optional<Vec3> project_to_surface(const NearAtoms& atoms, double decay, const Box& box, Vec3 p) {
  for (int iteration = 0; iteration < 30; ++iteration) {
    const PointValue v = evaluate(atoms, decay, p);
    double slope_sq = 0.0;
    for (double g : v.gradient) slope_sq += g * g;
    if (slope_sq == 0.0) return std::nullopt;
    for (int k = 0; k < 3; ++k) {
      p[k] -= v.value / slope_sq * v.gradient[k];
      if (p[k] <= box.lo[k] || p[k] >= box.hi[k]) return std::nullopt;
    }
    if (std::abs(v.value) < 1e-11 * std::sqrt(slope_sq)) return p;
  }
  return std::nullopt;
}

/// Whether arcs between their vertices join all loops into one.
bool are_connected(const std::vector<std::vector<int>>& loops, const std::vector<std::pair<int, int>>& arcs) {
  const auto loop_of = [&](int v) {
    return static_cast<std::size_t>(
        std::find_if(loops.begin(), loops.end(),
                     [v](const auto& loop) { return std::find(loop.begin(), loop.end(), v) != loop.end(); }) -
        loops.begin());
  };
  std::vector<bool> reached(loops.size(), false);
  reached[0] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [from, to] : arcs) {
      const std::size_t p = loop_of(from), q = loop_of(to);
      if (reached[p] == reached[q]) continue;
      reached[p] = reached[q] = grows = true;
    }
  }
  return std::find(reached.begin(), reached.end(), false) == reached.end();
}

}  // namespace

const Patch& FoldTriangulator::triangulate(const Lattice& lattice, const FoldCell& cell, std::span<const Loop> loops) {
  lo_ = lattice.point(cell.key.lo);
  hi_ = lattice.point(cell_hi(cell.key));
  box_ = {to_angstrom(lo_), to_angstrom(hi_)};
  patch_.triangles.clear();
  patch_.points.clear();
  patch_.complete = false;
  triangles_.clear();
  if (!assign_loops(cell, loops)) return patch_;
  Box wide = box_;  // predictors of fold curves step a little out of the cell
  for (int k = 0; k < 3; ++k) {
    wide.lo[k] -= 0.5 * (box_.hi[k] - box_.lo[k]);
    wide.hi[k] += 0.5 * (box_.hi[k] - box_.lo[k]);
  }
  field_.collect_near(wide, atoms_, kFineTruncation);
  for (std::size_t i = 0; i < cell.components.size(); ++i) {
    if (!triangulate_component(cell.components[i], loops_of_[i])) return patch_;
  }
  if (!triangles_are_disjoint()) return patch_;
  for (const auto& t : triangles_) {
    patch_.triangles.push_back({vertices_[t[0]].vertex, vertices_[t[1]].vertex, vertices_[t[2]].vertex});
  }
  patch_.complete = true;
  return patch_;
}

bool FoldTriangulator::assign_loops(const FoldCell& cell, std::span<const Loop> loops) {
  vertices_.clear();
  loops_of_.assign(cell.components.size(), {});
  for (const Loop& loop : loops) {
    Polygon polygon;
    std::optional<std::size_t> owner;
    for (const LoopVertex& v : loop) {
      polygon.push_back(static_cast<int>(vertices_.size()));
      vertices_.push_back(v);
      for (std::size_t c = 0; c < cell.components.size(); ++c) {
        const auto& roots = cell.components[c].roots;
        if (std::find(roots.begin(), roots.end(), v.point.position) != roots.end()) owner = c;
      }
    }
    if (!owner) return false;
    loops_of_[*owner].push_back(std::move(polygon));
  }
  for (std::size_t c = 0; c < cell.components.size(); ++c) {
    if (static_cast<int>(loops_of_[c].size()) != cell.components[c].boundary_loops) return false;
  }
  return true;
}

bool FoldTriangulator::triangulate_component(const FoldComponent& component, std::vector<Polygon> polygons) {
  const std::vector<Polygon> loops = polygons;
  Arcs arcs;
  if (component.fold_axis && !cut_along_folds(*component.fold_axis, polygons, arcs)) return false;
  // Discs glued along arcs: connected, and with this Euler number and these loops it is the surface that was proven.
  if (static_cast<int>(polygons.size()) - static_cast<int>(arcs.size()) != component.chi) return false;
  if (!are_connected(loops, arcs)) return false;
  return std::all_of(polygons.begin(), polygons.end(), [&](const Polygon& p) { return triangulate_polygon(p); });
}

bool FoldTriangulator::cut_along_folds(int axis, std::vector<Polygon>& polygons, Arcs& arcs) {
  std::vector<int> open;
  for (const Polygon& polygon : polygons) {
    for (int v : polygon) {
      if (vertices_[v].point.fold_axes >> axis & 1) open.push_back(v);
    }
  }
  const auto find_polygon = [&](int v) {
    return std::find_if(polygons.begin(), polygons.end(),
                        [v](const Polygon& p) { return std::find(p.begin(), p.end(), v) != p.end(); });
  };
  while (open.size() > 1) {
    const int from = open.front();
    open.erase(open.begin());
    const auto arc = fold_arc(axis, from, open);
    if (!arc) return false;
    const int to = arc->back();
    open.erase(std::find(open.begin(), open.end(), to));
    arcs.emplace_back(from, to);
    const auto p = find_polygon(from), q = find_polygon(to);
    Polygon first = *p, second = *q;
    std::rotate(first.begin(), std::find(first.begin(), first.end(), from), first.end());
    const Polygon inner(arc->begin() + 1, arc->end() - 1), inner_back(inner.rbegin(), inner.rend());
    if (p == q) {
      // Two polygons: from .. to and back along the arc; to .. from and on along the arc.
      const auto at = std::find(first.begin(), first.end(), to);
      Polygon one(first.begin(), at + 1), two(at, first.end());
      one.insert(one.end(), inner_back.begin(), inner_back.end());
      two.push_back(from);
      two.insert(two.end(), inner.begin(), inner.end());
      *p = std::move(one);
      polygons.push_back(std::move(two));
    } else {
      // One polygon: round the first, along the arc, round the second, and back.
      std::rotate(second.begin(), std::find(second.begin(), second.end(), to), second.end());
      first.push_back(from);
      first.insert(first.end(), inner.begin(), inner.end());
      first.insert(first.end(), second.begin(), second.end());
      first.push_back(to);
      first.insert(first.end(), inner_back.begin(), inner_back.end());
      *p = std::move(first);
      polygons.erase(q);
    }
  }
  return open.empty();
}

std::optional<FoldTriangulator::Polygon> FoldTriangulator::fold_arc(int axis, int from,
                                                                    const std::vector<int>& fold_vertices) {
  const auto curve = follow_fold(atoms_, field_.decay(), box_, to_angstrom(vertices_[from].point.position), axis);
  if (!curve) return std::nullopt;
  const double size = box_.hi[0] - box_.lo[0];
  std::optional<int> nearest;
  double least = 0.01 * size * size;  // a tenth of the cell: the curve is followed in steps of a sixteenth
  for (int v : fold_vertices) {
    const double distance = squared_distance(curve->points.back(), to_angstrom(vertices_[v].point.position));
    if (distance >= least) continue;
    least = distance;
    nearest = v;
  }
  if (!nearest) return std::nullopt;
  auto inner = static_cast<std::size_t>(std::lround(curve->length / (0.8 * size)));
  if (inner == 0 && (vertices_[from].faces & vertices_[*nearest].faces)) inner = 1;
  if (curve->points.size() < inner + 2) return std::nullopt;
  Polygon arc{from};
  for (std::size_t i = 1; i <= inner; ++i) {
    const auto v = add_point(curve->points[i * curve->points.size() / (inner + 1) - 1]);
    if (!v) return std::nullopt;
    arc.push_back(*v);
  }
  arc.push_back(*nearest);
  return arc;
}

std::optional<int> FoldTriangulator::add_point(const Vec3& point) {
  LoopVertex v;
  for (int k = 0; k < 3; ++k) {
    v.point.position[k] = std::llround(point[k] * kUnitsPerAngstrom);
    if (v.point.position[k] <= lo_[k] || v.point.position[k] >= hi_[k]) return std::nullopt;
  }
  v.point.normal = outward_normal(evaluate(atoms_, field_.decay(), point).gradient);
  v.vertex = kLocalVertex + static_cast<std::uint32_t>(patch_.points.size());
  patch_.points.push_back(v.point);
  vertices_.push_back(v);
  return static_cast<int>(vertices_.size()) - 1;
}

double FoldTriangulator::triangle_cost(int i, int j, int k) const {
  const LoopVertex &p = vertices_[i], &q = vertices_[j], &r = vertices_[k];
  if ((p.faces & q.faces & r.faces) || i == j || j == k || i == k) return kImpossible;
  return shape_cost(p.point, q.point, r.point);
}

bool FoldTriangulator::triangulate_polygon(const Polygon& polygon) {
  const int n = static_cast<int>(polygon.size());
  const double cost = minimal_.solve(
      n,
      [&](int i, int j) {
        return polygon[i] != polygon[j] && !(vertices_[polygon[i]].faces & vertices_[polygon[j]].faces);
      },
      [&](int i, int j, int k) { return triangle_cost(polygon[i], polygon[j], polygon[k]); });
  if (cost >= kPoorTriangle) {
    if (const auto apex = add_apex(polygon)) {
      if (fan_cost(polygon, *apex) < cost) {
        for (int i = 0; i < n; ++i) triangles_.push_back({polygon[i], polygon[(i + 1) % n], *apex});
        return true;
      }
      vertices_.pop_back();
      patch_.points.pop_back();
    }
  }
  if (cost >= kTurnedTriangle) return false;
  minimal_.visit([&](int i, int j, int k) { triangles_.push_back({polygon[i], polygon[j], polygon[k]}); });
  return true;
}

double FoldTriangulator::fan_cost(const Polygon& polygon, int apex) const {
  double cost = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double one = triangle_cost(polygon[i], polygon[(i + 1) % polygon.size()], apex);
    if (one >= kTurnedTriangle) return kImpossible;
    cost += one;
  }
  return cost;
}

std::optional<int> FoldTriangulator::add_apex(const Polygon& polygon) {
  Vec3 middle{};
  for (int v : polygon) {
    const Vec3 p = to_angstrom(vertices_[v].point.position);
    for (int k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<double>(polygon.size());
  }
  const auto point = project_to_surface(atoms_, field_.decay(), box_, middle);
  return point ? add_point(*point) : std::nullopt;
}

bool FoldTriangulator::triangles_are_disjoint() const {
  // An edge that two pieces chose alike would be in four triangles.
  std::vector<std::pair<int, int>> edges;
  for (const auto& t : triangles_) {
    for (int i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;

  std::vector<NamedTriangle> named;
  for (const auto& t : triangles_) {
    NamedTriangle& n = named.emplace_back();
    for (int i = 0; i < 3; ++i) {
      n.name[i] = static_cast<std::uint32_t>(t[i]);
      n.at[i] = vertices_[t[i]].point.position;
    }
  }
  for (std::size_t i = 0; i < named.size(); ++i) {
    for (std::size_t j = i + 1; j < named.size(); ++j) {
      if (triangles_may_meet(named[i], named[j])) return false;
    }
  }
  return true;
}

}  // namespace gaussmesh
