// tests of terrain_times.c: MODEL 6.10
#include "terrain/ground.h"

#define ROWS 4

static const double when[ROWS] = {1.0, 3.0, 3.0, 5.0};

// two soils at four times, with a switch at 3 s; the second one stays as it is
static void rows_of(DpSoil row[2 * ROWS])
{
    for (int t = 0; t < ROWS; ++t) row[2 * t] = ground_soils[0], row[2 * t + 1] = ground_soils[2];
    const float modulus[ROWS] = {2e6f, 1e6f, 4e5f, 6e5f};
    const float rest[ROWS] = {0.5f, 0.6f, 0.3f, 0.4f};
    for (int t = 0; t < ROWS; ++t)
        row[2 * t].young_modulus = modulus[t], row[2 * t].rest_angle = rest[t];
}

static DpStatus make(DpTerrain** terrain, const DpSoil* row, const double* time)
{
    const DpGround   ground = ground_flat(0.0);
    DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    options.soils = row, options.soil_count = 2, options.times = ROWS, options.time = time;
    return dp_terrain_create(terrain, &options, &ground);
}

TEST(numbers_go_evenly_from_row_to_row_and_stay_beyond)
{
    DpSoil     row[2 * ROWS];
    DpTerrain* terrain = NULL;
    rows_of(row);
    CHECK(make(&terrain, row, when) == DP_OK);
    const double at[7] = {-2.0, 1.0, 1.5, 2.9999999999, 3.0, 4.5, 9.0};
    const double modulus[7] = {2e6, 2e6, 1.75e6, 1e6, 4e5, 5.5e5, 6e5};
    const double rest[7] = {0.5, 0.5, 0.525, 0.6, 0.3, 0.375, 0.4};
    for (int k = 0; k < 14; ++k) {  // forward, and back again
        const int n = k < 7 ? k : 13 - k;
        dp_terrain_set_time(terrain, at[n]);
        const DpSoil* soils = dp_terrain_soils(terrain);
        CHECK_CLOSE(soils[0].young_modulus, modulus[n], 1e-6);
        CHECK_CLOSE(soils[0].rest_angle, rest[n], 1e-6);
        CHECK(memcmp(&soils[1], &ground_soils[2], sizeof soils[1]) == 0);
    }
    dp_terrain_destroy(terrain);
}

