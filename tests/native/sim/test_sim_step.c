// What must hold of a whole step: the ledger, rest, threads, memory, and nothing lost when memory ends.
#include "sim/sim.h"

#include "check.h"
#include "sim/stride.h"

static DpSoil mud(void)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 0.6e6f;
    soil.poisson_ratio = 0.35f;
    soil.settle_time = 0.15f;
    soil.rest_angle = (float)(15.0 * DP_PI / 180.0);
    return soil;
}

typedef struct World
{
    DpTerrain* terrain;
    DpSim*     sim;
} World;

static DpStatus world_make(World* world, const DpSoil* soil, double cell, int workers)
{
    const DpTerrainOptions options = {{cell, 0.0, 0.0}, soil, 1, workers, 0, NULL};
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    DpSimOptions           sim = dp_sim_options_default();
    sim.workers = workers;
    *world = (World){NULL, NULL};
    DpStatus status = dp_terrain_create(&world->terrain, &options, &flat);
    if (status == DP_OK) status = dp_sim_create(&world->sim, world->terrain, &sim);
    return status;
}

static void world_drop(World* world)
{
    dp_sim_destroy(world->sim);
    dp_terrain_destroy(world->terrain);
}

static DpStatus walk(World* world, const Stride* s)
{
    DpStatus status = dp_sim_load(world->sim, &s->gait, s->touching, s->force, s->point);
    if (status == DP_OK) status = dp_sim_run(world->sim, s->gait.times - 1);
    return status == DP_OK ? dp_sim_settle(world->sim) : status;
}

// sum b cell^2 = 2 nu (V_c + V_b) - V_b and what feet that slide have cut, after several prints
TEST(ledger_balances)
{
    const DpSoil soil = mud();
    World        world;
    Stride       s = stride_make(1, 6, 80.0, STRIDE_RATE);
    CHECK(world_make(&world, &soil, 0.01, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    const DpSimReport r = dp_sim_report(world.sim);
    const double want = 2.0 * 0.35 * (r.pressed + r.pressed_heap) - r.pressed_heap + r.loosened;
    printf("  contacts %d, deepest %.1f mm, pressed %.3f l, heap %.3f l, %zu tiles\n", r.contacts,
           1e3 * r.deepest, 1e3 * r.pressed, 1e3 * r.heaped, dp_terrain_tile_count(world.terrain));
    CHECK(r.contacts == 6);
    CHECK(r.deepest > 0.01 && r.deepest < 0.08);
    CHECK_CLOSE(r.heaped, want, 1e-6);
    world_drop(&world);
    stride_drop(&s);
}

// 1, 2 and 4 workers, many walkers at once: the same bits everywhere
TEST(workers_do_not_matter)
{
    const DpSoil soil = mud();
    const int    nx = 600, ny = 700;
    const size_t cells = (size_t)nx * (size_t)ny;
    float*       grid[3];
    Stride       s = stride_make(6, 4, 80.0, STRIDE_RATE);
    for (int run = 0; run < 3; ++run) {
        World world;
        CHECK(world_make(&world, &soil, 0.01, 1 << run) == DP_OK);
        CHECK(walk(&world, &s) == DP_OK);
        grid[run] = dp_alloc(2 * cells, sizeof(float));
        CHECK(dp_terrain_read(world.terrain, DP_FIELD_HEAP, -100, -100, nx, ny, grid[run]) ==
              DP_OK);
        CHECK(dp_terrain_read(world.terrain, DP_FIELD_COMPRESSION, -100, -100, nx, ny,
                              grid[run] + cells) == DP_OK);
        world_drop(&world);
    }
    float most = 0.0f;
    for (size_t k = 0; k < cells; ++k) most = fmaxf(most, grid[0][k]);
    CHECK(most > 0.001f);
    CHECK(memcmp(grid[0], grid[1], 2 * cells * sizeof(float)) == 0);
    CHECK(memcmp(grid[0], grid[2], 2 * cells * sizeof(float)) == 0);
    for (int run = 0; run < 3; ++run) dp_free(grid[run]);
    stride_drop(&s);
}

// no loose slope steeper than the rest angle + 0.1 deg once all feet are lifted
TEST(everything_rests)
{
    const DpSoil soil = mud();
    const int    nx = 560, ny = 120;
    World        world;
    Stride       s = stride_make(1, 5, 80.0, STRIDE_RATE);
    CHECK(world_make(&world, &soil, 0.01, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    float* heap = dp_alloc(2 * (size_t)(nx * ny), sizeof(float));
    float* pressed = heap + nx * ny;
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_HEAP, -100, -60, nx, ny, heap) == DP_OK);
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_COMPRESSION, -100, -60, nx, ny, pressed) ==
          DP_OK);
    const double steepest = tan((15.0 + 0.1) * DP_PI / 180.0);
    const double film = 0.1 * tan(0.1 * DP_PI / 180.0) * 0.01;  // counts as at rest anywhere
    double       worst = 0.0;
    for (int j = 1; j < ny - 1; ++j)
        for (int i = 1; i < nx - 1; ++i)
            for (int n = 0; n < 9; ++n) {
                const int    a = j * nx + i, b = a + (n / 3 - 1) * nx + n % 3 - 1;
                const double way = 0.01 * ((n % 2 == 0) ? sqrt(2.0) : 1.0);
                if (a == b || heap[a] <= 0.0f) continue;
                const double fall = (double)(heap[a] - pressed[a]) - (double)(heap[b] - pressed[b]);
                // what may still slide: the steeper part, but no more than the loose soil there
                worst = fmax(worst,
                             fmin((fall - steepest * way) / way, ((double)heap[a] - film) / way));
            }
    printf("  steepest loose slope %.4f over the limit\n", worst);
    CHECK(worst <= 1e-5);
    dp_free(heap);
    world_drop(&world);
    stride_drop(&s);
}

