// tests of sim_carry.c: soil a sole takes from mud goes with it, and is left on a road; none is lost. MODEL 6.16
#include "stand.h"

#define STICKS 0.003

static Stand stand;

// mud in the west, a road from x = 0.5 on
static DpTerrain* mud_and_road(float adhesion)
{
    DpSoil soil[2] = {dp_soil_default(), dp_soil_default()};
    for (int k = 0; k < 2; ++k) soil[k].young_modulus = 3e5f, soil[k].settle_time = 0.05f;
    soil[0].adhesion = adhesion, soil[0].release_pressure = 2e4f;
    static const float heights[8] = {0},
                       weight[2][8] = {{1, 1, 0, 0, 1, 1, 0, 0}, {0, 0, 1, 1, 0, 0, 1, 1}};
    const DpGround         ground = {.kind = DP_GROUND_HEIGHTS,
                                     .nx = 4,
                                     .ny = 2,
                                     .x0 = -0.5,
                                     .y0 = -0.5,
                                     .spacing = 2.0 / 3.0,
                                     .heights = heights,
                                     .kind_count = 2,
                                     .kind_weight = &weight[0][0]};
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, soil, 2, 1, 0, NULL};
    DpTerrain*             terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    return terrain;
}

// all that was ever pressed, taken and left is where the ledger says
static void balance(void)
{
    double             heaped, pressed, deepest;
    const DpSimReport  report = dp_sim_report(stand.sim);
    const DpSimCarried mud = dp_sim_carried(stand.sim, 0);
    dp_terrain_totals(stand.terrain, &heaped, &pressed, &deepest);
    // what was taken out of firm ground counts as loosened: walls of this soil stand
    CHECK_CLOSE(pressed, report.pressed + report.loosened, 1e-5);
    CHECK_NEAR(heaped, report.displaced - report.pressed_heap + report.loosened - mud.taken, 1e-9);
    CHECK_CLOSE(mud.carried + mud.left, mud.taken, 1e-6);
}

TEST(mud_goes_with_the_sole_and_is_left_on_the_road)
{
    stand_make(&stand, 1);
    stand_on(&stand, 0, 5, 50, 0.1, 0.0, 150.0);
    stand_on(&stand, 0, 70, 120, 0.8, 0.0, 150.0);
    stand_load_on(&stand, mud_and_road((float)STICKS), dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 40) == DP_OK);
    CHECK(dp_sim_carried(stand.sim, 0).taken <= 0.0);  // while it stands
    CHECK(!dp_cells_empty(dp_carry_cells(stand.sim->limb[0].carry)));
    CHECK(dp_sim_run(stand.sim, 60) == DP_OK);
    DpSimCarried mud = dp_sim_carried(stand.sim, 0);
    CHECK(dp_cells_empty(dp_carry_cells(stand.sim->limb[0].carry)));
    CHECK_CLOSE(mud.taken, STICKS * 0.01, 0.1);  // a layer on all of its 10 x 10 cm
    CHECK(mud.left <= 0.0 && dp_sim_report(stand.sim).loosened > 0.0);
    balance();
    const double taken = mud.taken;

    CHECK(dp_sim_run(stand.sim, 130) == DP_OK);
    mud = dp_sim_carried(stand.sim, 0);
    // 1 - exp(-p / p0) of it, p = 15 kPa
    CHECK_CLOSE(mud.left, taken * (1.0 - exp(-150.0 / 0.01 / 2e4)), 0.06);
    CHECK(mud.taken == taken);  // a road gives nothing
    balance();
    float coat[30 * 30];
    int   lies = 0;
    CHECK(dp_terrain_read(stand.terrain, DP_FIELD_COAT, 65, -15, 30, 30, coat) == DP_OK);
    for (int n = 0; n < 900; ++n) {
        const double x = (65 + n % 30 + 0.5) * CELL - 0.8, y = (-15 + n / 30 + 0.5) * CELL;
        if (coat[n] > 0.0f) CHECK(fabs(x) < 0.06 && fabs(y) < 0.06);
        lies += coat[n] > 0.0f;
    }
    CHECK(lies >= 90);
    stand_drop(&stand);
}

