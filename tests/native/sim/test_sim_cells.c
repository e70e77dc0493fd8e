// tests of sim_cells.c: boxes of the world as cells
#include "stand.h"

static Stand stand;

// every cell that a box meets is there, and none is farther than a cell from it
TEST(cells_of_a_box_are_those_that_it_meets)
{
    const DpSoil           soil = dp_soil_default();
    const DpGround         flat = {.kind = DP_GROUND_FLAT};
    DpTerrain*             terrain = NULL;
    DpSim*                 sim = NULL;
    unsigned               seed = 5u;
    const DpTerrainOptions options = {{0.02, 0.3, -1.1}, &soil, 1, 1, 0, NULL};
    const DpSimOptions     chosen = dp_sim_options_default();
    CHECK(dp_terrain_create(&terrain, &options, &flat) == DP_OK);
    CHECK(dp_sim_create(&sim, terrain, &chosen) == DP_OK);
    for (int n = 0; n < 200; ++n) {
        const double     x0 = 4.0 * check_random(&seed) - 2.0, y0 = 4.0 * check_random(&seed) - 2.0;
        const double     x1 = x0 + 0.3 * check_random(&seed), y1 = y0 + 0.3 * check_random(&seed);
        const DpCellRect at = dp_sim_cells(sim, x0, y0, x1, y1);
        const double     first_x = 0.3 + 0.02 * ((double)at.i0 + 0.5);
        const double     last_x = 0.3 + 0.02 * ((double)at.i1 - 0.5);
        const double     first_y = -1.1 + 0.02 * ((double)at.j0 + 0.5);
        const double     last_y = -1.1 + 0.02 * ((double)at.j1 - 0.5);
        CHECK(first_x <= x0 && x0 - first_x < 0.04 && last_x >= x1 - 0.01 && last_x - x1 < 0.04);
        CHECK(first_y <= y0 && y0 - first_y < 0.04 && last_y >= y1 - 0.01 && last_y - y1 < 0.04);
    }
    const DpCellRect far = dp_sim_cells(sim, -1e300, NAN, 1e300, 0.0);
    CHECK(far.i0 == -1000000000L && far.i1 == 1000000000L);
    dp_sim_destroy(sim);
    dp_terrain_destroy(terrain);
}

TEST(the_surface_of_plants_is_the_terrains)
{
    const DpSoil soil = dp_soil_default();
    stand_make(&stand, 1);
    stand_on(&stand, 0, 0, 50, 0.05, 0.05, 500.0);
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, TIMES - 1) == DP_OK);
    CHECK_NEAR(dp_sim_surface(stand.terrain, 0.055, 0.055),
               -stand_read(&stand, DP_FIELD_COMPRESSION, 5, 5), 1e-6);
    CHECK_NEAR(dp_sim_surface(stand.terrain, 3.0, 0.0), 0.0, 0.0);
    stand_drop(&stand);
}

int main(void)
{
    RUN(cells_of_a_box_are_those_that_it_meets);
    RUN(the_surface_of_plants_is_the_terrains);
    return check_done();
}
