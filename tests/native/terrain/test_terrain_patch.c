#include <limits.h>

#include <math.h>

#include "base/parallel.h"
#include "terrain/ground.h"

#define SIDE 48     // cells of a window: several of them share a tile
#define WINDOWS 64  // 8 x 8 of them, side by side

typedef struct Many
{
    DpTerrain* terrain;
    DpLease*   lease[8];
    int        bad[8];
} Many;

// add to every cell of one window a number that tells the cell
static void press_window(void* context, int index, int worker)
{
    Many*        many = context;
    DpSoilPatch* patch = NULL;
    const long   i0 = (index % 8) * SIDE - 200, j0 = (index / 8) * SIDE - 200;
    if (dp_terrain_acquire(many->terrain, many->lease[worker],
                           (DpCellRect){i0, i0 + SIDE, j0, j0 + SIDE}, &patch) != DP_OK) {
        ++many->bad[worker];
        return;
    }
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            patch->compression[j * patch->row + i] += (float)(index + 1);
            patch->heap[j * patch->row + i] += 0.5f * (float)(i + j);
            patch->pressure_time[j * patch->row + i] += 1.0f;
        }
    dp_terrain_commit(many->terrain, many->lease[worker], (DpCellRect){0, SIDE, 0, SIDE});
}

static void count_tile(void* context, long tx, long ty)
{
    (void)tx, (void)ty;
    ++*(int*)context;
}

TEST(windows_side_by_side_do_not_disturb_each_other)
{
    static float got[3][8 * SIDE * 8 * SIDE];
    for (int workers = 1; workers <= 8; ++workers) {
        const DpGround ground = ground_flat(0.0);
        Many           many = {ground_terrain(&ground, 0.01, 0.0, 0.0), {NULL}, {0}};
        for (int w = 0; w < workers; ++w) many.lease[w] = dp_lease_create();
        const long end = -200 + 8 * SIDE;
        CHECK(dp_terrain_touch(many.terrain, (DpCellRect){-200, end, -200, end}) == DP_OK);
        const int rounds = 5;
        for (int round = 0; round < rounds; ++round)
            dp_parallel_for(WINDOWS, workers, press_window, &many);
        for (DpField field = DP_FIELD_COMPRESSION; field <= DP_FIELD_PRESSURE_TIME; ++field)
            CHECK(dp_terrain_read(many.terrain, field, -200, -200, 8 * SIDE, 8 * SIDE,
                                  got[field]) == DP_OK);
        for (int n = 0; n < 8 * SIDE * 8 * SIDE; ++n) {
            const int i = n % (8 * SIDE), j = n / (8 * SIDE);
            const int index = j / SIDE * 8 + i / SIDE;
            CHECK(got[0][n] == (float)(rounds * (index + 1)));
            CHECK(got[1][n] == 2.5f * (float)(i % SIDE + j % SIDE));
            CHECK(got[2][n] == (float)rounds);
        }
        int changed = 0;
        dp_terrain_changed(many.terrain, count_tile, &changed);
        CHECK(changed == 49 && dp_terrain_tile_count(many.terrain) == 49);
        for (int w = 0; w < workers; ++w) {
            CHECK(many.bad[w] == 0);
            dp_lease_destroy(many.lease[w]);
        }
        dp_terrain_destroy(many.terrain);
    }
}

