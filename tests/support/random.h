// Random input for tests: the same everywhere, from a seed that failing tests print.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "gaussmesh/atom.h"

namespace gaussmesh::testing {

/// The distributions of the standard library differ between its makers; these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  double uniform(double lo, double hi) { return lo + (hi - lo) * 0x1p-53 * static_cast<double>(engine_() >> 11); }
  double logarithmic(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }

  /// From lo to hi, both included.
  std::int64_t integer(std::int64_t lo, std::int64_t hi) {
    return lo + static_cast<std::int64_t>(engine_() % (static_cast<std::uint64_t>(hi - lo) + 1));
  }

  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[engine_() % i]);
  }

 private:
  std::mt19937_64 engine_;
};

/// What random molecules are made of.
struct CloudOptions {
  int atoms = 10;
  double size = 6.0;          ///< edge of the cube around the origin that the centres are in (A)
  double least_radius = 0.8;  ///< A
  double largest_radius = 2.2;
  double zero_radii = 0.1;  ///< share of atoms of radius 0
};

inline std::vector<Atom> random_cloud(Random& random, const CloudOptions& options) {
  std::vector<Atom> atoms;
  const double half = 0.5 * options.size;
  for (int i = 0; i < options.atoms; ++i) {
    Atom a;
    a.x = random.uniform(-half, half);
    a.y = random.uniform(-half, half);
    a.z = random.uniform(-half, half);
    a.radius = random.uniform(options.least_radius, options.largest_radius);
    if (random.uniform(0.0, 1.0) < options.zero_radii) a.radius = 0.0;
    atoms.push_back(a);
  }
  return atoms;
}

}  // namespace gaussmesh::testing
