#include "verify/log_field.h"

#include <algorithm>
#include <cmath>

#include "verify/vector3.h"

namespace gaussmesh::verify {
namespace {

constexpr double kLeftOut = 1e-13;  // share of phi that may be missing
constexpr double kReach = 0.75;     // widths of a Gaussian that atoms are gathered for round a point

}  // namespace

double curvature_bound(double decay, double mean_square, const Point& mean) {
  const double trace = std::max(0.0, mean_square - dot(mean, mean));
  return 2 * decay * std::max(1.0, 2 * decay * trace);
}

LogField::LogField(const AtomTree& tree, double decay)
    : tree_(tree), decay_(decay), range_(std::log(static_cast<double>(tree.atom_count()) / kLeftOut) / decay) {}

void LogField::gather_round(const Point& x) {
  const double margin = kReach / std::sqrt(decay_);
  place_ = {{x[0] - margin, x[1] - margin, x[2] - margin}, {x[0] + margin, x[1] + margin, x[2] + margin}};
  near_.clear();
  tree_.for_each_near(place_, range_, [this](const Atom& atom) { near_.push_back(atom); });
  exponents_.resize(near_.size());
}

LogValue LogField::at(const Point& x) {
  if (!boxes_meet(place_, {x, x})) gather_round(x);
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const Atom& atom = near_[i];
    const double dx = x[0] - atom.x, dy = x[1] - atom.y, dz = x[2] - atom.z;
    exponents_[i] = atom.radius * atom.radius - (dx * dx + dy * dy + dz * dz);
    largest = std::max(largest, exponents_[i]);
  }
  double sum = 0.0;
  Point moment{};
  double square = 0.0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (exponents_[i] < largest - range_) continue;
    const Atom& atom = near_[i];
    const double weight = std::exp(decay_ * (exponents_[i] - largest));
    const Point arm{x[0] - atom.x, x[1] - atom.y, x[2] - atom.z};
    sum += weight;
    for (int k = 0; k < 3; ++k) moment[k] += weight * arm[k];
    square += weight * dot(arm, arm);
  }
  const Point mean{moment[0] / sum, moment[1] / sum, moment[2] / sum};
  return {decay_ * largest + std::log(sum),
          {-2 * decay_ * mean[0], -2 * decay_ * mean[1], -2 * decay_ * mean[2]},
          curvature_bound(decay_, square / sum, mean)};
}

}  // namespace gaussmesh::verify
