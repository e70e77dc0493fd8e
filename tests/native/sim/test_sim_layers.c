// tests of sim_layers.c: how thick layers still are where a sole has pressed them. MODEL 6.17
#include "stand.h"

#define SIDE 40

static Stand stand;

// layers that are springs yield to one pressure p, each by p L/E, of which a depth is the sum
static const double thick[3] = {0.05, 0.1, 0.15}, stiff[3] = {4e5, 1e6, 5e6};

static DpTerrain* layered(void)
{
    DpSoil  soil[2] = {dp_soil_default(), dp_soil_default()};
    DpLayer layer[5];
    int     start[3] = {0, 3, 5};
    for (int n = 0; n < 5; ++n) {
        const int k = n < 3 ? n : n - 3;
        layer[n] =
            (DpLayer){.soil = dp_soil_default(), .thickness = thick[k], .name = k, .place = k};
        layer[n].soil.young_modulus = (float)stiff[k];
        layer[n].soil.poisson_ratio = 0.1f;
        if (n == 0 || n == 3) soil[n / 3] = layer[n].soil;
    }
    soil[0].layer_depth = 0.3f, soil[1].layer_depth = 0.15f;
    // kind 1, of two layers, in the north
    static const float     heights[4] = {0}, weight[2][4] = {{1, 1, 0, 0}, {0, 0, 1, 1}};
    const DpGround         ground = {.kind = DP_GROUND_HEIGHTS,
                                     .nx = 2,
                                     .ny = 2,
                                     .spacing = 0.4,
                                     .heights = heights,
                                     .kind_count = 2,
                                     .kind_weight = &weight[0][0]};
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, soil, 2, 1, 0, NULL};
    DpTerrain*             terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_OK);
    return terrain;
}

TEST(each_layer_is_thinner_by_what_it_has_yielded)
{
    stand_make(&stand, 1);
    stand_on(&stand, 0, 10, 100, 0.2, 0.2, 300.0);  // on both kinds
    stand_load_on(&stand, layered(), dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 120) == DP_OK);
    const DpCellRect at = dp_cells(0, 0, SIDE, SIDE);
    static float     left[SIDE * SIDE], pressed[SIDE * SIDE], kind[SIDE * SIDE];
    CHECK(dp_terrain_read(stand.terrain, DP_FIELD_COMPRESSION, 0, 0, SIDE, SIDE, pressed) == DP_OK);
    CHECK(dp_terrain_read(stand.terrain, DP_FIELD_KIND, 0, 0, SIDE, SIDE, kind) == DP_OK);
    int pressed_of[2] = {0, 0};
    for (int layer = 0; layer < 4; ++layer) {
        CHECK(dp_sim_layers(stand.sim, DP_FIELD_LAYER + layer, &at, left) == DP_OK);
        for (int n = 0; n < SIDE * SIDE; ++n) {
            const int of =
                kind[n] > 0.5f ? 2 : 3;  // layers of the kind, the last of them the ground below
            double give = 0.0;
            for (int k = 0; k < of; ++k) give += thick[k] / stiff[k];
            const double share = layer < of ? thick[layer] / stiff[layer] / give : 0.0;
            const double want = layer + 1 < of ? thick[layer] - (double)pressed[n] * share : 0.0;
            CHECK_NEAR(left[n], want, 1e-6);
            pressed_of[of == 2] += pressed[n] > 0.002f;
        }
    }
    CHECK(pressed_of[0] > 0 && pressed_of[1] > 0);
    stand_drop(&stand);
}

TEST(a_window_reads_what_all_of_it_does)
{
    stand_make(&stand, 1);
    stand_on(&stand, 0, 10, 100, 0.2, 0.2, 300.0);
    stand_load_on(&stand, layered(), dp_sim_options_default());
    CHECK(dp_sim_run(stand.sim, 50) == DP_OK);
    static float     all[SIDE * SIDE], part[7 * 11];
    const DpCellRect at = dp_cells(0, 0, SIDE, SIDE), some = dp_cells(14, 17, 7, 11);
    CHECK(dp_sim_layers(stand.sim, DP_FIELD_LAYER, &at, all) == DP_OK);
    CHECK(dp_sim_layers(stand.sim, DP_FIELD_LAYER, &some, part) == DP_OK);
    for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 7; ++i) CHECK(part[j * 7 + i] == all[(j + 17) * SIDE + i + 14]);
    dp_alloc_fail_after(0);
    CHECK(dp_sim_layers(stand.sim, DP_FIELD_LAYER, &some, part) == DP_NO_MEMORY);
    dp_alloc_fail_after(-1);
    stand_drop(&stand);
}

TEST(there_are_as_many_as_the_kind_that_has_most)
{
    const DpSoil soil = dp_soil_default();
    stand_make(&stand, 1);
    stand_load_on(&stand, layered(), dp_sim_options_default());
    const bool want[4] = {true, true, false, false};
    for (int layer = 0; layer < 4; ++layer)
        CHECK(dp_sim_is_of_layers(stand.sim, DP_FIELD_LAYER + layer) == want[layer]);
    stand_drop(&stand);
    stand_make(&stand, 1);
    stand_load(&stand, &soil, dp_sim_options_default());
    CHECK(!dp_sim_is_of_layers(stand.sim, DP_FIELD_LAYER));  // one soil
    stand_drop(&stand);
}

int main(void)
{
    RUN(each_layer_is_thinner_by_what_it_has_yielded);
    RUN(a_window_reads_what_all_of_it_does);
    RUN(there_are_as_many_as_the_kind_that_has_most);
    return check_done();
}
