// tests of terrain_tiles.c: tiles are found, come row by row, and tell once that they changed
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "base/os.h"
#include "folder.h"
#include "ground.h"
#include "terrain/terrain_inside.h"

#define WIDE 40  // tiles on each side of the origin

static DpTerrain* flat(void)
{
    const DpGround ground = ground_flat(1.0);
    return ground_terrain(&ground, 0.05, 0.1, -0.2);
}

static void touch_tile(DpTerrain* terrain, long tx, long ty)
{
    CHECK(dp_terrain_touch(terrain, dp_cells(tx * DP_TILE, ty * DP_TILE, 1, 1)) == DP_OK);
}

// some tiles of a square, in an order that follows no axis
static bool is_chosen(long tx, long ty)
{
    return (tx * 31 + ty * 17 + 4000) % 9 == 0;
}

TEST(tiles_are_found_and_stand_row_by_row)
{
    DpTerrain* terrain = flat();
    size_t     count = 0;
    for (int n = 0; n < 4 * WIDE * WIDE; ++n) {
        const int  at = (n * 1367) % (4 * WIDE * WIDE);
        const long tx = at % (2 * WIDE) - WIDE, ty = at / (2 * WIDE) - WIDE;
        if (is_chosen(tx, ty)) touch_tile(terrain, tx, ty), ++count;
    }
    CHECK(terrain->tiles == count && count > 600 && 2 * count <= terrain->slots);
    size_t next = 0;
    for (long ty = -WIDE; ty < WIDE; ++ty)
        for (long tx = -WIDE; tx < WIDE; ++tx) {
            const Tile* tile = dp_tile_find(terrain, tx, ty);
            CHECK((tile != NULL) == is_chosen(tx, ty));
            if (!tile) continue;
            CHECK(tile->tx == tx && tile->ty == ty);
            CHECK(next < count && terrain->sorted[next++] == tile);
        }
    dp_terrain_destroy(terrain);
    CHECK(!dp_tile_find(&(DpTerrain){0}, 0, 0));
}

TEST(cells_belong_to_the_tiles_that_hold_them)
{
    const DpCellRect rect = {-70, 150, -64, 131};
    int              seen = 0;
    for (long ty = dp_tile_of(rect.j0); ty <= dp_tile_of(rect.j1 - 1); ++ty)
        for (long tx = dp_tile_of(rect.i0); tx <= dp_tile_of(rect.i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, rect);
            CHECK(part.tx == tx && part.ty == ty && part.nx > 0 && part.ny > 0);
            for (int j = 0; j < part.ny; ++j)
                for (int i = 0; i < part.nx; ++i) {
                    const long   wi = rect.i0 + part.i + i, wj = rect.j0 + part.j + j;
                    const size_t in = part.in_tile + (size_t)j * DP_TILE + (size_t)i;
                    CHECK(dp_tile_of(wi) == tx && dp_tile_of(wj) == ty);
                    CHECK((long)(in % DP_TILE) == wi - tx * DP_TILE);
                    CHECK((long)(in / DP_TILE) == wj - ty * DP_TILE);
                    ++seen;
                }
        }
    CHECK(seen == 220 * 195);
}

