// walker/foot_watch.c - heights and speeds of contact points over the surface. TRAIL (4).
#include "walker/foot_watch.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"

#define SUPPORT_CUTOFF 8.0  // low-pass of a_com for the question whether it falls        [Hz]
#define IN_PLACE 0.4        // feet of a walker that stays slide at least this fast     [m/s]

void dp_watch_close(DpWatch* w)
{
    dp_free(w->height), dp_free(w->speed), dp_free(w->drop), dp_free(w->rise), dp_free(w->gate),
        dp_free(w->fall);
    dp_free(w->belt);
    dp_free(w->on), dp_free(w->flown), dp_free(w->scratch), dp_free(w->line), dp_free(w->vote);
}

bool dp_watch_open(DpWatch* w)
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
    w->scratch = dp_alloc(dp_walker_fly_scratch(w->gait->times) + 8, sizeof(double));
    w->line = dp_alloc(3 * times, sizeof(double));
    w->vote = dp_alloc(times, sizeof(DpVote));
    return w->height && w->speed && w->drop && w->rise && w->belt && w->gate && w->fall && w->on &&
           w->flown && w->scratch && w->line && w->vote;
}

static DpVec3 line_velocity(const DpWatch* w, int t)
{
    const int times = w->gait->times;
    return dp_vec3(dp_walker_velocity(w->line, times, t, w->rate),
                   dp_walker_velocity(w->line + times, times, t, w->rate),
                   dp_walker_velocity(w->line + 2 * (size_t)times, times, t, w->rate));
}

static void smooth_line(const DpWatch* w, double cutoff)
{
    const int times = w->gait->times;
    for (int c = 0; c < 3; ++c)
        dp_walker_low_pass(w->line + (size_t)c * (size_t)times, times, w->rate, cutoff, w->scratch);
}

// heights of a point, and its smoothed places left in the line
static void watch_places(DpWatch* w, int k, const double* ground)
{
    const int    times = w->gait->times;
    const size_t row = (size_t)k * (size_t)times;
    const DpVec3 point = dp_walker_point(w->gait, k);
    for (int t = 0; t < times; ++t) {
        const DpVec3 at = dp_place(dp_walker_pose(w->gait, w->gait->point_part[k], t), point);
        w->line[t] = at.x, w->line[t + times] = at.y, w->line[t + 2 * times] = at.z;
        w->height[row + (size_t)t] = at.z - ground[row + (size_t)t];
    }
    smooth_line(w, w->limits->point_cutoff);
}

// speeds of a point relative to the surface
void dp_watch_point(DpWatch* w, int k, const double* ground)
{
    const size_t row = (size_t)k * (size_t)w->gait->times;
    watch_places(w, k, ground);
    for (int t = 0; t < w->gait->times; ++t) {
        const DpVec3 v = dp_sub(line_velocity(w, t), w->belt[dp_watch_owner(w->gait, k)]);
        w->speed[row + (size_t)t] = dp_length(v);
        w->rise[row + (size_t)t] = v.z;
        w->drop[row + (size_t)t] = -v.z - dp_length(dp_vec3(v.x, v.y, 0.0));
    }
}

// Samples at which a foot of a walker moves, and how many: while all stand, nothing tells of a belt.
static int find_steps(DpWatch* w, int walker, const double* ground, uint8_t* moves)
{
    const int times = w->gait->times;
    int       count = 0;
    memset(moves, 0, (size_t)times);
    for (int k = 0; k < w->gait->points; ++k) {
        if (dp_watch_owner(w->gait, k) != walker) continue;
        watch_places(w, k, ground);
        for (int t = 0; t < times; ++t)
            moves[t] |= dp_length(line_velocity(w, t)) > w->limits->slow_speed;
    }
    for (int t = 0; t < times; ++t) count += moves[t];
    return count;
}

// A walker that stays while its low feet slide walks in place: the surface moves as they do.
DpStatus dp_watch_belt(DpWatch* w, int walker, const double* ground)
{
    const DpGait* gait = w->gait;
    const int     times = gait->times;
    const DpVec3  displacement =
        dp_sub(dp_walker_com(gait, walker, times - 1), dp_walker_com(gait, walker, 0));
    uint8_t* moves = w->flown + (size_t)walker * (size_t)times;
    if (times < 3) return DP_OK;
    double* low = dp_alloc(3 * (size_t)gait->points * (size_t)times, sizeof(double));
    if (!low) return DP_NO_MEMORY;
    double *     x = low, *y = low + (size_t)gait->points * (size_t)times, *sorted = y + (y - x);
    size_t       count = 0;
    const double lasts = (double)find_steps(w, walker, ground, moves) / w->rate;
    for (int k = 0; k < gait->points; ++k) {
        if (dp_watch_owner(gait, k) != walker) continue;
        const double* height = w->height + (size_t)k * (size_t)times;
        size_t        n = 0;
        watch_places(w, k, ground);
        for (int t = 0; t < times; ++t)
            if (moves[t] && isfinite(height[t])) sorted[n++] = height[t];
        if (n == 0) continue;
        dp_walker_sort(sorted, n);
        const double low_band = sorted[n / 20] + 0.5 * w->limits->touch_height;
        for (int t = 0; t < times; ++t) {
            if (!moves[t] || !(height[t] <= low_band)) continue;
            const DpVec3 v = line_velocity(w, t);
            x[count] = v.x, y[count++] = v.y;
        }
    }
    if (count > 0) {
        const DpVec3 belt = dp_vec3(dp_walker_median(x, count), dp_walker_median(y, count), 0.0);
        const double speed = dp_length(belt);
        if (speed > IN_PLACE &&
            dp_length(dp_vec3(displacement.x, displacement.y, 0.0)) < 0.25 * speed * lasts)
            w->belt[walker] = belt;
    }
    dp_free(low);
    return DP_OK;
}

void dp_watch_walker(DpWatch* w, int walker)
{
    const int times = w->gait->times;
    double*   gate = w->gate + (size_t)walker * (size_t)times;
    double*   fall = w->fall + (size_t)walker * (size_t)times;
    for (int t = 0; t < times; ++t) w->line[t] = dp_walker_com(w->gait, walker, t).z;
    dp_walker_low_pass(w->line, times, w->rate, SUPPORT_CUTOFF, w->scratch);
    for (int t = 0; t < times; ++t) fall[t] = dp_walker_acceleration(w->line, times, t, w->rate);
    for (int t = 0; t < times; ++t) {
        const DpVec3 com = dp_walker_com(w->gait, walker, t);
        w->line[t] = com.x, w->line[t + times] = com.y, w->line[t + 2 * times] = com.z;
    }
    smooth_line(w, w->limits->com_cutoff);
    for (int t = 0; t < times; ++t)
        gate[t] =
            w->limits->touch_speed +
            w->limits->touch_speed_share * dp_length(dp_sub(line_velocity(w, t), w->belt[walker]));
}
