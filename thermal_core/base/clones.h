#pragma once

/// Before a function: compile it for AVX2 as well and pick at run time what the machine has. Both versions give
/// the same bits: no contraction into fused multiply-adds (see CMakeLists.txt), no reordering of sums. Not under
/// sanitizers, which cannot run before the choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define VELDT_CLONES __attribute__((target_clones("default", "avx2")))
#else
#define VELDT_CLONES
#endif

/// Before a small function that a function with VELDT_CLONES calls in its loops: it becomes part of both versions.
/// (A compiler may otherwise keep it apart, and then in the plain version only.)
#if defined(__GNUC__)
#define VELDT_INLINE __attribute__((always_inline)) inline
#else
#define VELDT_INLINE inline
#endif
