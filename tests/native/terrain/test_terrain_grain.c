// tests of terrain_grain.c: MODEL 6.15
#include "check.h"
#include "terrain/terrain.h"

#define CELL 0.01

static DpSoil loose(void)
{
    return (DpSoil){.layer_depth = 0.3f,
                    .young_modulus = 1e6f,
                    .poisson_ratio = 0.35f,
                    .settle_time = 0.1f,
                    .rest_angle = 0.5236f,
                    .wall_angle = 1.5707f,
                    .grain_size = 0.012f,
                    .bekker_power = 1.0f};
}

// 1 x 1 m of level ground
static DpTerrain* field(void)
{
    static const float     heights[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    const DpSoil           soil = loose();
    const DpTerrainOptions options = {
        .grid = {CELL, 0.0, 0.0}, .soils = &soil, .soil_count = 1, .workers = 1};
    const DpGround ground = {
        .kind = DP_GROUND_HEIGHTS, .nx = 2, .ny = 2, .spacing = 1.0, .heights = heights};
    DpTerrain* terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    return terrain;
}

static double cell_of(const DpTerrain* terrain, DpField what, long i, long j)
{
    float value = 0.0f;
    CHECK(dp_terrain_read(terrain, what, i, j, 1, 1, &value) == DP_OK);
    return (double)value;
}

// one print of 30 x 30 cells, 4 mm deep
static void press(DpTerrain* terrain)
{
    float   deep[30 * 30], none[30 * 30];
    DpTrail trail = {.i0 = 20,
                     .j0 = 20,
                     .nx = 30,
                     .ny = 30,
                     .compression = deep,
                     .heap = none,
                     .pressure_time = none};
    for (int n = 0; n < 30 * 30; ++n) deep[n] = 0.004f, none[n] = 0.0f;
    CHECK(dp_terrain_lay(terrain, &trail) == DP_OK);
}

// A volume lies in the cells of its square, by how much of them lies within.
TEST(a_volume_is_laid_by_area)
{
    DpTerrain* terrain = field();
    DpCellRect cells;
    double     laid;
    CHECK(dp_terrain_drop(terrain, 0.305, 0.40, 0.02, 1e-6, &cells, &laid) == DP_OK);
    CHECK_CLOSE(laid, 1e-6, 1e-6);
    CHECK(cells.i0 == 29 && cells.i1 == 32 && cells.j0 == 39 && cells.j1 == 41);
    CHECK_CLOSE(cell_of(terrain, DP_FIELD_HEAP, 30, 39), 1e-6 / 4.0 / 1e-4, 1e-6);
    CHECK_CLOSE(cell_of(terrain, DP_FIELD_HEAP, 29, 40), 0.5e-6 / 4.0 / 1e-4, 1e-6);
    CHECK_CLOSE(cell_of(terrain, DP_FIELD_HEAP, 31, 40), 0.5e-6 / 4.0 / 1e-4, 1e-6);
    // smaller than a cell: all of it in one
    CHECK(dp_terrain_drop(terrain, 0.606, 0.703, 0.002, 1e-6, &cells, &laid) == DP_OK);
    CHECK_CLOSE(cell_of(terrain, DP_FIELD_HEAP, 60, 70), 1e-2, 1e-6);
    dp_terrain_destroy(terrain);
    // wider than 64 cells: in the 64 in the middle
    const double wide[2] = {0.4, 0.9}, lies_in[2] = {0.4, 64.0 * CELL};
    for (int k = 0; k < 2; ++k) {
        terrain = field();
        CHECK(dp_terrain_drop(terrain, 0.5, 0.5, wide[k], 1e-4, &cells, &laid) == DP_OK);
        CHECK_CLOSE(laid, 1e-4, 1e-5);
        CHECK(cells.i1 - cells.i0 == (int)(lies_in[k] / CELL + 0.5));
        CHECK_CLOSE(cell_of(terrain, DP_FIELD_HEAP, cells.i0, cells.j0),
                    1e-4 / lies_in[k] / lies_in[k], 1e-5);
        dp_terrain_destroy(terrain);
    }
}

TEST(beside_the_ground_nothing_is_laid)
{
    DpTerrain* terrain = field();
    DpCellRect cells;
    double     laid;
    CHECK(dp_terrain_drop(terrain, 1.2, 0.5, 0.02, 1e-6, &cells, &laid) == DP_OK);
    CHECK(laid == 0.0);
    CHECK(dp_terrain_drop(terrain, 1e300, 0.5, 0.02, 1e-6, &cells, &laid) == DP_OK);
    CHECK(laid == 0.0);
    CHECK(dp_terrain_drop(terrain, 0.999, 0.5, 0.02, 1e-6, &cells, &laid) == DP_OK);
    CHECK_CLOSE(laid, 1e-6, 1e-6);  // half beside: all of it lies on what there is
    dp_terrain_destroy(terrain);
}

// Heaps first, then what was pressed; never more than that.
TEST(no_more_is_taken_than_was_disturbed)
{
    DpTerrain* terrain = field();
    DpCellRect cells;
    DpDug      dug;
    double     laid, heap, firm = 0.0, pressed[2], deepest;
    CHECK(!dp_terrain_dig(terrain, 0.35, 0.35, 0.01, 1e-8, &dug));  // nobody was there
    press(terrain);
    dp_terrain_totals(terrain, &heap, &pressed[0], &deepest);
    CHECK(dp_terrain_drop(terrain, 0.355, 0.355, 0.01, 1e-7, &cells, &laid) == DP_OK);
    CHECK(dp_terrain_dig(terrain, 0.355, 0.355, 0.01, 3e-7, &dug) && dug.kind == 0);
    CHECK_CLOSE(dug.heap, laid, 1e-6);
    CHECK_CLOSE(dug.heap + dug.firm, 3e-7, 1e-5);
    firm += dug.firm;
    for (int k = 0; k < 100 && dp_terrain_dig(terrain, 0.355, 0.355, 0.01, 3e-8, &dug); ++k)
        firm += dug.firm;
    CHECK(!dp_terrain_dig(terrain, 0.355, 0.355, 0.01, 1e-3, &dug));
    dp_terrain_totals(terrain, &heap, &pressed[1], &deepest);
    CHECK_NEAR(pressed[1] - pressed[0], firm, 1e-12);
    CHECK_NEAR(heap, 0.0, 1e-15);
    dp_terrain_destroy(terrain);
}

TEST(steep_places_are_told)
{
    DpTerrain* terrain = field();
    DpCellRect cells;
    double     laid;
    CHECK(dp_terrain_drop(terrain, 0.505, 0.505, 0.01, 1e-7, &cells, &laid) == DP_OK);
    CHECK(!dp_terrain_steep(terrain, cells));  // 1 mm on 1 cm
    CHECK(dp_terrain_drop(terrain, 0.505, 0.505, 0.01, 6e-7, &cells, &laid) == DP_OK);
    CHECK(dp_terrain_steep(terrain, cells));
    dp_terrain_destroy(terrain);
}

// nothing is taken from below 95 per cent of a layer, however deep it was pressed
TEST(what_is_rigid_below_stays)
{
    const float  depth = 0.28f, layer = 0.3f;  // of soil 0
    DpTerrain*   terrain = field();
    DpLease*     lease = dp_lease_create();
    DpDug        dug;
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, dp_cells(35, 35, 1, 1), &patch) == DP_OK);
    patch->compression[0] = depth;
    dp_terrain_commit(terrain, lease, dp_cells(0, 0, 1, 1));
    dp_lease_destroy(lease);
    const double left = (0.95 * (double)layer - (double)depth) * 1e-4;
    CHECK(!dp_terrain_dig(terrain, 0.355, 0.355, 0.01, 1.01 * left, &dug));
    CHECK(dp_terrain_dig(terrain, 0.355, 0.355, 0.01, 0.99 * left, &dug));
    CHECK_CLOSE(dug.firm, 0.99 * left, 1e-4);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(a_volume_is_laid_by_area);
    RUN(beside_the_ground_nothing_is_laid);
    RUN(no_more_is_taken_than_was_disturbed);
    RUN(steep_places_are_told);
    RUN(what_is_rigid_below_stays);
    return check_done();
}
