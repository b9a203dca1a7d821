// Loops compiled for several instruction sets, the best of which is chosen when the program starts.
#pragma once

// Sanitizers run before the dynamic linker's resolvers are safe to call; other compilers and processors take the
// portable code. All versions round alike: fused multiply-add is off (-ffp-contract=off).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define GAUSSMESH_SIMD_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GAUSSMESH_SIMD_CLONES
#endif
