// Loops compiled for several instruction sets, the best of which is chosen when the program starts.
#pragma once

// The best version is chosen while the program is loaded, before a sanitizer's runtime is ready, and instrumented code
// would crash there: sanitizers, and other compilers and processors, take the portable code. Versions differ by
// roundings: wider lanes add in another order, and where the processor can, products are fused with sums
// (src/CMakeLists.txt says in which files).
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GAUSSMESH_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define GAUSSMESH_SIMD_CLONES
#endif

// What such a loop calls must become part of it.
#if defined(__GNUC__)
#define GAUSSMESH_SIMD_INLINE inline __attribute__((always_inline))
#else
#define GAUSSMESH_SIMD_INLINE inline
#endif