TEST(each_limb_carries_its_own_and_takes_when_it_lifts)
{
    stand_make(&stand, 2);
    stand_on(&stand, 0, 5, 50, 0.1, 0.0, 150.0);
    stand_on(&stand, 1, 5, 90, -0.3, 0.0, 150.0);
    stand_load_on(&stand, mud_and_road((float)STICKS), dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 60) == DP_OK);
    const DpCarry* first = stand.sim->limb[0].carry;
    const DpCarry* other = stand.sim->limb[1].carry;
    CHECK(dp_carry_volume(first, 0) > 0.0 && dp_carry_volume(other, 0) <= 0.0);
    CHECK(!dp_cells_empty(dp_carry_cells(other)));
    CHECK(dp_sim_run(stand.sim, 100) == DP_OK);
    CHECK_CLOSE(dp_carry_volume(other, 0), dp_carry_volume(first, 0), 0.05);
    CHECK_CLOSE(dp_sim_carried(stand.sim, 0).taken,
                dp_carry_taken(first, 0) + dp_carry_taken(other, 0), 1e-12);
    CHECK_CLOSE(dp_sim_carried(stand.sim, 0).carried,
                dp_carry_volume(first, 0) + dp_carry_volume(other, 0), 1e-12);
    balance();
    stand_drop(&stand);
}

TEST(who_still_stands_at_the_end_lets_go)
{
    stand_make(&stand, 1);
    stand_on(&stand, 0, 5, TIMES, 0.1, 0.0, 150.0);
    stand_load_on(&stand, mud_and_road((float)STICKS), dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, TIMES) == DP_OK && dp_sim_carried(stand.sim, 0).taken <= 0.0);
    CHECK(dp_sim_settle(stand.sim) == DP_OK);
    CHECK_CLOSE(dp_sim_carried(stand.sim, 0).taken, STICKS * 0.01, 0.1);
    CHECK(dp_cells_empty(dp_carry_cells(stand.sim->limb[0].carry)));
    balance();
    stand_drop(&stand);
}

// who walks next begins clean, and what went with those before is not forgotten
TEST(what_went_away_with_a_walker_stays_counted)
{
    stand_make(&stand, 1);
    stand_on(&stand, 0, 5, 50, 0.1, 0.0, 150.0);
    stand_load_on(&stand, mud_and_road((float)STICKS), dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 60) == DP_OK);
    const DpSimCarried before = dp_sim_carried(stand.sim, 0);
    for (int n = 0; n < 2; ++n) {
        stand_follow(&stand);
        const DpSimCarried after = dp_sim_carried(stand.sim, 0);
        CHECK(dp_carry_volume(stand.sim->limb[0].carry, 0) <= 0.0);
        CHECK(after.taken == before.taken && after.carried == before.carried);
    }
    CHECK(dp_sim_run(stand.sim, 60) == DP_OK);  // the same place: less is loose, some is taken
    CHECK(dp_sim_carried(stand.sim, 0).taken > 1.5 * before.taken);
    stand_drop(&stand);
}

TEST(where_nothing_sticks_nobody_carries)
{
    stand_make(&stand, 2);
    stand_on(&stand, 0, 5, 50, 0.1, 0.0, 150.0);
    stand_load_on(&stand, mud_and_road(0.0f), dp_sim_options_default());
    CHECK(!stand.sim->limb[0].carry && !stand.sim->limb[1].carry);
    CHECK(dp_sim_run(stand.sim, 60) == DP_OK && dp_sim_settle(stand.sim) == DP_OK);
    CHECK(dp_sim_report(stand.sim).loosened <= 0.0);
    stand_drop(&stand);
}

int main(void)
{
    RUN(mud_goes_with_the_sole_and_is_left_on_the_road);
    RUN(each_limb_carries_its_own_and_takes_when_it_lifts);
    RUN(who_still_stands_at_the_end_lets_go);
    RUN(what_went_away_with_a_walker_stays_counted);
    RUN(where_nothing_sticks_nobody_carries);
    return check_done();
}
