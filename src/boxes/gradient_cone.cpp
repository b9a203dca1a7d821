#include "boxes/gradient_cone.h"

#include <algorithm>
#include <cmath>

#include "core/vectors.h"

namespace gaussmesh {
namespace {

void add_to(Vec3& sum, const Vec3& v) {
  for (int k = 0; k < 3; ++k) sum[k] += v[k];
}

}  // namespace

Direction nearest_direction(const Vec3& vector) {
  Direction direction;
  for (std::int8_t k = 1; k < 3; ++k) {
    if (std::abs(vector[k]) > std::abs(vector[direction.axis])) direction.axis = k;
  }
  const double along = vector[direction.axis];
  direction.sign = along > 0.0 ? 1 : -1;
  if (along == 0.0) return direction;
  const auto slant = [&](int k) {
    return static_cast<std::int8_t>(std::lround(Direction::kSlantParts * vector[k] / along));
  };
  direction.slant = {slant(first_axis(direction.axis)), slant(second_axis(direction.axis))};
  return direction;
}

void GradientCone::add(const Vec3& gradient) {
  const double length = std::sqrt(dot(gradient, gradient));
  if (length > 0.0) gradients_.push_back({gradient[0] / length, gradient[1] / length, gradient[2] / length});
}

Vec3 GradientCone::middle() const {
  // From their mean step by step towards the one that is farthest, in ever smaller steps (Badoiu and Clarkson's way to
  // the centre of the smallest ball).
  Vec3 sum{};
  for (const Vec3& gradient : gradients_) add_to(sum, gradient);
  for (std::size_t step = 0; step < 2 * gradients_.size(); ++step) {
    add_to(sum, *std::min_element(gradients_.begin(), gradients_.end(),
                                  [&](const Vec3& a, const Vec3& b) { return dot(a, sum) < dot(b, sum); }));
  }
  return sum;
}

}  // namespace gaussmesh
