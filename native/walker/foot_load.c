// walker/foot_load.c - which limbs and points of a walker carry it, and how surely. MODEL 4.3
#include "walker/foot_load.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"

#define SOLE_LIFT 0.04     // a point this far above its limb's lowest carries nothing [m]
#define TIP_CAPACITY 0.25  // toes carry a quarter of what heel or ball does      [-]

void dp_load_close(DpLoad* l)
{
    dp_free(l->limb), dp_free(l->point), dp_free(l->first), dp_free(l->capacity), dp_free(l->place);
    dp_free(l->limb_on), dp_free(l->point_on), dp_free(l->limb_weight), dp_free(l->point_weight);
    dp_free(l->accel), dp_free(l->velocity), dp_free(l->landing), dp_free(l->landed),
        dp_free(l->tau);
}

bool dp_load_open(DpLoad* l)
{
    const size_t limbs = (size_t)l->gait->limbs, points = (size_t)l->gait->points;
    const size_t times = (size_t)l->gait->times;
    l->limb = dp_alloc(limbs, sizeof(int));
    l->point = dp_alloc(points, sizeof(int));
    l->first = dp_alloc(limbs + 1, sizeof(int));
    l->capacity = dp_alloc(points, sizeof(double));
    l->place = dp_alloc(points * times, sizeof(DpVec3));
    l->limb_on = dp_alloc(limbs * times, 1);
    l->point_on = dp_alloc(points * times, 1);
    l->limb_weight = dp_alloc(limbs * times, sizeof(double));
    l->point_weight = dp_alloc(points * times, sizeof(double));
    l->accel = dp_alloc(3 * times, sizeof(double));
    l->velocity = dp_alloc(2 * times, sizeof(double));
    l->landing = dp_alloc(limbs, sizeof(DpVec3));
    l->landed = dp_alloc(limbs, sizeof(int));
    l->tau = dp_alloc(limbs, sizeof(double));
    return l->limb && l->point && l->first && l->capacity && l->place && l->limb_on &&
           l->point_on && l->limb_weight && l->point_weight && l->accel && l->velocity &&
           l->landing && l->landed && l->tau;
}

// Which points of a limb carry: those of touching parts, near the height of the limb's lowest one.
static void gather_points(DpLoad* l, int i, const uint8_t* touching)
{
    const DpGait* gait = l->gait;
    const size_t  times = (size_t)gait->times;
    int           in_role[3] = {0};
    for (int k = l->first[i]; k < l->first[i + 1]; ++k) ++in_role[gait->point_role[l->point[k]]];
    for (int k = l->first[i]; k < l->first[i + 1]; ++k) {
        const int role = gait->point_role[l->point[k]];
        l->capacity[k] = (role == DP_POINT_TIP ? TIP_CAPACITY : 1.0) / (double)in_role[role];
    }
    for (size_t t = 0; t < times; ++t) {
        double lowest = INFINITY;
        for (int k = l->first[i]; k < l->first[i + 1]; ++k) {
            const int    part = gait->point_part[l->point[k]];
            const double below = l->ground[(size_t)l->point[k] * times + t];
            DpVec3*      at = l->place + (size_t)k * times + t;
            *at = dp_place(dp_walker_pose(gait, part, (int)t), dp_walker_point(gait, l->point[k]));
            l->point_on[(size_t)k * times + t] = touching[(size_t)part * times + t] != 0;
            l->point_weight[(size_t)k * times + t] = at->z - (isfinite(below) ? below : 0.0);
            if (l->point_on[(size_t)k * times + t])
                lowest = fmin(lowest, l->point_weight[(size_t)k * times + t]);
            if (isfinite(below)) at->z = below;
        }
        for (int k = l->first[i]; k < l->first[i + 1]; ++k) {
            uint8_t* on = l->point_on + (size_t)k * times + t;
            *on = *on && l->point_weight[(size_t)k * times + t] < lowest + SOLE_LIFT;
            l->limb_on[(size_t)i * times + t] |= *on;
        }
    }
}

void dp_load_gather(DpLoad* l, int walker, const uint8_t* touching)
{
    const DpGait* gait = l->gait;
    const size_t  times = (size_t)gait->times;
    l->walker = walker, l->limbs = 0, l->points = 0;
    memset(l->limb_on, 0, (size_t)gait->limbs * times);
    for (int limb = 0; limb < gait->limbs; ++limb) {
        if (gait->limb_walker[limb] != walker) continue;
        const int i = l->limbs++;
        l->limb[i] = limb;
        l->first[i] = l->points;
        for (int k = 0; k < gait->points; ++k)
            if (gait->part_limb[gait->point_part[k]] == limb) l->point[l->points++] = k;
        l->first[i + 1] = l->points;
        gather_points(l, i, touching);
        const size_t row = (size_t)l->first[i] * times;
        dp_walker_ramps(l->point_on + row, l->first[i + 1] - l->first[i], gait->times, l->rate,
                        l->options, true, l->point_weight + row);
    }
    dp_walker_ramps(l->limb_on, l->limbs, gait->times, l->rate, l->options, false, l->limb_weight);
}
