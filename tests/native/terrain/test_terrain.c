#include <limits.h>
#include <math.h>

#include "terrain/ground.h"

static const DpField playback[] = {DP_FIELD_HEIGHT_CHANGE, DP_FIELD_PLANT_STRENGTH,
                                   DP_FIELD_COMPRESSION, DP_FIELD_PRESSURE_TIME};

typedef struct Visits
{
    int  count;
    long tx[64], ty[64];
} Visits;

static void visit(void* context, long tx, long ty)
{
    Visits* visits = context;
    visits->tx[visits->count] = tx;
    visits->ty[visits->count++] = ty;
}

// lend cells, write three numbers into all of them and give them back
static DpStatus write_cells(DpTerrain* terrain, long i0, long i1, long j0, long j1,
                            float compression, float heap, float pressure_time)
{
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    DpStatus     status = dp_terrain_acquire(terrain, lease, (DpCellRect){i0, i1, j0, j1}, &patch);
    if (status == DP_OK) {
        for (int j = 0; j < patch->ny; ++j)
            for (int i = 0; i < patch->nx; ++i) {
                const int at = j * patch->row + i;
                patch->compression[at] = compression;
                patch->heap[at] = heap;
                patch->pressure_time[at] = pressure_time;
            }
        dp_terrain_commit(terrain, lease, (DpCellRect){0, patch->nx, 0, patch->ny});
    }
    dp_lease_destroy(lease);
    return status;
}

TEST(untouched_ground_costs_nothing)
{
    const DpGround ground = ground_flat(1.5);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, -5000.0, -5000.0);
    const size_t   before = dp_bytes_live();
    const double   xy[] = {1234.5, -4321.0, 0.0, 0.0, 4999.0, 4999.0};
    double         height[3];
    dp_terrain_base_height(terrain, 3, xy, height);
    for (int n = 0; n < 3; ++n) CHECK(height[n] == 1.5);
    const DpVec3 normal = dp_terrain_normal(terrain, 3.0, 4.0, 0.2);
    CHECK(normal.x == 0.0 && normal.y == 0.0 && normal.z == 1.0);
    float rgba[DP_TILE * DP_TILE * 4];
    rgba[17] = 3.0f;
    for (int c = 0; c < 4; ++c) dp_terrain_tile(terrain, 3, -9, playback[c], rgba + c, 4);
    for (int n = 0; n < DP_TILE * DP_TILE * 4; ++n) CHECK(rgba[n] == 0.0f);
    float field[9] = {9.0f};
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, 999000, -5, 3, 3, field) == DP_OK);
    CHECK(field[0] == 0.0f);
    CHECK(dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, 999000, -5, 3, 3, field) == DP_OK);
    CHECK(field[0] == 1.5f);
    CHECK(dp_terrain_tile_count(terrain) == 0);
    CHECK(dp_bytes_live() == before);
    double bounds[4];
    dp_terrain_bounds(terrain, bounds);
    CHECK(bounds[0] == -INFINITY && bounds[1] == -INFINITY);
    CHECK(bounds[2] == INFINITY && bounds[3] == INFINITY);
    dp_terrain_destroy(terrain);
}

TEST(a_walk_over_ten_kilometres_stays_small)
{
    const DpGround ground = ground_flat(0.0);
    dp_bytes_peak_reset();
    const size_t before = dp_bytes_peak();
    DpTerrain*   terrain = ground_terrain(&ground, 0.01, -5000.0, -5000.0);
    for (long step = 0; step < 100; ++step) {  // 10 m, windows of 0.6 m, far from the corner
        const long i = 987000 + 10 * step, j = 912345 + 20 * (step % 2);
        CHECK(write_cells(terrain, i, i + 60, j, j + 60, 0.01f, 0.002f, 1.0f) == DP_OK);
    }
    CHECK(dp_terrain_tile_count(terrain) > 16 && dp_terrain_tile_count(terrain) < 70);
    CHECK(dp_bytes_peak() - before < 8u << 20);
    dp_terrain_destroy(terrain);
}

