// Triangles for the surface in ONE cell that is single-valued along a direction.
//
// The loops come from the curves on the cell's faces (trace/); cells that are not single-valued are
// patch/fold_triangulator.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/direction.h"
#include "field/gaussian_field.h"
#include "gaussmesh/triangle_mesh.h"
#include "patch/minimal_triangulation.h"
#include "trace/face_tracer.h"

namespace gaussmesh {

/// A vertex of a loop: a surface point with the faces of the cell that it lies on.
struct LoopVertex {
  std::uint32_t vertex = 0;
  SurfacePoint point;
  std::uint8_t faces = 0;  ///< bit 2 k: low face across axis k; bit 2 k + 1: high face
};

/// Boundary of the surface in a cell: closed, counter-clockwise round the surface seen from the solvent.
using Loop = std::vector<LoopVertex>;

/// Which faces of the cell from `lo` to `hi` a point lies on.
std::uint8_t faces_of(const CoordPoint& point, const CoordPoint& lo, const CoordPoint& hi);

/// Triangles of a cell; vertex numbers from kLocalVertex on count `points`.
struct Patch {
  bool complete = false;  ///< false: no embedded triangulation was found, the cell must be split
  std::vector<Triangle> triangles;
  std::vector<SurfacePoint> points;
};

/// Triangulates single-valued surface in the plane that it is single-valued over.
///
/// Every loop becomes a polygon of that plane (holes are joined to the polygon round them by bridges) and the polygon
/// is cut into triangles by dynamic programming over all triangulations (Klincsek's), the best for shape and for
/// agreement with the field's normals. No inner edge lies in a face of the cell, so triangles of two cells meet only
/// in the curves that the cells share; in the plane no two triangles overlap, by exact signs. Where polygons leave no
/// such triangulation (a cap bounded by a curve in one face) a point of the surface inside the cell is added.
/// Keeps buffers: one for each thread.
class PatchTriangulator {
 public:
  explicit PatchTriangulator(const GaussianField& field) : field_(field) {}

  /// @param direction  as in CellCertificate
  /// @return           valid until the next call
  const Patch& triangulate(const CoordPoint& lo, const CoordPoint& hi, const Direction& direction,
                           std::span<const Loop> loops);

 private:
  struct Corner {
    PlanePoint at;
    int vertex = 0;  ///< index into vertices_
  };
  using Polygon = std::vector<Corner>;

  bool make_polygons(std::span<const Loop> loops);
  bool boundaries_are_disjoint() const;
  bool are_separate_discs() const;
  bool join_holes();
  bool bridge(Polygon& outer, const Polygon& hole);
  bool triangulate_polygon(const Polygon& polygon);
  double best_triangulation(const Polygon& polygon);
  void take_triangles(const Polygon& polygon);
  double triangle_cost(const Corner& p, const Corner& q, const Corner& r) const;
  bool diagonal_is_free(const Polygon& polygon, int i, int j) const;
  bool segment_is_clear(const Polygon& polygon, const Corner& p, const Corner& q) const;
  bool add_inner_corner(Polygon& polygon);
  std::optional<int> lift(const PlanePoint& at);
  void drop_last_point();
  PlanePoint project(const CoordPoint& p) const;

  const GaussianField& field_;
  CoordPoint lo_{}, hi_{};
  Direction direction_;
  bool atoms_loaded_ = false;
  NearAtoms atoms_;
  bool on_outline_ = true;  ///< every corner on the outline of the square: polygons are convex
  std::vector<LoopVertex> vertices_;
  std::vector<Polygon> polygons_, holes_;
  MinimalTriangulation minimal_;
  Patch patch_;
};

}  // namespace gaussmesh
