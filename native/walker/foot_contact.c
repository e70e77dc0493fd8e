// walker/foot_contact.c - which part touches the ground when. TRAIL (4).
//
//   heights, speeds ---calibrate---> clearance ---hysteresis---> touching ---support---> touching
//
// Departures
//   TRAIL (4): a point touches below a height and a speed, and lets go above others, each over the
//   clip's own resting clearance; one fixed height loses most contacts of real recordings.
//   test_foot_contact.c, hovering_clip_touches.
//   TRAIL (4): what comes down steeper than 45 degrees touches at any speed; falls and landings
//   would begin after their impact otherwise. test_foot_contact.c, falling_ball_touches_in_time.
//   TRAIL (4): limits tell that a foot stands, not since when; foot_edge.c moves the edges.
//   test_foot_contact.c, the_ground_marks_the_edges.
//   TRAIL (4): the clearance is that of stays, not of samples: a pose that is held for long is one.
//   test_foot_contact.c, a_long_stay_is_one_stay.
//   TRAIL (4): every point has a speed of its own, so "both touch" needs no case of its own.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "walker/walker_inside.h"

#define SUPPORT_CUTOFF 8.0   // low-pass of a_com for the question whether it falls        [Hz]
#define CLEARANCE_MOST 0.08  // a foot at rest this far above the lowest one hangs in the air [m]
#define STAY 0.2             // longer stays of a foot tell no more of its height than this  [s]
#define IN_PLACE 0.4         // feet of a walker that stays slide at least this fast     [m/s]

DpContactLimits dp_contact_limits_default(void)
{
    const DpContactLimits limits = {.touch_height = 0.03,
                                    .release_height = 0.03,
                                    .release_height_toe = 0.05,
                                    .touch_speed = 0.3,
                                    .touch_speed_share = 0.4,
                                    .release_speed = 1.2,
                                    .slow_speed = 0.25,
                                    .shortest = 0.03,
                                    .point_cutoff = 20.0,
                                    .com_cutoff = 3.0,
                                    .support_fall = 0.5,
                                    .frame_time = 0.0};
    return limits;
}

// where a point was, and how much that counts
typedef struct Vote
{
    double height, weight;
} Vote;

// what is known of the points and walkers over the clip
typedef struct Watch
{
    const DpGait*          gait;
    const DpContactLimits* limits;
    double                 rate;
    double*                height;   // over the ground; NaN = no ground [m]   (K, T)
    double*                speed;    // [m/s]                                  (K, T)
    double*                drop;     // downward speed over sideways speed [m/s]  (K, T)
    double*                rise;     // upward speed [m/s]                     (K, T)
    DpVec3*                belt;     // the surface under a walker that stays in place [m/s] (W)
    double*                gate;     // speed below which a point may touch [m/s] (W, T)
    double*                fall;     // a_com upward [m/s^2]                   (W, T)
    uint8_t*               on;       // the point touches                      (K, T)
    uint8_t*               flown;    // nothing touched shortly before         (W, T)
    double*                scratch;  // for the low-pass
    double*                line;     // three signals                          (3, T)
    Vote*                  vote;     // heights of one point                   (T)
} Watch;

static void close_watch(Watch* w)
{
    dp_free(w->height), dp_free(w->speed), dp_free(w->drop), dp_free(w->rise), dp_free(w->gate),
        dp_free(w->fall);
    dp_free(w->belt);
    dp_free(w->on), dp_free(w->flown), dp_free(w->scratch), dp_free(w->line), dp_free(w->vote);
}

static bool open_watch(Watch* w)
{
    const size_t times = (size_t)w->gait->times, points = (size_t)w->gait->points;
    const size_t walkers = (size_t)w->gait->walkers;
    w->height = dp_alloc(points * times, sizeof(double));
    w->speed = dp_alloc(points * times, sizeof(double));
    w->drop = dp_alloc(points * times, sizeof(double));
    w->rise = dp_alloc(points * times, sizeof(double));
    w->belt = dp_alloc(walkers, sizeof(DpVec3));
    w->gate = dp_alloc(walkers * times, sizeof(double));
    w->fall = dp_alloc(walkers * times, sizeof(double));
    w->on = dp_alloc(points * times, 1);
    w->flown = dp_alloc(walkers * times, 1);
    w->scratch = dp_alloc(walker_fly_scratch(w->gait->times) + 8, sizeof(double));
    w->line = dp_alloc(3 * times, sizeof(double));
    w->vote = dp_alloc(times, sizeof(Vote));
    return w->height && w->speed && w->drop && w->rise && w->belt && w->gate && w->fall && w->on &&
           w->flown && w->scratch && w->line && w->vote;
}