TEST(what_is_given_back_is_there)
{
    const DpGround ground = ground_flat(2.0);
    DpTerrain*     terrain = ground_terrain(&ground, 0.25, 10.0, -20.0);
    DpLease*       lease = dp_lease_create();
    DpSoilPatch*   patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){-70, 75, -3, 66}, &patch) == DP_OK);
    CHECK(patch->nx == 145 && patch->ny == 69 && patch->row == 160);
    CHECK(patch->cell == 0.25);
    CHECK(patch->x0 == 10.0 + (-70 + 0.5) * 0.25 && patch->y0 == -20.0 + (-3 + 0.5) * 0.25);
    CHECK(patch->soil_count == 3 && patch->soils[1].young_modulus == 4e5f);
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->row; ++i) {
            const int at = j * patch->row + i;
            CHECK(i < patch->nx ? patch->base_height[at] == 2.0f : isnan(patch->base_height[at]));
            CHECK(patch->compression[at] == 0.0f && patch->heap[at] == 0.0f);
            CHECK(patch->pressure_time[at] == 0.0f && patch->kind[at] == 0);
            CHECK(patch->modulus[at] == 2e6f);
            CHECK_CLOSE(patch->rest_slope[at], tan(0.5585), 1e-6);
            patch->compression[at] = (float)(1000 * j + i);
            patch->heap[at] = (float)(i - 1000 * j);
            patch->pressure_time[at] = (float)(i * j);
        }
    CHECK(((uintptr_t)patch->compression & 63) == 0 && ((uintptr_t)patch->heap & 63) == 0);
    dp_terrain_commit(terrain, lease, (DpCellRect){5, 140, 1, 68});

    float field[3][145 * 69];
    CHECK(dp_terrain_read(terrain, DP_FIELD_COMPRESSION, -70, -3, 145, 69, field[0]) == DP_OK);
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, -70, -3, 145, 69, field[1]) == DP_OK);
    CHECK(dp_terrain_read(terrain, DP_FIELD_PRESSURE_TIME, -70, -3, 145, 69, field[2]) == DP_OK);
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){-60, 75, -3, 66}, &patch) == DP_OK);
    for (int j = 0; j < 69; ++j)
        for (int i = 0; i < 145; ++i) {
            const bool in = i >= 5 && i < 140 && j >= 1 && j < 68;
            CHECK(field[0][j * 145 + i] == (in ? (float)(1000 * j + i) : 0.0f));
            CHECK(field[1][j * 145 + i] == (in ? (float)(i - 1000 * j) : 0.0f));
            CHECK(field[2][j * 145 + i] == (in ? (float)(i * j) : 0.0f));
            if (i >= 10) CHECK(patch->heap[j * patch->row + i - 10] == field[1][j * 145 + i]);
        }
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

TEST(changed_tiles_are_told_once_and_in_order)
{
    const DpGround ground = ground_flat(0.0);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    Visits         visits = {0};
    CHECK(dp_terrain_touch(terrain, (DpCellRect){-500, 500, -500, 500}) == DP_OK);
    dp_terrain_changed(terrain, visit, &visits);
    CHECK(visits.count == 0);  // touched is not changed
    CHECK(write_cells(terrain, 60, 70, 130, 131, 1.0f, 0.0f, 0.0f) == DP_OK);
    CHECK(write_cells(terrain, -1, 1, -1, 1, 1.0f, 0.0f, 0.0f) == DP_OK);
    CHECK(write_cells(terrain, 60, 70, 130, 131, 2.0f, 0.0f, 0.0f) == DP_OK);
    dp_terrain_changed(terrain, visit, &visits);
    const long tx[] = {-1, 0, -1, 0, 0, 1}, ty[] = {-1, -1, 0, 0, 2, 2};
    CHECK(visits.count == 6);
    for (int n = 0; n < 6; ++n) CHECK(visits.tx[n] == tx[n] && visits.ty[n] == ty[n]);
    dp_terrain_changed(terrain, visit, &visits);
    CHECK(visits.count == 6);
    CHECK(write_cells(terrain, 65, 66, 131, 132, 2.0f, 0.0f, 0.0f) == DP_OK);
    dp_terrain_changed(terrain, visit, &visits);
    CHECK(visits.count == 7 && visits.tx[6] == 1 && visits.ty[6] == 2);
    CHECK(write_cells(terrain, 65, 66, 131, 132, 2.0f, 0.0f, 0.0f) == DP_OK);  // nothing new
    dp_terrain_changed(terrain, visit, &visits);
    CHECK(visits.count == 7);
    for (int again = 1; again <= 2; ++again) {  // each of them is told of whenever it changes anew
        visits.count = 0;
        CHECK(write_cells(terrain, -1, 1, -1, 1, 3.0f * (float)again, 0.0f, 0.0f) == DP_OK);
        dp_terrain_changed(terrain, visit, &visits);
        CHECK(visits.count == 4);
        for (int n = 0; n < visits.count; ++n)
            CHECK(visits.tx[n] == tx[n] && visits.ty[n] == ty[n]);
    }
    dp_terrain_destroy(terrain);
}

