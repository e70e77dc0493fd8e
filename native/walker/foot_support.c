// walker/foot_support.c - somebody carries what does not fall.
//
// Departures
//   TRAIL (4): a body that nobody carries falls; where it does not, the foot that is lowest and
//   slowest touches at its own height, as on a block that the ground does not show. Feet farther up
//   hang from something else, a chair, a rope or wings, and press nothing. test_foot_contact_fall.c,
//   somebody_carries_what_does_not_fall, who_glides_stands_on_both_feet, who_hangs_presses_nothing.
//   A rigid body has no feet to reach down with: lifted, it is carried by what lifts it.
//   a_crate_on_a_rope_presses_nothing.
#include <math.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define SHORTEST 0.1       // shorter gaps without a foot may well be a flight's edge       [s]
#define HIGHEST 0.4        // a foot so far above where it stands carries nothing         [m]
#define RISE_TO_SPEED 5.0  // a foot this much faster carries as little as one 1 m higher [1/s]

static int limb_of(const DpGait* gait, int point)
{
    return gait->part_limb[gait->point_part[point]];
}

static bool carried(const DpGait* gait, int walker, const uint8_t* on, int t)
{
    for (int k = 0; k < gait->points; ++k)
        if (gait->limb_walker[limb_of(gait, k)] == walker &&
            on[(size_t)k * (size_t)gait->times + (size_t)t])
            return true;
    return false;
}

// The slowest lowest foot touches, at its own height, and with it any as low that hardly moves
// faster: who glides on two feet stands on both. False if it is too high to carry.
static bool support(const DpGait* gait, int walker, int t, const double* height,
                    const double* speed, const double* clearance, const DpContactLimits* limits,
                    double highest, uint8_t* on)
{
    double cheapest = INFINITY, lowest = 0.0, pace = 0.0;
    int    limb = -1;
    for (int k = 0; k < gait->points; ++k) {
        const size_t at = (size_t)k * (size_t)gait->times + (size_t)t;
        if (gait->limb_walker[limb_of(gait, k)] != walker || isnan(height[at])) continue;
        const double d = height[at] - clearance[k];
        const double cost = speed[at] + RISE_TO_SPEED * d;
        if (cost < cheapest) cheapest = cost, lowest = d, pace = speed[at], limb = limb_of(gait, k);
    }
    if (limb < 0 || lowest > highest) return false;
    for (int k = 0; k < gait->points; ++k) {
        const size_t at = (size_t)k * (size_t)gait->times + (size_t)t;
        if (gait->limb_walker[limb_of(gait, k)] != walker || isnan(height[at])) continue;
        if (limb_of(gait, k) != limb && !(speed[at] < pace + limits->slow_speed)) continue;
        if (height[at] - clearance[k] <= lowest + limits->touch_height) on[at] = 1;
    }
    return true;
}

// Who is carried at one sample is so at those beside it, though his feet be a little higher there: a
// stance on a box as high as feet may be does not come and go with the noise of the recording.
static void support_all(const DpGait* gait, int walker, int first, int end, const double* height,
                        const double* speed, const double* clearance, const DpContactLimits* limits,
                        uint8_t* on)
{
    bool held = false;
    for (int t = first; t < end; ++t)
        held = support(gait, walker, t, height, speed, clearance, limits,
                       HIGHEST + (held ? limits->touch_height : 0.0), on);
    for (int t = end - 1; t >= first; --t)
        held = support(gait, walker, t, height, speed, clearance, limits,
                       HIGHEST + (held ? limits->touch_height : 0.0), on);
}

static double mean(const double* value, int first, int end)
{
    double sum = 0.0;
    for (int t = first; t < end; ++t) sum += value[t];
    return end > first ? sum / (double)(end - first) : -INFINITY;
}

// one limb of one part, with neither ball nor tip: a crate, a ball, a wheel
static bool is_rigid(const DpGait* gait, int walker)
{
    int limbs = 0, parts = 0;
    for (int l = 0; l < gait->limbs; ++l) limbs += gait->limb_walker[l] == walker;
    for (int p = 0; p < gait->parts; ++p) parts += gait->limb_walker[gait->part_limb[p]] == walker;
    bool foot = false;
    for (int k = 0; k < gait->points; ++k)
        foot = foot || (gait->limb_walker[limb_of(gait, k)] == walker &&
                        gait->point_role[k] != DP_POINT_HEEL);
    return limbs == 1 && parts == 1 && !foot;
}

void dp_walker_support(const DpGait* gait, int walker, const double* height, const double* speed,
                       const double* clearance, const double* fall, const DpContactLimits* limits,
                       double rate, uint8_t* on)
{
    const int    times = gait->times;
    const double floats = -limits->support_fall * DP_GRAVITY;
    if (is_rigid(gait, walker)) return;
    for (int t = 0; t < times;) {
        int end = t;
        while (end < times && fall[end] > floats && !carried(gait, walker, on, end)) ++end;
        if ((double)(end - t) >= SHORTEST * rate)
            support_all(gait, walker, t, end, height, speed, clearance, limits, on);
        t = end > t ? end : t + 1;
    }
    // at the clip's ends even a short gap hides a foot: the rest of its stance lies outside
    int first = 0, last = times;
    while (first < times && !carried(gait, walker, on, first)) ++first;
    while (last > first && !carried(gait, walker, on, last - 1)) --last;
    if (first < times && (double)first < SHORTEST * rate && mean(fall, 0, first) > floats)
        support_all(gait, walker, 0, first, height, speed, clearance, limits, on);
    if (last > first && (double)(times - last) < SHORTEST * rate &&
        mean(fall, last, times) > floats)
        support_all(gait, walker, last, times, height, speed, clearance, limits, on);
}
