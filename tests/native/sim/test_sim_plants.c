// What must hold of plants on trodden ground: roots hold the soil, nothing lies in the ground or
// in a sole, threads and memory do not matter, and cost follows the feet.
#include "base/vec.h"
#include "sim/planted.h"
#include "sim/sim_inside.h"

static DpPlantKind tough(void)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.break_angle = 10.0f, kind.degrade_rate = 0.0f;
    return kind;
}

TEST(roots_hold_the_soil_and_brittle_ones_let_go)
{
    DpPlantKind  brittle = tough(), whole = tough();
    const Stride one = stride_make(1, 2, 80.0, 60.0);
    Stride       s = one;
    double       deepest[3];
    brittle.break_angle = brittle.degrade_angle;
    for (int run = 0; run < 3; ++run) {
        const DpPlantKind* kind = run == 0 ? NULL : run == 1 ? &brittle : &whole;
        World              world;
        CHECK(world_make(&world, kind, -0.5, -0.7, 1.8, 0.09, 0.01, 1) == DP_OK);
        CHECK(walk(&world, &s) == DP_OK);
        const DpSimReport r = dp_sim_report(world.sim);
        deepest[run] = r.deepest;
        CHECK((r.broke > 0) == (run == 1));
        world_drop(&world);
    }
    printf("  bare %.2f, brittle %.2f, tough %.2f mm\n", 1e3 * deepest[0], 1e3 * deepest[1],
           1e3 * deepest[2]);
    CHECK(deepest[2] < 0.3 * deepest[0]);
    CHECK(deepest[1] > 1.1 * deepest[2] && deepest[1] < deepest[0]);
    stride_drop(&s);
}

// every particle, at every sample: over the surface, and not between a sole's underside and its top
TEST(nothing_lies_in_the_ground_or_in_a_sole)
{
    const DpPlantKind  kind = tough();
    const DpPlantShape shape = dp_plant_shape(&kind);
    const float        half[2] = {0.28f / 2, 0.10f / 2};
    Stride             s = stride_make(1, 1, 80.0, 60.0);
    World              world;
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.3, 0.08, 0.01, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    float* at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    double lowest = 1.0, under = -1.0;
    int    flat = 0;
    for (int t = 1; t < s.gait.times; ++t) {
        CHECK(dp_sim_run(world.sim, t) == DP_OK);
        for (int k = 0; k < world.grown; ++k) {
            dp_plants_read(world.plants, world.stand, k, at, NULL, NULL);
            for (int p = 0; p < shape.particles; ++p) {
                if (p % shape.rows == 0) continue;  // the root is in the ground
                const float* x = at + 3 * p;
                const long   i = (long)floorf(x[0] / 0.01f), j = (long)floorf(x[1] / 0.01f);
                float        pressed[9], heap[9], low = 1.0f;
                dp_terrain_read(world.terrain, DP_FIELD_COMPRESSION, i - 1, j - 1, 3, 3, pressed);
                dp_terrain_read(world.terrain, DP_FIELD_HEAP, i - 1, j - 1, 3, 3, heap);
                for (int n = 0; n < 9; ++n) low = fminf(low, heap[n] - pressed[n]);
                const double surface = (double)(heap[4] - pressed[4]);
                lowest = fmin(lowest, (double)(x[2] - low));  // cells are steps, plants see slopes
                // at t = 0.3 s the sole is flat on what it has pressed: middle of the print
                const bool stands = t >= 12 && t <= 18;
                const bool below =
                    fabsf(x[0] - 0.12f) < half[0] - 0.04f && fabsf(x[1] - 0.1f) < half[1] - 0.02f;
                if (!stands || !below) continue;
                under = fmax(under, (double)x[2] - surface), ++flat;
            }
        }
    }
    printf("  lowest %.2f mm over the surface, %d seen under the sole, highest %.2f mm\n",
           1e3 * lowest, flat, 1e3 * under);
    CHECK(lowest > -1e-5);
    CHECK(flat > 20 && under < 2.5e-3);
    dp_free(at);
    world_drop(&world);
    stride_drop(&s);
}

