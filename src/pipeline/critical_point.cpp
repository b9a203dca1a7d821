#include "pipeline/critical_point.h"

#include <Eigen/Dense>
#include <cmath>

#include "field/point_value.h"

namespace gaussmesh {

CriticalPoint find_critical_point(const GaussianField& field, const Vec3& place) {
  constexpr double kFarthest = 0.3;     // A
  constexpr double kDifference = 1e-5;  // A, for the Hessian by central differences
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = place[k] - kFarthest - kDifference;
    box.hi[k] = place[k] + kFarthest + kDifference;
  }
  NearAtoms atoms;
  field.collect_near(box, atoms);
  const auto gradient = [&](const Vec3& p) {
    const PointValue v = evaluate(atoms, field.decay(), p);
    return Eigen::Vector3d(v.gradient[0], v.gradient[1], v.gradient[2]);
  };
  Vec3 at = place;
  bool converged = false;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::Matrix3d hessian;
    for (int k = 0; k < 3; ++k) {
      Vec3 before = at, after = at;
      before[k] -= kDifference;
      after[k] += kDifference;
      hessian.col(k) = (gradient(after) - gradient(before)) / (2.0 * kDifference);
    }
    const Eigen::Vector3d step = -hessian.fullPivLu().solve(gradient(at));
    double farthest = 0.0;
    Vec3 next = at;
    for (int k = 0; k < 3; ++k) {
      next[k] += step[k];
      farthest = std::max(farthest, std::abs(next[k] - place[k]));
    }
    if (!(farthest < kFarthest)) {
      at = place;
      converged = false;
      break;
    }
    at = next;
    // The differences in the Hessian leave it a relative error of some 1e-6, so that late steps fall by that factor.
    converged = step.norm() < 1e-9;
    if (step.norm() < 1e-12) break;
  }
  return {at, std::exp(evaluate(atoms, field.decay(), at).value), converged};
}

}  // namespace gaussmesh
