#include "improve/surface_projector.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/vector_exp.h"
#include "field/point_value.h"

namespace gaussmesh {
namespace {

double length(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

bool is_in(const Box& box, const Vec3& p) {
  for (int k = 0; k < 3; ++k) {
    if (!(p[k] >= box.lo[k] && p[k] <= box.hi[k])) return false;
  }
  return true;
}

}  // namespace

const SurfaceProjector::CachedCell& SurfaceProjector::cell_of(const Vec3& point) {
  std::array<std::int64_t, 3> index;
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) {
    index[k] = static_cast<std::int64_t>(std::floor(point[k] / kCellSize));
    hash = (hash ^ static_cast<std::uint64_t>(index[k])) * 0x9E3779B97F4A7C15ull;
  }
  CachedCell& cell = cells_[hash >> 58];
  if (cell.is_filled && cell.index == index) return cell;
  cell.is_filled = true;
  cell.index = index;
  for (int k = 0; k < 3; ++k) {
    cell.box.lo[k] = static_cast<double>(index[k]) * kCellSize - kMargin;
    cell.box.hi[k] = static_cast<double>(index[k] + 1) * kCellSize + kMargin;
  }
  field_.collect_near(cell.box, cell.atoms);
  return cell;
}

std::optional<SurfacePoint> SurfaceProjector::project(const Vec3& point, double farthest) {
  // Where the next Newton step is below this (A) the last one was good to its square.
  constexpr double kGoodStep = 3e-6;
  const CachedCell* cell = &cell_of(point);
  Vec3 p = point;
  for (int iteration = 0; iteration < 40; ++iteration) {
    if (!is_in(cell->box, p)) cell = &cell_of(p);
    const PointValue v = evaluate(cell->atoms, field_.decay(), p);
    const double slope = length(v.gradient);
    if (!(slope > 0.0)) return std::nullopt;
    double step = -v.value / slope;
    const double limit = 0.5 * farthest;
    step = std::clamp(step, -limit, limit);
    Vec3 moved;
    for (int k = 0; k < 3; ++k) {
      p[k] += step * v.gradient[k] / slope;
      moved[k] = p[k] - point[k];
    }
    if (!(length(moved) <= farthest)) return std::nullopt;
    if (std::abs(step) > kGoodStep) continue;
    SurfacePoint result;
    for (int k = 0; k < 3; ++k) result.position[k] = std::llround(p[k] * kUnitsPerAngstrom);
    result.normal = outward_normal(v.gradient);
    return result;
  }
  return std::nullopt;
}

double SurfaceProjector::curvature(const Vec3& point) {
  using Eigen::Matrix3d, Eigen::Vector3d;
  const NearAtoms& atoms = cell_of(point).atoms;
  const double d = field_.decay();
  double total = 0.0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Vector3d u(point[0] - atoms.x[i], point[1] - atoms.y[i], point[2] - atoms.z[i]);
    const double a = vector_exp(atoms.w[i] - d * u.squaredNorm());
    total += a;
    first += a * u;
    second += a * u * u.transpose();
  }
  const Vector3d mean = first / total, gradient = -2.0 * d * mean;
  const Matrix3d hessian =
      4.0 * d * d * (second / total - mean * mean.transpose()) - 2.0 * d * Matrix3d::Identity();
  const double slope = gradient.norm();
  // Shape operator: the Hessian in the tangent plane over the slope.
  const Matrix3d tangent = Matrix3d::Identity() - gradient * gradient.transpose() / (slope * slope);
  const Matrix3d shape = tangent * hessian * tangent / slope;
  return shape.norm() > 0.0 ? Eigen::SelfAdjointEigenSolver<Matrix3d>(shape, Eigen::EigenvaluesOnly)
                                  .eigenvalues()
                                  .cwiseAbs()
                                  .maxCoeff()
                            : 0.0;
}

}  // namespace gaussmesh
