// What must hold of steps that are worked out ahead: they are the steps made in turn, to the bit,
// whether plants break under them or not, wherever a run ends.
#include "sim/planted.h"
#include "sim/sim_inside.h"

#define SIDE 300
#define CELLS ((size_t)SIDE * SIDE)

// the ground after a walk of `walkers` over a lawn, run `stride` samples at a time
static float* ground_after(const DpPlantKind* kind, const Stride* s, int workers, int stride,
                           long* broke)
{
    World  world;
    float* grid = dp_alloc(3 * CELLS, sizeof(float));
    CHECK(grid != NULL);
    CHECK(world_make(&world, kind, -0.5, -0.5, 2.5, 0.07, 0.01, workers) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s->gait, s->touching, s->force, s->point) == DP_OK);
    for (int at = 0; at < s->gait.times - 1; at += stride)
        CHECK(dp_sim_run(world.sim, at) == DP_OK);
    CHECK(dp_sim_run(world.sim, s->gait.times - 1) == DP_OK);
    CHECK(dp_sim_settle(world.sim) == DP_OK);
    const DpField field[3] = {DP_FIELD_COMPRESSION, DP_FIELD_HEAP, DP_FIELD_PLANT_STRENGTH};
    for (size_t f = 0; f < 3; ++f)
        CHECK(dp_terrain_read(world.terrain, field[f], -60, -60, SIDE, SIDE, grid + f * CELLS) ==
              DP_OK);
    *broke = dp_sim_report(world.sim).broke;
    world_drop(&world);
    return grid;
}

// stems that break in any step change the soil of the next one
TEST(what_breaks_counts_in_the_next_step)
{
    DpPlantKind brittle = dp_plant_kind_default();
    brittle.strength = 0.05f, brittle.degrade_rate = 1.0f, brittle.spread = 1.5f;
    Stride    s = stride_make(2, 3, 80.0, 60.0);
    long      broke, same;
    float*    turn = ground_after(&brittle, &s, 1, 1, &broke);
    const int workers[4] = {2, 2, 3, 8}, stride[4] = {1, 1000, 7, 1000};
    CHECK(broke > 200);
    for (int run = 0; run < 4; ++run) {
        float* ahead = ground_after(&brittle, &s, workers[run], stride[run], &same);
        CHECK(same == broke);
        CHECK(memcmp(turn, ahead, 3 * CELLS * sizeof(float)) == 0);
        dp_free(ahead);
    }
    dp_free(turn);
    stride_drop(&s);
}

// a step that was worked out ahead can be taken, or dropped with its limbs as they were planned
TEST(a_step_ahead_is_taken_or_dropped)
{
    const DpPlantKind kind = dp_plant_kind_default();
    Stride            s = stride_make(1, 2, 80.0, 60.0);
    World             world;
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.5, 0.1, 0.01, 2) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_sim_run(world.sim, 12) == DP_OK);
    DpSim* sim = world.sim;
    for (int drops = 1; drops >= 0; --drops) {
        int limbs = 0;
        CHECK(dp_speculate_open(sim, 12, &limbs) == DP_OK);
        CHECK(limbs == 1);
        const Limb planned = *sim->speculation.limb[0];
        Limb*      limb = sim->speculation.limb[0];
        dp_speculate_press(sim, 12, 0, &sim->scratch[0]);
        CHECK(limb->firm > 0.0 && sim->speculation.status[0] == DP_OK);
        dp_speculate_worn(sim, 50.0, 50.0, 51.0, 51.0);  // far away
        CHECK(sim->speculation.count == 1);
        if (drops) dp_speculate_worn(sim, -1.0, -1.0, 2.0, 2.0);
        CHECK((limb->firm > 0.0) == !drops);
        CHECK(!drops || memcmp(&planned, limb, sizeof planned) == 0);
        CHECK(dp_speculate_take(sim) == !drops);
        if (drops) limb->stands = true;
    }
    world_drop(&world);
    stride_drop(&s);
}

int main(void)
{
    RUN(what_breaks_counts_in_the_next_step);
    RUN(a_step_ahead_is_taken_or_dropped);
    return check_done();
}
