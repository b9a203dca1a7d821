#include "pipeline/critical_point.h"

#include <Eigen/Dense>
#include <cmath>

#include "field/point_value.h"

namespace gaussmesh {

CriticalPoint find_critical_point(const GaussianField& field, const Vec3& place) {
  const double width = 1.0 / std::sqrt(2.0 * field.decay());  // of a Gaussian (A)
  const double farthest_step = 0.3 * width;
  const double difference = 1e-5 * width;  // for the Hessian by central differences
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = place[k] - farthest_step - difference;
    box.hi[k] = place[k] + farthest_step + difference;
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
      before[k] -= difference;
      after[k] += difference;
      hessian.col(k) = (gradient(after) - gradient(before)) / (2.0 * difference);
    }
    const Eigen::Vector3d step = -hessian.fullPivLu().solve(gradient(at));
    double farthest = 0.0;
    Vec3 next = at;
    for (int k = 0; k < 3; ++k) {
      next[k] += step[k];
      farthest = std::max(farthest, std::abs(next[k] - place[k]));
    }
    if (!(farthest < farthest_step)) {
      at = place;
      converged = false;
      break;
    }
    at = next;
    // The differences in the Hessian leave it a relative error of some 1e-6, so that late steps fall by that factor.
    converged = step.norm() < 1e-9 * width;
    if (step.norm() < 1e-12 * width) break;
  }
  return {at, std::exp(evaluate(atoms, field.decay(), at).value), converged};
}

}  // namespace gaussmesh