TEST(workers_do_not_matter)
{
    const DpPlantKind kind = dp_plant_kind_default();
    const int         nx = 300, ny = 300;
    const size_t      cells = (size_t)nx * (size_t)ny;
    float*            grid[3];
    Stride            s = stride_make(2, 3, 80.0, 60.0);
    for (int run = 0; run < 3; ++run) {
        World world;
        CHECK(world_make(&world, &kind, -0.5, -0.5, 2.5, 0.1, 0.01, 1 << run) == DP_OK);
        CHECK(walk(&world, &s) == DP_OK);
        grid[run] = dp_alloc(5 * cells, sizeof(float));
        const DpField field[2] = {DP_FIELD_COMPRESSION, DP_FIELD_PLANT_STRENGTH};
        for (size_t f = 0; f < 2; ++f)
            CHECK(dp_terrain_read(world.terrain, field[f], -60, -60, nx, ny,
                                  grid[run] + f * cells) == DP_OK);
        dp_grass_read(dp_sim_grass(world.sim), -60, -60, nx, ny, grid[run] + 2 * cells,
                      grid[run] + 3 * cells, grid[run] + 4 * cells);
        world_drop(&world);
    }
    float most = 0.0f;
    for (size_t k = 4 * cells; k < 5 * cells; ++k) most = fmaxf(most, grid[0][k]);
    CHECK(most > 0.2f);
    for (int run = 1; run < 3; ++run)
        CHECK(memcmp(grid[0], grid[run], 5 * cells * sizeof(float)) == 0);
    for (int run = 0; run < 3; ++run) dp_free(grid[run]);
    stride_drop(&s);
}

// a foot that is put elsewhere sweeps nothing on the way, and all stays a number
TEST(feet_that_jump_touch_nothing_between)
{
    const DpPlantKind kind = tough();
    Stride            s = stride_make(1, 1, 80.0, 60.0);
    World             world;
    for (int p = 0; p < s.gait.parts; ++p)
        for (int t = 0; t < s.gait.times; ++t) {
            const size_t k = (size_t)(p * s.gait.times + t);
            s.touching[k] = 0;
            memset(s.force + 3 * k, 0, 3 * sizeof(double));
            s.pose[7 * k] = t < 10 ? -5.0 : 5.0, s.pose[7 * k + 1] = 0.0, s.pose[7 * k + 2] = 0.02;
        }
    CHECK(world_make(&world, &kind, -1.0, -1.0, 2.0, 0.1, 0.01, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    CHECK(dp_sim_report(world.sim).awake == 0);
    float lean[3] = {1.0f, 1.0f, 1.0f};
    dp_grass_read(dp_sim_grass(world.sim), 0, 0, 1, 1, &lean[0], &lean[1], &lean[2]);
    CHECK(!(lean[0] > 0.0f) && !(lean[2] > 0.0f));
    dp_grass_read(dp_sim_grass(world.sim), 500, 0, 1, 1, &lean[0], &lean[1], &lean[2]);
    CHECK(!(lean[2] > 0.0f));  // no plants there
    CHECK(dp_terrain_tile_count(world.terrain) < 30);
    world_drop(&world);
    stride_drop(&s);
}

// a foot that is put elsewhere while it stands in its print rises out of it unfelt: its soles push nothing aside
TEST(a_sole_that_jumps_does_not_move)
{
    const DpPlantKind kind = tough();
    Stride            s = stride_make(1, 1, 80.0, 60.0);
    World             world;
    const int         jump = 16;
    for (int p = 0; p < s.gait.parts; ++p)
        for (int t = jump; t < s.gait.times; ++t) {
            const size_t k = (size_t)(p * s.gait.times + t);
            s.pose[7 * k] += 0.6, s.touching[k] = 0;
            memset(s.force + 3 * k, 0, 3 * sizeof(double));
        }
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.8, 0.1, 0.01, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_sim_run(world.sim, jump - 1) == DP_OK);
    const double was = world.sim->limb[0].lowered;
    CHECK(was > 1e-3);
    CHECK(dp_sim_run(world.sim, jump) == DP_OK);
    CHECK(fabs(world.sim->limb[0].lowered - was) > 1e-4);
    CHECK(world.sim->stage.soles > 0);
    for (int k = 0; k < world.sim->stage.soles; ++k)
        CHECK(dp_length(world.sim->stage.sole[k].velocity) == 0.0);
    world_drop(&world);
    stride_drop(&s);
}

TEST(odd_plants_and_long_steps_stay_numbers)
{
    for (int run = 0; run < 2; ++run) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.height = run == 0 ? 0.0f : kind.height;
        Stride s = stride_make(1, 2, 80.0, run == 0 ? 60.0 : 1.0);
        World  world;
        float  grid[4][100 * 60];
        CHECK(world_make(&world, &kind, -0.5, -0.5, 1.6, 0.08, 0.02, 1) == DP_OK);
        CHECK(walk(&world, &s) == DP_OK);
        CHECK(dp_terrain_read(world.terrain, DP_FIELD_PLANT_STRENGTH, -25, -25, 100, 60, grid[0]) ==
              DP_OK);
        dp_grass_read(dp_sim_grass(world.sim), -25, -25, 100, 60, grid[1], grid[2], grid[3]);
        bool good = true;
        for (int k = 0; k < 4 * 100 * 60; ++k)
            good = good && fabsf(grid[k / 6000][k % 6000]) <= 1.0f;
        CHECK(good);
        world_drop(&world);
        stride_drop(&s);
    }
}

