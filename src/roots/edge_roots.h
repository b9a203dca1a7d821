// Roots of phi = c on ONE edge of the lattice, all of them.
//
// Which edges there are is the pipeline's business; joining roots across faces is trace/.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "field/gaussian_field.h"
#include "field/lazy_model.h"
#include "field/point_value.h"
#include "gaussmesh/triangle_mesh.h"

namespace gaussmesh {

/// A point of the surface, rounded to the units that are written, with the direction into the solvent.
struct SurfacePoint {
  CoordPoint position{};
  Normal normal{};             ///< -grad phi / |grad phi|
  std::uint8_t fold_axes = 0;  ///< bit k: a fold point, d(phi)/dx_k = 0 here
};

/// A place where a lattice edge goes through the surface.
struct EdgeRoot {
  SurfacePoint point;
  std::int8_t rise = 0;  ///< +1: enters the molecule along the edge; -1: leaves it
};

/// A root on a line: its coordinate (A), and grad log phi there.
struct LineRoot {
  double position = 0.0;
  Vec3 gradient{};
};

/// Where nothing tells where a root may be.
inline constexpr double kNoGuess = std::numeric_limits<double>::quiet_NaN();

/// What is known of an edge beforehand.
struct EdgeEnds {
  Side lo = Side::kUnknown;  ///< of its lower end
  Side hi = Side::kUnknown;
  bool is_monotone = false;  ///< phi passes c in one direction only along the edge
  double guess = kNoGuess;   ///< where the root of a monotone edge may be (A); where there is none, the model tells
};

/// Finds every root of phi = c on lattice edges.
///
/// Following [CL11] roots are found on lines along x, y and z; the proof of completeness is ours: the edge is cut
/// into intervals on which bounds show that phi - c has no root, or that its derivative has one sign where it has,
/// so that the signs at the ends tell whether there is one. No step size is involved. Keeps buffers: one for each
/// thread.
class EdgeRootFinder {
 public:
  EdgeRootFinder(const GaussianField& field, const Lattice& lattice) : field_(field), lattice_(lattice) {}

  /// Roots on the edge from `lo` along `axis` to coordinate `hi`, in rising order, strictly inside the edge, and on
  /// that side of each plane of the finest lattice where the exact root is. `model` is over a box that contains the
  /// edge, and `atoms` were collected for one.
  /// @throws LatticeDegenerate where two roots, or a root and a lattice plane, cannot be told apart
  std::span<const EdgeRoot> find(const NearAtoms& atoms, const LazyModel& model, int axis, const CoordPoint& lo,
                                 Coord hi, const EdgeEnds& ends = {});

 private:
  struct Segment {
    double a, b;
    bool inside_a, inside_b;
  };

  /// Whether bounds show at once that the edge has no root.
  bool is_free(const LazyModel& model, int axis, const CoordPoint& lo, Coord hi, const EdgeEnds& ends) const;
  void isolate(const LazyModel& model, const Segment& segment);
  /// @param guess  as in EdgeEnds
  void refine(const LazyModel& model, const Segment& segment, double guess);
  /// How far a root may be from the exact one (A); infinity where the slope is too small to tell.
  double root_error(const LineRoot& root) const;
  /// The coordinate of a root, rounded, on the side of every lattice plane that the exact root is on: signs on the
  /// planes tell where distances do not.
  Coord snap(const LazyModel& model, const Segment& segment, const LineRoot& root) const;
  Vec3 at(double x) const;

  const GaussianField& field_;
  const Lattice& lattice_;
  const NearAtoms* atoms_ = nullptr;
  int axis_ = 0;
  CoordPoint lo_{};
  Coord hi_ = 0;
  Vec3 base_{};
  NearAtoms all_;  ///< those of a segment that needs every atom
  std::vector<EdgeRoot> roots_;
};

/// Whether phi >= c at a point, proven: by the model, by the sum over `atoms`, or by the sum over all atoms.
/// @throws LatticeDegenerate where |phi / c - 1| is below the rounding error, some 1e-13
bool is_inside(const GaussianField& field, const NearAtoms& atoms, const LazyModel& model, const Vec3& point);

/// The root of phi = c on the line through `start` along `axis` between coordinates a and b, where phi - c has
/// opposite signs; its distance from the surface is at most some 5e-7 A, also where phi hardly changes. `atoms` were
/// collected for a box that holds the line between a and b.
/// @param inside_a  whether phi > c at a
/// @param guess     near the root, or anything else
/// Cost: two or three sums over the atoms; more where those left out are felt.
LineRoot refine_root(const GaussianField& field, const NearAtoms& atoms, const Vec3& start, int axis, double a,
                     double b, bool inside_a, double guess);

/// -gradient / |gradient|.
Normal outward_normal(const Vec3& gradient);

}  // namespace gaussmesh