// ground that is there already is leased as it has become, and untouched ground, too
TEST(patches_are_of_the_time_at_hand)
{
    DpSoil       row[2 * ROWS];
    DpTerrain*   terrain = NULL;
    DpSoilPatch* patch = NULL;
    DpLease*     lease = dp_lease_create();
    rows_of(row);
    for (int t = 0; t < ROWS; ++t) {
        row[2 * t].roughness = t == 3 ? 0.5f : 0.0f;  // rough in the end alone
        row[2 * t].wall_angle = 1.0f + 0.1f * (float)t;
    }
    CHECK(make(&terrain, row, when) == DP_OK);
    const double at[3] = {1.0, 3.0, 2.0};
    for (int k = 0; k < 3; ++k) {
        dp_terrain_set_time(terrain, at[k]);
        CHECK(dp_terrain_acquire(terrain, lease, dp_cells(10 * k, 0, 20, 20), &patch) == DP_OK);
        const DpSoil* soil = dp_terrain_soils(terrain);
        CHECK_CLOSE(patch->rest_slope[5], tan((double)soil->rest_angle), 1e-6);
        CHECK_CLOSE(patch->wall_slope[5], tan((double)soil->wall_angle), 1e-6);
        CHECK_NEAR(patch->modulus[5], soil->young_modulus, 0.0);
        CHECK_NEAR(patch->uneven[5], 0.0, 0.0);
    }
    dp_terrain_set_time(terrain, 5.0);
    CHECK(dp_terrain_acquire(terrain, lease, dp_cells(0, 0, 200, 20), &patch) == DP_OK);
    float low = INFINITY, high = 0.0f;
    for (int i = 0; i < 200; ++i)
        low = fminf(low, patch->rest_slope[i]), high = fmaxf(high, patch->rest_slope[i]);
    CHECK((double)low < tan(0.4) && (double)high > tan(0.4));
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

// a crust whose pieces are as wide as it is thick at its thickest, even where it begins without one
TEST(a_crust_may_come_later)
{
    DpSoil       row[2 * ROWS];
    DpTerrain*   terrain = NULL;
    DpSoilPatch* patch = NULL;
    DpLease*     lease = dp_lease_create();
    rows_of(row);
    row[4].crust_depth = row[6].crust_depth = 0.05f;
    row[4].crust_strength = row[6].crust_strength = 1e5f;
    CHECK(make(&terrain, row, when) == DP_OK);
    dp_terrain_set_time(terrain, 0.0);
    CHECK(dp_terrain_acquire(terrain, lease, dp_cells(0, 0, 60, 60), &patch) == DP_OK);
    int pieces = 0;
    for (int i = 1; i < 60; ++i) {
        CHECK(patch->plate[i] != 0u);
        pieces += patch->plate[i] != patch->plate[i - 1];
    }
    CHECK(pieces >= 2 && pieces <= 8);  // 0.6 m, in pieces about 0.15 m wide
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

TEST(times_that_fall_and_grain_that_wanders_are_refused)
{
    DpSoil       row[2 * ROWS];
    DpTerrain*   terrain = NULL;
    const double falls[ROWS] = {1.0, 3.0, 2.9, 5.0}, endless[ROWS] = {1.0, 2.0, 3.0, INFINITY};
    rows_of(row);
    CHECK(make(&terrain, row, falls) == DP_BAD_ARGUMENT);
    CHECK(make(&terrain, row, endless) == DP_BAD_ARGUMENT);
    CHECK(make(&terrain, row, NULL) == DP_BAD_ARGUMENT);
    row[5].grain_size *= 2.0f;
    CHECK(make(&terrain, row, when) == DP_BAD_ARGUMENT);
}

// ground of one soil, all of which changes
TEST(slopes_follow_where_all_soils_change)
{
    const double     time[2] = {0.0, 1.0}, rest[3] = {0.3, 0.4, 0.5};
    const DpGround   ground = ground_flat(0.0);
    DpSoil           row[2] = {ground_soils[0], ground_soils[0]};
    DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    DpTerrain*       terrain = NULL;
    DpSoilPatch*     patch = NULL;
    DpLease*         lease = dp_lease_create();
    row[0].rest_angle = 0.3f, row[1].rest_angle = 0.5f;
    options.soils = row, options.soil_count = 1, options.times = 2, options.time = time;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    for (int k = 0; k < 3; ++k) {
        dp_terrain_set_time(terrain, 0.5 * k);
        CHECK(dp_terrain_acquire(terrain, lease, dp_cells(0, 0, 20, 20), &patch) == DP_OK);
        CHECK_CLOSE(patch->rest_slope[5], tan(rest[k]), 1e-6);
    }
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

// rough ground that was touched when its soil was another is as ground that is touched now
TEST(ground_touched_early_is_as_rough_as_that_touched_late)
{
    DpSoil       row[2 * ROWS];
    float        slope[2][300], wall[2][300];
    DpTerrain*   terrain[2] = {NULL, NULL};
    DpSoilPatch* patch = NULL;
    rows_of(row);
    for (int t = 0; t < ROWS; ++t) {
        row[2 * t].roughness = 0.1f + 0.2f * (float)t;
        row[2 * t].wall_angle = 1.0f + 0.1f * (float)t;
    }
    for (int k = 0; k < 2; ++k) {
        DpLease* lease = dp_lease_create();
        CHECK(make(&terrain[k], row, when) == DP_OK);
        dp_terrain_set_time(terrain[k], 1.0);
        if (k) CHECK(dp_terrain_touch(terrain[k], dp_cells(0, 0, 300, 20)) == DP_OK);
        dp_terrain_set_time(terrain[k], 4.0);
        CHECK(dp_terrain_acquire(terrain[k], lease, dp_cells(0, 0, 300, 20), &patch) == DP_OK);
        memcpy(slope[k], patch->rest_slope, sizeof slope[k]);
        memcpy(wall[k], patch->wall_slope, sizeof wall[k]);
        dp_lease_destroy(lease);
        dp_terrain_destroy(terrain[k]);
    }
    CHECK(memcmp(slope[0], slope[1], sizeof slope[0]) == 0);
    CHECK(memcmp(wall[0], wall[1], sizeof wall[0]) == 0);
    float low = INFINITY, high = 0.0f;
    for (int i = 0; i < 300; ++i) low = fminf(low, slope[1][i]), high = fmaxf(high, slope[1][i]);
    CHECK(high > 1.2f * low);
}

int main(void)
{
    RUN(numbers_go_evenly_from_row_to_row_and_stay_beyond);
    RUN(patches_are_of_the_time_at_hand);
    RUN(a_crust_may_come_later);
    RUN(times_that_fall_and_grain_that_wanders_are_refused);
    RUN(slopes_follow_where_all_soils_change);
    RUN(ground_touched_early_is_as_rough_as_that_touched_late);
    return check_done();
}
