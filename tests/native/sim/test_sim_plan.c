// Which limbs are worked on in turn, since their patches meet, and which at once.
#include "check.h"
#include "sim/planted.h"
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

int main(void)
{
    RUN(who_walks_beside_is_worked_on_at_once);
    RUN(feet_that_meet_are_worked_on_in_turn);
    return check_done();
}