// a sole that rolls from heel to toe through sand leaves no ridges across its print
TEST(rolling_leaves_no_ridges)
{
    DpSoil sand = dp_soil_default();
    sand.young_modulus = 1.0e6f;
    sand.poisson_ratio = 0.5f;
    sand.settle_time = 0.05f;
    sand.rest_angle = (float)(32.0 * DP_PI / 180.0);
    World  world;
    Stride s = stride_make(1, 1, 80.0, STRIDE_RATE);
    CHECK(world_make(&world, &sand, 0.005, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    // along the middle of the print, from the heel to the toes: x 0 to 0.22, y 0.1
    float heap[44], pressed[44];
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_HEAP, 0, 20, 44, 1, heap) == DP_OK);
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_COMPRESSION, 0, 20, 44, 1, pressed) == DP_OK);
    double ridges =
        0.0;  // all that the surface rises on the way, but for the way out of the deepest
    double lowest = 1.0, last = (double)(heap[0] - pressed[0]);
    for (int k = 0; k < 44; ++k) {
        const double at = (double)(heap[k] - pressed[k]);
        ridges += fmax(0.0, at - last);
        lowest = fmin(lowest, at);
        last = at;
    }
    ridges -= last - lowest;
    printf("  deepest %.1f mm, ridges %.1f mm\n", -1e3 * lowest, 1e3 * ridges);
    CHECK(lowest < -0.005);
    CHECK(ridges < 0.1 * -lowest);
    world_drop(&world);
    stride_drop(&s);
}

