// A direction along which surface that bends may still be a graph: one that is far from none of its gradients.
#pragma once

#include <vector>

#include "core/direction.h"

namespace gaussmesh {

/// The direction nearest to a vector of those that Direction can say, with the sense of the vector for its sign.
Direction nearest_direction(const Vec3& vector);

/// Gradients that a direction must go up along with.
class GradientCone {
 public:
  /// Vectors of any length; zero is left out.
  void add(const Vec3& gradient);

  void clear() { gradients_.clear(); }
  bool empty() const { return gradients_.empty(); }

  /// About the axis of the narrowest cone round them. Cost: the square of their number.
  Vec3 middle() const;

 private:
  std::vector<Vec3> gradients_;  ///< of length 1
};

}  // namespace gaussmesh