// a lawn out of reach: nobody wakes, and the ground stays as bare ground would
TEST(cost_follows_the_feet)
{
    const DpPlantKind kind = dp_plant_kind_default();
    Stride            s = stride_make(1, 4, 80.0, 60.0);
    World             world;
    CHECK(world_make(&world, &kind, -1.0, -1.0, 15.0, 0.1, 0.01, 1) == DP_OK);
    CHECK(world.grown == 150 * 150);
    CHECK(dp_terrain_tile_count(world.terrain) == 0);
    int most = 0;
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    for (int t = 1; t < s.gait.times; ++t) {
        CHECK(dp_sim_run(world.sim, t) == DP_OK);
        const int awake = dp_sim_report(world.sim).awake;
        most = awake > most ? awake : most;
    }
    printf("  at most %d of %d plants awake, %zu tiles\n", most, world.grown,
           dp_terrain_tile_count(world.terrain));
    CHECK(most > 20 && most < 500);
    CHECK(dp_terrain_tile_count(world.terrain) < 40);
    world_drop(&world);
    stride_drop(&s);
}

// grass that was trodden into prints with rims lies still there
// once all has come to rest nothing that lies there is in the ground, though its rims slid
TEST(rims_come_to_rest_under_what_lies_there)
{
    DpPlantKind kind = tough();
    kind.height = 0.3f, kind.spacing = 0.04f, kind.sway = 0.5f, kind.damping = 30.0f;
    const DpPlantShape shape = dp_plant_shape(&kind);
    Stride             s = stride_make(1, 2, 80.0, 60.0);
    World              world;
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.6, 0.05, 0.01, 2) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_sim_run(world.sim, s.gait.times / 2) == DP_OK);  // with a foot down
    CHECK(dp_sim_settle(world.sim) == DP_OK);
    float* at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    double lowest = 1.0;
    int    lying = 0;
    for (int k = 0; k < world.grown; ++k) {
        dp_plants_read(world.plants, world.stand, k, at, NULL, NULL);
        for (int p = 0; p < shape.particles; ++p) {
            if (p % shape.rows < 2) continue;
            const float* x = at + 3 * p;
            const double over =
                (double)x[2] - dp_terrain_surface_at(world.terrain, (double)x[0], (double)x[1]);
            lowest = fmin(lowest, over), lying += over < 0.01;
        }
    }
    printf("  lowest %.3f mm over the surface, %d lie\n", 1e3 * lowest, lying);
    CHECK(lowest > -2e-5 && lying > 50);
    dp_free(at);
    world_drop(&world);
    stride_drop(&s);
}

TEST(trodden_grass_comes_to_rest)
{
    DpPlantKind kind = dp_plant_kind_default();
    Stride      s = stride_make(1, 2, 80.0, 60.0), away = stride_make(1, 10, 80.0, 60.0);
    World       world;
    kind.break_angle = 0.5f;
    for (int p = 0; p < away.gait.parts; ++p)
        for (int t = 0; t < away.gait.times; ++t) {
            const size_t k = (size_t)(p * away.gait.times + t);
            away.pose[7 * k + 2] = 5.0, away.touching[k] = 0;
            memset(away.force + 3 * k, 0, 3 * sizeof(double));
        }
    CHECK(world_make(&world, &kind, -0.5, -0.7, 1.8, 0.11, 0.01, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    const int before = dp_sim_report(world.sim).awake;
    CHECK(walk(&world, &away) == DP_OK);  // five seconds in the air
    const DpSimReport r = dp_sim_report(world.sim);
    printf("  %d plants awake, then %d; %ld bends broken, %.1f mm deep\n", before, r.awake, r.broke,
           1e3 * r.deepest);
    CHECK(before > 20 && r.broke > 100 && r.deepest > 0.005);
    CHECK(r.awake == 0);
    world_drop(&world);
    stride_drop(&s), stride_drop(&away);
}

TEST(rest_grows_what_broke)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.break_angle = kind.degrade_angle;
    Stride s = stride_make(1, 1, 80.0, 60.0);
    World  world;
    float  worn, grown, crushed[2];
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.6, 0.08, 0.01, 1) == DP_OK);
    CHECK(walk(&world, &s) == DP_OK);
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_PLANT_STRENGTH, 16, 9, 1, 1, &worn) == DP_OK);
    dp_grass_read(dp_sim_grass(world.sim), 16, 9, 1, 1, NULL, NULL, &crushed[0]);
    CHECK(dp_sim_pass_time(world.sim, 50.0 * 365.25 * 86400.0) == DP_OK);
    CHECK(dp_terrain_read(world.terrain, DP_FIELD_PLANT_STRENGTH, 16, 9, 1, 1, &grown) == DP_OK);
    dp_grass_read(dp_sim_grass(world.sim), 16, 9, 1, 1, NULL, NULL, &crushed[1]);
    printf("  cover %.2f, after 50 years %.2f; crushed %.2f, %.2f\n", (double)worn, (double)grown,
           (double)crushed[0], (double)crushed[1]);
    CHECK(worn < 0.6f && grown > 0.99f);
    CHECK(crushed[0] > 0.3f && crushed[1] < 0.02f);
    world_drop(&world);
    stride_drop(&s);
}

