// tests of terrain_layers.c: what lies on what is kept as it was told, or refused. MODEL 6.17
#include <string.h>

#include "base/alloc.h"
#include "ground.h"

// kind 0 lies in three layers, kind 1 is one soil, kind 2 lies in two
static const int start[4] = {0, 3, 3, 5};

static void layers_fill(DpLayer layer[5])
{
    for (int n = 0; n < 5; ++n) {
        layer[n] = (DpLayer){.soil = ground_soils[n % 3], .thickness = 0.02 + 0.01 * n};
        layer[n].soil.young_modulus = 1e5f * (float)(n + 1);
    }
}

static DpTerrain* flat(void)
{
    const DpGround ground = ground_flat(0.0);
    return ground_terrain(&ground, 0.01, 0.0, 0.0);
}

TEST(layers_are_those_of_their_kind)
{
    DpTerrain* terrain = flat();
    DpLayer    layer[5], told[5];
    int        many[4], count = -1;
    layers_fill(layer), layers_fill(told);
    memcpy(many, start, sizeof many);
    for (int kind = 0; kind < 3; ++kind)
        CHECK(!dp_terrain_layers(terrain, kind, &count) && count == 0);  // none yet
    CHECK(dp_terrain_set_layers(terrain, told, many) == DP_OK);
    memset(told, 0, sizeof told), memset(many, 0, sizeof many);  // it has copied them
    for (int kind = 0; kind < 3; ++kind) {
        const DpLayer* got = dp_terrain_layers(terrain, kind, &count);
        CHECK(count == start[kind + 1] - start[kind] && (got != NULL) == (count > 0));
        for (int n = 0; n < count; ++n) {
            const DpLayer* want = &layer[start[kind] + n];
            CHECK_NEAR(got[n].thickness, want->thickness, 0.0);
            CHECK(memcmp(&got[n].soil, &want->soil, sizeof want->soil) == 0);
        }
    }
    dp_terrain_destroy(terrain);
}

// a wet layer yields as a wet soil does: the terrain's own soils tell how
TEST(layers_are_as_wet_as_soils_are)
{
    DpSoil wet[3];
    for (int k = 0; k < 3; ++k) wet[k] = ground_soils[k], wet[k].wetness = 1.0f - 0.02f * (float)k;
    DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    options.soils = wet;
    const DpGround ground = ground_flat(0.0);
    DpTerrain*     terrain = NULL;
    DpLayer        layer[5];
    int            count;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    layers_fill(layer);
    for (int n = 0; n < 5; ++n) layer[n].soil = wet[n % 3];
    CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_OK);
    const DpLayer* got = dp_terrain_layers(terrain, 0, &count);
    for (int n = 0; n < 3; ++n) {
        const DpSoil* want = &dp_terrain_soils(terrain)[n];
        CHECK(memcmp(&got[n].soil, want, sizeof *want) == 0);
        CHECK(want->young_modulus < wet[n].young_modulus);
    }
    dp_terrain_destroy(terrain);
}

TEST(layers_that_cannot_be_are_refused)
{
    const int    bad[][4] = {{1, 3, 3, 5}, {0, 3, 2, 5}, {0, 5, 5, 5}, {0, 0, 0, 0}};
    const double thickness[] = {0.0, -0.1, 100.5, (double)NAN};
    DpTerrain*   terrain = flat();
    DpLayer      layer[5];
    int          count;
    layers_fill(layer);
    for (int n = 0; n < 4; ++n)
        CHECK(dp_terrain_set_layers(terrain, layer, bad[n]) == DP_BAD_ARGUMENT);
    for (int n = 0; n < 4; ++n) {
        layer[4].thickness = thickness[n];
        CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_BAD_ARGUMENT);
    }
    CHECK(dp_terrain_set_layers(terrain, NULL, start) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_set_layers(terrain, layer, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_set_layers(NULL, layer, start) == DP_BAD_ARGUMENT);
    layer[4].thickness = 100.0;
    for (long n = 0; n < 2; ++n) {
        dp_alloc_fail_after(n);
        CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
    }
    CHECK(!dp_terrain_layers(terrain, 0, &count));
    CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_OK);
    CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_BAD_ARGUMENT);  // a second time
    dp_terrain_destroy(terrain);
}

TEST(ground_that_was_touched_or_changes_over_time_takes_none)
{
    DpTerrain* terrain = flat();
    DpLayer    layer[5];
    layers_fill(layer);
    CHECK(dp_terrain_touch(terrain, dp_cells(0, 0, 1, 1)) == DP_OK);
    CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_BAD_ARGUMENT);
    dp_terrain_destroy(terrain);

    const double     time[1] = {0.0};
    const DpGround   ground = ground_flat(0.0);
    DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    options.times = 1, options.time = time;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    CHECK(dp_terrain_set_layers(terrain, layer, start) == DP_BAD_ARGUMENT);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(layers_are_those_of_their_kind);
    RUN(layers_are_as_wet_as_soils_are);
    RUN(layers_that_cannot_be_are_refused);
    RUN(ground_that_was_touched_or_changes_over_time_takes_none);
    return check_done();
}
