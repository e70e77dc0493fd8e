// Planted ground: cover is asked for tile by tile, when it is needed, and stiffens what is lent.
#include <math.h>

#include "base/parallel.h"
#include "terrain/ground.h"

#define CELL 0.01

// cover that tells its place, and how often it was asked for
typedef struct Garden
{
    double share;
    int    asked;
} Garden;

static void grow(const void* context, double x0, double y0, double cell, int nx, int ny,
                 float* strength, float* roots)
{
    Garden* garden = (Garden*)(size_t)context;
    ++garden->asked;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const double at = fabs(sin(3.0 * (x0 + i * cell)) * cos(2.0 * (y0 + j * cell)));
            strength[j * nx + i] = (float)(garden->share * at);
            roots[j * nx + i] = (float)(1e6 * garden->share * at);
        }
}

static double strength_at(const Garden* garden, long i, long j)
{
    return garden->share *
           fabs(sin(3.0 * CELL * ((double)i + 0.5)) * cos(2.0 * CELL * ((double)j + 0.5)));
}

static DpTerrain* garden_terrain(Garden* garden)
{
    const DpGround         flat = ground_flat(0.25);
    const DpTerrainOptions options = {{CELL, 0.0, 0.0}, ground_soils, 3, 1, 0, NULL};
    DpTerrain*             terrain = NULL;
    CHECK(dp_terrain_create(&terrain, &options, &flat) == DP_OK);
    CHECK(dp_terrain_set_cover(terrain, grow, garden) == DP_OK);
    return terrain;
}

TEST(untouched_ground_shows_its_cover_and_keeps_nothing)
{
    Garden       garden = {0.8, 0};
    DpTerrain*   terrain = garden_terrain(&garden);
    const size_t before = dp_bytes_live();
    float        strength[50 * 30], modulus[50 * 30], tile[DP_TILE * DP_TILE * 2];
    CHECK(dp_terrain_read(terrain, DP_FIELD_PLANT_STRENGTH, -20, -10, 50, 30, strength) == DP_OK);
    CHECK(dp_terrain_read(terrain, DP_FIELD_MODULUS, -20, -10, 50, 30, modulus) == DP_OK);
    for (int k = 0; k < 50 * 30; ++k) {
        const double want = strength_at(&garden, k % 50 - 20, k / 50 - 10);
        CHECK_NEAR(strength[k], want, 1e-6);
        CHECK_CLOSE(modulus[k], (double)ground_soils[0].young_modulus + 1e6 * want, 1e-6);
    }
    dp_terrain_tile(terrain, 0, 0, DP_FIELD_PLANT_STRENGTH, tile + 1, 2);
    CHECK_NEAR(tile[2 * (5 * DP_TILE + 7) + 1], strength_at(&garden, 7, 5), 1e-6);
    CHECK(dp_bytes_live() == before && dp_terrain_tile_count(terrain) == 0);
    dp_terrain_destroy(terrain);
}

TEST(roots_stiffen_what_is_lent)
{
    Garden       garden = {0.8, 0};
    DpTerrain*   terrain = garden_terrain(&garden);
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){-3, 70, -5, 9}, &patch) == DP_OK);
    CHECK(garden.asked == 6);  // tiles
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i)
            CHECK_CLOSE(
                patch->modulus[j * patch->row + i],  // TRAIL (9)
                (double)ground_soils[0].young_modulus + 1e6 * strength_at(&garden, i - 3, j - 5),
                1e-6);
    CHECK(dp_terrain_set_cover(terrain, grow, &garden) == DP_BAD_ARGUMENT);  // somebody was here
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

static void list_tile(void* context, long tx, long ty)
{
    long* list = context;
    list[0] += 1;
    if (list[0] == 1) list[1] = tx, list[2] = ty;
}

TEST(cover_changes_where_it_is_told)
{
    Garden     garden = {0.8, 0};
    DpTerrain* terrain = garden_terrain(&garden);
    long       list[3] = {0, 0, 0};
    float      strength[64 * 64];
    CHECK(dp_terrain_touch(terrain, (DpCellRect){-10, 80, 0, 10}) == DP_OK);
    garden.share = 0.4, garden.asked = 0;
    dp_terrain_refresh_cover(terrain,
                             (DpCellRect){10, 20, 3, 500});  // one tile of those that are there
    CHECK(garden.asked == 1 && dp_terrain_tile_count(terrain) == 3);
    dp_terrain_changed(terrain, list_tile, list);
    CHECK(list[0] == 1 && list[1] == 0 && list[2] == 0);
    CHECK(dp_terrain_read(terrain, DP_FIELD_PLANT_STRENGTH, 0, 0, 64, 64, strength) == DP_OK);
    for (int k = 0; k < 64 * 64; ++k) {
        const int  i = k % 64, j = k / 64;
        const bool fresh = i >= 10 && i < 20 && j >= 3;
        CHECK_NEAR(strength[k], strength_at(&garden, i, j) * (fresh ? 1.0 : 2.0), 1e-6);
    }
    dp_terrain_refresh_cover(terrain,
                             (DpCellRect){10, 20, 3, 500});  // the same again: nothing is new
    list[0] = 0;
    dp_terrain_changed(terrain, list_tile, list);
    CHECK(list[0] == 0);
    dp_terrain_destroy(terrain);
}

TEST(the_surface_is_what_prints_left)
{
    const float    heights[4] = {0.0f, 1.0f, 2.0f, 3.0f};  // x + 2 y
    const DpGround slope = ground_heights(2, 2, -1.0, -1.0, 2.0, heights);
    DpTerrain*     terrain = ground_terrain(&slope, CELL, 0.0, 0.0);
    DpLease*       lease = dp_lease_create();
    DpSoilPatch*   patch = NULL;
    float          surface[20 * 20];
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){-10, 10, -10, 10}, &patch) == DP_OK);
    for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 20; ++i) {
            patch->compression[j * patch->row + i] = i < 10 ? 0.02f : 0.0f;
            patch->heap[j * patch->row + i] = i < 10 ? 0.0f : 0.01f;
        }
    dp_terrain_commit(terrain, lease, (DpCellRect){0, 20, 0, 20});
    dp_terrain_surface(terrain, -10, -10, 20, 20, surface);
    for (int k = 0; k < 400; ++k) {
        const double x = CELL * (k % 20 - 10 + 0.5), y = CELL * (k / 20 - 10 + 0.5);
        const double want = 1.5 + 0.5 * x + y + (k % 20 < 10 ? -0.02 : 0.01);
        CHECK_NEAR(surface[k], want, 1e-6);
        CHECK_NEAR(dp_terrain_surface_at(terrain, x, y), want, 1e-6);
    }
    CHECK_NEAR(dp_terrain_surface_at(terrain, 0.0, 0.0), 1.5 - 0.005, 1e-6);  // between two cells
    CHECK_NEAR(dp_terrain_surface_at(terrain, 0.9, 0.9), 1.5 + 0.45 + 0.9, 1e-6);  // untouched
    CHECK(isnan(dp_terrain_surface_at(terrain, 5.0, 0.0)));
    CHECK(isnan(dp_terrain_surface_at(terrain, NAN, 0.0)));
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(untouched_ground_shows_its_cover_and_keeps_nothing);
    RUN(roots_stiffen_what_is_lent);
    RUN(cover_changes_where_it_is_told);
    RUN(the_surface_is_what_prints_left);
    return check_done();
}
