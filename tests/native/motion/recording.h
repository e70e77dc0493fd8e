// tests/native/motion/recording.h - two walkers whose every number is another, for the motion's tests.
#pragma once
#include <math.h>

#include "base/alloc.h"
#include "check.h"
#include "motion/motion.h"

enum
{
    WALKERS = 2,
    PARTS = 3,  // walker 0 owns parts 0 and 2, walker 1 part 1
    TIMES = 10
};

static const float   VERTEX[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const int32_t TRIANGLE[] = {0, 1, 2};

typedef struct Recording
{
    DpGait        gait;
    double        time[TIMES], mass[WALKERS];
    double        pose[7 * PARTS * TIMES], force[3 * PARTS * TIMES], point[3 * PARTS * TIMES];
    uint8_t       touching[PARTS * TIMES];
    int32_t       limb_walker[PARTS], part_limb[PARTS];
    DpMesh        sole[PARTS];
    DpLoadedPoses poses;
} Recording;

static inline void fill(Recording* r)
{
    *r = (Recording){.mass = {70.0, 80.0}, .limb_walker = {0, 1, 0}, .part_limb = {0, 1, 2}};
    for (int t = 0; t < TIMES; ++t) r->time[t] = 0.1 * t;
    for (int p = 0; p < PARTS; ++p) {
        r->sole[p] = (DpMesh){3, 1, VERTEX, TRIANGLE};
        for (int t = 0; t < TIMES; ++t) {
            const int k = p * TIMES + t;
            r->pose[7 * k] = p, r->pose[7 * k + 1] = t, r->pose[7 * k + 2] = 10 * p + t;
            r->pose[7 * k + 3] = 1.0;
            r->force[3 * k + 2] = -100.0 * p - t;
            r->point[3 * k] = t ? 0.5 : NAN;
            r->touching[k] = (uint8_t)(t > 4 && p != 0);
        }
    }
    r->gait = (DpGait){.times = TIMES,
                       .walkers = WALKERS,
                       .limbs = PARTS,
                       .parts = PARTS,
                       .time = r->time,
                       .mass = r->mass,
                       .pose = r->pose,
                       .limb_walker = r->limb_walker,
                       .part_limb = r->part_limb,
                       .sole = r->sole};
    r->poses = (DpLoadedPoses){r->pose, r->touching, r->force, r->point};
}
