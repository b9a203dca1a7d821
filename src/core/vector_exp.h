// An exponential and a logarithm that a compiler can put into SIMD lanes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/quad.h"

namespace gaussmesh {

/// Relative error of vector_exp(), with room to spare: argument reduction leaves |r| <= ln(2)/2 to within 2 ulp, the
/// Taylor remainder of degree 12 is 1.7e-16, and Horner's scheme rounds 24 times on terms that fall by r/n.
inline constexpr double kVectorExpError = 8e-16;

/// Bound of the relative error of a sum of n positive terms. 1e-9 is for the terms, products of a few exponentials:
/// below 1e-14 by kVectorExpError, and so much more for whoever adds up in another way, since no bound here needs to be
/// tighter. The rest is for the additions.
inline constexpr double sum_error(std::size_t n) { return 1e-9 + 1.2e-16 * static_cast<double>(n); }

/// exp(x), for x clamped to [-700, 700]. Branch-free, so that loops over it are vectorised.
inline double vector_exp(double x) {
  constexpr double kLog2e = 1.4426950408889634;
  constexpr double kLn2Hi = 0.693145751953125;  // 15 significant bits: n * kLn2Hi is exact
  constexpr double kLn2Lo = 1.42860682030941723212e-6;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to the nearest integer
  x = x < -700.0 ? -700.0 : x;
  x = x > 700.0 ? 700.0 : x;
  const double shifted = x * kLog2e + kRound;
  const double n = shifted - kRound;
  const double r = (x - n * kLn2Hi) - n * kLn2Lo;
  double p = 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  // The low bits of `shifted` hold n; put n + 1023 where the exponent of a double sits.
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023u) << 52;
  return p * std::bit_cast<double>(exponent);
}

/// A number of [1, 1.062] exp(x), for x in [-700, 700]: the chord of 2^y between whole numbers, a third of the cost of
/// vector_exp().
inline double exp_above(double x) {
  constexpr double kLog2e = 1.4426950408889634;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52, as above
  // y = x / ln 2 + 1023 in parts of 2^-20, rounded up: as the high half of a double's bits its whole part is the
  // exponent, and the rest of it the fraction.
  const double shifted = x * (kLog2e * 0x1p20) + (1023.0 * 0x1p20 + 1.0 + kRound);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(shifted) << 32);
}

/// Error of vector_log(): the terms left out are below 2e-11, and rounding of n log(2) is below 1e-13.
inline constexpr double kVectorLogError = 1e-10;

/// log(x) of a positive normal number, or of four: with x = 2^n m, m within sqrt(2) of 1, and
/// s = (m - 1) / (m + 1), log m = 2 (s + s^3/3 + ... + s^11/11 + ...). Branch-free.
template <typename Real>
GAUSSMESH_SIMD_INLINE Real vector_log(const Real& x) {
  constexpr double kLn2 = 0.6931471805599453;
  constexpr std::uint64_t kHalfRoot = 0x3FE6A09E667F3BCDu;  // sqrt(1/2): it and what follows up to sqrt(2) get n = 0
  constexpr std::uint64_t kMantissa = 0x000FFFFFFFFFFFFFu;
  constexpr std::uint64_t kBias = 1024, kWhole = 0x4330000000000000u;  // 2^52: whole numbers stand in its low bits
  const auto shifted = words_of(x) - kHalfRoot;
  const Real n = from_words(((shifted + (kBias << 52)) >> 52) + kWhole) - (0x1p52 + static_cast<double>(kBias));
  const Real m = from_words((shifted & kMantissa) + kHalfRoot);
  const Real s = (m - 1.0) / (m + 1.0), s2 = s * s;
  Real p = s2 * (1.0 / 11.0) + 1.0 / 9.0;
  p = p * s2 + 1.0 / 7.0;
  p = p * s2 + 1.0 / 5.0;
  p = p * s2 + 1.0 / 3.0;
  p = p * s2 + 1.0;
  return n * kLn2 + 2.0 * s * p;
}

/// exp(x) in single precision, for x clamped to [-80, 80]; good to 3e-7, and no proof rests on it.
inline float vector_exp(float x) {
  constexpr float kLog2e = 1.44269504f;
  constexpr float kLn2Hi = 0.693359375f;  // 10 significant bits: n * kLn2Hi is exact
  constexpr float kLn2Lo = -2.12194440e-4f;
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23
  x = x < -80.0f ? -80.0f : x;
  x = x > 80.0f ? 80.0f : x;
  const float shifted = x * kLog2e + kRound;
  const float n = shifted - kRound;
  const float r = (x - n * kLn2Hi) - n * kLn2Lo;
  float p = 1.0f / 720.0f;
  p = p * r + 1.0f / 120.0f;
  p = p * r + 1.0f / 24.0f;
  p = p * r + 1.0f / 6.0f;
  p = p * r + 0.5f;
  p = p * r + 1.0f;
  p = p * r + 1.0f;
  const std::uint32_t exponent = (std::bit_cast<std::uint32_t>(shifted) + 127u) << 23;
  return p * std::bit_cast<float>(exponent);
}

}  // namespace gaussmesh
