// walker/foot_edge.c - the moment a contact begins, and the moment it ends. TRAIL (4).
//
// Limits on height and speed tell that a foot stands and that it swings; between the two lie some
// hundredths of a second. The ground itself marks the moments: it stops a foot that comes down, so
// that its fall is fastest as it arrives, and it lets a foot go that is being pulled up, so that
// the ball is lifted hardest as it leaves (Hreljac and Marshall 2000 time both by the peaks of the
// foot's acceleration; O'Connor et al. 2007 by its vertical velocity).
#include <math.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define EDGE 0.1    // the limits are no farther than this from the moment meant [s]
#define HOVER 0.01  // what rests does so within this of its clearance              [m]

// A point that touches while it still comes down does so when its fall is fastest.
// @param height, rise  over the ground [m] and upward speed [m/s] (times)
static void arrive(uint8_t* on, const double* height, double clearance, const double* rise,
                   int times, double rate, double moves, double fast)
{
    for (int t = 0; t < times; ++t) {
        if (!on[t] || (t > 0 && on[t - 1]) || (t == 0 && rise[t] > -moves)) continue;
        int fastest = t;
        for (int k = t; k < times && on[k] && rise[k] < 0.0 && (double)(k - t) < EDGE * rate; ++k) {
            if (rise[k] < rise[fastest]) fastest = k;
            if (height[k] < clearance) break;  // who is down has come down
        }
        // what comes down faster than its stop can be timed is timed by its height
        while (fastest + 1 < times && on[fastest + 1] && -rise[fastest] > fast &&
               height[fastest] > clearance + HOVER)
            ++fastest;
        for (; t < fastest; ++t) on[t] = 0;
    }
}

// Mean upward speed, or acceleration, of a limb's balls; of all its points if it has none.
static double lift(const DpGait* gait, int limb, const double* rise, int t, double rate, bool speed)
{
    double sum[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
    for (int k = 0; k < gait->points; ++k) {
        if (gait->part_limb[gait->point_part[k]] != limb) continue;
        const int     ball = gait->point_role[k] == DP_POINT_BALL;
        const double* row = rise + (size_t)k * (size_t)gait->times;
        sum[ball] += speed ? row[t] : walker_velocity(row, gait->times, t, rate);
        count[ball] += 1.0;
    }
    const int ball = count[1] > 0.0;
    return sum[ball] / fmax(count[ball], 1.0);
}

static bool limb_on(const DpGait* gait, int limb, const uint8_t* on, int t)
{
    for (int k = 0; k < gait->points; ++k)
        if (gait->part_limb[gait->point_part[k]] == limb &&
            on[(size_t)k * (size_t)gait->times + (size_t)t])
            return true;
    return false;
}

static bool rests(const DpGait* gait, int limb, const double* speed, double moves,
                  const uint8_t* on, int t)
{
    for (int k = 0; k < gait->points; ++k) {
        const size_t at = (size_t)k * (size_t)gait->times + (size_t)t;
        if (gait->part_limb[gait->point_part[k]] == limb && on[at] && speed[at] < moves)
            return true;
    }
    return false;
}

// A limb that has let go did so when its ball was lifted hardest.
static void leave(const DpGait* gait, int limb, const double* rise, const double* speed,
                  uint8_t* on, double rate, double moves)
{
    const int times = gait->times, reach = (int)(EDGE * rate);
    for (int t = 1; t <= times; ++t) {
        if (!limb_on(gait, limb, on, t - 1)) continue;
        // a clip that ends while the ball is pulled up ends after the contact
        if (t == times ? lift(gait, limb, rise, t - 1, rate, true) < moves
                       : limb_on(gait, limb, on, t))
            continue;
        int    hardest = t;
        double most = 0.0;
        for (int k = t < times ? t : times - 1;
             k > 0 && t - k < reach && limb_on(gait, limb, on, k - 1); --k) {
            const double now = lift(gait, limb, rise, k, rate, false);
            if (now > most) most = now, hardest = k;
        }
        // no limb has left while a point of it still rests
        for (int s = hardest; s < t; ++s)
            if (rests(gait, limb, speed, moves, on, s)) hardest = s + 1;
        for (int k = 0; k < gait->points; ++k) {
            if (gait->part_limb[gait->point_part[k]] != limb) continue;
            uint8_t* row = on + (size_t)k * (size_t)times;
            for (int s = hardest; s < t; ++s) row[s] = 0;
        }
    }
}

void walker_edges(const DpGait* gait, const double* height, const double* clearance,
                  const double* rise, const double* speed, double moves, double fast, uint8_t* on,
                  double rate)
{
    for (int k = 0; k < gait->points; ++k) {
        const size_t row = (size_t)k * (size_t)gait->times;
        arrive(on + row, height + row, clearance[k], rise + row, gait->times, rate, moves, fast);
    }
    for (int limb = 0; limb < gait->limbs; ++limb) leave(gait, limb, rise, speed, on, rate, moves);
}
