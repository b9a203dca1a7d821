// Putting points back on the surface.
#pragma once

#include <array>
#include <optional>

#include "field/gaussian_field.h"
#include "roots/edge_roots.h"

namespace gaussmesh {

/// Moves points onto phi = c along the gradient. Keeps the atoms near recent points: one for each thread.
class SurfaceProjector {
 public:
  explicit SurfaceProjector(const GaussianField& field) : field_(field) {}

  /// Newton's method on log phi along its gradient, from a point near the surface; good to the rounding of the result.
  /// @return nothing if that leads farther than `farthest` (A) away
  /// Cost: about three sums over the atoms nearby.
  std::optional<SurfacePoint> project(const Vec3& point, double farthest);

  /// Largest principal curvature in absolute value (1/A) of the level set of phi through a point.
  double curvature(const Vec3& point);

 private:
  static constexpr double kCellSize = 1.0;   ///< A: atoms are kept for cells of this size
  static constexpr double kMargin = 0.3;     ///< A: how far beyond its cell a list serves

  struct CachedCell {
    std::array<std::int64_t, 3> index{};
    bool is_filled = false;
    Box box;
    NearAtoms atoms;
  };
  const CachedCell& cell_of(const Vec3& point);

  const GaussianField& field_;
  std::array<CachedCell, 64> cells_;
};

}  // namespace gaussmesh
