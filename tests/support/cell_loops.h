// The loops round one cell, made of the real stages: roots on its edges, curves on its faces.
#pragma once

#include <map>
#include <utility>

#include "patch/patch_triangulator.h"
#include "roots/edge_roots.h"
#include "support/lattices.h"
#include "trace/face_tracer.h"

namespace gaussmesh::testing {

/// Loops of the cell of level 0 at `key`, counter-clockwise round the surface seen from the solvent, as the
/// pipeline makes them. Vertices are numbered from 0 on. @param fold_axes as in FaceTracer::trace
inline std::vector<Loop> cell_loops(const GaussianField& field, const Lattice& lattice, const CellKey& key,
                                    unsigned fold_axes = 0) {
  const CoordPoint lo = lattice.point(key.lo), hi = lattice.point(cell_hi(key));
  const Box box{to_angstrom(lo), to_angstrom(hi)};
  NearAtoms near;
  field.collect_near(box, near);
  const LocalModel model(near, field.decay(), box);
  EdgeRootFinder finder(field, lattice);
  FaceTracer tracer(field, lattice);

  std::vector<SurfacePoint> points;
  std::map<std::pair<CoordPoint, int>, std::vector<FaceRoot>> edges;
  const auto edge_roots = [&](CoordPoint start, int axis) -> const std::vector<FaceRoot>& {
    const auto [it, is_new] = edges.try_emplace({start, axis});
    if (is_new) {
      for (const EdgeRoot& root : finder.find(near, model, axis, start, hi[axis])) {
        it->second.push_back({static_cast<std::uint32_t>(points.size()), root.point.position, 0, root.rise});
        points.push_back(root.point);
      }
    }
    return it->second;
  };
  std::vector<Link> links;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      CoordPoint from = lo, to = hi;
      (high ? from : to)[axis] = (high ? hi : lo)[axis];
      const int a = first_axis(axis), b = second_axis(axis);
      CoordPoint low_high = from, high_low = from;
      low_high[b] = to[b];
      high_low[a] = to[a];
      std::vector<FaceRoot> roots;
      const std::pair<CoordPoint, int> sides[] = {{from, a}, {high_low, b}, {low_high, a}, {from, b}};
      for (int side = 0; side < 4; ++side) {
        for (FaceRoot root : edge_roots(sides[side].first, sides[side].second)) {
          root.boundary_side = side;
          roots.push_back(root);
        }
      }
      const Box face{to_angstrom(from), to_angstrom(to)};
      const FaceCurves& curves = tracer.trace(axis, from, to, certify_face(model, axis, face), roots, fold_axes);
      const auto base = static_cast<std::uint32_t>(points.size());
      const auto numbered = [&](std::uint32_t v) { return v >= kLocalVertex ? base + (v - kLocalVertex) : v; };
      for (const Link& link : curves.links) {
        const Link own{numbered(link.from), numbered(link.to)};
        links.push_back(high ? Link{own.to, own.from} : own);
      }
      points.insert(points.end(), curves.points.begin(), curves.points.end());
    }
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const Link& link : links) next[link.from] = link.to;
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop& loop = loops.emplace_back();
    for (auto it = next.begin(); it != next.end();) {
      const SurfacePoint& point = points[it->first];
      loop.push_back({it->first, point, faces_of(point.position, lo, hi)});
      const std::uint32_t following = it->second;
      next.erase(it);
      it = next.find(following);
    }
  }
  return loops;
}

}  // namespace gaussmesh::testing
