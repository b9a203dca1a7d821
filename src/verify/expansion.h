// Exact arithmetic on doubles: a number as the unevaluated sum of doubles of falling size.
//
// After J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates,
// Discrete Comput. Geom. 18:305 (1997), called [She97] here. Exact as long as nothing overflows or underflows;
// which coordinates that allows is said in exact_orientation.h, where the signs are made.
#pragma once

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <vector>

#ifdef __FAST_MATH__
#error "exact arithmetic needs IEEE arithmetic: do not compile this with -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "exact arithmetic needs doubles that are rounded at every operation");

namespace gaussmesh::verify {

/// A sum or product of two doubles, and what rounding took from it: value + error is exact.
struct Rounded {
  double value = 0.0;
  double error = 0.0;
};

/// a + b for any a and b, Theorem 7 of [She97] (Knuth).
inline Rounded two_sum(double a, double b) {
  const double value = a + b;
  const double b_part = value - a;
  const double a_part = value - b_part;
  return {value, (a - a_part) + (b - b_part)};
}

/// a * b; std::fma rounds once, so that what it returns here is the error itself.
inline Rounded two_product(double a, double b) {
  const double value = a * b;
  return {value, std::fma(a, b, -value)};
}

/// An exact number of at most N terms: none is zero, none overlaps another, the largest is last.
///
/// Every function here returns expansions that are "strongly nonoverlapping", as [She97] needs of the next one.
template <std::size_t N>
struct Expansion {
  std::array<double, N> terms{};  ///< the first `size` of them count
  std::size_t size = 0;

  void append(double term) {
    if (term != 0.0) terms[size++] = term;
  }

  int sign() const {
    if (size == 0) return 0;
    return terms[size - 1] > 0.0 ? 1 : -1;
  }
};

/// a - b, exactly.
inline Expansion<2> exact_difference(double a, double b) {
  const Rounded difference = two_sum(a, -b);
  Expansion<2> result;
  result.append(difference.error);
  result.append(difference.value);
  return result;
}

/// e + f, exactly: merge by size, then one pass of two_sum; Theorem 13 of [She97].
template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> result;
  double carry = 0.0;
  for (std::size_t i = 0, j = 0; i < e.size || j < f.size;) {
    const bool from_e = j == f.size || (i < e.size && std::abs(e.terms[i]) < std::abs(f.terms[j]));
    const Rounded step = two_sum(carry, from_e ? e.terms[i++] : f.terms[j++]);
    result.append(step.error);
    carry = step.value;
  }
  result.append(carry);
  return result;
}

template <std::size_t N>
Expansion<N> operator-(Expansion<N> e) {
  for (std::size_t i = 0; i < e.size; ++i) e.terms[i] = -e.terms[i];
  return e;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  return e + (-f);
}

/// e * factor, exactly; Theorem 19 of [She97].
template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& e, double factor) {
  Expansion<2 * N> result;
  double carry = 0.0;
  for (std::size_t i = 0; i < e.size; ++i) {
    const Rounded product = two_product(e.terms[i], factor);
    const Rounded low = two_sum(carry, product.error);
    const Rounded high = two_sum(product.value, low.value);
    result.append(low.error);
    result.append(high.error);
    carry = high.value;
  }
  result.append(carry);
  return result;
}

/// e * f, exactly: f is short, so the products by its terms are added up.
template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& e, const Expansion<2>& f) {
  const Expansion<2 * N> low = e * (f.size > 0 ? f.terms[0] : 0.0);
  const Expansion<2 * N> high = e * (f.size > 1 ? f.terms[1] : 0.0);
  return low + high;
}

/// The exact sum of any number of expansions. Its length is bounded by the range of exponents, not by their number.
class ExactSum {
 public:
  /// Adds term by term; Theorem 10 of [She97].
  template <std::size_t N>
  void add(const Expansion<N>& e) {
    for (std::size_t i = 0; i < e.size; ++i) add(e.terms[i]);
  }

  int sign() const {
    if (terms_.empty()) return 0;
    return terms_.back() > 0.0 ? 1 : -1;
  }

 private:
  void add(double term) {
    std::size_t kept = 0;
    for (const double old : terms_) {
      const Rounded step = two_sum(term, old);
      if (step.error != 0.0) terms_[kept++] = step.error;
      term = step.value;
    }
    terms_.resize(kept);
    if (term != 0.0) terms_.push_back(term);
  }

  std::vector<double> terms_;  // as in Expansion
};

}  // namespace gaussmesh::verify
