// walker/foot_bounce.c - when a foot leaves the ground, told by the flight that follows.
//
// From one flight to the next the ground turns the body's momentum round. Flights are parabolas, and
// with them the sum of the force between, its middle and its spread in time are known, however few
// frames show the stance: a smoothing as flat as dp_walker_fly's moves none of the three. Where frames
// are far apart that tells the end of a bounce better than the foot, which is seen once before it
// left and once after. A bounce is half a sine in time (Alexander 1989; Morin et al. 2005 find
// contact times and forces of runs from it): it ends 2.3 of its spread after its middle.
//
// Departures
//   TRAIL (4): a contact that a flight follows ends where momentum says, within the half frame to
//   which the foot tells it. test_foot_bounce.c, momentum_ends_a_bounce.
#include <math.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define CUTOFF 10.0       // smooths a stance; its sum, middle and spread do not feel it     [Hz]
#define UNSURE 0.01       // flights are free of force so far from their edges              [s]
#define LAST 0.1          // what a contact carried in the end is seen over this              [s]
#define HALF_SINE 2.2975  // half of its length over its spread: 1 / 2 / sqrt(1/4 - 2/pi^2)  [-]

static bool is_mine(const DpGait* gait, int walker, int point)
{
    return gait->limb_walker[gait->part_limb[gait->point_part[point]]] == walker;
}

static void find_air(const DpGait* gait, int walker, const uint8_t* on, uint8_t* air)
{
    for (int t = 0; t < gait->times; ++t) air[t] = 1;
    for (int k = 0; k < gait->points; ++k)
        for (int t = 0; t < gait->times && is_mine(gait, walker, k); ++t)
            if (on[(size_t)k * (size_t)gait->times + (size_t)t]) air[t] = 0;
}

// last sample before t, or first from t on, that is of another kind than `kind`; -1 or times
static int back_over(const uint8_t* air, int t, uint8_t kind)
{
    while (t >= 0 && air[t] == kind) --t;
    return t;
}

static int ahead_over(const uint8_t* air, int times, int t, uint8_t kind)
{
    while (t < times && air[t] == kind) ++t;
    return t;
}

// of each flight what is surely one: all but a little at its edges, its middle at least
static void keep_sure(uint8_t* air, int times, int unsure)
{
    for (int t = 0; t < times;) {
        const int end = ahead_over(air, times, t, air[t]);
        if (air[t]) {
            const int middle = (t + end) / 2;
            for (int k = t; k < end; ++k)
                air[k] = k == middle ||
                         ((t == 0 || k >= t + unsure) && (end == times || k < end - unsure));
        }
        t = end;
    }
}

static double pull(const double* height, int times, int t, double rate)
{
    return dp_walker_acceleration(height, times, t, rate) + DP_GRAVITY;
}

static bool flies(const double* height, int times, int t, double rate)
{
    return pull(height, times, t, rate) < 0.5 * DP_GRAVITY;
}

// half of the most that was carried in the last tenth of a second of a contact
static double held(const double* height, int times, int end, double rate)
{
    double carried = 0.0;
    for (int t = end - 1; t >= 0 && (double)(end - t) < LAST * rate; --t)
        carried = fmax(carried, pull(height, times, t, rate));
    return 0.5 * carried;
}

// the time at which the bounce between two samples inside flights ends [samples]; NaN if it is none
static double bounce_end(const double* height, int times, int first, int last, double rate)
{
    double sum = 0.0, middle = 0.0, square = 0.0;
    for (int t = first; t <= last; ++t) {
        const double now = pull(height, times, t, rate), at = (double)(t - first);
        sum += now, middle += now * at, square += now * at * at;
    }
    middle /= sum;
    const double spread = square / sum - middle * middle;
    return sum > 0.0 && spread > 0.0 ? first + middle + HALF_SINE * sqrt(spread) : NAN;
}

// the walker's points that touch at sample `end - 1` touch until `moved`; none touches after it
static void move_end(const DpGait* gait, int walker, int end, int moved, uint8_t* on)
{
    for (int k = 0; k < gait->points; ++k) {
        uint8_t* row = on + (size_t)k * (size_t)gait->times;
        if (!is_mine(gait, walker, k) || !row[end - 1]) continue;
        for (int t = end; t < moved; ++t) row[t] = 1;
        for (int t = moved; t < end; ++t) row[t] = 0;
    }
}

void dp_walker_bounces(const DpGait* gait, int walker, double frame, double rate, uint8_t* on,
                       uint8_t* air, double* height, double* scratch)
{
    const int    times = gait->times;
    const double half = 0.5 * frame * rate;
    for (int t = 0; t < times; ++t) height[t] = dp_walker_com(gait, walker, t).z;
    find_air(gait, walker, on, air);
    if (!dp_walker_falls(air, height, times, rate)) return;
    keep_sure(air, times, (int)(UNSURE * rate));
    dp_walker_fly(height, air, times, rate, CUTOFF, -DP_GRAVITY, scratch);
    find_air(gait, walker, on, air);
    for (int begin = ahead_over(air, times, 0, 1); begin < times;) {
        const int end = ahead_over(air, times, begin, 0);
        const int next = ahead_over(air, times, end, 1);
        const int last = (end + next) / 2;
        int       moved = end;
        if (end < times && flies(height, times, last, rate)) {
            const int    first = (back_over(air, begin - 1, 1) + begin) / 2;
            const double by = begin > 0 && flies(height, times, first, rate)
                                  ? bounce_end(height, times, first, last, rate) + 0.5 - end
                                  : NAN;
            if (fabs(by) < 2.0 * half)  // the foot and the flight tell of the same end
                moved += (int)round(dp_clamp(by, -half, half));
            else  // no bounce: a weight that is let go at once is so when half of it is gone
                while ((double)(moved + 1 - end) <= half &&
                       pull(height, times, moved, rate) > held(height, times, end, rate))
                    ++moved;
            moved = moved <= begin ? begin + 1 : moved >= next ? next - 1 : moved;
            move_end(gait, walker, end, moved, on);
        }
        begin = next;
    }
}
