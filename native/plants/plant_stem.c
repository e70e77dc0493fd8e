// plants/plant_stem.c - the shape of one stem: how high it is, bent, risen, drawn out.
//
// None of it changes a piece's length. Shares are looked for by halving: a shape's height is no
// simple function of them.
#include "plants/plant_stem.h"

#define HALVINGS 24     // of a share that is looked for
#define FLATTENINGS 4   // until it is no higher by that, nearly
#define FOOT_STIFF 1.5  // a stem bends less at its foot
#define TIP_SLACK 0.75  // and more at its tip

double dp_stem_high(const Stem* stem)
{
    double at = 0.0, max = 0.0;
    for (int k = 0; k < stem->pieces; ++k) {
        const DpVec3 segment = stem->segment[k];
        at += segment.z - stem->slope[0] * segment.x - stem->slope[1] * segment.y;
        max = at > max ? at : max;
    }
    return max;
}

static DpVec3 between(DpVec3 a, DpVec3 b, double share)
{
    return dp_add(dp_scale(a, 1.0 - share), dp_scale(b, share));
}

Stem dp_stem_risen(const Stem* laid, const Stem* own, double share)
{
    Stem out = *own;
    for (int k = 0; k < own->pieces; ++k) {
        const DpVec3 up = dp_unit(own->segment[k]);
        const DpVec3 segment = between(dp_unit(laid->segment[k]), up, share);
        out.segment[k] =
            dp_scale(dp_length(segment) > 1e-6 ? dp_unit(segment) : up, dp_length(own->segment[k]));
    }
    return out;
}

Stem dp_stem_bent(const Stem* own, const double lean[2], double share)
{
    Stem         out = *own;
    const double size = sqrt(lean[0] * lean[0] + lean[1] * lean[1]);
    const double x = size > 0.0 ? lean[0] / size : 1.0, y = size > 0.0 ? lean[1] / size : 0.0;
    const DpVec3 flat = dp_unit(dp_vec3(x, y, own->slope[0] * x + own->slope[1] * y));
    for (int k = 0; k < own->pieces; ++k) {
        const double along = own->pieces > 1 ? (double)k / (own->pieces - 1) : 1.0;
        const double here = pow(share, FOOT_STIFF + (TIP_SLACK - FOOT_STIFF) * along);
        const DpVec3 segment = between(dp_unit(own->segment[k]), flat, here);
        out.segment[k] = dp_scale(dp_unit(segment), dp_length(own->segment[k]));
    }
    return out;
}

double dp_stem_smooth(double from, double to, double at)
{
    const double x = dp_clamp((at - from) / (to - from), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

Stem dp_stem_unfolded(const Stem* stem, double share)
{
    Stem         out = *stem;
    DpVec3       sum = dp_vec3(0, 0, 0);
    double       length = 0.0;
    const double high = dp_stem_high(stem);
    for (int k = 0; k < stem->pieces; ++k) {
        sum = dp_add(sum, stem->segment[k]);
        length += dp_length(stem->segment[k]);
    }
    share *= length > 0.0 ? dp_stem_smooth(0.2, 0.6, dp_length(sum) / length) : 0.0;
    for (int k = 0; k < stem->pieces; ++k) {
        const DpVec3 segment = between(dp_unit(stem->segment[k]), dp_unit(sum), share);
        if (dp_length(segment) > 1e-6)
            out.segment[k] = dp_scale(dp_unit(segment), dp_length(stem->segment[k]));
    }
    for (int pass = 0; pass < FLATTENINGS && dp_stem_high(&out) > high; ++pass) {
        const double lost = 1.0 - high / dp_stem_high(&out);
        for (int k = 0; k < stem->pieces; ++k) {
            DpVec3 segment = out.segment[k];
            segment.z -=
                lost * (segment.z - stem->slope[0] * segment.x - stem->slope[1] * segment.y);
            if (dp_length(segment) > 1e-9)
                out.segment[k] = dp_scale(dp_unit(segment), dp_length(stem->segment[k]));
        }
    }
    return out;
}

double dp_stem_risen_by(const Stem* laid, const Stem* own, double height)
{
    double low = 0.0, top = 1.0;
    for (int k = 0; k < HALVINGS && dp_stem_high(laid) < height; ++k) {
        const double share = 0.5 * (low + top);
        const Stem   stem = dp_stem_risen(laid, own, share);
        if (dp_stem_high(&stem) > height)
            top = share;
        else
            low = share;
    }
    return low;
}

double dp_stem_bent_by(const Stem* own, const double lean[2], double lost)
{
    Stem   straight = {.pieces = own->pieces};
    double low = 0.0, top = 1.0;
    for (int k = 0; k < own->pieces; ++k) straight.segment[k].z = 1.0;
    for (int k = 0; k < HALVINGS; ++k) {
        const double share = 0.5 * (low + top);
        const Stem   stem = dp_stem_bent(&straight, lean, share);
        if (dp_stem_high(&stem) > (1.0 - lost) * own->pieces)
            low = share;
        else
            top = share;
    }
    return low;
}
