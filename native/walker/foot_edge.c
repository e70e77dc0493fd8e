// walker/foot_edge.c - the moment a contact begins, and the moment it ends. TRAIL (4).
//
// Limits on height and speed tell that a foot stands and that it swings; between the two lie some
// hundredths of a second. The ground itself marks the moments: it stops a foot that comes down, so
// that its fall is fastest as it arrives, and it lets a foot go that is being pulled up and ahead, so
// that the ball is lifted and sped up hardest as it leaves (Hreljac and Marshall 2000 time both by
// the peaks of the foot's acceleration; O'Connor et al. 2007 by its vertical velocity).
//
// Speeds are low-passed, which turns a sudden stop into a slope of at least a quarter of the
// cut-off's period to either side and moves the fastest fall ahead of the stop. Lengths of slopes
// that follow upon each other add as squares: what the filter added is taken out again where a foot
// comes down from a flight and is stopped with the whole body. test_foot_contact_fall.c,
// a_sudden_stop_out_of_a_flight_is_timed.
#include <math.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define EDGE 0.1     // the limits are no farther than this from the moment meant [s]
#define FLIGHT 0.05  // who touched nothing so long before comes from a flight      [s]
#define HOVER 0.01   // what rests does so within this of its clearance              [m]

// The time from the fastest fall to the beginning of the stop that a low-pass made of it [samples]:
// none for a stop much slower than the filter, a quarter of its period for a sudden one.
static int smeared(const double* rise, int times, int fastest, double rate, double cutoff)
{
    const double half = 0.5 * rise[fastest], filter = 0.25 * rate / cutoff;
    int          k = fastest + 1;
    while (k < times && rise[k] < half && (double)(k - fastest) < EDGE * rate) ++k;
    if (k >= times || !(rise[k] >= half)) return 0;
    const double slope = (double)(k - fastest) - (rise[k] - half) / (rise[k] - rise[k - 1]);
    return (int)(slope - sqrt(fmax(slope * slope - filter * filter, 0.0)) + 0.5);
}

// A point that touches while it still comes down does so when its fall is fastest.
// @param height, rise  over the ground [m] and upward speed [m/s] (times)
// @param flown         where the walker was in the air until then (times)
// @param cutoff        of the low-pass through which rise has gone [Hz]
static void arrive(uint8_t* on, const double* height, double clearance, const double* rise,
                   const uint8_t* flown, int times, double rate, double moves, double fast,
                   double cutoff)
{
    for (int t = 0; t < times; ++t) {
        if (!on[t] || (t > 0 && on[t - 1]) || (t == 0 && rise[t] > -moves)) continue;
        int fastest = t;
        for (int k = t; k < times && on[k] && rise[k] < 0.0 && (double)(k - t) < EDGE * rate; ++k) {
            if (rise[k] < rise[fastest]) fastest = k;
            if (height[k] < clearance) break;  // who is down has come down
        }
        const int timed = fastest;
        // what comes down faster than its stop can be timed is timed by its height
        // and so is what falls out of a flight, whose toes may be slowed by the foot that lifts them
        while (fastest + 1 < times && on[fastest + 1] &&
               -rise[fastest] > (flown[t] ? moves : fast) && height[fastest] > clearance + HOVER)
            ++fastest;
        if (flown[t] && rise[timed] < 0.0) {
            const int stop = timed + smeared(rise, times, timed, rate, cutoff);
            while (fastest < stop && on[fastest + 1] && height[fastest] > clearance) ++fastest;
        }
        for (; t < fastest; ++t) on[t] = 0;
    }
}

// Mean of a row of each point at a sample, or of its growth, over a limb's balls; over all its points
// if it has none.
static double of_balls(const DpGait* gait, int limb, const double* rows, int t, double rate,
                       bool growth)
{
    double sum[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
    for (int k = 0; k < gait->points; ++k) {
        if (gait->part_limb[gait->point_part[k]] != limb) continue;
        const int     ball = gait->point_role[k] == DP_POINT_BALL;
        const double* row = rows + (size_t)k * (size_t)gait->times;
        sum[ball] += growth ? dp_walker_velocity(row, gait->times, t, rate) : row[t];
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

static bool is_slow_contact(const DpGait* gait, int limb, const double* speed, double moves,
                            const uint8_t* on, int t)
{
    for (int k = 0; k < gait->points; ++k) {
        const size_t at = (size_t)k * (size_t)gait->times + (size_t)t;
        if (gait->part_limb[gait->point_part[k]] == limb && on[at] && speed[at] < moves)
            return true;
    }
    return false;
}

// A limb that has let go did so when its ball was lifted and sped up hardest.
static void leave(const DpGait* gait, int limb, const double* rise, const double* speed,
                  uint8_t* on, double rate, double moves)
{
    const int times = gait->times, within = (int)(EDGE * rate);
    for (int t = 1; t <= times; ++t) {
        if (!limb_on(gait, limb, on, t - 1)) continue;
        // a clip that ends while the ball is pulled up ends after the contact
        if (t == times ? of_balls(gait, limb, rise, t - 1, rate, false) < moves
                       : limb_on(gait, limb, on, t))
            continue;
        int    hardest = t;
        double most = 0.0;
        for (int k = t < times ? t : times - 1;
             k > 0 && t - k < within && limb_on(gait, limb, on, k - 1); --k) {
            const double now = of_balls(gait, limb, rise, k, rate, true) +
                               of_balls(gait, limb, speed, k, rate, true);
            if (now > most) most = now, hardest = k;
        }
        // no limb has left while a point of it still rests
        for (int s = hardest; s < t; ++s)
            if (is_slow_contact(gait, limb, speed, moves, on, s)) hardest = s + 1;
        for (int k = 0; k < gait->points; ++k) {
            if (gait->part_limb[gait->point_part[k]] != limb) continue;
            uint8_t* row = on + (size_t)k * (size_t)times;
            for (int s = hardest; s < t; ++s) row[s] = 0;
        }
    }
}

// where no limb of a walker touched shortly before
static void find_flown(const DpGait* gait, int walker, const uint8_t* on, double rate,
                       uint8_t* flown)
{
    const int before = (int)(FLIGHT * rate);
    for (int t = 0; t < gait->times; ++t) flown[t] = t >= before;
    for (int k = 0; k < gait->points; ++k) {
        if (gait->limb_walker[gait->part_limb[gait->point_part[k]]] != walker) continue;
        const uint8_t* row = on + (size_t)k * (size_t)gait->times;
        for (int t = before; t < gait->times; ++t) flown[t] = flown[t] && !row[t - before];
    }
}

void dp_walker_edges(const DpGait* gait, const double* height, const double* clearance,
                     const double* rise, const double* speed, double moves, double fast,
                     double cutoff, uint8_t* on, uint8_t* flown, double rate)
{
    for (int walker = 0; walker < gait->walkers; ++walker)
        find_flown(gait, walker, on, rate, flown + (size_t)walker * (size_t)gait->times);
    for (int k = 0; k < gait->points; ++k) {
        const size_t row = (size_t)k * (size_t)gait->times;
        const int    walker = gait->limb_walker[gait->part_limb[gait->point_part[k]]];
        arrive(on + row, height + row, clearance[k], rise + row,
               flown + (size_t)walker * (size_t)gait->times, gait->times, rate, moves, fast,
               cutoff);
    }
    for (int limb = 0; limb < gait->limbs; ++limb) leave(gait, limb, rise, speed, on, rate, moves);
}