TEST(pixels_of_a_tile)
{
    const DpGround ground = ground_flat(7.0);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    CHECK(write_cells(terrain, -64, -62, -1, 0, 0.03f, 0.01f, 5.0f) == DP_OK);
    static float rgba[DP_TILE * DP_TILE * 4];
    for (int c = 0; c < 4; ++c) dp_terrain_tile(terrain, -1, -1, playback[c], rgba + c, 4);
    const float* pixel = rgba + (size_t)63 * DP_TILE * 4;  // the highest row
    for (int i = 0; i < 3; ++i, pixel += 4) {
        CHECK(pixel[0] == (i < 2 ? 0.01f - 0.03f : 0.0f));
        CHECK(pixel[1] == 0.0f);
        CHECK(pixel[2] == (i < 2 ? 0.03f : 0.0f));
        CHECK(pixel[3] == (i < 2 ? 5.0f : 0.0f));
    }
    CHECK(rgba[0] == 0.0f);
    dp_terrain_destroy(terrain);
}

TEST(totals_do_not_depend_on_who_came_first)
{
    double sums[2][3];
    for (int way = 0; way < 2; ++way) {
        const DpGround ground = ground_flat(0.0);
        DpTerrain*     terrain = ground_terrain(&ground, 0.02, 0.0, 0.0);
        for (int n = 0; n < 40; ++n) {
            const int      step = way ? 39 - n : n;
            const long     i = 97 * step - 1000, j = 61 * ((step * 7) % 40) - 1200;
            const DpStatus status =
                write_cells(terrain, i, i + 9, j, j + 7, 0.1f + 0.01f * (float)step,
                            1.0f / (float)(3 + step), 0.0f);
            CHECK(status == DP_OK);
        }
        dp_terrain_totals(terrain, &sums[way][0], &sums[way][1], &sums[way][2]);
        dp_terrain_destroy(terrain);
    }
    CHECK(memcmp(sums[0], sums[1], sizeof sums[0]) == 0);
    double heaped = 0.0, pressed = 0.0;
    for (int n = 0; n < 40; ++n) {
        heaped += 63.0 * 0.0004 / (3.0 + n);
        pressed += 63.0 * 0.0004 * (0.1 + 0.01 * n);
    }
    CHECK_CLOSE(sums[0][0], heaped, 1e-6);
    CHECK_CLOSE(sums[0][1], pressed, 1e-6);
    CHECK_NEAR(sums[0][2], 0.49, 1e-6);
}

TEST(many_tiles_are_all_found_again)
{
    const DpGround ground = ground_flat(0.0);
    DpTerrain*     terrain = ground_terrain(&ground, 1.0, 0.0, 0.0);
    unsigned       seed = 8;
    const long     apart = sizeof(long) > 4 ? 1000 : 1;  // as far as cells are counted
    long           at[300][2];
    for (int n = 0; n < 300; ++n) {
        at[n][0] = (long)(2e9 * (check_random(&seed) - 0.5)) * apart;
        at[n][1] = (long)(2e9 * (check_random(&seed) - 0.5)) * apart;
        CHECK(write_cells(terrain, at[n][0], at[n][0] + 1, at[n][1], at[n][1] + 1, (float)n + 1.0f,
                          0.0f, 0.0f) == DP_OK);
    }
    CHECK(dp_terrain_tile_count(terrain) == 300);
    for (int n = 0; n < 300; ++n) {
        float got[4];
        CHECK(dp_terrain_read(terrain, DP_FIELD_COMPRESSION, at[n][0], at[n][1], 2, 2, got) ==
              DP_OK);
        CHECK(got[0] == (float)n + 1.0f && got[1] == 0.0f && got[2] == 0.0f);
    }
    dp_terrain_destroy(terrain);
}

