// tests of sim_create.c: a simulation is whole or not there
#include "base/vec.h"
#include "check.h"
#include "sim/sim_inside.h"

static DpTerrain* level(void)
{
    const DpSoil           soil = dp_soil_default();
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    const DpTerrainOptions options = {{0.005, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    DpTerrain*             terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &flat) == DP_OK);
    return terrain;
}

TEST(options_that_cannot_be_are_refused)
{
    DpTerrain*   terrain = level();
    DpSim*       sim = NULL;
    DpSimOptions o;
#define REFUSES(change)           \
    o = dp_sim_options_default(); \
    change;                       \
    CHECK(dp_sim_create(&sim, terrain, &o) == DP_BAD_ARGUMENT && !sim)
    REFUSES(o.law = (DpContactLaw)3);
    REFUSES(o.heap_law = (DpHeapLaw)2);
    REFUSES(o.rim_width = 0.0);
    REFUSES(o.rim_width = INFINITY);
    REFUSES(o.tolerance = 0.0);
    REFUSES(o.tolerance = 1.0);
    REFUSES(o.max_sweeps = 0);
    REFUSES(o.normal_radius = NAN);
    REFUSES(o.workers = 0);
    REFUSES(o.workers = 65);
    o = dp_sim_options_default();
    CHECK(dp_sim_create(&sim, NULL, &o) == DP_BAD_ARGUMENT);
    CHECK_CLOSE(o.tolerance, 0.1 * DP_PI / 180.0, 1e-12);  // MODEL 6.4
    dp_terrain_destroy(terrain);
}

TEST(every_worker_has_what_it_needs)
{
    DpTerrain*   terrain = level();
    DpSim*       sim = NULL;
    DpSimOptions o = dp_sim_options_default();
    o.workers = 5;
    CHECK(dp_sim_create(&sim, terrain, &o) == DP_OK);
    CHECK(sim->worker_count == 5);
    for (int k = 0; k < 5; ++k)
        CHECK(sim->scratch[k].lease && sim->scratch[k].imprint_scratch &&
              sim->scratch[k].soil_scratch);
    for (int a = 0; a < MAX_SPECULATED; ++a) CHECK(sim->speculation.lease[a]);
    dp_sim_destroy(sim);
    dp_sim_destroy(NULL);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(options_that_cannot_be_are_refused);
    RUN(every_worker_has_what_it_needs);
    return check_done();
}