static int limb_of(const DpGait* gait, int point)
{
    return gait->part_limb[gait->point_part[point]];
}

static int walker_of(const DpGait* gait, int point)
{
    return gait->limb_walker[limb_of(gait, point)];
}

static DpVec3 line_velocity(const Watch* w, int t)
{
    const int times = w->gait->times;
    return dp_vec3(walker_velocity(w->line, times, t, w->rate),
                   walker_velocity(w->line + times, times, t, w->rate),
                   walker_velocity(w->line + 2 * (size_t)times, times, t, w->rate));
}

static void smooth_line(const Watch* w, double cutoff)
{
    const int times = w->gait->times;
    for (int c = 0; c < 3; ++c)
        walker_low_pass(w->line + (size_t)c * (size_t)times, times, w->rate, cutoff, w->scratch);
}

// heights of a point, and its smoothed places left in the line
static void watch_places(Watch* w, int k, const double* ground)
{
    const int    times = w->gait->times;
    const size_t row = (size_t)k * (size_t)times;
    const DpVec3 point = walker_point(w->gait, k);
    for (int t = 0; t < times; ++t) {
        const DpVec3 at = dp_place(walker_pose(w->gait, w->gait->point_part[k], t), point);
        w->line[t] = at.x, w->line[t + times] = at.y, w->line[t + 2 * times] = at.z;
        w->height[row + (size_t)t] = at.z - ground[row + (size_t)t];
    }
    smooth_line(w, w->limits->point_cutoff);
}

// speeds of a point relative to the surface
static void watch_point(Watch* w, int k, const double* ground)
{
    const size_t row = (size_t)k * (size_t)w->gait->times;
    watch_places(w, k, ground);
    for (int t = 0; t < w->gait->times; ++t) {
        const DpVec3 v = dp_sub(line_velocity(w, t), w->belt[walker_of(w->gait, k)]);
        w->speed[row + (size_t)t] = dp_length(v);
        w->rise[row + (size_t)t] = v.z;
        w->drop[row + (size_t)t] = -v.z - dp_length(dp_vec3(v.x, v.y, 0.0));
    }
}

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

static double median(double* value, size_t count)
{
    qsort(value, count, sizeof *value, by_value);
    return value[count / 2];
}

// Samples at which a foot of a walker moves, and how many: while all stand, nothing tells of a belt.
static int find_steps(Watch* w, int walker, const double* ground, uint8_t* moves)
{
    const int times = w->gait->times;
    int       count = 0;
    memset(moves, 0, (size_t)times);
    for (int k = 0; k < w->gait->points; ++k) {
        if (walker_of(w->gait, k) != walker) continue;
        watch_places(w, k, ground);
        for (int t = 0; t < times; ++t)
            moves[t] |= dp_length(line_velocity(w, t)) > w->limits->slow_speed;
    }
    for (int t = 0; t < times; ++t) count += moves[t];
    return count;
}

