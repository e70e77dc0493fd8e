// Rough ground differs from place to place, each soil as it is rough, and no farther than it may. MODEL 6.8
#include "terrain/ground.h"

#define SIDE 4
#define CELLS 100  // along a side of the patch
#define CELL 0.01  // [m]

static float weight[2 * SIDE * SIDE], height[SIDE * SIDE];

// soil 0 where x < 1.5 m, soil 1 beyond; rest slopes of the cells, in rows
static void slopes_of(float rho0, float rho1, float* slope, uint8_t* kind)
{
    DpGround     ground = ground_heights(SIDE, SIDE, 0.0, 0.0, 1.0, height);
    DpSoil       soils[2] = {ground_soils[0], ground_soils[2]};
    DpTerrain*   terrain = NULL;
    DpSoilPatch* patch = NULL;
    soils[0].roughness = rho0, soils[1].roughness = rho1;
    soils[0].grain_size = soils[1].grain_size = 0.05f;
    for (int k = 0; k < SIDE * SIDE; ++k)
        weight[k] = k % SIDE < 2 ? 1.0f : 0.0f, weight[SIDE * SIDE + k] = 1.0f - weight[k];
    ground.kind_count = 2, ground.kind_weight = weight;
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, soils, 2, 1, 0, NULL};
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    DpLease* lease = dp_lease_create();
    CHECK(dp_terrain_acquire(terrain, lease, dp_cells(100, 100, CELLS, CELLS), &patch) == DP_OK);
    for (int j = 0; j < CELLS; ++j)
        for (int i = 0; i < CELLS; ++i) {
            slope[j * CELLS + i] = patch->rest_slope[j * patch->row + i];
            kind[j * CELLS + i] = patch->kind[j * patch->row + i];
        }
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

static float   slope[CELLS * CELLS];
static uint8_t kind[CELLS * CELLS];

// the flattest and the steepest cell of a soil, over what its rest angle says
static void ends_of(int soil, double angle, double* flattest, double* steepest)
{
    *flattest = INFINITY, *steepest = 0.0;
    for (int k = 0; k < CELLS * CELLS; ++k) {
        if (kind[k] != soil) continue;
        *flattest = fmin(*flattest, (double)slope[k] / tan(angle));
        *steepest = fmax(*steepest, (double)slope[k] / tan(angle));
    }
}

TEST(each_soil_is_as_rough_as_it_is)
{
    const double plain = (double)ground_soils[0].rest_angle;
    for (int rough = 0; rough < 2; ++rough) {
        double low[2], high[2];
        slopes_of(rough == 0 ? 1.0f : 0.0f, rough == 1 ? 1.0f : 0.0f, slope, kind);
        ends_of(0, plain, &low[0], &high[0]);
        ends_of(1, (double)ground_soils[2].rest_angle, &low[1], &high[1]);
        CHECK(low[rough] < 0.8 && high[rough] > 1.2);
        CHECK_NEAR(low[1 - rough], 1.0, 1e-6);
        CHECK_NEAR(high[1 - rough], 1.0, 1e-6);
    }
}

TEST(slopes_differ_no_farther_than_they_may)
{
    double low[2], high[2];
    slopes_of(1.0f, 1.0f, slope, kind);
    ends_of(0, (double)ground_soils[0].rest_angle, &low[0], &high[0]);
    ends_of(1, (double)ground_soils[2].rest_angle, &low[1], &high[1]);
    for (int k = 0; k < 2; ++k) CHECK(low[k] >= 0.3 - 1e-6 && high[k] <= 2.0 + 1e-6);
    CHECK_NEAR(low[0], 0.3, 1e-6);  // and some would, if they could
    CHECK_NEAR(high[0], 2.0, 1e-6);
}

int main(void)
{
    RUN(each_soil_is_as_rough_as_it_is);
    RUN(slopes_differ_no_farther_than_they_may);
    return check_done();
}
