#include "field/near_atoms.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/vector_exp.h"
#include "core/vectors.h"

namespace gaussmesh {
namespace {

/// Exponents are differences of numbers that the limits of decays, radii and coordinates keep below 1e13 (w) and 2e16
/// (d dist^2), each rounded half a dozen times: a slack relative to both.
inline double exponent_slack(double w, double decay_times_sq) { return 1e-15 * (std::abs(w) + decay_times_sq) + 1e-12; }

/// The same of exponents down to -size, of atoms with |log-weight| at most `largest_w`.
double exponents_slack(double largest_w, double size) { return 4e-15 * (2.0 * largest_w + size) + 1e-12; }

/// Log-weight of the entries that fill up a vector: e^-1e30 is 0, and vector_exp() of it 1e-304, 1e-200 times less
/// than any sum that it is added to.
constexpr double kNoWeight = -1e30;

GAUSSMESH_SIMD_CLONES
void exponents_in(const double* x, const double* y, const double* z, const double* w, std::size_t n, double d,
                  const double* lo, const double* hi, double* exponent) {
  const double ax = lo[0], ay = lo[1], az = lo[2], bx = hi[0], by = hi[1], bz = hi[2];
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = gap(x[i], ax, bx), dy = gap(y[i], ay, by), dz = gap(z[i], az, bz);
    exponent[i] = w[i] - d * (dx * dx + dy * dy + dz * dz);
  }
}

/// The smallest and the largest of some numbers.
struct Extremes {
  double least, largest;
};

GAUSSMESH_SIMD_CLONES
Extremes extremes_of(const double* values, std::size_t n) {
  double least = values[0], largest = least;
#pragma omp simd reduction(min : least) reduction(max : largest)
  for (std::size_t i = 0; i < n; ++i) {
    least = values[i] < least ? values[i] : least;
    largest = values[i] > largest ? values[i] : largest;
  }
  return {least, largest};
}

/// Exponents below this count as this: e^-600 = 1e-261.
constexpr double kLeastExponent = -600.0;

/// Over exponents E below -cut: bounds of the sums of e^E and of e^E max(w - E, 1/2).
struct LeftOutSums {
  double weight, weight_times_distance;
};

GAUSSMESH_SIMD_CLONES
LeftOutSums sum_left_out(const double* exponent, std::size_t n, double cut, double w) {
  double weight = 0.0, times_distance = 0.0;
#pragma omp simd reduction(+ : weight, times_distance)
  for (std::size_t i = 0; i < n; ++i) {
    const double counted = exponent[i] < -cut ? exponent[i] : kLeastExponent;
    const double e = counted > kLeastExponent ? counted : kLeastExponent;
    const double a = exp_above(e);
    weight += a;
    times_distance += a * std::max(w - e, 0.5);
  }
  return {weight, times_distance};
}

/// Over a box: the sum of what the weights of atoms can be at most, and the largest exponent that one has at least.
struct DistanceSums {
  double largest, least_exponent;
};

GAUSSMESH_SIMD_CLONES
DistanceSums sums_by_distance(const double* x, const double* y, const double* z, const double* w, std::size_t n,
                              double d, const double* lo, const double* hi) {
  const double ax = lo[0], ay = lo[1], az = lo[2], bx = hi[0], by = hi[1], bz = hi[2];
  double sum = 0.0, largest_lower = -1e300;
#pragma omp simd reduction(+ : sum) reduction(max : largest_lower)
  for (std::size_t i = 0; i < n; ++i) {
    const double gx = gap(x[i], ax, bx), gy = gap(y[i], ay, by), gz = gap(z[i], az, bz);
    const double fx = std::max(bx - x[i], x[i] - ax), fy = std::max(by - y[i], y[i] - ay),
                 fz = std::max(bz - z[i], z[i] - az);
    const double near_sq = d * (gx * gx + gy * gy + gz * gz), far_sq = d * (fx * fx + fy * fy + fz * fz);
    sum += vector_exp(w[i] - near_sq + exponent_slack(w[i], near_sq));
    const double lower = w[i] - far_sq - exponent_slack(w[i], far_sq);
    largest_lower = lower > largest_lower ? lower : largest_lower;
  }
  return {sum, largest_lower};
}

/// Copies chosen entries and gives their least and largest; there is at least one.
Extremes gather(const double* from, const std::uint32_t* index, std::size_t n, double* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = from[index[i]];
  return extremes_of(to, n);
}

}  // namespace

