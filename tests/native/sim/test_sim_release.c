// tests of sim_release.c: MODEL 6.9
#include "stand.h"

#define NEWTON 500.0
#define BACK 0.2

static Stand stand;

static DpSoil springy(void)
{
    DpSoil soil = dp_soil_default();
    soil.rebound = (float)BACK, soil.settle_time = 0.05f, soil.poisson_ratio = 0.0f;
    return soil;
}

// One sole from 0 to 0.1 m stands until 0.6 s, another from 0.05 to 0.15 m until 1.2 s. What the first alone stood on
// comes back when it lifts, what both stood on when both have gone.
TEST(ground_comes_back_once_nobody_stands_there)
{
    const DpSoil soil = springy();
    const long   at[3] = {2, 7, 12};  // under the first, both, the second
    double       deep[3];
    stand_make(&stand, 2);
    stand_on(&stand, 0, 0, 60, 0.05, 0.05, NEWTON);
    stand_on(&stand, 1, 0, 120, 0.10, 0.05, NEWTON);
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 50) == DP_OK);
    for (int k = 0; k < 3; ++k) {
        deep[k] = stand_read(&stand, DP_FIELD_COMPRESSION, at[k], 5);
        CHECK_CLOSE(deep[k], NEWTON / 0.01 * 0.3 / 1e6, 0.01);
    }
    CHECK(dp_sim_run(stand.sim, 100) == DP_OK);
    for (int k = 0; k < 3; ++k)
        CHECK_CLOSE(stand_read(&stand, DP_FIELD_COMPRESSION, at[k], 5),
                    (k == 0 ? 1.0 - BACK : 1.0) * deep[k], 1e-5);
    CHECK(dp_sim_run(stand.sim, TIMES - 1) == DP_OK);
    double left = 0.0, heap = 0.0, deepest = 0.0;
    for (int k = 0; k < 3; ++k)
        CHECK_CLOSE(stand_read(&stand, DP_FIELD_COMPRESSION, at[k], 5), (1.0 - BACK) * deep[k],
                    1e-5);
    dp_terrain_totals(stand.terrain, &heap, &left, &deepest);
    const DpSimReport report = dp_sim_report(stand.sim);
    CHECK_CLOSE(report.pressed - report.rebounded, left, 1e-6);
    CHECK_CLOSE(report.rebounded, BACK * report.pressed, 1e-5);
    stand_drop(&stand);
}

// Ground that is settled with soles still on it comes back as where they have lifted.
TEST(settled_ground_comes_back)
{
    const DpSoil soil = springy();
    stand_make(&stand, 2);
    stand_on(&stand, 0, 0, 60, 0.05, 0.05, NEWTON);
    stand_on(&stand, 1, 0, 120, 0.10, 0.05, NEWTON);
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 50) == DP_OK);
    const DpSimReport before = dp_sim_report(stand.sim);
    CHECK(before.rebounded == 0.0 && before.deepest > 0.0);
    CHECK(dp_sim_settle(stand.sim) == DP_OK);
    const DpSimReport after = dp_sim_report(stand.sim);
    CHECK_CLOSE(after.deepest, (1.0 - BACK) * before.deepest, 1e-5);
    CHECK_CLOSE(after.rebounded, BACK * after.pressed, 1e-5);
    stand_drop(&stand);
}

// The same load again goes down to where it was, and what had come back counts as taken back.
TEST(the_same_load_again_presses_what_came_back)
{
    const DpSoil soil = springy();
    stand_make(&stand, 1);
    stand_on(&stand, 0, 0, 50, 0.05, 0.05, NEWTON);
    stand_on(&stand, 0, 100, 150, 0.05, 0.05, NEWTON);
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 80) == DP_OK);
    const DpSimReport before = dp_sim_report(stand.sim);
    const double      deep = stand_read(&stand, DP_FIELD_COMPRESSION, 5, 5);
    CHECK(dp_sim_run(stand.sim, 140) == DP_OK);
    CHECK_CLOSE(stand_read(&stand, DP_FIELD_COMPRESSION, 5, 5), deep / (1.0 - BACK), 1e-5);
    CHECK_NEAR(dp_sim_report(stand.sim).rebounded, 0.0, 1e-5 * before.rebounded);
    CHECK(dp_sim_run(stand.sim, TIMES - 1) == DP_OK);
    CHECK_CLOSE(dp_sim_report(stand.sim).pressed, before.pressed, 1e-6);
    CHECK_CLOSE(dp_sim_report(stand.sim).rebounded, before.rebounded, 1e-5);
    stand_drop(&stand);
}

// who is held keeps its print down without a force of its own
TEST(a_sole_that_is_held_keeps_its_print)
{
    const DpSoil soil = springy();
    stand_make(&stand, 1);
    stand_on(&stand, 0, 0, 150, 0.05, 0.05, NEWTON);
    for (int t = 50; t < 100; ++t) stand.touching[0][t] = 1 | DP_HELD;
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 49) == DP_OK);
    const double deep = stand_read(&stand, DP_FIELD_COMPRESSION, 5, 5);
    CHECK(dp_sim_run(stand.sim, 90) == DP_OK);
    CHECK_CLOSE(stand_read(&stand, DP_FIELD_COMPRESSION, 5, 5), deep, 1e-3);
    stand_drop(&stand);
}

int main(void)
{
    RUN(ground_comes_back_once_nobody_stands_there);
    RUN(settled_ground_comes_back);
    RUN(the_same_load_again_presses_what_came_back);
    RUN(a_sole_that_is_held_keeps_its_print);
    return check_done();
}
