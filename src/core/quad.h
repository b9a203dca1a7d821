// Four doubles at a time, for formulas that are written once for a double and for a Quad.
//
// Sums over many atoms are loops that a compiler puts into lanes (simd.h); this is for long formulas without a loop.
#pragma once

#include <bit>
#include <cstdint>

#include "core/simd.h"

namespace gaussmesh {

/// As wide as comparisons go into lanes on all processors with AVX2; others take it apart.
inline constexpr int kQuadLanes = 4;
typedef double Quad __attribute__((vector_size(kQuadLanes * sizeof(double))));
typedef std::int64_t QuadBits __attribute__((vector_size(kQuadLanes * sizeof(std::int64_t))));
typedef std::uint64_t QuadWords __attribute__((vector_size(kQuadLanes * sizeof(std::uint64_t))));

/// a where `condition` holds, else b.
GAUSSMESH_SIMD_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }
GAUSSMESH_SIMD_INLINE Quad select(const QuadBits& condition, const Quad& a, const Quad& b) { return condition ? a : b; }

template <typename Real>
GAUSSMESH_SIMD_INLINE Real smaller_of(const Real& a, const Real& b) {
  return select(a < b, a, b);
}
template <typename Real>
GAUSSMESH_SIMD_INLINE Real larger_of(const Real& a, const Real& b) {
  return select(a < b, b, a);
}

GAUSSMESH_SIMD_INLINE std::uint64_t words_of(double x) { return std::bit_cast<std::uint64_t>(x); }
GAUSSMESH_SIMD_INLINE QuadWords words_of(const Quad& x) { return (QuadWords)x; }
GAUSSMESH_SIMD_INLINE double from_words(std::uint64_t words) { return std::bit_cast<double>(words); }
GAUSSMESH_SIMD_INLINE Quad from_words(const QuadWords& words) { return (Quad)words; }

/// |x|
template <typename Real>
GAUSSMESH_SIMD_INLINE Real size_of(const Real& x) {
  return from_words(words_of(x) & 0x7FFFFFFFFFFFFFFFu);
}

/// The same number in all lanes.
template <typename Real>
GAUSSMESH_SIMD_INLINE Real spread(double x) {
  return Real{} + x;
}

}  // namespace gaussmesh
