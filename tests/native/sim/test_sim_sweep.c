// What must hold of soles that are cast ahead: they are those of their step, to the bit.
#include "base/vec.h"
#include "sim/planted.h"
#include "sim/sim_inside.h"

TEST(cast_ahead_is_cast_in_turn)
{
    const DpPlantKind kind = dp_plant_kind_default();
    Stride            s = stride_make(1, 2, 80.0, 60.0);
    World             world[2];
    int               cast = 0;
    for (int w = 0; w < 2; ++w) {
        CHECK(world_make(&world[w], &kind, -0.5, -0.5, 1.5, 0.1, 0.01, 2) == DP_OK);
        CHECK(dp_sim_load(world[w].sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    }
    for (int sample = 0; sample + 1 < s.gait.times; ++sample)
        for (int part = 0; part < s.gait.parts; ++part) {
            DpImprintScratch* scratch = world[0].sim->scratch[0].imprint_scratch;
            dp_sweep_ahead(world[0].sim, part, sample, scratch);  // knows where the part was
            SweptSole* ahead = dp_sweep_path(world[0].sim, part, sample);
            if (!ahead->cast) continue;
            SweptSole* turn = dp_sweep_path(world[1].sim, part, sample);
            turn->sample = -1;  // and this one asks anew
            CHECK(dp_sweep_cast(world[1].sim, turn, part, scratch) == DP_OK);
            const size_t cells =
                (size_t)((ahead->at.i1 - ahead->at.i0) * (ahead->at.j1 - ahead->at.j0));
            CHECK(memcmp(&ahead->at, &turn->at, sizeof ahead->at) == 0);
            CHECK(memcmp(&ahead->from, &turn->from, sizeof ahead->from) == 0);
            CHECK(memcmp(ahead->imprint.bottom, turn->imprint.bottom, cells * sizeof(float)) == 0);
            ++cast;
        }
    CHECK(cast > 100);
    for (int w = 0; w < 2; ++w) world_drop(&world[w]);
    stride_drop(&s);
}

// what is far over all plants is not worth it, and a part that was put elsewhere sweeps nothing
TEST(high_soles_wait_and_jumps_sweep_nothing)
{
    const DpPlantKind kind = dp_plant_kind_default();
    Stride            s = stride_make(1, 1, 80.0, 60.0);
    World             world;
    for (int p = 0; p < s.gait.parts; ++p) {
        double* at = s.pose + 7 * (size_t)p * (size_t)s.gait.times;
        at[7 * 5 + 2] += 3.0;  // one sample, three metres up
    }
    CHECK(world_make(&world, &kind, -0.5, -0.5, 1.5, 0.1, 0.01, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    dp_sweep_ahead(world.sim, 0, 4, world.sim->scratch[0].imprint_scratch);
    const SweptSole* high = dp_sweep_path(world.sim, 0, 4);
    CHECK(high->jumps && !high->cast);
    CHECK(dp_length(high->displacement) <= 0.0);
    CHECK_NEAR(high->from.z0, high->to.z0, 1e-12);
    world_drop(&world);
    stride_drop(&s);
}

// 25 m/s is the fastest a sole goes; faster it was put elsewhere
TEST(fast_soles_sweep_and_faster_ones_jump)
{
    const DpPlantKind kind = dp_plant_kind_default();
    const double      speed[4] = {1.0, 24.0, -24.0, 26.0};
    for (int k = 0; k < 4; ++k) {
        Stride  s = stride_make(1, 1, 80.0, 60.0);
        World   world;
        double* at = s.pose + 7 * 4;  // of part 0 from one sample to the next
        memcpy(at + 7, at, 7 * sizeof *at);
        at[7] += speed[k] / 60.0;
        CHECK(world_make(&world, &kind, -0.5, -0.5, 1.5, 0.1, 0.01, 1) == DP_OK);
        CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
        const SweptSole* swept = dp_sweep_path(world.sim, 0, 4);
        CHECK(swept->jumps == (k == 3));
        CHECK_NEAR(swept->displacement.x, k == 3 ? 0.0 : speed[k] / 60.0, 1e-9);
        CHECK_NEAR(swept->to.x0 - swept->from.x0, k == 3 ? 0.0 : speed[k] / 60.0, 1e-9);
        CHECK_NEAR(swept->low, fmin(swept->from.z0, swept->to.z0), 1e-12);
        CHECK_NEAR(swept->ground, 0.0, 1e-9);
        world_drop(&world);
        stride_drop(&s);
    }
}

int main(void)
{
    RUN(cast_ahead_is_cast_in_turn);
    RUN(high_soles_wait_and_jumps_sweep_nothing);
    RUN(fast_soles_sweep_and_faster_ones_jump);
    return check_done();
}
