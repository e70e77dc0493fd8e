// base/finite.h - for files whose loops meet neither NaN nor infinity, nor ask for the sign of a zero.
//
// Saying so changes no result; without it GCC 12 takes two or three instructions for the smaller or the larger of two
// numbers. Holds from here to the end of the file, so it comes before every other header: a function that was
// promised less does not become part of one that was promised more.
#pragma once

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("finite-math-only", "no-signed-zeros")
#endif
