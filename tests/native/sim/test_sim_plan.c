// Which limbs are worked on in turn, since their patches meet, and which at once.
#include "check.h"
#include "sim/planted.h"
#include "sim/stand.h"
#include "sim/sim_inside.h"

// every active limb is in one group, in the order of its number; a group is of those that meet
static void check_groups(const DpSim* sim, int want)
{
    int active = 0, members = 0;
    for (int l = 0; l < sim->cast.limbs; ++l) active += sim->limb[l].active;
    CHECK(sim->groups == want);
    for (int g = 0; g < sim->groups; ++g)
        for (int k = sim->start[g]; k < sim->start[g + 1]; ++k) {
            CHECK(sim->limb[sim->order[k]].active);
            CHECK(k == sim->start[g] || sim->order[k] > sim->order[k - 1]);
            ++members;
        }
    CHECK(members == active && active > 0);
    for (int g = 0; g < sim->groups; ++g)
        for (int h = 0; h < g; ++h)
            for (int k = sim->start[g]; k < sim->start[g + 1]; ++k)
                for (int n = sim->start[h]; n < sim->start[h + 1]; ++n)
                    CHECK(!dp_cells_meet(sim->limb[sim->order[k]].patch,
                                         sim->limb[sim->order[n]].patch));
}

// walkers side by side, a metre apart: their feet share columns, but no cells
TEST(who_walks_beside_is_worked_on_at_once)
{
    Stride s = stride_make(3, 2, 80.0, 60.0);
    World  world;
    CHECK(world_make(&world, NULL, 0, 0, 0, 0, 0.01, 1) == DP_OK);
    CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
    CHECK(dp_step_plan(world.sim, 10) == DP_OK);  // one foot of each stands
    check_groups(world.sim, 3);
    world_drop(&world);
    stride_drop(&s);
}

// whichever of two feet is farther to the left, and whoever walks beside
TEST(feet_that_meet_are_worked_on_in_turn)
{
    for (int side = 0; side < 2; ++side) {
        Stride    s = stride_make(3, 2, 80.0, 60.0);
        World     world;
        const int both = 33;  // at which both feet stand, 0.7 m apart
        for (int p = 0; p < s.gait.parts; ++p)
            for (int t = 0; p / 2 % 2 == 1 && t < s.gait.times; ++t)  // of the right feet
                s.pose[7 * (p * s.gait.times + t)] -= side ? 0.75 : 0.65;
        CHECK(world_make(&world, NULL, 0, 0, 0, 0, 0.01, 1) == DP_OK);
        CHECK(dp_sim_load(world.sim, &s.gait, s.touching, s.force, s.point) == DP_OK);
        CHECK(dp_step_plan(world.sim, both) == DP_OK);
        CHECK(world.sim->limb[0].active && world.sim->limb[1].active);
        CHECK((world.sim->limb[1].patch.i0 < world.sim->limb[0].patch.i0) == (side == 1));
        check_groups(world.sim, 3);
        world_drop(&world);
        stride_drop(&s);
    }
}

// room around a sole of 10 x 10 cm: for heaps two fifths of its length, more where the ground bulges, and for as far as
// soles may slip
TEST(patches_have_room_for_what_their_soils_do)
{
    static Stand stand;
    DpSoil soil[4] = {dp_soil_default(), dp_soil_default(), dp_soil_default(), dp_soil_default()};
    const double heap = 0.4 * hypot(0.1, 0.1);
    const double room[4] = {heap, heap + DP_MAX_SLIP, 4.0 * 0.05 + 4.0 * CELL, 1.0 + 4.0 * CELL};
    soil[1].shear_modulus = 0.01f;
    soil[2].heave = 0.05f;
    soil[3].heave = 0.3f;  // a metre at most
    for (int k = 0; k < 4; ++k) {
        stand_make(&stand, 1);
        stand_on(&stand, 0, 0, 50, 0.055, 0.055, 500.0);
        stand_load(&stand, &soil[k], dp_sim_options_default());
        CHECK(dp_step_plan(stand.sim, 1) == DP_OK);
        const Limb*  limb = &stand.sim->limb[0];
        const double low = 0.005 - room[k], high = 0.105 + room[k];  // of its box, and beside it
        CHECK(limb->active);
        CHECK(limb->patch.i0 == (long)floor(low / CELL) &&
              limb->patch.i1 == (long)ceil(high / CELL));
        CHECK(limb->patch.j0 == (long)floor(low / CELL) &&
              limb->patch.j1 == (long)ceil(high / CELL));
        stand_drop(&stand);
    }
}

// `uniform` presses the ground as its stance met it: cell by cell what lay there before its first step
TEST(a_stance_meets_the_ground_as_it_was)
{
    enum
    {
        I0 = -40,
        SIDE = 100
    };
    static Stand stand;
    static float was[SIDE * SIDE];
    DpSoil       soil = dp_soil_default();
    DpSimOptions chosen = dp_sim_options_default();
    chosen.law = DP_CONTACT_UNIFORM;
    soil.settle_time = 0.05f, soil.poisson_ratio = 0.4f;
    stand_make(&stand, 1);
    stand_on(&stand, 0, 0, 50, 0.05, 0.05, 500.0);
    stand_on(&stand, 0, 100, 150, 0.09, 0.08, 500.0);  // half on its old print
    stand_load(&stand, &soil, chosen);
    CHECK(dp_sim_run(stand.sim, 99) == DP_OK);
    CHECK(dp_terrain_read(stand.terrain, DP_FIELD_HEIGHT_CHANGE, I0, I0, SIDE, SIDE, was) == DP_OK);
    CHECK(dp_sim_run(stand.sim, 103) == DP_OK);
    const Limb*      limb = &stand.sim->limb[0];
    const DpCellRect at = limb->met_at;
    const long       nx = at.i1 - at.i0;
    const int        row = stand.sim->pressing[0].row;
    const float*     met = stand.sim->scratch[0].imprint.met;
    int              uneven = 0;
    CHECK(limb->stands && limb->met && met && nx > 20 && row >= nx);
    CHECK(at.i0 >= I0 && at.i1 <= I0 + SIDE && at.j0 >= I0 && at.j1 <= I0 + SIDE);
    for (long j = at.j0; j < at.j1; ++j)
        for (long i = at.i0; i < at.i1; ++i) {
            const float want = was[(j - I0) * SIDE + (i - I0)];
            CHECK(limb->met[(j - at.j0) * nx + (i - at.i0)] == want);
            CHECK(met[(j - at.j0) * row + (i - at.i0)] == want);
            uneven += want < -0.005f;
        }
    CHECK(uneven > 50);
    stand_drop(&stand);
}

int main(void)
{
    RUN(who_walks_beside_is_worked_on_at_once);
    RUN(feet_that_meet_are_worked_on_in_turn);
    RUN(patches_have_room_for_what_their_soils_do);
    RUN(a_stance_meets_the_ground_as_it_was);
    return check_done();
}