void largest_exponents(const WeightedCentres& atoms, std::size_t first, std::size_t count, const Box& box, double decay,
                       double* exponent) {
  exponents_in(atoms.x.data() + first, atoms.y.data() + first, atoms.z.data() + first, atoms.w.data() + first, count,
               decay, box.lo.data(), box.hi.data(), exponent);
}

void NearAtoms::clear(double new_cut) {
  size_ = 0;
  cut = new_cut;
  tail = tail_slope = w_size = 0.0;
  lo = {kEmptyLo, kEmptyLo, kEmptyLo};
  hi = {-kEmptyLo, -kEmptyLo, -kEmptyLo};
}

void NearAtoms::take(const WeightedCentres& atoms, std::vector<std::uint32_t>& chosen, std::size_t count) {
  size_ = count;
  if (count == 0) return;
  const std::size_t n = padded();
  if (chosen.size() < n) chosen.resize(n);
  for (std::size_t i = count; i < n; ++i) chosen[i] = chosen[0];
  if (x.size() < n) {
    for (std::vector<double>* list : {&x, &y, &z, &w}) list->resize(std::max(n, 2 * list->size()));
  }
  const Extremes in_x = gather(atoms.x.data(), chosen.data(), n, x.data());
  const Extremes in_y = gather(atoms.y.data(), chosen.data(), n, y.data());
  const Extremes in_z = gather(atoms.z.data(), chosen.data(), n, z.data());
  lo = {in_x.least, in_y.least, in_z.least};
  hi = {in_x.largest, in_y.largest, in_z.largest};
  const Extremes in_w = gather(atoms.w.data(), chosen.data(), n, w.data());
  w_size = std::max(std::abs(in_w.least), std::abs(in_w.largest));
  for (std::size_t i = count; i < n; ++i) w[i] = kNoWeight;
}

void NearAtoms::add_to_tail(double count, double w_max, double distance_sq, double decay) {
  // The slope 2 d r exp(w - d r^2) falls with r beyond 1 / sqrt(2 d): at least that far is assumed in front of it.
  const double exponent = w_max - decay * distance_sq + exponent_slack(w_max, decay * distance_sq);
  // 1e-9 is more than the rounding of 4e6 additions to the tail: there are fewer nodes than that.
  const double value = count * (std::exp(exponent) * (1.0 + 1e-9) + 1e-300);
  const double r = std::sqrt(std::max(distance_sq, 0.5 / decay));
  tail += value;
  tail_slope += 2.0 * decay * r * value * (1.0 + 1e-9);
}

void NearAtoms::add_to_tail(const double* exponent, std::size_t n, double largest_w, double decay) {
  const LeftOutSums sums = sum_left_out(exponent, n, cut, largest_w);
  const double factor = std::exp(exponents_slack(largest_w, -kLeastExponent)) * (1.0 + sum_error(n));
  tail += factor * sums.weight;
  tail_slope += factor * 2.0 * std::sqrt(decay * sums.weight) * std::sqrt(sums.weight_times_distance);
}

void NearAtoms::restrict_from(const NearAtoms& parent, const Box& box, double decay, double new_cut) {
  clear(new_cut);
  tail = parent.tail;
  tail_slope = parent.tail_slope;
  thread_local std::vector<double> exponent;
  thread_local std::vector<std::uint32_t> kept;
  if (exponent.size() < parent.padded()) {
    exponent.resize(parent.padded());
    kept.resize(parent.padded());
  }
  largest_exponents(parent, 0, parent.padded(), box, decay, exponent.data());
  std::size_t count = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    kept[count] = static_cast<std::uint32_t>(i);
    count += exponent[i] >= -cut;
  }
  if (count < parent.size()) add_to_tail(exponent.data(), parent.padded(), parent.w_size, decay);
  take(parent, kept, count);
}

CrudeBounds crude_bounds(const NearAtoms& atoms, const Box& box, double decay) {
  const DistanceSums sums = sums_by_distance(atoms.x.data(), atoms.y.data(), atoms.z.data(), atoms.w.data(),
                                             atoms.size(), decay, box.lo.data(), box.hi.data());
  return {sums.largest * (1.0 + sum_error(atoms.size())) + atoms.tail, sums.least_exponent > 0.0};
}

}  // namespace gaussmesh
