// walker/foot_landing.c - how fast a foot comes down: the v(t0 - dt) of TRAIL (3), which is that of
// the heel, of the toe or of both, whichever lands. TRAIL (4)
//
// Departures
//   TRAIL (3): v(t0 - dt) is measured over a fixed 1/30 s, and in a flight long enough 0.1 s before
//   touch-down with what gravity adds since, so that the landing does not depend on the frame rate.
//   test_foot_force.c, impulse_of_fall.
#include <math.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define LATCH_TIME (1.0 / 30.0)  // v0 is measured over this                                   [s]
#define FRAMES_BACK 0.1          // and in a fall before this, two frames at 24 a second       [s]
#define FALLS 0.5                // who falls does so by more than this share of g             [-]

// samples for which no limb has touched, up to this one
static int time_in_air(const uint8_t* limb_on, int limbs, int times, int t)
{
    int count = 0;
    for (; t >= 0; --t, ++count)
        for (int i = 0; i < limbs; ++i)
            if (limb_on[(size_t)i * (size_t)times + (size_t)t]) return count;
    return count;
}

// the middle of the points of a limb that land
static DpVec3 spot(const DpGait* gait, const DpLanding* landing, int t)
{
    DpVec3 sum = {0.0, 0.0, 0.0};
    for (int k = 0; k < landing->count; ++k) {
        const int point = landing->point[k];
        sum = dp_add(sum, dp_place(dp_walker_pose(gait, gait->point_part[point], t),
                                   dp_walker_point(gait, point)));
    }
    return dp_scale(sum, 1.0 / landing->count);
}

// the velocity of what lands at a sample, from the parabola through the last 1/30 s
static DpVec3 velocity(const DpGait* gait, const DpLanding* landing, double rate, int t)
{
    const double half = LATCH_TIME / 2.0 * rate;  // in samples
    if ((double)t < 2.0 * half) {
        const int    from = 0, to = t > 0 ? t : 1;
        const DpVec3 d = dp_sub(spot(gait, landing, to), spot(gait, landing, from));
        return dp_scale(d, rate / (double)(to - from));
    }
    DpVec3 x[3];
    for (int k = 0; k < 3; ++k) {
        // the parabola through the three samples around the time asked for
        const double when = (double)t - half * (double)k;
        int          mid = (int)floor(when + 0.5);
        mid = mid < 1 ? 1 : mid > t - 1 && t >= 2 ? t - 1 : mid;
        const double u = when - (double)mid;
        const DpVec3 a = spot(gait, landing, mid - 1);
        const DpVec3 b = spot(gait, landing, mid);
        const DpVec3 c = spot(gait, landing, mid + 1);
        x[k] = dp_add(dp_add(dp_scale(a, u * (u - 1.0) / 2.0), dp_scale(b, 1.0 - u * u)),
                      dp_scale(c, u * (u + 1.0) / 2.0));
    }
    const DpVec3 d = dp_add(dp_sub(dp_scale(x[0], 3.0), dp_scale(x[1], 4.0)), x[2]);
    return dp_scale(d, rate / (2.0 * half));
}

// did the whole body fall, in the time in which its speed is measured up to this sample?
static bool falls(const DpGait* gait, int walker, double rate, int t)
{
    const int    h = (int)fmax(LATCH_TIME / 2.0 * rate, 1.0);
    const double last = dp_walker_com(gait, walker, t).z,
                 before = dp_walker_com(gait, walker, t - h).z;
    const double first = dp_walker_com(gait, walker, t - 2 * h).z, step = (double)h / rate;
    return (last - 2.0 * before + first) / (step * step) < -FALLS * DP_GRAVITY;
}

DpVec3 dp_walker_landing_velocity(const DpGait* gait, const DpLanding* landing,
                                  const uint8_t* limb_on, int limbs, double rate, int t)
{
    // who has been falling freely still does: his speed is taken from before the frame in which he
    // lands, as that one shows already how he is stopped
    const int    back = (int)ceil(FRAMES_BACK * rate);
    const double needs = (FRAMES_BACK + LATCH_TIME) * rate + 2.0;
    const int    walker = gait->limb_walker[gait->part_limb[gait->point_part[landing->point[0]]]];
    if ((double)time_in_air(limb_on, limbs, gait->times, t) < needs ||
        !falls(gait, walker, rate, t - back))
        return velocity(gait, landing, rate, t);
    DpVec3 v = velocity(gait, landing, rate, t - back);
    v.z -= DP_GRAVITY * (double)back / rate;
    return v;
}
