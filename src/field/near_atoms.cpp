#include "field/near_atoms.h"

#include <algorithm>
#include <cmath>

#include "core/vector_exp.h"

namespace gaussmesh {
namespace {

/// Distance of a coordinate from an interval, zero inside.
inline double gap(double p, double lo, double hi) { return std::max(0.0, std::max(lo - p, p - hi)); }

/// Exponents are differences of numbers up to 1e12 (the limits of coordinates and radii): a slack for their rounding.
inline double exponent_slack(double w, double decay_times_sq) { return 1e-15 * (std::abs(w) + decay_times_sq) + 1e-12; }

}  // namespace

void NearAtoms::clear() {
  x.clear();
  y.clear();
  z.clear();
  w.clear();
  tail = tail_slope = w_size = 0.0;
  lo = {kEmptyLo, kEmptyLo, kEmptyLo};
  hi = {-kEmptyLo, -kEmptyLo, -kEmptyLo};
}

void NearAtoms::add(double ax, double ay, double az, double aw) {
  lo = {std::min(lo[0], ax), std::min(lo[1], ay), std::min(lo[2], az)};
  hi = {std::max(hi[0], ax), std::max(hi[1], ay), std::max(hi[2], az)};
  w_size = std::max(w_size, std::abs(aw));
  x.push_back(ax);
  y.push_back(ay);
  z.push_back(az);
  w.push_back(aw);
}

void NearAtoms::add_to_tail(double count, double w_max, double distance_sq, double decay) {
  // The slope 2 d r exp(w - d r^2) falls with r beyond 1 / sqrt(2 d): at least that far is assumed in front of it.
  const double exponent = w_max - decay * distance_sq + exponent_slack(w_max, decay * distance_sq);
  const double value = count * (std::exp(exponent) * (1.0 + 1e-9) + 1e-300);
  const double r = std::sqrt(std::max(distance_sq, 0.5 / decay));
  tail += value;
  tail_slope += 2.0 * decay * r * value * (1.0 + 1e-9);
}

void NearAtoms::restrict_from(const NearAtoms& parent, const Box& box, double decay, double cut) {
  clear();
  tail = parent.tail;
  tail_slope = parent.tail_slope;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    const double dx = gap(parent.x[i], box.lo[0], box.hi[0]);
    const double dy = gap(parent.y[i], box.lo[1], box.hi[1]);
    const double dz = gap(parent.z[i], box.lo[2], box.hi[2]);
    const double distance_sq = dx * dx + dy * dy + dz * dz;
    if (parent.w[i] - decay * distance_sq >= -cut) {
      add(parent.x[i], parent.y[i], parent.z[i], parent.w[i]);
    } else {
      add_to_tail(1.0, parent.w[i], distance_sq, decay);
    }
  }
}

CrudeBounds crude_bounds(const NearAtoms& atoms, const Box& box, double decay) {
  CrudeBounds bounds;
  double sum = 0.0;
  double largest_lower = -1e300;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const double gx = gap(atoms.x[i], box.lo[0], box.hi[0]);
    const double gy = gap(atoms.y[i], box.lo[1], box.hi[1]);
    const double gz = gap(atoms.z[i], box.lo[2], box.hi[2]);
    const double fx = std::max(box.hi[0] - atoms.x[i], atoms.x[i] - box.lo[0]);
    const double fy = std::max(box.hi[1] - atoms.y[i], atoms.y[i] - box.lo[1]);
    const double fz = std::max(box.hi[2] - atoms.z[i], atoms.z[i] - box.lo[2]);
    const double near_sq = decay * (gx * gx + gy * gy + gz * gz);
    const double far_sq = decay * (fx * fx + fy * fy + fz * fz);
    sum += vector_exp(atoms.w[i] - near_sq + exponent_slack(atoms.w[i], near_sq));
    largest_lower = std::max(largest_lower, atoms.w[i] - far_sq - exponent_slack(atoms.w[i], far_sq));
  }
  bounds.upper = sum * (1.0 + 1e-9) + atoms.tail;
  bounds.inside = largest_lower > 0.0;
  return bounds;
}

}  // namespace gaussmesh
