#include "pipeline/critical_point.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "field/point_value.h"

namespace gaussmesh {

CriticalPoint find_critical_point(const GaussianField& field, const Vec3& place) {
  const double width = 1.0 / std::sqrt(2.0 * field.decay());  // of a Gaussian (A)
  const double farthest_step = 0.3 * width;
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = place[k] - farthest_step;
    box.hi[k] = place[k] + farthest_step;
  }
  NearAtoms atoms;
  field.collect_near(box, atoms);
  // Where critical points are a curve, as between coaxial rings, the Hessian is singular along it: the shortest step
  // leads there.
  constexpr double kSingular = 1e-6;
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> decomposition;
  decomposition.setThreshold(kSingular);
  Vec3 at = place;
  bool converged = false;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::Matrix3d hessian;
    Eigen::Vector3d gradient;
    for (int k = 0; k < 3; ++k) {
      const LineValue along = evaluate_along(atoms, field.decay(), at, k);
      hessian.col(k) = Eigen::Vector3d::Map(along.gradient_slope.data());
      gradient = Eigen::Vector3d::Map(along.point.gradient.data());
    }
    decomposition.compute(hessian);
    const Eigen::Vector3d step = -decomposition.solve(gradient);
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
    converged = step.norm() < 1e-9 * width;
    if (step.norm() < 1e-12 * width) break;
  }
  return {at, std::exp(evaluate(atoms, field.decay(), at).value), converged};
}

}  // namespace gaussmesh