TEST(no_memory_is_a_status)
{
    const DpPlantKind kind = dp_plant_kind_default();
    Stride            s = stride_make(1, 1, 80.0, 30.0);
    int               refused = 0;
    for (long k = 0; k < 260; k += k < 120 ? 1 : 7) {
        World world;
        dp_alloc_fail_after(k);
        DpStatus status = world_make(&world, &kind, -0.3, -0.1, 0.8, 0.1, 0.02, 1);
        if (status == DP_OK) status = walk(&world, &s);
        dp_alloc_fail_after(-1);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
        refused += status == DP_NO_MEMORY;
        world_drop(&world);
    }
    CHECK(refused > 60);
    stride_drop(&s);
}

// soles that have let go rise from their prints to where they were recorded, as exp(-t / 0.1 s)
TEST(soles_rise_from_their_prints)
{
    const DpPlantKind kind = dp_plant_kind_default();
    Stride            s = stride_make(1, 2, 80.0, STRIDE_RATE);
    World             world;
    int               stood = 0, rose = 0;
    CHECK(world_make(&world, &kind, -0.2, -0.3, 0.8, 0.2, 0.02, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    for (int k = 1; k < s.gait.times; ++k) {
        const double was = world.sim->limb[0].lowered;
        CHECK(dp_sim_run(world.sim, k) == DP_OK);
        const Limb* limb = &world.sim->limb[0];
        if (limb->stands)
            CHECK_NEAR(limb->lowered, limb->sink, 0.0);
        else
            CHECK_NEAR(limb->lowered, was * exp(-1.0 / STRIDE_RATE / 0.1), 1e-12);
        stood += limb->stands && limb->lowered > 0.002;
        rose += !limb->stands && was > 1e-4;
    }
    CHECK(stood > 20 && rose > 10);
    world_drop(&world);
    stride_drop(&s);
}

// a sole that was recorded over the ground, higher than plants are, meets them where it is lowered to
TEST(plants_are_met_where_the_sole_stands)
{
    const DpPlantKind kind = tough();
    Stride            s = stride_make(1, 1, 80.0, 60.0);
    World             world;
    for (int p = 0; p < s.gait.parts; ++p)
        for (int t = 0; t < s.gait.times; ++t) s.pose[7 * (p * s.gait.times + t) + 2] += 0.25;
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.3, 0.08, 0.01, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_sim_run(world.sim, 16) == DP_OK);  // in the middle of the stance
    CHECK(world.sim->stage.extent < 0.25 && world.sim->limb[0].lowered > 0.25);
    CHECK(world.sim->stage.soles > 0 && dp_sim_report(world.sim).awake > 0);
    world_drop(&world);
    stride_drop(&s);
}

int main(void)
{
    RUN(roots_hold_the_soil_and_brittle_ones_let_go);
    RUN(nothing_lies_in_the_ground_or_in_a_sole);
    RUN(workers_do_not_matter);
    RUN(feet_that_jump_touch_nothing_between);
    RUN(a_sole_that_jumps_does_not_move);
    RUN(odd_plants_and_long_steps_stay_numbers);
    RUN(cost_follows_the_feet);
    RUN(rims_come_to_rest_under_what_lies_there);
    RUN(trodden_grass_comes_to_rest);
    RUN(rest_grows_what_broke);
    RUN(no_memory_is_a_status);
    RUN(soles_rise_from_their_prints);
    RUN(plants_are_met_where_the_sole_stands);
    return check_done();
}
