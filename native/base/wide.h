// base/wide.h - one body, several machines.
//
// Hot loops are written plainly, row by row, so that a compiler can widen them. DP_CLONES before a
// function asks for a second build of it for wider registers, picked when the program starts. Both
// do the same operations in the same order (no fused multiply-add), so both give the same bits.
// -DDP_SCALAR leaves only the plain build. Only static functions have clones, whose names no other
// file has: Clang gives those of shared ones a name that other files do not know, and shows those of static
// ones to all.
#pragma once
#include <limits.h>  // tells __GLIBC__, whose loader picks the clone; elsewhere each call does, by base/os_processor.c

#if defined(__x86_64__) && (defined(__GLIBC__) || defined(DP_CPU_MODEL)) && !defined(DP_SCALAR) && \
    !defined(DP_CHECKED)
#define DP_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define DP_CLONES
#endif

// Nobody here asks the machine whether a floating-point exception was raised. Saying so changes no
// result; without it GCC leaves loops with comparisons narrow. Holds from here to the end of the file.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-trapping-math")
#endif