// A walker that stays while its low feet slide walks in place: the surface moves as they do.
static DpStatus find_belt(Watch* w, int walker, const double* ground)
{
    const DpGait* gait = w->gait;
    const int     times = gait->times;
    const DpVec3  way = dp_sub(walker_com(gait, walker, times - 1), walker_com(gait, walker, 0));
    uint8_t*      moves = w->flown + (size_t)walker * (size_t)times;
    if (times < 3) return DP_OK;
    double* low = dp_alloc(3 * (size_t)gait->points * (size_t)times, sizeof(double));
    if (!low) return DP_NO_MEMORY;
    double *     x = low, *y = low + (size_t)gait->points * (size_t)times, *sorted = y + (y - x);
    size_t       count = 0;
    const double lasts = (double)find_steps(w, walker, ground, moves) / w->rate;
    for (int k = 0; k < gait->points; ++k) {
        if (walker_of(gait, k) != walker) continue;
        const double* height = w->height + (size_t)k * (size_t)times;
        size_t        n = 0;
        watch_places(w, k, ground);
        for (int t = 0; t < times; ++t)
            if (moves[t] && isfinite(height[t])) sorted[n++] = height[t];
        if (n == 0) continue;
        qsort(sorted, n, sizeof *sorted, by_value);
        const double most = sorted[n / 20] + 0.5 * w->limits->touch_height;
        for (int t = 0; t < times; ++t) {
            if (!moves[t] || !(height[t] <= most)) continue;
            const DpVec3 v = line_velocity(w, t);
            x[count] = v.x, y[count++] = v.y;
        }
    }
    if (count > 0) {
        const DpVec3 belt = dp_vec3(median(x, count), median(y, count), 0.0);
        const double speed = dp_length(belt);
        if (speed > IN_PLACE && dp_length(dp_vec3(way.x, way.y, 0.0)) < 0.25 * speed * lasts)
            w->belt[walker] = belt;
    }
    dp_free(low);
    return DP_OK;
}

static void watch_walker(Watch* w, int walker)
{
    const int times = w->gait->times;
    double*   gate = w->gate + (size_t)walker * (size_t)times;
    double*   fall = w->fall + (size_t)walker * (size_t)times;
    for (int t = 0; t < times; ++t) w->line[t] = walker_com(w->gait, walker, t).z;
    walker_low_pass(w->line, times, w->rate, SUPPORT_CUTOFF, w->scratch);
    for (int t = 0; t < times; ++t) fall[t] = walker_acceleration(w->line, times, t, w->rate);
    for (int t = 0; t < times; ++t) {
        const DpVec3 com = walker_com(w->gait, walker, t);
        w->line[t] = com.x, w->line[t + times] = com.y, w->line[t + 2 * times] = com.z;
    }
    smooth_line(w, w->limits->com_cutoff);
    for (int t = 0; t < times; ++t)
        gate[t] =
            w->limits->touch_speed +
            w->limits->touch_speed_share * dp_length(dp_sub(line_velocity(w, t), w->belt[walker]));
}

// ---- the clip's own resting clearance
// ------------------------------------------------------------

static int by_height(const void* a, const void* b)
{
    return by_value(&((const Vote*)a)->height, &((const Vote*)b)->height);
}

