// tests/native/sim/stand.h - square soles of 10 cm that stand where and when a test has them stand, on level ground.
#pragma once
#include "base/vec.h"
#include "check.h"
#include "sim/sim_inside.h"

#define CELL 0.01
#define RATE 100.0
#define TIMES 201
#define MAX_LIMBS 2

static const float   STAND_BOX[] = {-0.05f, -0.05f, 0, 0.05f,  -0.05f, 0,
                                    0.05f,  0.05f,  0, -0.05f, 0.05f,  0};
static const int32_t STAND_FACES[] = {0, 1, 2, 0, 2, 3};

// One walker for each sole.
typedef struct Stand
{
    int        limbs;
    DpTerrain* terrain;
    DpSim*     sim;
    double     time[TIMES], pose[MAX_LIMBS][TIMES][7], force[MAX_LIMBS][TIMES][3];
    double     point[MAX_LIMBS][TIMES][3];
    uint8_t    touching[MAX_LIMBS][TIMES];
} Stand;

// nobody touches yet
static inline void stand_make(Stand* s, int limbs)
{
    memset(s, 0, sizeof *s);
    s->limbs = limbs;
    for (int t = 0; t < TIMES; ++t) s->time[t] = t / RATE;
    for (int l = 0; l < limbs; ++l)
        for (int t = 0; t < TIMES; ++t) s->pose[l][t][3] = 1.0;
}

// a sole stands at (x, y) with `newton` in some samples; it comes there in the air, and stays over it afterwards
static inline void stand_on(Stand* s, int limb, int from, int end, double x, double y,
                            double newton)
{
    for (int t = from > 0 ? from - 1 : 0; t < TIMES; ++t) {
        s->pose[limb][t][0] = s->point[limb][t][0] = x;
        s->pose[limb][t][1] = s->point[limb][t][1] = y;
    }
    for (int t = from; t < end; ++t) s->force[limb][t][2] = -newton, s->touching[limb][t] = 1;
}

// all of them begin to walk, again
static inline void stand_follow(Stand* s)
{
    static const double  mass[MAX_LIMBS] = {70.0, 70.0};
    static const int32_t owner[MAX_LIMBS] = {0, 1};
    const DpMesh sole[MAX_LIMBS] = {{4, 2, STAND_BOX, STAND_FACES}, {4, 2, STAND_BOX, STAND_FACES}};
    const DpGait gait = {.times = TIMES,
                         .walkers = s->limbs,
                         .limbs = s->limbs,
                         .parts = s->limbs,
                         .time = s->time,
                         .mass = mass,
                         .pose = &s->pose[0][0][0],
                         .limb_walker = owner,
                         .part_limb = owner,
                         .sole = sole};
    CHECK(dp_sim_load(s->sim, &gait, &s->touching[0][0], &s->force[0][0][0], &s->point[0][0][0]) ==
          DP_OK);
}

// on ground of a test's own, which is the stand's from now on
static inline void stand_load_on(Stand* s, DpTerrain* terrain, DpSimOptions chosen)
{
    s->terrain = terrain;
    CHECK(dp_sim_create(&s->sim, s->terrain, &chosen) == DP_OK);
    stand_follow(s);
}

static inline void stand_load(Stand* s, const DpSoil* soil, DpSimOptions chosen)
{
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, soil, 1, 1, 0, NULL};
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    DpTerrain*             terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &flat) == DP_OK);
    stand_load_on(s, terrain, chosen);
}

static inline double stand_read(const Stand* s, DpField field, long i, long j)
{
    float value;
    CHECK(dp_terrain_read(s->terrain, field, i, j, 1, 1, &value) == DP_OK);
    return (double)value;
}

static inline void stand_drop(Stand* s)
{
    dp_sim_destroy(s->sim);
    dp_terrain_destroy(s->terrain);
}
