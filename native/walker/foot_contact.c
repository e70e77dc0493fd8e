// walker/foot_contact.c - which part touches the ground when. TRAIL (4), MODEL 4.2
//
//   heights, speeds ---dp_watch_clearance---> clearance ---hysteresis---> touching ---support---> touching
//
// Departures
//   TRAIL (4): a point touches below a height and a speed, and lets go above others, each over the
//   clip's own resting clearance; one fixed height loses most contacts of real recordings.
//   test_foot_contact.c, hovering_clip_touches.
//   TRAIL (4): what comes down steeper than 45 degrees touches at any speed; falls and landings
//   would begin after their impact otherwise. test_foot_contact_fall.c, falling_ball_touches_in_time.
//   TRAIL (4): limits tell that a foot stands, not since when; foot_edge.c moves the edges.
//   test_foot_contact.c, the_ground_marks_the_edges.
//   TRAIL (4): every point has a speed of its own, so "both touch" needs no case of its own.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "walker/foot_watch.h"

static void touch_point(DpWatch* w, int k, double clearance)
{
    const DpContactLimits* limits = w->limits;
    const int              times = w->gait->times;
    const double*          height = w->height + (size_t)k * (size_t)times;
    const double*          speed = w->speed + (size_t)k * (size_t)times;
    const double*          drop = w->drop + (size_t)k * (size_t)times;
    const double*          gate = w->gate + (size_t)dp_watch_owner(w->gait, k) * (size_t)times;
    uint8_t*               on = w->on + (size_t)k * (size_t)times;
    const double release = w->gait->point_role[k] == DP_POINT_HEEL ? limits->release_height
                                                                   : limits->release_height_toe;
    bool         touches = false, came_to_rest = false;
    for (int t = 0; t < times; ++t) {
        const double d = height[t] - clearance;  // TRAIL (4)
        if (!touches) {
            // what drops steeply onto the ground will not be held up by its speed
            touches = d < limits->touch_height && (speed[t] < gate[t] || drop[t] > 0.0);
            came_to_rest = false;
        }
        // a foot that lands fast lets go by speed only once it has been slower
        if (speed[t] <= limits->release_speed) came_to_rest = true;
        if (touches && (!(d <= release) || (came_to_rest && speed[t] > limits->release_speed)))
            touches = false;
        on[t] = touches;
    }
}

// close runs of `value` that are shorter than `shortest` samples and have something on both sides
static void close_runs(uint8_t* on, int times, uint8_t value, double shortest)
{
    for (int t = 0; t < times;) {
        int end = t;
        while (end < times && on[end] == on[t]) ++end;
        if (on[t] == value && t > 0 && end < times && (double)(end - t) < shortest)
            memset(on + t, !value, (size_t)(end - t));
        t = end;
    }
}

static void tidy(uint8_t* on, int times, double shortest)
{
    close_runs(on, times, 0, shortest);  // gaps first, so that a broken stance is whole
    close_runs(on, times, 1, shortest);
}

DpStatus dp_foot_contact(const DpGait* gait, const double* ground, const DpContactLimits* limits,
                         uint8_t* touching, double* clearance)
{
    if (!dp_walker_gait_ok(gait) || !ground || dp_contact_limits_check(limits, NULL) != DP_OK ||
        !touching || !clearance)
        return DP_BAD_ARGUMENT;
    DpWatch w = {.gait = gait, .limits = limits, .rate = dp_walker_rate(gait)};
    if (gait->times > 1 && w.rate <= 0.0) return DP_BAD_ARGUMENT;
    if (gait->times == 1) w.rate = 1.0;
    if (!dp_watch_open(&w)) {
        dp_watch_close(&w);
        return DP_NO_MEMORY;
    }
    const int    times = gait->times;
    const double shortest = limits->shortest * w.rate - 1e-6;
    DpStatus     status = DP_OK;
    for (int walker = 0; walker < gait->walkers && status == DP_OK; ++walker)
        status = dp_watch_belt(&w, walker, ground);
    for (int k = 0; k < gait->points; ++k) dp_watch_point(&w, k, ground);
    for (int walker = 0; walker < gait->walkers && status == DP_OK; ++walker) {
        dp_watch_walker(&w, walker);
        status = dp_walker_level_floor(gait, walker, w.height, w.speed, limits->slow_speed, w.rate);
    }
    if (status != DP_OK) {
        dp_watch_close(&w);
        return status;
    }
    dp_watch_clearance(&w, clearance);
    for (int k = 0; k < gait->points; ++k) {
        touch_point(&w, k, clearance[k]);
        tidy(w.on + (size_t)k * (size_t)times, times, shortest);
    }
    dp_walker_edges(gait, w.height, clearance, w.rise, w.speed, limits->slow_speed,
                    limits->release_speed, limits->point_cutoff, w.on, w.flown, w.rate);
    for (int k = 0; k < gait->points; ++k) tidy(w.on + (size_t)k * (size_t)times, times, shortest);
    for (int walker = 0; walker < gait->walkers; ++walker)
        dp_walker_support(gait, walker, w.height, w.speed, clearance,
                          w.fall + (size_t)walker * (size_t)times, limits, w.rate, w.on);
    for (int walker = 0; walker < gait->walkers; ++walker)
        dp_walker_bounces(gait, walker, limits->frame_time, w.rate, w.on, w.flown, w.line,
                          w.scratch);
    memset(touching, 0, (size_t)gait->parts * (size_t)times);
    for (int k = 0; k < gait->points; ++k) {
        uint8_t*       part = touching + (size_t)gait->point_part[k] * (size_t)times;
        const uint8_t* on = w.on + (size_t)k * (size_t)times;
        for (int t = 0; t < times; ++t) part[t] |= on[t];
    }
    for (int p = 0; p < gait->parts; ++p)
        tidy(touching + (size_t)p * (size_t)times, times, shortest);
    dp_watch_close(&w);
    return DP_OK;
}
