// tests/native/sim/planted.h - a lawn to walk on, for the simulation's tests.
#pragma once
#include "check.h"
#include "sim/sim.h"
#include "sim/stride.h"

typedef struct World
{
    DpTerrain* terrain;
    DpSim*     sim;
    DpPlants*  plants;
    int        stand, grown;
} World;

// a lawn of `side` x `side` m from (x0, y0) on, roots `apart` m apart
static inline DpStatus world_make(World* world, const DpPlantKind* kind, double x0, double y0,
                                  double side, double apart, double cell, int workers)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 0.6e6f;
    const DpTerrainOptions options = {{cell, 0.0, 0.0}, &soil, 1, workers, 0, NULL};
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    DpSimOptions           sim = dp_sim_options_default();
    sim.workers = workers;
    *world = (World){.stand = -1};
    DpStatus status = dp_terrain_create(&world->terrain, &options, &flat);
    if (status == DP_OK) status = dp_sim_create(&world->sim, world->terrain, &sim);
    if (status != DP_OK || !kind) return status;
    world->plants = dp_plants_create(3);
    if (!world->plants) return DP_NO_MEMORY;
    status = dp_sim_plant(world->sim, world->plants);
    const int n = (int)(side / apart + 0.5);
    float*    xy = dp_alloc((size_t)(n * n), 2 * sizeof(float));
    if (!xy) return DP_NO_MEMORY;
    for (int k = 0; k < n * n; ++k) {
        xy[2 * k] = (float)(x0 + apart * (k % n));
        xy[2 * k + 1] = (float)(y0 + apart * (k / n));
    }
    if (status == DP_OK)
        status = dp_sim_grow(world->sim, kind, xy, n * n, &world->stand, &world->grown);
    dp_free(xy);
    return status;
}

static inline void world_drop(World* world)
{
    dp_sim_destroy(world->sim);
    dp_plants_destroy(world->plants);
    dp_terrain_destroy(world->terrain);
}

static inline DpStatus walk(World* world, const Stride* s)
{
    DpStatus status = dp_sim_load(world->sim, &s->gait, s->touching, s->force, s->point);
    if (status == DP_OK) status = dp_sim_run(world->sim, s->gait.times - 1);
    return status == DP_OK ? dp_sim_settle(world->sim) : status;
}
