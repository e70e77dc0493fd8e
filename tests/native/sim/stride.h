// tests/native/sim/stride.h - a small world for the simulation's tests: two-part feet that land heel
// first, roll over the ball and lift, with the force of a walk of `mass` kg.
#pragma once
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "sim/sim.h"

#define STRIDE_RATE 120.0

typedef struct Stride
{
    DpGait   gait;
    double * time, *com, *mass, *pose, *force, *point;
    int32_t *limb_walker, *part_limb;
    uint8_t* touching;
    DpMesh*  sole;
} Stride;

// a heel block and a toe block that meet at the ball, x forward, underside at z = 0
static const float   STRIDE_HEEL[] = {-0.08f, -0.04f, 0, 0.10f,  -0.05f, 0,
                                      0.10f,  0.05f,  0, -0.08f, 0.04f,  0};
static const float   STRIDE_TOE[] = {0, -0.05f, 0, 0.08f, -0.04f, 0, 0.08f, 0.04f, 0, 0, 0.05f, 0};
static const int32_t STRIDE_FACES[] = {0, 1, 2, 0, 2, 3};

// share of the load on the toes: none at landing, all at lift-off
static inline double stride_share(double phase)
{
    return phase < 0.2 ? 0.0 : phase > 0.8 ? 1.0 : (phase - 0.2) / 0.6;
}

// `walkers` side by side, 1 m apart, each `steps` steps of 0.6 s (0.1 s shared), 0.7 m long, on z = 0
static inline Stride stride_make(int walkers, int steps, double mass, double rate)
{
    Stride       s;
    const double stance = 0.6, beat = 0.5;
    const int    limbs = 2 * walkers, parts = 2 * limbs;
    const int    times = (int)lround((beat * steps + 0.4) * rate) + 1;
    const size_t P = (size_t)parts, T = (size_t)times, L = (size_t)limbs, W = (size_t)walkers;
    s.time = dp_alloc(T, sizeof(double)), s.com = dp_alloc(3 * W * T, sizeof(double));
    s.mass = dp_alloc(W, sizeof(double)), s.pose = dp_alloc(7 * P * T, sizeof(double));
    s.force = dp_alloc(3 * P * T, sizeof(double)), s.point = dp_alloc(3 * P * T, sizeof(double));
    s.limb_walker = dp_alloc(L, sizeof(int32_t)), s.part_limb = dp_alloc(P, sizeof(int32_t));
    s.touching = dp_alloc(P * T, 1), s.sole = dp_alloc(P, sizeof(DpMesh));
    for (int t = 0; t < times; ++t) s.time[t] = t / rate;
    for (int w = 0; w < walkers; ++w) s.mass[w] = mass;
    for (int l = 0; l < limbs; ++l) s.limb_walker[l] = l / 2;
    for (int p = 0; p < parts; ++p) {
        const int limb = p / 2, toe = p % 2, side = limb % 2;
        s.part_limb[p] = limb;
        s.sole[p] = (DpMesh){4, 2, toe ? STRIDE_TOE : STRIDE_HEEL, STRIDE_FACES};
        for (int t = 0; t < times; ++t) {
            int step = -1;  // the step of this foot that has begun last
            for (int k = side; k < steps; k += 2)
                if (s.time[t] >= k * beat) step = k;
            const double since = step < 0 ? -1.0 : s.time[t] - step * beat;
            const double phase = since / stance;
            const bool   down = phase >= 0.0 && phase < 1.0;
            // lands 15 deg toes up, is flat from 0.2 to 0.6, then the heel lifts to 40 deg
            const double up = phase < 0.2 ? 15.0 * (1.0 - phase / 0.2) : 0.0;
            const double lift = phase > 0.6 ? 40.0 * fmin(1.0, (phase - 0.6) / 0.4) : 0.0;
            const double pitch = (toe && lift > 0.0 ? 0.0 : lift - up) * DP_PI / 180.0;
            const double x = 0.7 * (step < 0 ? side - 1 : step) + 0.17;
            const double ball[3] = {x, 1.0 * (limb / 2) + (side ? -0.1 : 0.1), 0.0};
            double*      pose = s.pose + 7 * ((size_t)p * T + (size_t)t);
            const double c = cos(pitch), n = sin(pitch);
            // the heel block turns about the ball, 0.10 in front of its origin; the toe about its own
            pose[0] = ball[0] - (toe ? 0.0 : 0.10 * c), pose[1] = ball[1];
            pose[2] = toe ? 0.0 : 0.10 * n;
            pose[3] = cos(0.5 * pitch), pose[5] = sin(0.5 * pitch);
            if (!down) pose[2] += 0.2;
            s.touching[(size_t)p * T + (size_t)t] = (uint8_t)down;
            const double toe_share = stride_share(phase);
            const double load = down ? mass * DP_GRAVITY * sin(DP_PI * phase) * 1.15 : 0.0;
            double*      force = s.force + 3 * ((size_t)p * T + (size_t)t);
            double*      point = s.point + 3 * ((size_t)p * T + (size_t)t);
            const double share = toe ? toe_share : 1.0 - toe_share;
            force[2] = -load * share;
            force[0] = load * share * 0.15 * -cos(DP_PI * phase);
            point[0] = ball[0] + (toe ? 0.04 : -0.1), point[1] = ball[1];
        }
    }
    s.gait = (DpGait){.times = times,
                      .walkers = walkers,
                      .limbs = limbs,
                      .parts = parts,
                      .time = s.time,
                      .com = s.com,
                      .mass = s.mass,
                      .pose = s.pose,
                      .limb_walker = s.limb_walker,
                      .part_limb = s.part_limb,
                      .sole = s.sole};
    return s;
}

static inline void stride_drop(Stride* s)
{
    void* const blocks[] = {s->time,  s->com,         s->mass,      s->pose,     s->force,
                            s->point, s->limb_walker, s->part_limb, s->touching, s->sole};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
}
