#include "patch/fold_curve.h"

#include <Eigen/Dense>
#include <numbers>
#include <optional>

#include "catch2.h"
#include "field/gaussian_field.h"
#include "support/fields.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

NearAtoms atoms_near(const std::vector<Atom>& atoms, double decay, double isovalue, const Box& box) {
  NearAtoms near;
  GaussianField(atoms, decay, isovalue).collect_near(box, near, 60.0);
  return near;
}

/// The place of a fold curve that Newton's method finds from a place of the surface, by steps of least length.
std::optional<Vec3> fold_near(const ExactField& exact, Vec3 p, int axis) {
  constexpr double kDifference = 1e-5;
  for (int step = 0; step < 30; ++step) {
    Vec3 before = p, after = p;
    before[axis] -= kDifference;
    after[axis] += kDifference;
    const auto slope = exact.gradient(p), slope_before = exact.gradient(before), slope_after = exact.gradient(after);
    Eigen::Matrix<double, 2, 3> jacobian;
    for (int k = 0; k < 3; ++k) {
      jacobian(0, k) = static_cast<double>(slope[k]);
      jacobian(1, k) = static_cast<double>(slope_after[k] - slope_before[k]) / (after[axis] - before[axis]);
    }
    const Eigen::Vector2d residual(static_cast<double>(exact.psi(p)), static_cast<double>(slope[axis]));
    if (residual.norm() < 1e-12) return p;
    const Eigen::Vector3d change = jacobian.transpose() * (jacobian * jacobian.transpose()).inverse() * residual;
    if (!(change.norm() < 1.0)) return std::nullopt;  // far from any, or where they meet
    for (int k = 0; k < 3; ++k) p[k] -= change[k];
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("the fold curve of a sphere along an axis is its equator across that axis") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    // A quarter of the sphere: the equator runs from the face a = 0 to the face b = 0.
    Box box;
    box.lo[a] = box.lo[b] = 0.0;
    box.hi[a] = box.hi[b] = 3.0;
    box.lo[axis] = -1.4;
    box.hi[axis] = 1.6;
    const NearAtoms near = atoms_near({{0, 0, 0, 2.0, 0}}, 0.6, 1.0, box_around({0, 0, 0}, 4.0));
    Vec3 start{};
    start[a] = 2.0;
    const auto curve = follow_fold(near, 0.6, box, start, axis);
    REQUIRE(curve);
    for (const Vec3& p : curve->points) {
      CHECK(std::abs(p[axis]) < 1e-9);
      CHECK(std::hypot(p[a], p[b]) == Approx(2.0).margin(1e-9));
    }
    // The chords of the steps are shorter than the arc by their sagitta; the last step leaves the box.
    const double step = 3.0 / 16.0;
    CHECK(curve->length > 0.99 * std::numbers::pi);
    CHECK(curve->length < std::numbers::pi + 1.1 * step);
    CHECK(curve->points.back()[a] <= 0.0);
    CHECK(curve->points[curve->points.size() - 2][a] > 0.0);
  }
}

TEST_CASE("fold curves of clouds stay on the surface, where it has no slope along the axis") {
  const std::uint64_t seed = 73;
  CAPTURE(seed);
  Random random(seed);
  std::size_t followed = 0, points = 0;
  for (int cloud = 0; cloud < 400; ++cloud) {
    const std::vector<Atom> atoms = random_cloud(random, {8, 4.0, 1.0, 2.2, 0.0});
    const ExactField exact(atoms, 0.6, 1.2);
    const Box room = box_around({0, 0, 0}, 3.0);
    const NearAtoms near = atoms_near(atoms, 0.6, 1.2, room);
    const Vec3 p = random_point(random, room), q = random_point(random, room);
    if ((exact.psi(p) >= 0.0L) == (exact.psi(q) >= 0.0L)) continue;
    const Vec3 on = exact.psi(p) >= 0.0L ? surface_between(exact, p, q) : surface_between(exact, q, p);
    const int axis = static_cast<int>(random.integer(0, 2));
    const auto fold = fold_near(exact, on, axis);
    if (!fold) continue;
    // A box with the fold point on one of its faces.
    Box box = box_around(*fold, 0.4);
    const auto face = random.integer(0, 2);
    box.lo[face] = (*fold)[face];
    box.hi[face] = (*fold)[face] + 0.8;
    const auto curve = follow_fold(near, 0.6, box, *fold, axis);
    if (!curve) continue;
    ++followed;
    double length = 0.0;
    Vec3 before = *fold;
    for (const Vec3& at : curve->points) {
      CHECK(static_cast<double>(std::abs(exact.psi(at))) < 1e-8);
      CHECK(static_cast<double>(std::abs(exact.gradient(at)[axis])) < 1e-8);
      length += std::hypot(at[0] - before[0], at[1] - before[1], at[2] - before[2]);
      before = at;
      ++points;
    }
    CHECK(curve->length == Approx(length));
  }
  CHECK(followed > 15);
  CHECK(points > 100);
}

TEST_CASE("a curve that does not go into the box is not followed") {
  const NearAtoms near = atoms_near({{0, 0, 0, 2.0, 0}}, 0.6, 1.0, box_around({0, 0, 0}, 4.0));
  // On the diagonal the equator runs along (-1, 1): both ways lead out of a box with its corner there.
  const double c = 2.0 / std::numbers::sqrt2;
  CHECK_FALSE(follow_fold(near, 0.6, {{c, c, -1.0}, {c + 2.0, c + 2.0, 1.0}}, {c, c, 0}, 2));
}
