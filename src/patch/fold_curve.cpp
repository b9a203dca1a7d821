#include "patch/fold_curve.h"

#include <Eigen/Dense>

#include "field/point_value.h"

namespace gaussmesh {
namespace {

using Eigen::Vector3d;

/// log(phi / c) with its first derivatives, and the second ones in one row of the Hessian.
struct FoldJet {
  double value = 0.0;
  Vector3d gradient;
  Vector3d hessian_row;  ///< derivatives of the slope along the axis
};

FoldJet fold_jet(const NearAtoms& atoms, double d, const Vector3d& p, int axis) {
  const LineValue line = evaluate_along(atoms, d, {p[0], p[1], p[2]}, axis);
  return {line.point.value, Vector3d(line.point.gradient.data()), Vector3d(line.gradient_slope.data())};
}

/// Newton's method for value = 0 and slope along the axis = 0, with steps of least length.
std::optional<Vector3d> correct(const NearAtoms& atoms, double d, Vector3d p, int axis, double farthest) {
  const Vector3d start = p;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const FoldJet jet = fold_jet(atoms, d, p, axis);
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian.row(0) = jet.gradient;
    jacobian.row(1) = jet.hessian_row;
    const Eigen::Vector2d residual(jet.value, jet.gradient[axis]);
    const Eigen::Matrix2d normal = jacobian * jacobian.transpose();
    // The two surfaces meet at a good angle: its sine squared is the determinant over the squared gradients.
    if (!(normal.determinant() > 1e-12 * normal(0, 0) * normal(1, 1))) return std::nullopt;
    const Vector3d step = -jacobian.transpose() * normal.inverse() * residual;
    p += step;
    if (!((p - start).norm() <= farthest)) return std::nullopt;
    if (step.norm() < 1e-11) return p;
  }
  return std::nullopt;
}

bool is_in(const Box& box, const Vector3d& p) {
  for (int k = 0; k < 3; ++k) {
    if (p[k] < box.lo[k] || p[k] > box.hi[k]) return false;
  }
  return true;
}

}  // namespace

std::optional<FoldCurve> follow_fold(const NearAtoms& atoms, double decay, const Box& box, const Vec3& start,
                                     int axis) {
  constexpr double kLongest = 5.2;  // cells: three diagonals, more than a curve that does not turn back has
  const double size = box.hi[0] - box.lo[0];
  const double step = size / 16.0;
  const auto direction = [&](const Vector3d& p) {
    const FoldJet jet = fold_jet(atoms, decay, p, axis);
    return jet.gradient.cross(jet.hessian_row).normalized().eval();
  };
  Vector3d p(start[0], start[1], start[2]);
  Vector3d forward = direction(p);
  // Into the box: a short step one way stays in it, the other way leaves it.
  if (!is_in(box, p + 1e-3 * step * forward)) forward = -forward;
  if (!is_in(box, p + 1e-3 * step * forward)) return std::nullopt;

  FoldCurve curve;
  while (curve.length < kLongest * size) {
    const auto next = correct(atoms, decay, p + step * forward, axis, 0.5 * step);
    if (!next) return std::nullopt;
    curve.length += (*next - p).norm();
    Vector3d tangent = direction(*next);
    if (tangent.dot(forward) < 0.0) tangent = -tangent;
    if (tangent.dot(forward) < 0.5) return std::nullopt;  // turns too fast to be followed with confidence
    p = *next;
    forward = tangent;
    curve.points.push_back({p[0], p[1], p[2]});
    if (!is_in(box, p)) return curve;
  }
  return std::nullopt;
}

}  // namespace gaussmesh
