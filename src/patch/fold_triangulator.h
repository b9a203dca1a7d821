// Triangles for the surface in one cell where it is not single-valued along any direction.
#pragma once

#include <optional>

#include "patch/minimal_triangulation.h"
#include "patch/patch_triangulator.h"

namespace gaussmesh {

/// A connected piece of the surface in a cell, as proven through smaller cells.
struct FoldComponent {
  int chi = 1;  ///< Euler number: 1 for a disc, 0 for a tube
  int boundary_loops = 1;
  std::optional<int> fold_axis;   ///< the piece is cut along the fold curves of this axis; none: it needs no cut
  std::vector<CoordPoint> roots;  ///< roots on the cell's edges that belong to it
};

/// A cell whose surface is cut along fold curves.
struct FoldCell {
  CellKey key;
  std::vector<FoldComponent> components;
};

/// Cuts surface along its fold curves { phi = c, d(phi)/dx_k = 0 } [CTL12] and triangulates the pieces.
///
/// The fold points are vertices of the loops (trace/ keeps them for the axes that FoldCell names). From each the fold
/// curve is followed through the cell to another; cut along these arcs the loops of a component become polygons, and
/// these are triangulated in space. The result is accepted when every component has the Euler number and the
/// boundary that were proven, no inner edge lies in a face of the cell, no triangle is turned against the field, and
/// no two triangles of the cell meet, by exact signs. Otherwise the cell must be split. Fold curves need no
/// certificate for that: they only tell where to cut.
/// Keeps buffers: one for each thread.
class FoldTriangulator {
 public:
  explicit FoldTriangulator(const GaussianField& field) : field_(field) {}

  /// @return  valid until the next call
  const Patch& triangulate(const Lattice& lattice, const FoldCell& cell, std::span<const Loop> loops);

 private:
  using Polygon = std::vector<int>;  ///< indices into vertices_

  bool assign_loops(const FoldCell& cell, std::span<const Loop> loops);
  bool triangulate_component(const FoldComponent& component, std::vector<Polygon> polygons);
  using Arcs = std::vector<std::pair<int, int>>;  ///< ends of fold arcs
  bool cut_along_folds(int axis, std::vector<Polygon>& polygons, Arcs& arcs);
  std::optional<Polygon> fold_arc(int axis, int from, const std::vector<int>& fold_vertices);
  bool triangulate_polygon(const Polygon& polygon);
  double fan_cost(const Polygon& polygon, int apex) const;
  std::optional<int> add_apex(const Polygon& polygon);
  std::optional<int> add_point(const Vec3& point);
  double triangle_cost(int i, int j, int k) const;
  bool triangles_are_disjoint() const;

  const GaussianField& field_;
  CoordPoint lo_{}, hi_{};
  Box box_;
  NearAtoms atoms_;
  std::vector<LoopVertex> vertices_;
  std::vector<std::vector<Polygon>> loops_of_;  ///< by component
  std::vector<std::array<int, 3>> triangles_;
  MinimalTriangulation minimal_;
  Patch patch_;
};

}  // namespace gaussmesh