TEST(a_touched_rectangle_has_all_its_tiles_and_no_other)
{
    DpTerrain* terrain = flat();
    CHECK(dp_terrain_touch(terrain, (DpCellRect){-1, 2 * DP_TILE, DP_TILE - 1, DP_TILE + 1}) ==
          DP_OK);
    CHECK(terrain->tiles == 3 * 2);
    for (long ty = -1; ty <= 2; ++ty)
        for (long tx = -2; tx <= 3; ++tx)
            CHECK((dp_tile_find(terrain, tx, ty) != NULL) ==
                  (tx >= -1 && tx <= 1 && ty >= 0 && ty <= 1));
    const Tile* before = dp_tile_find(terrain, 0, 0);
    CHECK(dp_terrain_touch(terrain, (DpCellRect){0, 3 * DP_TILE, 0, 1}) == DP_OK);
    CHECK(terrain->tiles == 7 && dp_tile_find(terrain, 0, 0) == before);
    CHECK(dp_terrain_touch(terrain, (DpCellRect){5, 5, 0, 1}) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_touch(terrain, dp_cells(MAX_CELL_INDEX - 1, 0, 1, 1)) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_touch(terrain, dp_cells(0, 0, 70000L * DP_TILE, 1)) == DP_NO_MEMORY);
    CHECK(dp_terrain_touch(terrain, dp_cells(0, 0, 1, 70000L * DP_TILE)) == DP_NO_MEMORY);
    CHECK(dp_terrain_touch(terrain, dp_cells(0, 0, 257 * DP_TILE, 256 * DP_TILE)) == DP_NO_MEMORY);
    CHECK(terrain->tiles == 7);
    dp_terrain_destroy(terrain);
}

static void square(const void* context, double x0, double y0, double cell, int nx, int ny,
                   float* strength, float* roots)
{
    (void)context;
    for (int n = 0; n < nx * ny; ++n) {
        strength[n] = (float)(x0 + cell * (n % nx)), roots[n] = (float)(y0 + cell * (n / nx));
    }
}

// a tile that comes has the ground's height, and the cover of its own cells
TEST(a_new_tile_is_as_its_ground_is)
{
    DpTerrain* terrain = flat();
    CHECK(dp_terrain_set_cover(terrain, square, NULL) == DP_OK);
    touch_tile(terrain, -1, 2);
    const Tile* tile = dp_tile_find(terrain, -1, 2);
    for (int n = 0; n < TILE_CELLS; ++n) {
        const long i = -DP_TILE + n % DP_TILE, j = 2 * DP_TILE + n / DP_TILE;
        CHECK_NEAR((double)tile->base_height[n] + dp_terrain_datum(terrain), 1.0, 1e-6);
        CHECK_NEAR(tile->plant[n], dp_grid_x(&terrain->grid, i), 1e-5);
        CHECK_NEAR(tile->plant[TILE_CELLS + n], dp_grid_y(&terrain->grid, j), 1e-5);
    }
    dp_terrain_destroy(terrain);
}

typedef struct Told
{
    int  count;
    long at[16][2];
} Told;

static void tell(void* context, long tx, long ty)
{
    Told* told = context;
    if (told->count < 16) told->at[told->count][0] = tx, told->at[told->count][1] = ty;
    ++told->count;
}

TEST(a_tile_tells_once_that_it_changed)
{
    const long order[4][2] = {{2, 1}, {-1, 1}, {5, -3}, {-1, 1}};
    DpTerrain* terrain = flat();
    Told       told = {0};
    for (int n = 0; n < 4; ++n) touch_tile(terrain, order[n][0], order[n][1]);
    dp_terrain_changed(terrain, tell, &told);
    CHECK(told.count == 0);  // touched is not changed
    for (int round = 0; round < 2; ++round) {
        told = (Told){0};
        for (int n = 0; n < 4; ++n)
            dp_tile_mark(terrain, dp_tile_find(terrain, order[n][0], order[n][1]));
        dp_terrain_changed(terrain, tell, &told);
        CHECK(told.count == 3 && told.at[0][0] == 5 && told.at[0][1] == -3);
        CHECK(told.at[1][0] == -1 && told.at[1][1] == 1 && told.at[2][0] == 2);
        told = (Told){0};
        dp_terrain_changed(terrain, tell, &told);
        CHECK(told.count == 0);
    }
    // what was measured of a tile that changed is not true any more
    Tile* tile = dp_tile_find(terrain, 2, 1);
    CHECK_NEAR(dp_terrain_highest(terrain, 2, 1), 1.0 - dp_terrain_datum(terrain), 1e-6);
    tile->heap[77] = 0.5f;
    dp_tile_mark(terrain, tile);
    CHECK_NEAR(dp_terrain_highest(terrain, 2, 1), 1.5 - dp_terrain_datum(terrain), 1e-6);
    dp_terrain_destroy(terrain);
}

