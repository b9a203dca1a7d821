// Eight doubles at a time: the vectors that the judge's inner loops are written in, and an exponential of them.
//
// Lanes hold different points, and sums go over atoms in their order.
#pragma once

#include <cstddef>
#include <cstdint>

// Functions so marked are compiled for several instruction sets, the best of which is chosen while the program is
// loaded, before a sanitizer's runtime is ready, and instrumented code would crash there: sanitizers, and other
// compilers and processors, take the portable code.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GAUSSMESH_LANE_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define GAUSSMESH_LANE_CLONES
#endif

namespace gaussmesh::verify {

inline constexpr std::size_t kLanes = 8;

typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));
typedef std::int64_t LaneBits __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

/// x <- exp(x), x within [-700, 700], to a relative error of 1e-14: with |r| <= ln(2)/2 the Taylor remainder of
/// degree 11 is 6e-15, and rounding adds less than 1e-15. By reference, since how vectors are passed by value
/// depends on the instruction set.
inline void exponentiate(Lanes& x) {
  constexpr double kLog2e = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e4p-1;  // 15 significant bits: a whole number times it is exact
  constexpr double kLn2Low = 0x1.7f7d1cf79abcap-20;
  constexpr double kToWhole = 0x1.8p52;  // adding it rounds to a whole number, which stands in the low bits
  const Lanes shifted = x * kLog2e + kToWhole;
  const Lanes n = shifted - kToWhole;
  const Lanes r = (x - n * kLn2High) - n * kLn2Low;
  Lanes p = r * (1.0 / 39916800) + 1.0 / 3628800;
  p = p * r + 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  const LaneBits exponent = ((LaneBits)shifted + 1023) << 52;
  x = p * (Lanes)exponent;
}

}  // namespace gaussmesh::verify
