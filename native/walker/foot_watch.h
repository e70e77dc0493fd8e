// walker/foot_watch.h - what is known of contact points over a clip, for the files of TRAIL (4).
#pragma once
#include "walker/walker_inside.h"

// where a point was, and how much that counts
typedef struct DpVote
{
    double height, weight;
} DpVote;

// what is known of the points and walkers over the clip
typedef struct DpWatch
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
    DpVote*                vote;     // heights of one point                   (T)
} DpWatch;

bool dp_watch_open(DpWatch* watch);  // gait, limits and rate are set; false: no memory
void dp_watch_close(DpWatch* watch);

// A walker that stays while its low feet slide walks in place: the surface moves as they do.
DpStatus dp_watch_belt(DpWatch* watch, int walker, const double* ground);
// Heights and speeds of a point over the surface; gate and fall of a walker.
void dp_watch_point(DpWatch* watch, int k, const double* ground);
void dp_watch_walker(DpWatch* watch, int walker);

// foot_clearance.c: resting height of each point [m] (K), from its heights and speeds.
void dp_watch_clearance(const DpWatch* watch, double* clearance);

// the limb of a contact point, and its walker
static inline int dp_watch_limb(const DpGait* gait, int point)
{
    return gait->part_limb[gait->point_part[point]];
}

static inline int dp_watch_owner(const DpGait* gait, int point)
{
    return gait->limb_walker[dp_watch_limb(gait, point)];
}
