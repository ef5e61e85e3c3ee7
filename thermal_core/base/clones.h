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
