// How a function is compiled for an instruction set: `REMAP_FOR_AVX2 int f()` is f with everything that it
// calls inlined, compiled with AVX2.
//
// Only functions of internal linkage may carry these, and only they are compiled with wider instructions:
// what they call is inlined into them or called as it was compiled for everybody. Had whole source files been
// compiled with -mavx512f instead, their copies of inline functions (std::array, a header's own) would be
// candidates for the one copy that a linker keeps, and the baseline might run instructions that the processor
// does not have.
//
// No target has FMA on its own, AVX-512 brings it; -ffp-contract=off keeps compilers from fusing with it, so
// that every set computes the same bits.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define REMAP_HAS_X86_SETS 1
#else
#define REMAP_HAS_X86_SETS 0
#endif

#if defined(__GNUC__)
#define REMAP_FOR_BASELINE __attribute__((flatten))
#else
#define REMAP_FOR_BASELINE
#endif

#if REMAP_HAS_X86_SETS
#define REMAP_FOR_AVX2 __attribute__((target("avx2"), flatten))
#if defined(__clang__)
#define REMAP_FOR_AVX512 __attribute__((target("avx2,avx512f,avx512vl,avx512bw,avx512dq"), flatten))
#else
#define REMAP_FOR_AVX512 \
  __attribute__((target("avx2,avx512f,avx512vl,avx512bw,avx512dq,prefer-vector-width=512"), flatten))
#endif
#endif

// Around the definitions of what such a function calls, and what that calls: clang's `flatten` inlines one
// level of calls only, where gcc's inlines all.
#if defined(__clang__)
#define REMAP_INLINED_FUNCTIONS_BEGIN \
  _Pragma("clang attribute push(__attribute__((always_inline)), apply_to = function)")
#define REMAP_INLINED_FUNCTIONS_END _Pragma("clang attribute pop")
#else
#define REMAP_INLINED_FUNCTIONS_BEGIN
#define REMAP_INLINED_FUNCTIONS_END
#endif