TEST(without_memory_no_tile_is_new)
{
    for (long n = 0; n < 12; ++n) {
        DpTerrain* terrain = flat();
        touch_tile(terrain, 0, 0);
        dp_alloc_fail_after(n);
        const DpStatus status = dp_terrain_touch(terrain, dp_cells(0, 0, 8 * DP_TILE, 5 * DP_TILE));
        dp_alloc_fail_after(-1);
        CHECK(status == DP_NO_MEMORY && terrain->tiles == 1 && dp_tile_find(terrain, 0, 0));
        CHECK(!dp_tile_find(terrain, 7, 4));
        CHECK(dp_terrain_touch(terrain, dp_cells(0, 0, 8 * DP_TILE, 5 * DP_TILE)) == DP_OK);
        CHECK(terrain->tiles == 40 && dp_tile_find(terrain, 7, 4));
        dp_terrain_destroy(terrain);
    }
}

// ground of 400 tiles, trodden here and there, as it is saved; fields of all of it go into `told`
static DpStateWriter trodden(float* told)
{
    DpTerrain*   terrain = flat();
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    for (int n = 0; n < 1500; ++n) {
        const int        at = (n * 1367) % 1500;
        const DpCellRect cells = dp_cells(30L * (at % 40), 30L * (at / 40), 40, 40);
        CHECK(dp_terrain_acquire(terrain, lease, cells, &patch) == DP_OK);
        for (int k = 0; k < patch->row * patch->ny; ++k)
            patch->compression[k] += 1e-3f * (float)((n + k) % 7);
        dp_terrain_commit(terrain, lease, dp_cells(0, 0, patch->nx, patch->ny));
    }
    dp_terrain_totals(terrain, &(double){0.0}, &(double){0.0}, &(double){0.0});
    CHECK(dp_terrain_read(terrain, DP_FIELD_COMPRESSION, 0, 0, 1200, 1200, told) == DP_OK);
    DpStateWriter state = {0};
    dp_terrain_save(terrain, &state);
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
    return state;
}

TEST(tiles_that_leave_memory_come_back_to_the_bit)
{
    char folder[300], place[400];
    folder_make(folder, sizeof folder, "tiles");
    snprintf(place, sizeof place, "%s/pages", folder);
    const size_t  size = (size_t)1200 * 1200;
    float *       here = dp_alloc(size, sizeof *here), *there = dp_alloc(size, sizeof *there);
    DpStateWriter state = trodden(here);
    const size_t  limit = dp_os_resident() + ((size_t)12 << 20);  // a third of what they take
    CHECK(dp_memory_hold(place, limit) == DP_OK);
    DpStateWriter held = trodden(there);
    CHECK(dp_memory_needs() > 0 && dp_os_resident() <= limit + limit / 10);
    dp_memory_release();
    CHECK(memcmp(here, there, size * sizeof *here) == 0);
    CHECK(held.size == state.size && memcmp(held.bytes, state.bytes, state.size) == 0);
    dp_write_drop(&held), dp_write_drop(&state);
    dp_free(here), dp_free(there);
    FOLDER_REMOVE(folder);
}

int main(void)
{
    RUN(tiles_that_leave_memory_come_back_to_the_bit);
    RUN(tiles_are_found_and_stand_row_by_row);
    RUN(cells_belong_to_the_tiles_that_hold_them);
    RUN(a_touched_rectangle_has_all_its_tiles_and_no_other);
    RUN(a_new_tile_is_as_its_ground_is);
    RUN(a_tile_tells_once_that_it_changed);
    RUN(without_memory_no_tile_is_new);
    return check_done();
}
