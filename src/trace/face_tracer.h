// The curves in which the surface cuts ONE rectangle of the lattice.
//
// The roots on its edges come from roots/; making loops of the curves on all faces of a
// cell is pipeline/loop_collector.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boxes/gradient_cone.h"
#include "core/exact_plane.h"
#include "field/local_atoms.h"
#include "gaussmesh/error.h"
#include "roots/edge_roots.h"
#include "trace/face_certificate.h"

namespace gaussmesh {

/// A root on the boundary of a face.
struct FaceRoot {
  std::uint32_t vertex = 0;  ///< its number in the mesh
  CoordPoint position{};
  int boundary_side = 0;  ///< 0..3 counter-clockwise against the axis: low second, high first, high second, low first
  int rise = 0;           ///< +1: the edge enters the molecule as its coordinate grows
};

/// A piece of a curve, from vertex to vertex, with the molecule on its left seen against the face's axis.
struct Link {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// Marks vertex numbers that count points made by the tracer (or by a patch) and not those of the mesh.
inline constexpr std::uint32_t kLocalVertex = 0x80000000u;

/// A number for the mesh's own vertices. @throws CannotMeshError if there are too many
inline std::uint32_t vertex_number(std::size_t number) {
  if (number >= kLocalVertex) throw CannotMeshError("more than 2^31 vertices; choose a larger spacing");
  return static_cast<std::uint32_t>(number);
}

/// Curves of a face: links between roots, through `points` where a chord would not do.
struct FaceCurves {
  std::vector<Link> links;
  std::vector<SurfacePoint> points;  ///< vertex numbers kLocalVertex + index
};

/// Follows the section curves of a face from root to root [CL11].
///
/// Where the face has a certificate along an axis m, the section is a graph over the other axis o, over disjoint
/// intervals; the roots in order of o are their ends, two by two. Where chords will do, a slanted direction serves as
/// well, and so does a proof that no curve closes, if there are two roots or none. Other faces are cut in four, and so
/// on: the pieces are joined through the roots on the cuts, and curves that close inside the face are found too. Curves
/// become chords between their ends; a curve that turns back to the edge it came from keeps its turning point - the
/// fold point - and more points are kept where polygons would cross. Keeps buffers: one for each thread.
class FaceTracer {
 public:
  FaceTracer(const GaussianField& field, const Lattice& lattice)
      : field_(field), finder_(field, lattice), atoms_(field), prover_(field.decay()) {}

  /// Atoms for the faces to come are taken from those of `around`, a box round them, and not from the field; it
  /// lives and stays where it is as long as they are traced.
  void take_atoms_from(LocalAtoms& around) { around_ = &around; }

  /// In the faces to come atoms beyond Reach::kProof and kPlain do not matter (or do, which is so at first), unless a
  /// face has to be cut: then those left out are mostly the reason.
  void set_plain(bool is_plain) { is_plain_ = is_plain; }

  /// @param hi         the corner of the rectangle opposite to `lo`; equal to it along `axis`
  /// @param fold_axes  bit k: keep the points of the curves where d(phi)/dx_k changes its sign, the fold points of
  ///                   axis k
  /// @throws LatticeDegenerate where roots and curves do not fit together to rounding
  const FaceCurves& trace(int axis, const CoordPoint& lo, const CoordPoint& hi, FaceCertificate certificate,
                          std::span<const FaceRoot> roots, unsigned fold_axes = 0);

 private:
  static constexpr int kEnd = -1;  ///< no point follows: the end of a curve that is not closed

  struct TracePoint {
    SurfacePoint point;
    std::uint32_t vertex = 0;  ///< kLocalVertex for a point inside the face
    int rise = 0;
    bool kept = false;
    int next = kEnd;  ///< index into points_
    int piece = 0;    ///< piece that leads to `next`, if there is one
  };
  struct Rect {
    CoordPoint lo{}, hi{};
  };
  struct Piece {
    Rect rect;
    int along = 0;             ///< axis along which the section is single-valued in rect
    Side lo = Side::kUnknown;  ///< of the low end of `along`, all over the piece
    double last = 0.0;         ///< coordinate along it of the point found last (A): the next is near
  };
  struct RectRoot {
    int point = 0;          ///< index into points_
    int boundary_side = 0;  ///< as in FaceRoot, of the rectangle
  };
  struct Chain {
    int first = 0;
    bool closed = false;
  };

  void trace_rect(const Rect& rect, FaceCertificate certificate, std::vector<RectRoot> roots);
  bool pair_roots(const Rect& rect, const Direction& along, std::vector<RectRoot>& roots);
  bool pair_only_curve(const Rect& rect, const std::vector<RectRoot>& roots);
  bool chords_will_do(const Rect& rect, const std::vector<RectRoot>& roots) const;
  void link(const Rect& rect, RectRoot from, RectRoot to, int axis);
  bool pair_along_slant(const Rect& rect, const LocalModel& model, std::vector<RectRoot>& roots);
  void split_rect(const Rect& rect, const std::vector<RectRoot>& roots);
  std::vector<RectRoot> cut_roots(const NearAtoms& atoms, int edge_axis, const CoordPoint& lo, Coord hi);
  void collect_chains(std::span<const FaceRoot> roots);
  void choose_points(const Chain& chain);
  void keep_fold_points(const Chain& chain, int axis);
  void insert_fold_points(int from, int axis);
  /// Where on a piece the slope along `axis` changes its sign, between two places where its signs differ.
  double find_fold_point(Piece& piece, int axis, double lo, double hi, double lo_slope, double hi_slope);
  int insert_between(int from, double at);
  int insert_turning_point(int from);
  int insert_middle(int from);
  SurfacePoint solve_on_piece(Piece& piece, double at);
  bool polygons_cross() const;
  void refine_all();
  void emit();
  bool is_plain(const Rect& rect) const;
  const NearAtoms& proof_atoms_of(const Rect& rect) {
    return atoms_.within(is_plain(rect) ? Reach::kProof : Reach::kFine);
  }
  const NearAtoms& root_atoms_of(const Rect& rect) {
    return atoms_.within(is_plain(rect) ? Reach::kPlain : Reach::kFine);
  }
  PlanePoint plane(int point) const;
  int length_of(const Chain& chain) const;
  /// Calls visit(from, to) for every two points that are kept and follow each other.
  template <typename Visit>
  void visit_sides(const Chain& chain, const Visit& visit) const;
  /// Whether the face has one curve, from side to side and no closed ones, for which a chord will do.
  static bool is_one_chord(FaceCertificate certificate, std::span<const FaceRoot> roots);
  static bool starts_curve(int side, int rise);
  bool starts_curve(const RectRoot& root) const;

  const GaussianField& field_;
  EdgeRootFinder finder_;
  LocalAtoms atoms_;  ///< near the face
  LocalAtoms* around_ = nullptr;
  bool is_plain_ = false;
  int axis_ = 0;
  unsigned fold_axes_ = 0;
  Rect face_;
  FaceProver prover_;
  GradientCone cone_;
  std::vector<TracePoint> points_;
  std::vector<Piece> pieces_;
  std::vector<Chain> chains_;
  FaceCurves curves_;
};

}  // namespace gaussmesh