TEST(cells_without_ground_are_never_written)
{
    const float    height[9] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, NAN, 0.0f, 0.0f};
    const DpGround ground = ground_heights(3, 3, 0.0, 0.0, 1.0, height);
    DpTerrain*     terrain = ground_terrain(&ground, 0.1, 0.0, 0.0);
    DpLease*       lease = dp_lease_create();
    DpSoilPatch*   patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){-5, 25, -5, 25}, &patch) == DP_OK);
    for (int n = 0; n < patch->row * patch->ny; ++n)
        patch->compression[n] = patch->heap[n] = patch->pressure_time[n] = 1.0f;
    dp_terrain_commit(terrain, lease, (DpCellRect){0, patch->nx, 0, patch->ny});
    float got[4][900];
    for (DpField field = DP_FIELD_COMPRESSION; field <= DP_FIELD_BASE_HEIGHT; ++field)
        CHECK(dp_terrain_read(terrain, field, -5, -5, 30, 30, got[field]) == DP_OK);
    int ground_cells = 0;
    for (int n = 0; n < 900; ++n) {
        const int  i = n % 30 - 5, j = n / 30 - 5;
        const bool hole = i < 0 || j < 0 || i >= 20 || j >= 20 || (i < 10 && j >= 10);
        CHECK(isnan(got[3][n]) == hole);
        for (int f = 0; f < 3; ++f) CHECK(got[f][n] == (hole ? 0.0f : 1.0f));
        ground_cells += !hole;
    }
    CHECK(ground_cells == 300);
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

TEST(each_soil_brings_its_modulus_and_slope)
{
    const float height[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    const float weight[12] = {1.0f, 0.0f, 0.0f, 0.2f, 0.0f, 1.0f,
                              0.0f, 0.2f, 0.0f, 0.0f, 1.0f, 0.2f};
    DpGround    ground = ground_heights(2, 2, 0.0, 0.0, 1.0, height);
    ground.kind_count = 3;
    ground.kind_weight = weight;
    DpTerrain*   terrain = ground_terrain(&ground, 0.125, 0.0, 0.0);
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){0, 8, 0, 8}, &patch) == DP_OK);
    float modulus[64], kind[64];
    CHECK(dp_terrain_read(terrain, DP_FIELD_MODULUS, 0, 0, 8, 8, modulus) == DP_OK);
    CHECK(dp_terrain_read(terrain, DP_FIELD_KIND, 0, 0, 8, 8, kind) == DP_OK);
    for (int n = 0; n < 64; ++n) {
        const int i = n % 8, j = n / 8, at = j * patch->row + i;
        const int want = j < 4 ? (i < 4 ? 0 : 1) : (i < 4 ? 2 : 0);  // of equals the first
        CHECK(patch->kind[at] == want && kind[n] == (float)want);
        CHECK(patch->modulus[at] == ground_soils[want].young_modulus);
        CHECK(modulus[n] == ground_soils[want].young_modulus);
        CHECK_CLOSE(patch->rest_slope[at], tan((double)ground_soils[want].rest_angle), 1e-6);
    }
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

// windows at the end of all numbers are none, and asking for them overflows nothing
TEST(windows_that_cannot_be_are_refused)
{
    const DpGround ground = ground_flat(0.0);
    DpTerrain*     terrain = ground_terrain(&ground, 0.1, 0.0, 0.0);
    const long     far[4] = {LONG_MAX, LONG_MAX - 3, LONG_MIN, LONG_MIN + 3};
    float          got[16];
    for (int n = 0; n < 4; ++n) {
        CHECK(!dp_terrain_has(far[n], 0, 4, 4) && !dp_terrain_has(0, far[n], 4, 4));
        for (DpField field = DP_FIELD_COMPRESSION; field <= DP_FIELD_HEIGHT_CHANGE; ++field) {
            CHECK(dp_terrain_read(terrain, field, far[n], 0, 4, 4, got) == DP_BAD_ARGUMENT);
            CHECK(dp_terrain_read(terrain, field, 0, far[n], 4, 4, got) == DP_BAD_ARGUMENT);
        }
    }
    CHECK(!dp_terrain_has(0, 0, 0, 4) && !dp_terrain_has(0, 0, 4, LONG_MAX));
    CHECK(dp_terrain_has(-1000000, 1000000, 4, 4));
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, -1000000, 1000000, 4, 4, got) == DP_OK);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(windows_side_by_side_do_not_disturb_each_other);
    RUN(cells_without_ground_are_never_written);
    RUN(each_soil_brings_its_modulus_and_slope);
    RUN(windows_that_cannot_be_are_refused);
    return check_done();
}