TEST(bad_arguments_are_refused)
{
    DpTerrain*       terrain = NULL;
    DpGround         ground = ground_flat(0.0);
    DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
#define REFUSED(what)                                                             \
    do {                                                                          \
        what;                                                                     \
        CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_BAD_ARGUMENT); \
        CHECK(terrain == NULL);                                                   \
        ground = ground_flat(0.0);                                                \
        options = ground_options(0.01, 0.0, 0.0);                                 \
    } while (0)
    DpSoil soil = ground_soils[0];
    REFUSED(options.grid.cell = 0.0);
    REFUSED(options.grid.cell = -1.0);
    REFUSED(options.grid.cell = (double)NAN);
    REFUSED(options.grid.cell = (double)INFINITY);
    REFUSED(options.grid.x0 = (double)NAN);
    REFUSED(options.grid.y0 = (double)INFINITY);
    REFUSED(options.soil_count = 0);
    REFUSED(options.soil_count = 256);
    REFUSED(options.soils = NULL);
    REFUSED(soil.young_modulus = 0.0f; options.soils = &soil; options.soil_count = 1);
    soil = ground_soils[0];
    REFUSED(soil.rest_angle = 1.6f; options.soils = &soil; options.soil_count = 1);
    REFUSED(ground.height = (double)NAN);
    REFUSED(ground.kind_count = 4);
    REFUSED(ground.kind_count = -1);
    REFUSED(ground.kind = (DpGroundKind)3);
    CHECK(dp_terrain_create(&terrain, &options, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_create(&terrain, NULL, &ground) == DP_BAD_ARGUMENT);

    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){5, 5, 0, 1}, &patch) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){0, 1, 3, 2}, &patch) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){0, LONG_MAX, 0, 1}, &patch) ==
          DP_BAD_ARGUMENT);
    CHECK(dp_terrain_touch(terrain, (DpCellRect){0, 1000000, 0, 1000000}) == DP_NO_MEMORY);
    CHECK(dp_terrain_touch(terrain, (DpCellRect){0, 0, 0, 1}) == DP_BAD_ARGUMENT);
    float cell;
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, 0, 0, 0, 1, &cell) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_read(terrain, (DpField)8, 0, 0, 1, 1, &cell) == DP_BAD_ARGUMENT);
    CHECK(patch == NULL && dp_terrain_tile_count(terrain) == 0);
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
    dp_terrain_destroy(NULL);
    dp_lease_destroy(NULL);
}

TEST(without_memory_nothing_is_half_done)
{
    const DpGround         ground = ground_flat(0.0);
    const DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    DpTerrain*             terrain = NULL;
    for (long left = 0; left < 3; ++left) {
        dp_alloc_fail_after(left);
        CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_NO_MEMORY);
    }
    dp_alloc_fail_after(-1);
    CHECK(terrain == NULL);
    terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    CHECK(write_cells(terrain, 0, 3, 0, 3, 1.0f, 0.0f, 0.0f) == DP_OK);
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    long         left = 0;
    for (;; ++left) {  // until it passes
        dp_alloc_fail_after(left);
        const DpStatus status =
            dp_terrain_acquire(terrain, lease, (DpCellRect){-600, 600, -600, 600}, &patch);
        dp_alloc_fail_after(-1);
        if (status == DP_OK) break;
        CHECK(status == DP_NO_MEMORY && patch == NULL);
        CHECK(dp_terrain_tile_count(terrain) == 1 || dp_terrain_tile_count(terrain) == 400);
    }
    CHECK(left > 400 && dp_terrain_tile_count(terrain) == 400);
    CHECK(patch->compression[600 * patch->row + 600] == 1.0f);
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

// floats on tiles count from a whole multiple of 16 m near the ground, which stays once a tile is there
TEST(heights_count_from_a_multiple_of_16)
{
    const double height[] = {0.0, 7.9, 8.1, 100.0, -1234.5};
    const double datum[] = {0.0, 0.0, 16.0, 96.0, -1232.0};
    for (int k = 0; k < 5; ++k) {
        const DpGround ground = ground_flat(height[k]);
        DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
        CHECK(dp_terrain_datum(terrain) == datum[k]);
        dp_terrain_move_datum(terrain, 50.0);
        CHECK(dp_terrain_datum(terrain) == 48.0);
        CHECK(dp_terrain_touch(terrain, (DpCellRect){0, 1, 0, 1}) == DP_OK);
        dp_terrain_move_datum(terrain, 0.0);
        CHECK(dp_terrain_datum(terrain) == 48.0);
        dp_terrain_destroy(terrain);
    }
}

int main(void)
{
    RUN(untouched_ground_costs_nothing);
    RUN(a_walk_over_ten_kilometres_stays_small);
    RUN(what_is_given_back_is_there);
    RUN(changed_tiles_are_told_once_and_in_order);
    RUN(pixels_of_a_tile);
    RUN(totals_do_not_depend_on_who_came_first);
    RUN(many_tiles_are_all_found_again);
    RUN(bad_arguments_are_refused);
    RUN(without_memory_nothing_is_half_done);
    RUN(heights_count_from_a_multiple_of_16);
    return check_done();
}
