#include "verify/log_field.h"

#include <algorithm>
#include <cmath>

namespace gaussmesh {
namespace {

constexpr double kLeftOut = 1e-13;  // share of phi that may be missing
constexpr double kReach = 0.75;     // widths of a Gaussian that atoms are gathered for round a point

}  // namespace

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
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (exponents_[i] < largest - range_) continue;
    const Atom& atom = near_[i];
    const double weight = std::exp(decay_ * (exponents_[i] - largest));
    sum += weight;
    moment[0] += weight * (x[0] - atom.x);
    moment[1] += weight * (x[1] - atom.y);
    moment[2] += weight * (x[2] - atom.z);
  }
  const double scale = -2 * decay_ / sum;
  return {decay_ * largest + std::log(sum), {scale * moment[0], scale * moment[1], scale * moment[2]}};
}

}  // namespace gaussmesh
