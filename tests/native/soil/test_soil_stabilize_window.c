// the part of the ground that soil_stabilize.c looks at: it grows as soil slides on, and nobody sees that. MODEL 6.4
#include "check.h"
#include "ground.h"

#define SIDE 120

static Ground tower(double height, float flow_time)
{
    DpSoil soil = dp_soil_default();
    soil.rest_angle = (float)(20.0 * DP_PI / 180.0);
    soil.flow_time = flow_time;
    Ground ground = ground_make(SIDE, SIDE, 0.01, soil);
    for (int j = 58; j < 62; ++j)
        for (int i = 58; i < 62; ++i) ground.heap[j * SIDE + i] = (float)height;
    return ground;
}

static DpSettled settle(Ground* ground, int most)
{
    DpSoilScratch* scratch = dp_soil_scratch_create();
    DpSettled      settled;
    ground->patch.soils = ground->soil;
    CHECK(dp_soil_stabilize(&ground->patch, NULL, NULL, 0.002, most, scratch, &settled) == DP_OK);
    dp_soil_scratch_destroy(scratch);
    return settled;
}

// a crumb in two corners has all of the ground looked at from the beginning
TEST(it_grows_without_a_trace)
{
    for (int sweeps = 40; sweeps <= 640; sweeps *= 4) {
        Ground some = tower(6.0, 0.0f), all = tower(6.0, 0.0f);
        all.heap[0] = all.heap[SIDE * SIDE - 1] = 1e-9f;
        const DpSettled a = settle(&some, sweeps), b = settle(&all, sweeps);
        CHECK(a.sweeps == sweeps && b.sweeps == sweeps);
        for (int k = 0; k < SIDE * SIDE; ++k) CHECK_NEAR(some.heap[k], all.heap[k], 1e-6);
        ground_free(&some), ground_free(&all);
    }
}

// soil that takes its time does not leave a high wall at once, however steep that is
TEST(slow_soil_falls_by_half_a_cell_in_a_sweep)
{
    Ground slow = tower(0.6, 2.0f), quick = tower(0.6, 0.0f);
    settle(&slow, 1), settle(&quick, 1);
    CHECK_NEAR(ground_max(&slow, slow.heap), 0.6, 1e-6);  // its middle has equals all around
    CHECK_NEAR(slow.heap[58 * SIDE + 58], 0.6 - 0.5 * 0.01, 1e-4);
    CHECK(quick.heap[58 * SIDE + 58] < 0.4f);
    ground_free(&slow), ground_free(&quick);
}

int main(void)
{
    RUN(it_grows_without_a_trace);
    RUN(slow_soil_falls_by_half_a_cell_in_a_sweep);
    return check_done();
}
