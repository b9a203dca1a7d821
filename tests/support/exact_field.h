// The field by its definition, in long double: what every bound and every root is held against.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/lattice.h"
#include "gaussmesh/atom.h"

namespace gaussmesh::testing {

/// psi = log(phi / c) of some atoms. With exponents up to 10^6 (radii of 1000 A) long double is good to 1e-12.
class ExactField {
 public:
  ExactField(std::vector<Atom> atoms, double decay, double isovalue)
      : atoms_(std::move(atoms)), decay_(decay), log_isovalue_(std::log(static_cast<long double>(isovalue))) {}

  long double psi(const Vec3& p) const { return sums(p).psi; }

  /// phi / c itself, where it does not overflow.
  long double relative(const Vec3& p) const { return std::exp(psi(p)); }

  /// Gradient of psi (1/A).
  std::array<long double, 3> gradient(const Vec3& p) const { return sums(p).gradient; }

 private:
  struct Sums {
    long double psi = 0.0L;
    std::array<long double, 3> gradient{};
  };

  Sums sums(const Vec3& p) const {
    std::vector<long double> exponents;
    for (const Atom& a : atoms_) {
      const auto u = offset(a, p);
      const long double r = a.radius;
      exponents.push_back(decay_ * (r * r - (u[0] * u[0] + u[1] * u[1] + u[2] * u[2])) - log_isovalue_);
    }
    const long double largest = *std::max_element(exponents.begin(), exponents.end());
    long double total = 0.0L;
    Sums result;
    for (std::size_t i = 0; i < atoms_.size(); ++i) {
      const long double weight = std::exp(exponents[i] - largest);
      total += weight;
      const auto u = offset(atoms_[i], p);
      for (int k = 0; k < 3; ++k) result.gradient[k] += -2.0L * decay_ * weight * u[k];
    }
    for (long double& g : result.gradient) g /= total;
    result.psi = largest + std::log(total);
    return result;
  }

  static std::array<long double, 3> offset(const Atom& a, const Vec3& p) {
    return {static_cast<long double>(p[0]) - a.x, static_cast<long double>(p[1]) - a.y,
            static_cast<long double>(p[2]) - a.z};
  }

  std::vector<Atom> atoms_;
  long double decay_;
  long double log_isovalue_;
};

/// Where psi changes its sign between points p (psi >= 0) and q (psi < 0), to long double's last bits.
inline Vec3 surface_between(const ExactField& field, Vec3 p, Vec3 q) {
  for (int i = 0; i < 100; ++i) {
    Vec3 middle;
    for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (p[k] + q[k]);
    (field.psi(middle) >= 0.0L ? p : q) = middle;
  }
  return p;
}

/// Radius of the sphere that is the surface of one atom: sqrt(r^2 - ln(c) / d).
inline double sphere_radius(double radius, double decay, double isovalue) {
  return std::sqrt(radius * radius - std::log(isovalue) / decay);
}

}  // namespace gaussmesh::testing
