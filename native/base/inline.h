// base/inline.h - what is part of a loop wherever it is written.
//
// Loops are widened only around functions that are put into them; GCC leaves out those that look long. What is put into
// a function with DP_CLONES is built for wider registers with it.
#pragma once
#if defined(__GNUC__)
#define DP_INLINE static inline __attribute__((always_inline))
#else
#define DP_INLINE static inline
#endif
