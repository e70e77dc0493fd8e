// walker/foot_support.c - somebody carries what does not fall.
//
// Departures
//   TRAIL (4): a body that nobody carries falls; where it does not, the foot that is lowest and
//   slowest touches at its own height, as on a block that the ground does not show. Feet farther up
//   hang from something else, a chair, a rope or wings, and press nothing. test_foot_contact.c,
//   somebody_carries_what_does_not_fall, who_glides_stands_on_both_feet, who_hangs_presses_nothing.
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

// the slowest lowest foot touches, at its own height, and with it any as low that hardly moves
// faster: who glides on two feet stands on both
static void support(const DpGait* gait, int walker, int t, const double* height,
                    const double* speed, const double* clearance, const DpContactLimits* limits,
                    uint8_t* on)
{
    double least = INFINITY, lowest = 0.0, pace = 0.0;
    int    limb = -1;
    for (int k = 0; k < gait->points; ++k) {
        const size_t at = (size_t)k * (size_t)gait->times + (size_t)t;
        if (gait->limb_walker[limb_of(gait, k)] != walker || isnan(height[at])) continue;
        const double d = height[at] - clearance[k];
        const double cost = speed[at] + RISE_TO_SPEED * d;
        if (cost < least) least = cost, lowest = d, pace = speed[at], limb = limb_of(gait, k);
    }
    if (lowest > HIGHEST) return;
    for (int k = 0; k < gait->points && limb >= 0; ++k) {
        const size_t at = (size_t)k * (size_t)gait->times + (size_t)t;
        if (gait->limb_walker[limb_of(gait, k)] != walker || isnan(height[at])) continue;
        if (limb_of(gait, k) != limb && !(speed[at] < pace + limits->slow_speed)) continue;
        if (height[at] - clearance[k] <= lowest + limits->touch_height) on[at] = 1;
    }
}

static double mean(const double* value, int first, int end)
{
    double sum = 0.0;
    for (int t = first; t < end; ++t) sum += value[t];
    return end > first ? sum / (double)(end - first) : -INFINITY;
}

void walker_support(const DpGait* gait, int walker, const double* height, const double* speed,
                    const double* clearance, const double* fall, const DpContactLimits* limits,
                    double rate, uint8_t* on)
{
    const int    times = gait->times;
    const double floats = -limits->support_fall * DP_GRAVITY;
    for (int t = 0; t < times;) {
        int end = t;
        while (end < times && fall[end] > floats && !carried(gait, walker, on, end)) ++end;
        if ((double)(end - t) >= SHORTEST * rate)
            for (int s = t; s < end; ++s)
                support(gait, walker, s, height, speed, clearance, limits, on);
        t = end > t ? end : t + 1;
    }
    // at the clip's ends even a short gap hides a foot: the rest of its stance lies outside
    int first = 0, last = times;
    while (first < times && !carried(gait, walker, on, first)) ++first;
    while (last > first && !carried(gait, walker, on, last - 1)) --last;
    if (first < times && (double)first < SHORTEST * rate && mean(fall, 0, first) > floats)
        for (int s = 0; s < first; ++s)
            support(gait, walker, s, height, speed, clearance, limits, on);
    if (last > first && (double)(times - last) < SHORTEST * rate &&
        mean(fall, last, times) > floats)
        for (int s = last; s < times; ++s)
            support(gait, walker, s, height, speed, clearance, limits, on);
}