// Heights at which a point rests, each stay counting as much as any other, however long it was.
static int gather_votes(const Watch* w, int k, const double* gate, Vote* vote)
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
static double resting_height(const Watch* w, int k, const double* gate)
{
    Vote*     vote = w->vote;
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
static double lowest_rest(const Watch* w, const double* clearance, int walker)
{
    const DpGait* gait = w->gait;
    double        rest = INFINITY, low = INFINITY;
    for (int k = 0; k < gait->points; ++k) {
        if (walker_of(gait, k) != walker) continue;
        rest = fmin(rest, clearance[k]);  // fmin passes over NaN
        const double* height = w->height + (size_t)k * (size_t)gait->times;
        for (int t = 0; t < gait->times; ++t) low = fmin(low, height[t]);
    }
    return isfinite(rest) ? rest : isfinite(low) ? low : 0.0;
}

static void calibrate(const Watch* w, double* clearance)
{
    const DpGait* gait = w->gait;
    for (int k = 0; k < gait->points; ++k) {
        clearance[k] = resting_height(w, k, NULL);
        if (isnan(clearance[k]))  // never slow: the samples at which it might land
            clearance[k] =
                resting_height(w, k, w->gate + (size_t)walker_of(gait, k) * (size_t)gait->times);
    }
    // a foot held up in the air, or one that never rests, hovers as its lowest fellow does
    for (int walker = 0; walker < gait->walkers; ++walker) {
        const double lowest = lowest_rest(w, clearance, walker);
        for (int k = 0; k < gait->points; ++k)
            if (walker_of(gait, k) == walker && !(clearance[k] <= lowest + CLEARANCE_MOST))
                clearance[k] = lowest;
    }
}

// ---- touching and letting go
// ---------------------------------------------------------------------

static void touch_point(Watch* w, int k, double clearance)
{
    const DpContactLimits* limits = w->limits;
    const int              times = w->gait->times;
    const double*          height = w->height + (size_t)k * (size_t)times;
    const double*          speed = w->speed + (size_t)k * (size_t)times;
    const double*          drop = w->drop + (size_t)k * (size_t)times;
    const double*          gate = w->gate + (size_t)walker_of(w->gait, k) * (size_t)times;
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

// close runs of `value` that are shorter than `most` samples and have something on both sides
static void close_runs(uint8_t* on, int times, uint8_t value, double most)
{
    for (int t = 0; t < times;) {
        int end = t;
        while (end < times && on[end] == on[t]) ++end;
        if (on[t] == value && t > 0 && end < times && (double)(end - t) < most)
            memset(on + t, !value, (size_t)(end - t));
        t = end;
    }
}

static void tidy(uint8_t* on, int times, double most)
{
    close_runs(on, times, 0, most);  // gaps first, so that a broken stance is whole
    close_runs(on, times, 1, most);
}

DpStatus dp_foot_contact(const DpGait* gait, const double* ground, const DpContactLimits* limits,
                         uint8_t* touching, double* clearance)
{
    if (!walker_gait_ok(gait) || !ground || !limits || !touching || !clearance)
        return DP_BAD_ARGUMENT;
    Watch w = {.gait = gait, .limits = limits, .rate = walker_rate(gait)};
    if (gait->times > 1 && w.rate <= 0.0) return DP_BAD_ARGUMENT;
    if (gait->times == 1) w.rate = 1.0;
    if (!open_watch(&w)) {
        close_watch(&w);
        return DP_NO_MEMORY;
    }
    const int    times = gait->times;
    const double shortest = limits->shortest * w.rate - 1e-6;
    DpStatus     status = DP_OK;
    for (int walker = 0; walker < gait->walkers && status == DP_OK; ++walker)
        status = find_belt(&w, walker, ground);
    for (int k = 0; k < gait->points; ++k) watch_point(&w, k, ground);
    for (int walker = 0; walker < gait->walkers && status == DP_OK; ++walker) {
        watch_walker(&w, walker);
        status = walker_level_floor(gait, walker, w.height, w.speed, limits->slow_speed, w.rate);
    }
    if (status != DP_OK) {
        close_watch(&w);
        return status;
    }
    calibrate(&w, clearance);
    for (int k = 0; k < gait->points; ++k) {
        touch_point(&w, k, clearance[k]);
        tidy(w.on + (size_t)k * (size_t)times, times, shortest);
    }
    walker_edges(gait, w.height, clearance, w.rise, w.speed, limits->slow_speed,
                 limits->release_speed, limits->point_cutoff, w.on, w.flown, w.rate);
    for (int k = 0; k < gait->points; ++k) tidy(w.on + (size_t)k * (size_t)times, times, shortest);
    for (int walker = 0; walker < gait->walkers; ++walker)
        walker_support(gait, walker, w.height, w.speed, clearance,
                       w.fall + (size_t)walker * (size_t)times, limits, w.rate, w.on);
    for (int walker = 0; walker < gait->walkers; ++walker)
        walker_bounces(gait, walker, limits->frame_time, w.rate, w.on, w.flown, w.line, w.scratch);
    memset(touching, 0, (size_t)gait->parts * (size_t)times);
    for (int k = 0; k < gait->points; ++k) {
        uint8_t*       part = touching + (size_t)gait->point_part[k] * (size_t)times;
        const uint8_t* on = w.on + (size_t)k * (size_t)times;
        for (int t = 0; t < times; ++t) part[t] |= on[t];
    }
    for (int p = 0; p < gait->parts; ++p)
        tidy(touching + (size_t)p * (size_t)times, times, shortest);
    close_watch(&w);
    return DP_OK;
}
