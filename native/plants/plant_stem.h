// plants/plant_stem.h - one stem by itself, for what is shown of it.
#pragma once
#include "base/vec.h"

#define DP_STEM_MAX_PIECES 64

// A stem from its foot upward.
typedef struct Stem
{
    DpVec3 foot, segment[DP_STEM_MAX_PIECES];
    int    pieces;
    double slope[2];
} Stem;

// its highest point over its foot and the slope [m]
double dp_stem_high(const Stem* stem);
// `laid` on its way to `own`, as long as that is; share 0..1
Stem dp_stem_risen(const Stem* laid, const Stem* own, double share);
// a share at which that is so high
double dp_stem_risen_by(const Stem* laid, const Stem* own, double height);
// `own` bent down to the slope, to where the lean goes; share 0..1
Stem dp_stem_bent(const Stem* own, const double lean[2], double share);
// a share at which a straight stem that is bent loses so much of its height, 0..1
double dp_stem_bent_by(const Stem* own, const double lean[2], double lost);
// A stem whose folds are drawn out, no higher than it was: its pieces turn to where it goes as a
// whole. One that comes back to its foot goes nowhere and stays as it is.
Stem dp_stem_unfolded(const Stem* stem, double share);
// 0 up to `from`, 1 from `to` on
double dp_stem_smooth(double from, double to, double at);
