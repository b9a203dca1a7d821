#include "trace/face_certificate.h"

#include <set>
#include <utility>
#include <vector>

#include "catch2.h"
#include "field/gaussian_field.h"
#include "support/fields.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// The sides of the points of a grid on a face.
class FaceSamples {
 public:
  FaceSamples(const ExactField& exact, int axis, const Box& face) {
    const int a = first_axis(axis), b = second_axis(axis);
    for (int p = 0; p < kPoints; ++p) {
      for (int q = 0; q < kPoints; ++q) {
        Vec3 at = face.lo;
        at[a] += (face.hi[a] - face.lo[a]) * p / (kPoints - 1);
        at[b] += (face.hi[b] - face.lo[b]) * q / (kPoints - 1);
        inside_[p][q] = exact.psi(at) >= 0.0L;
      }
    }
  }

  /// The sides that lines along each axis of the face leave; both, if they cross the surface both ways.
  std::set<bool> left_along_first() const {
    std::set<bool> left;
    for (int p = 0; p + 1 < kPoints; ++p) {
      for (int q = 0; q < kPoints; ++q) {
        if (inside_[p][q] != inside_[p + 1][q]) left.insert(inside_[p][q]);
      }
    }
    return left;
  }
  std::set<bool> left_along_second() const {
    std::set<bool> left;
    for (int p = 0; p < kPoints; ++p) {
      for (int q = 0; q + 1 < kPoints; ++q) {
        if (inside_[p][q] != inside_[p][q + 1]) left.insert(inside_[p][q]);
      }
    }
    return left;
  }
  bool is_crossed() const { return !left_along_first().empty() || !left_along_second().empty(); }

  /// Patches of one side that do not reach the boundary: a closed curve goes round each.
  int islands() const {
    std::vector<bool> seen(kPoints * kPoints, false);
    int count = 0;
    for (int start = 0; start < kPoints * kPoints; ++start) {
      if (seen[start]) continue;
      bool reaches_boundary = false;
      std::vector<int> to_do = {start};
      seen[start] = true;
      while (!to_do.empty()) {
        const int p = to_do.back() / kPoints, q = to_do.back() % kPoints;
        to_do.pop_back();
        // Diagonal neighbours too: what comes near a boundary counts as reaching it.
        for (int i = p - 1; i <= p + 1; ++i) {
          for (int j = q - 1; j <= q + 1; ++j) {
            if (i < 0 || j < 0 || i == kPoints || j == kPoints) {
              reaches_boundary = true;
            } else if (inside_[i][j] == inside_[p][q] && !seen[i * kPoints + j]) {
              seen[i * kPoints + j] = true;
              to_do.push_back(i * kPoints + j);
            }
          }
        }
      }
      count += !reaches_boundary;
    }
    return count;
  }

 private:
  static constexpr int kPoints = 15;
  bool inside_[kPoints][kPoints];
};

/// The face across `axis` in the middle of a box.
Box middle_face(Box box, int axis) {
  box.lo[axis] = box.hi[axis] = 0.5 * (box.lo[axis] + box.hi[axis]);
  return box;
}

}  // namespace

TEST_CASE("what a face is certified as is what samples of it show") {
  const std::uint64_t seed = 63;
  CAPTURE(seed);
  Random random(seed);
  int empty = 0, along = 0, without_loops = 0, proven_without_loops = 0, with_islands = 0;
  for (int cloud = 0; cloud < 60; ++cloud) {
    const std::vector<Atom> atoms = random_cloud(random, {12, 5.0, 0.8, 2.2, 0.1});
    const GaussianField field(atoms, 0.8, 1.0);
    const ExactField exact(atoms, 0.8, 1.0);
    for (int i = 0; i < 60; ++i) {
      const int axis = static_cast<int>(random.integer(0, 2));
      const Vec3 middle = random_point(random, box_around({0, 0, 0}, 4.0));
      const Box box = middle_face(box_around(middle, random.logarithmic(0.05, 2.0)), axis);
      NearAtoms near;
      field.collect_near(box, near);
      const LocalModel model(near, 0.8, box);
      const FaceCertificate certificate = certify_face(model, axis, box);
      FaceProver prover(0.8);
      prover.move_to(near, axis);
      const bool none_closes = prover.has_no_closed_curve(model);
      const FaceSamples samples(exact, axis, box);
      if (certificate == kFaceEmpty) CHECK_FALSE(samples.is_crossed());
      if (certificate & kFaceAlongFirst) CHECK(samples.left_along_first().size() <= 1);
      if (certificate & kFaceAlongSecond) CHECK(samples.left_along_second().size() <= 1);
      if (certificate != kFaceUncertified || none_closes) CHECK(samples.islands() == 0);
      empty += certificate == kFaceEmpty;
      along += (certificate & (kFaceAlongFirst | kFaceAlongSecond)) != 0;
      without_loops += certificate == kFaceNoClosedCurve;
      proven_without_loops += none_closes && certificate == kFaceUncertified;
      with_islands += samples.islands() > 0;
    }
  }
  CHECK(empty > 200);
  CHECK(along > 200);
  CHECK(without_loops > 10);
  CHECK(proven_without_loops > 50);
  CHECK(with_islands > 5);
}

TEST_CASE("a circle in a face closes, and three quarters of it do not") {
  const GaussianField field({{0, 0, 0, 1.0, 0}}, 0.6, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto is_proven = [&](double first, double second) {
      Vec3 middle{0.0, 0.0, 0.0};
      middle[first_axis(axis)] = first;
      middle[second_axis(axis)] = second;
      const Box box = middle_face(box_around(middle, 1.2), axis);
      NearAtoms near;
      field.collect_near(box, near);
      FaceProver prover(0.6);
      prover.move_to(near, axis);
      return prover.has_no_closed_curve(LocalModel(near, 0.6, box));
    };
    CHECK_FALSE(is_proven(0.0, 0.0));
    for (const double by : {-0.8, 0.8}) {
      CHECK(is_proven(by, 0.0));
      CHECK(is_proven(0.0, by));
      CHECK(is_proven(by, by));
    }
  }
}
