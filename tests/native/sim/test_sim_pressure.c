// What the soles press with now: it carries the load, is the same worked out ahead and in turn, and
// is gone with the foot.
#include "sim/planted.h"
#include "sim/sim_inside.h"

#define SIDE 300

static float now[2][SIDE * SIDE];

static double load_at(const Stride* s, int sample)
{
    double load = 0.0;
    for (int p = 0; p < s->gait.parts; ++p)
        load -= s->force[3 * ((size_t)p * (size_t)s->gait.times + (size_t)sample) + 2];
    return load;
}

static double carried(const float* pressure)
{
    double sum = 0.0;
    for (int n = 0; n < SIDE * SIDE; ++n) sum += (double)pressure[n];
    return 1e-4 * sum;
}

TEST(pressure_carries_the_load_for_any_number_of_workers)
{
    DpPlantKind brittle = dp_plant_kind_default();
    brittle.strength = 0.05f, brittle.degrade_rate = 1.0f;
    Stride s = stride_make(2, 3, 80.0, 60.0);
    World  world[2];
    int    stood = 0;
    for (int w = 0; w < 2; ++w) {
        CHECK(world_make(&world[w], &brittle, -0.5, -0.5, 2.5, 0.07, 0.01, w ? 8 : 1) == DP_OK);
        CHECK(dp_sim_load(world[w].sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    }
    for (int at = 5; at < s.gait.times; at += 5) {
        for (int w = 0; w < 2; ++w) {
            CHECK(dp_sim_run(world[w].sim, at) == DP_OK);
            dp_sim_pressure(world[w].sim, -60, -60, SIDE, SIDE, now[w]);
        }
        CHECK(memcmp(now[0], now[1], sizeof now[0]) == 0);
        const double before = load_at(&s, at - 1), then = load_at(&s, at), sum = carried(now[0]);
        CHECK(sum <= fmax(before, then) * (1.0 + 1e-5));  // less on a first touch, a needle's
        if (fmin(before, then) > 400.0) {
            CHECK(sum >= fmin(before, then) * (1.0 - 1e-5));
            ++stood;
        }
    }
    CHECK(stood > 5);
    CHECK(carried(now[0]) == 0.0);  // both have gone
    for (int w = 0; w < 2; ++w) world_drop(&world[w]);
    stride_drop(&s);
}

// soles that share a cell share its load: what they press with adds
TEST(soles_on_one_cell_add)
{
    Stride s = stride_make(1, 2, 80.0, 60.0);
    World  world;
    float  out[6 * 4];
    CHECK(world_make(&world, NULL, 0, 0, 0, 0, 0.01, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_sim_run(world.sim, 1) == DP_OK);
    for (int l = 0; l < 2; ++l) {  // cells 10 + l .. 12 + l, of a row of four
        Pressing* pressing = &world.sim->pressing[l];
        CHECK(dp_make_room(&pressing->value, 8, sizeof *pressing->value));
        for (int k = 0; k < 8; ++k) pressing->value[k] = (float)((l + 1) * (1 + k));
        pressing->at = (DpCellRect){10 + l, 13 + l, 5, 7};
        pressing->i0 = 10 + l, pressing->j0 = 5, pressing->row = 4;
    }
    dp_sim_pressure(world.sim, 9, 4, 6, 4, out);
    const float row[2][6] = {{0, 1, 2 + 2, 3 + 4, 6, 0}, {0, 5, 6 + 10, 7 + 12, 14, 0}};
    for (int i = 0; i < 6; ++i) {
        CHECK(out[i] == 0.0f && out[18 + i] == 0.0f);
        CHECK(out[6 + i] == row[0][i] && out[12 + i] == row[1][i]);
    }
    world_drop(&world);
    stride_drop(&s);
}

static void count_tile(void* context, long tx, long ty)
{
    (void)tx, (void)ty;
    ++*(int*)context;
}

TEST(settled_ground_bears_nothing)
{
    Stride s = stride_make(1, 2, 80.0, 60.0);
    World  world;
    int    tiles = 0;
    CHECK(world_make(&world, NULL, -0.5, -0.5, 2.5, 0.07, 0.01, 1) == DP_OK);
    dp_sim_soles(world.sim, count_tile, &tiles);  // before anything is loaded
    CHECK(tiles == 0);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_sim_run(world.sim, 18) == DP_OK);
    dp_sim_soles(world.sim, count_tile, &tiles);
    CHECK(tiles > 0);
    CHECK(dp_sim_settle(world.sim) == DP_OK);
    dp_sim_pressure(world.sim, -60, -60, SIDE, SIDE, now[0]);
    CHECK(carried(now[0]) == 0.0);
    tiles = 0;
    dp_sim_soles(world.sim, count_tile, &tiles);
    CHECK(tiles == 0);
    world_drop(&world);
    stride_drop(&s);
}

int main(void)
{
    RUN(soles_on_one_cell_add);
    RUN(pressure_carries_the_load_for_any_number_of_workers);
    RUN(settled_ground_bears_nothing);
    return check_done();
}
