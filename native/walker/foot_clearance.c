// walker/foot_clearance.c - a clip's own resting clearance. TRAIL (4).
//
// Departures
//   TRAIL (4): the clearance is that of stays, not of samples: a pose that is held for long is one.
//   test_foot_contact.c, a_long_stay_is_one_stay.
#include <math.h>
#include <stdlib.h>

#include "base/vec.h"
#include "walker/foot_watch.h"

#define MAX_CLEARANCE 0.08  // a foot at rest this far above the lowest one hangs in the air [m]
#define STAY 0.2            // longer stays of a foot tell no more of its height than this  [s]

static int by_height(const void* a, const void* b)
{
    const double x = ((const DpVote*)a)->height, y = ((const DpVote*)b)->height;
    return (x > y) - (x < y);
}

// Heights at which a point rests, each stay counting as much as any other, however long it was.
static int gather_votes(const DpWatch* w, int k, const double* gate, DpVote* vote)
{
    const int     times = w->gait->times;
    const double* height = w->height + (size_t)k * (size_t)times;
    const double* speed = w->speed + (size_t)k * (size_t)times;
    int           count = 0;
    for (int t = 0; t < times;) {
        int end = t;
        for (; end < times && !isnan(height[end]) &&
               speed[end] < (gate ? gate[end] : w->limits->slow_speed);
             ++end)
            vote[count + end - t].height = height[end];
        const double weight = fmin(1.0, STAY * w->rate / (double)(end - t));
        for (; t < end; ++t) vote[count++].weight = weight;
        ++t;
    }
    qsort(vote, (size_t)count, sizeof *vote, by_height);
    return count;
}

// median of the lowest band of heights at slow samples; NaN if the point is never slow
static double resting_height(const DpWatch* w, int k, const double* gate)
{
    DpVote*   vote = w->vote;
    const int count = gather_votes(w, k, gate, vote);
    double    sum = 0.0, below = 0.0;
    if (count == 0) return NAN;
    for (int n = 0; n < count; ++n) sum += vote[n].weight;
    int lowest = 0, middle = 0;
    for (double s = vote[0].weight; lowest < count - 1 && s <= 0.05 * sum;)
        s += vote[++lowest].weight;
    for (int n = 0; n < count; ++n)
        if (vote[n].height <= vote[lowest].height + w->limits->touch_height)
            below += vote[n].weight;
    for (double s = vote[0].weight; middle < count - 1 && s <= 0.5 * below;)
        s += vote[++middle].weight;
    return vote[middle].height;
}

// the lowest a walker's points rest; if none ever does, the lowest they go
static double lowest_rest(const DpWatch* w, const double* clearance, int walker)
{
    const DpGait* gait = w->gait;
    double        resting = INFINITY, low = INFINITY;
    for (int k = 0; k < gait->points; ++k) {
        if (dp_watch_owner(gait, k) != walker) continue;
        resting = fmin(resting, clearance[k]);  // fmin passes over NaN
        const double* height = w->height + (size_t)k * (size_t)gait->times;
        for (int t = 0; t < gait->times; ++t) low = fmin(low, height[t]);
    }
    return isfinite(resting) ? resting : isfinite(low) ? low : 0.0;
}

void dp_watch_clearance(const DpWatch* w, double* clearance)
{
    const DpGait* gait = w->gait;
    for (int k = 0; k < gait->points; ++k) {
        clearance[k] = resting_height(w, k, NULL);
        if (isnan(clearance[k]))  // never slow: the samples at which it might land
            clearance[k] = resting_height(
                w, k, w->gate + (size_t)dp_watch_owner(gait, k) * (size_t)gait->times);
    }
    // a foot held up in the air, or one that never rests, hovers as its lowest fellow does
    for (int walker = 0; walker < gait->walkers; ++walker) {
        const double lowest = lowest_rest(w, clearance, walker);
        for (int k = 0; k < gait->points; ++k)
            if (dp_watch_owner(gait, k) == walker && !(clearance[k] <= lowest + MAX_CLEARANCE))
                clearance[k] = lowest;
    }
}
