// tests/bench/bench_meadow.c - what plants cost a walk: a meadow of 100,000, and a trodden lane.
//
//   scripts/bench meadow   or   build/bench_meadow [passes]
//
// The walker has two feet of two parts and steps 0.7 m in half a second, at 60 frames a second, on
// soil of 1 cm cells. First on bare ground, then among plants that are all asleep when it comes;
// then back and forth over a lane of 0.5 m x 5 m with 200 plants, as often as told (500; 60 for a timing that is
// kept), on two cores.
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "../native/sim/stride.h"
#include "timing.h"

#define RATE 60.0

// by all threads of this process
static double spent(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct World
{
    DpTerrain* terrain;
    DpSim*     sim;
    DpPlants*  plants;
    int        stand, grown;
} World;

static World world_make(int workers)
{
    const DpSoil           soil = dp_soil_default();
    const DpTerrainOptions options = {{0.01, 0.0, 0.0}, &soil, 1, workers, 0, NULL};
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    DpSimOptions           choice = dp_sim_options_default();
    World                  world = {.stand = -1};
    choice.workers = workers;
    if (dp_terrain_create(&world.terrain, &options, &flat) != DP_OK ||
        dp_sim_create(&world.sim, world.terrain, &choice) != DP_OK)
        exit(1);
    return world;
}

// so many plants of TRAIL's Carex over a rectangle
static void plant(World* world, int wanted, double x0, double y0, double x1, double y1)
{
    const DpPlantKind kind = dp_plant_kind_default();
    float*            xy = dp_alloc((size_t)wanted, 2 * sizeof *xy);
    int               count = 0;
    world->plants = dp_plants_create(1);
    dp_plants_place(x0, y0, x1, y1, wanted / ((x1 - x0) * (y1 - y0)), NULL, 0, 0, 7, xy, wanted,
                    &count);
    if (dp_sim_plant(world->sim, world->plants) != DP_OK ||
        dp_sim_grow(world->sim, &kind, xy, count, &world->stand, &world->grown) != DP_OK)
        exit(1);
    dp_free(xy);
}

static void world_drop(World* world)
{
    dp_sim_destroy(world->sim);
    dp_plants_destroy(world->plants);
    dp_terrain_destroy(world->terrain);
}

static int by_size(const void* a, const void* b)
{
    const double x = *(const double*)a, y = *(const double*)b;
    return x < y ? -1 : x > y;
}

// the walk on ground with so many plants around it; the time of a frame, all in all [us]
static double walk(int plants, const char* name)
{
    Stride    s = stride_make(1, 20, 75.0, RATE);
    const int frames = s.gait.times - 1;
    World     world = world_make(1);
    double *  t = dp_alloc((size_t)frames, sizeof *t), sum = 0.0;
    int       most = 0;
    if (plants) plant(&world, plants, -10.0, -17.7, 25.4, 17.7);
    dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point);
    for (int f = 0; f < frames; ++f) {
        const double start = bench_now();
        dp_sim_run(world.sim, f + 1);
        sum += t[f] = bench_now() - start;
        const int awake = dp_sim_report(world.sim).awake;
        most = awake > most ? awake : most;
    }
    qsort(t, (size_t)frames, sizeof *t, by_size);
    printf("%-34s %7.0f us a frame (median %.0f, worst %.0f), at most %d awake\n", name,
           1e6 * sum / frames, 1e6 * t[frames / 2], 1e6 * t[frames - 1], most);
    bench_keep("meadow", name, sum / frames);
    dp_free(t);
    world_drop(&world);
    stride_drop(&s);
    return 1e6 * sum / frames;
}

// beside the lane's middle by as much as chance says, every other pass the other way round
static void put_on_lane(Stride* s, bool back, unsigned* state)
{
    *state = *state * 1664525u + 1013904223u;
    const double aside = 0.24 * ((double)(*state >> 8) / 16777216.0 - 0.5);
    for (int k = 0; k < s->gait.parts * s->gait.times; ++k) {
        double *pose = s->pose + 7 * k, *point = s->point + 3 * k, *force = s->force + 3 * k;
        pose[1] += aside, point[1] += aside;
        if (!back) continue;
        pose[0] = 5.0 - pose[0], point[0] = 5.0 - point[0], force[0] = -force[0];
        const double w = pose[3], y = pose[5];  // and half a turn about z: (0, 0, 0, 1) times it
        pose[3] = 0.0, pose[4] = -y, pose[5] = 0.0, pose[6] = w;
    }
}

static void lane(int passes)
{
    World    world = world_make(2);
    unsigned state = 3;
    plant(&world, 200, 0.0, -0.25, 5.0, 0.25);
    const double start = bench_now(), worked = spent();
    for (int k = 0; k < passes; ++k) {
        Stride s = stride_make(1, 7, 75.0, RATE);
        put_on_lane(&s, k % 2 == 1, &state);
        dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point);
        dp_sim_run(world.sim, s.gait.times - 1);
        dp_sim_settle(world.sim);
        stride_drop(&s);
    }
    const double took = bench_now() - start;
    printf(
        "a lane, %d plants, %d passes %16.1f s, %.0f ms a pass (%.1f s of work); %ld bends broke\n",
        world.grown, passes, took, 1e3 * took / passes, spent() - worked,
        dp_sim_report(world.sim).broke);
    char what[64];
    snprintf(what, sizeof what, "a lane of %d passes: a pass", passes);
    bench_keep("meadow", what, took / passes);
    world_drop(&world);
}

int main(int argc, char** argv)
{
    const int    passes = bench_count(argc, argv, getenv("BENCH_KEEP") ? 60 : 500);
    const double bare = walk(0, "a walker on bare ground");
    const double grown = walk(100000, "the same among 100,000 plants");
    printf("%-34s %7.0f us a frame\n", "so plants cost", grown - bare);
    lane(passes);
    return 0;
}
