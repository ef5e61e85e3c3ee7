#pragma once

/// Before a function: compile it for AVX2 as well, and select the version for this machine at run time. Both versions
/// give the same bits: no contraction into fused multiply-adds (see CMakeLists.txt), no reordering of sums. Disabled
/// under sanitizers, which cannot run before the selection is made.
///
/// VELDT_DEFAULT_TARGET stands before a function that has an overload written for AVX2, which exists where
/// VELDT_HAS_CLONES is 1.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define VELDT_CLONES __attribute__((target_clones("default", "avx2")))
#define VELDT_HAS_CLONES 1
#define VELDT_DEFAULT_TARGET __attribute__((target("default")))
#else
#define VELDT_CLONES
#define VELDT_HAS_CLONES 0
#define VELDT_DEFAULT_TARGET
#endif

/// Before a small function that a function with VELDT_CLONES calls in its loops: it is inlined into both versions.
/// (Otherwise a compiler may keep it out of line, compiled for the plain version only.)
#if defined(__GNUC__)
#define VELDT_INLINE __attribute__((always_inline)) inline
#else
#define VELDT_INLINE inline
#endif