// 24, 60 and 240 samples a second leave the same volume within 1 %
TEST(rate_does_not_matter)
{
    const DpSoil soil = mud();
    double       volume[3];
    const double rate[3] = {24.0, 60.0, 240.0};
    for (int k = 0; k < 3; ++k) {
        World  world;
        Stride s = stride_make(1, 1, 80.0, rate[k]);
        CHECK(world_make(&world, &soil, 0.01, 1) == DP_OK);
        CHECK(walk(&world, &s) == DP_OK);
        volume[k] = dp_sim_report(world.sim).pressed;
        printf("  %3.0f/s: %.4f l\n", rate[k], 1e3 * volume[k]);
        world_drop(&world);
        stride_drop(&s);
    }
    CHECK_CLOSE(volume[1], volume[2], 0.01);
}

// ten kilometres away from the origin, and back: memory follows the walk
TEST(wide_ground_costs_nothing)
{
    const DpSoil soil = mud();
    dp_bytes_peak_reset();
    World  world;
    Stride s = stride_make(1, 14, 80.0, STRIDE_RATE);
    for (int p = 0; p < s.gait.parts; ++p)
        for (int t = 0; t < s.gait.times; ++t) {
            s.pose[7 * (p * s.gait.times + t)] += 9990.0;
            s.pose[7 * (p * s.gait.times + t) + 1] -= 9990.0;
            s.point[3 * (p * s.gait.times + t)] += 9990.0;
            s.point[3 * (p * s.gait.times + t) + 1] -= 9990.0;
        }
    CHECK(world_make(&world, &soil, 0.01, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    const double mb = (double)dp_bytes_peak() / 1048576.0;
    printf("  %.1f MB for %d steps\n", mb, dp_sim_report(world.sim).contacts);
    CHECK(mb < 64.0);
    world_drop(&world);
    stride_drop(&s);
}

// memory that ends at any point is a status, and nothing leaks
TEST(no_memory_is_a_status)
{
    const DpSoil soil = mud();
    Stride       s = stride_make(1, 1, 80.0, 60.0);
    int          refused = 0;
    for (long k = 0; k < 200; ++k) {
        World world;
        dp_alloc_fail_after(k);
        DpStatus status = world_make(&world, &soil, 0.02, 2);
        if (status == DP_OK) status = walk(&world, &s);
        dp_alloc_fail_after(-1);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
        refused += status == DP_NO_MEMORY;
        world_drop(&world);
    }
    CHECK(refused > 20);
    stride_drop(&s);
}

TEST(bad_recordings_are_refused)
{
    const DpSoil soil = mud();
    World        world;
    Stride       s = stride_make(1, 1, 80.0, 60.0);
    CHECK(world_make(&world, &soil, 0.02, 1) == DP_OK);
    s.pose[11] = NAN;
    CHECK(walk(&world, &s) == DP_BAD_ARGUMENT);
    s.pose[11] = 0.0;
    s.time[3] = s.time[2];
    CHECK(walk(&world, &s) == DP_BAD_ARGUMENT);
    s.time[3] = 3.0 / 60.0;
    s.part_limb[0] = 7;
    CHECK(walk(&world, &s) == DP_BAD_ARGUMENT);
    s.part_limb[0] = 0;
    s.pose[0] = 1e12;  // no cell has a number there
    CHECK(walk(&world, &s) == DP_BAD_ARGUMENT);
    s.pose[0] = 0.0, s.pose[3] = 2.0;
    CHECK(walk(&world, &s) == DP_BAD_ARGUMENT);
    s.pose[3] = 1.0;
    s.mass[0] = 0.0;
    CHECK(walk(&world, &s) == DP_BAD_ARGUMENT);
    CHECK(dp_sim_run(world.sim, 1) == DP_BAD_ARGUMENT);
    world_drop(&world);
    stride_drop(&s);
}

int main(void)
{
    RUN(ledger_balances);
    RUN(workers_do_not_matter);
    RUN(everything_rests);
    RUN(rolling_leaves_no_ridges);
    RUN(rate_does_not_matter);
    RUN(wide_ground_costs_nothing);
    RUN(no_memory_is_a_status);
    RUN(bad_recordings_are_refused);
    return check_done();
}
