// tests/native/walker/scene.h - one walker of boxes for the walker's tests.
#pragma once
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "check.h"
#include "walker/walker.h"

typedef struct Scene
{
    DpGait   gait;
    double * time, *com, *pose, *point, *ground;
    double   mass;
    int32_t *limb_walker, *part_limb, *point_part, *point_role;
} Scene;

// `limbs` limbs of one part with `points` contact points each (all at the part's origin until
// moved)
static inline Scene scene_make(int times, double rate, int limbs, int points)
{
    Scene     s = {.mass = 70.0};
    const int all = limbs * points;
    s.time = dp_alloc((size_t)times, sizeof(double));
    s.com = dp_alloc(3 * (size_t)times, sizeof(double));
    s.pose = dp_alloc(7 * (size_t)times * (size_t)limbs, sizeof(double));
    s.point = dp_alloc(3 * (size_t)all, sizeof(double));
    s.ground = dp_alloc((size_t)all * (size_t)times, sizeof(double));
    s.limb_walker = dp_alloc((size_t)limbs, sizeof(int32_t));
    s.part_limb = dp_alloc((size_t)limbs, sizeof(int32_t));
    s.point_part = dp_alloc((size_t)all, sizeof(int32_t));
    s.point_role = dp_alloc((size_t)all, sizeof(int32_t));
    for (int t = 0; t < times; ++t) s.time[t] = (double)t / rate;
    for (int p = 0; p < limbs; ++p) {
        s.part_limb[p] = p;
        for (int k = 0; k < points; ++k) s.point_part[p * points + k] = p;
        for (int t = 0; t < times; ++t) s.pose[7 * (p * times + t) + 3] = 1.0;
    }
    return s;
}

// the gait of the scene; call it once the scene is where it stays
static inline const DpGait* scene_gait(Scene* s, int times, int limbs, int points)
{
    s->gait = (DpGait){.times = times,
                       .walkers = 1,
                       .limbs = limbs,
                       .parts = limbs,
                       .points = limbs * points,
                       .time = s->time,
                       .com = s->com,
                       .mass = &s->mass,
                       .pose = s->pose,
                       .limb_walker = s->limb_walker,
                       .part_limb = s->part_limb,
                       .point = s->point,
                       .point_part = s->point_part,
                       .point_role = s->point_role};
    return &s->gait;
}

// what touches when (P, T), by the usual limits, and the resting clearance of each point (K)
static inline void scene_touch(Scene* s, int times, int limbs, int points, uint8_t* on,
                               double* clearance)
{
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(s, times, limbs, points), s->ground, &limits, on, clearance) ==
          DP_OK);
}

static inline void scene_free(Scene* s)
{
    dp_free(s->time), dp_free(s->com), dp_free(s->pose), dp_free(s->point), dp_free(s->ground);
    dp_free(s->limb_walker), dp_free(s->part_limb), dp_free(s->point_part), dp_free(s->point_role);
}

static inline void scene_put(Scene* s, int times, int part, int t, double x, double y, double z)
{
    double* at = s->pose + 7 * (part * times + t);
    at[0] = x, at[1] = y, at[2] = z;
}

static inline void scene_com(Scene* s, int t, double x, double y, double z)
{
    s->com[3 * t] = x, s->com[3 * t + 1] = y, s->com[3 * t + 2] = z;
}
