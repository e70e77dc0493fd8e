// tests of terrain_join.c: ground that was pressed in parts is, put together, that which was pressed in one
#include <string.h>

#include "base/alloc.h"
#include "ground.h"

static DpTerrain* flat(void)
{
    const DpGround ground = ground_flat(3.0);
    return ground_terrain(&ground, 0.01, 0.0, 0.0);
}

static void press(DpTerrain* terrain, long tx, long ty, float depth)
{
    DpLease*         lease = dp_lease_create();
    DpSoilPatch*     patch = NULL;
    const DpCellRect at = dp_cells(tx * DP_TILE + 3, ty * DP_TILE + 5, 20, 10);
    CHECK(dp_terrain_acquire(terrain, lease, at, &patch) == DP_OK);
    for (int n = 0; n < patch->row * patch->ny; ++n)
        patch->compression[n] = depth, patch->heap[n] = 0.5f * depth;
    dp_terrain_commit(terrain, lease, dp_cells(0, 0, patch->nx, patch->ny));
    dp_lease_destroy(lease);
}

static DpTerrainState* state_of(const DpTerrain* from, const DpTerrain* into)
{
    DpStateWriter   writer = {0};
    DpTerrainState* state = NULL;
    dp_terrain_save(from, &writer);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_terrain_load(into, &reader, &state) == DP_OK);
    dp_write_drop(&writer);
    return state;
}

static DpStateWriter kept(const DpTerrain* terrain)
{
    DpStateWriter writer = {0};
    dp_terrain_save(terrain, &writer);
    return writer;
}

static bool same(const DpTerrain* a, const DpTerrain* b)
{
    DpStateWriter one = kept(a), two = kept(b);
    const bool    holds = one.size == two.size && memcmp(one.bytes, two.bytes, one.size) == 0;
    dp_write_drop(&one), dp_write_drop(&two);
    return holds;
}

typedef struct Told
{
    int  count;
    long tx[8], ty[8];
} Told;

static void tell(void* context, long tx, long ty)
{
    Told* told = context;
    if (told->count < 8) told->tx[told->count] = tx, told->ty[told->count] = ty;
    ++told->count;
}

TEST(tiles_are_listed_row_by_row)
{
    const long at[5][2] = {{4, 1}, {-3, 0}, {0, -2}, {2, 0}, {-1, 1}};
    const int  order[5] = {2, 1, 3, 4, 0};
    DpTerrain* terrain = flat();
    int32_t    tile[10];
    for (int n = 0; n < 5; ++n)
        CHECK(dp_terrain_touch(terrain, dp_cells(at[n][0] * DP_TILE, at[n][1] * DP_TILE, 1, 1)) ==
              DP_OK);
    CHECK(dp_terrain_tile_count(terrain) == 5);
    dp_terrain_list(terrain, tile);
    for (int n = 0; n < 5; ++n)
        CHECK(tile[2 * n] == at[order[n]][0] && tile[2 * n + 1] == at[order[n]][1]);
    dp_terrain_destroy(terrain);
}

TEST(parts_put_together_are_the_ground_pressed_in_one)
{
    DpTerrain *whole = flat(), *west = flat(), *east = flat(), *both = flat();
    press(whole, -2, 0, 0.01f), press(whole, -1, 1, 0.02f), press(whole, 3, 0, 0.03f);
    press(whole, 4, -1, 0.04f);
    press(west, -2, 0, 0.01f), press(west, -1, 1, 0.02f), press(west, 3, 0, 0.5f);  // not taken
    press(east, 3, 0, 0.03f), press(east, 4, -1, 0.04f);
    CHECK(dp_terrain_touch(east, dp_cells(9 * DP_TILE, 0, 1, 1)) == DP_OK);  // touched, not pressed
    CHECK(dp_terrain_touch(whole, dp_cells(9 * DP_TILE, 0, 1, 1)) == DP_OK);

    const int32_t eastern[] = {4, -1, 3, 0, 9, 0}, western[] = {-2, 0, -1, 1};
    CHECK(dp_terrain_join(both, state_of(east, both), eastern, 3) == DP_OK);
    CHECK(!same(both, whole));
    Told told = {0};
    dp_terrain_changed(both, tell, &told);
    CHECK(told.count == 2 && told.tx[0] == 4 && told.ty[0] == -1 && told.tx[1] == 3);
    CHECK(dp_terrain_join(both, state_of(west, both), western, 2) == DP_OK);
    CHECK(same(both, whole));
    told = (Told){0};
    dp_terrain_changed(both, tell, &told);
    CHECK(told.count == 2 && told.tx[0] == -2 && told.ty[0] == 0 && told.tx[1] == -1);
    CHECK(dp_terrain_join(both, state_of(west, both), NULL, 0) == DP_OK && same(both, whole));
    dp_terrain_destroy(whole), dp_terrain_destroy(west);
    dp_terrain_destroy(east), dp_terrain_destroy(both);
}

static void bare(const void* context, double x0, double y0, double cell, int nx, int ny,
                 float* strength, float* roots)
{
    (void)context, (void)x0, (void)y0, (void)cell, (void)strength, (void)roots, (void)nx, (void)ny;
}

TEST(what_cannot_be_joined_leaves_all_as_it_was)
{
    const int32_t missing[] = {-2, 0, 7, 7}, there[] = {-2, 0, 3, 0}, falls[] = {-1, 1, -2, 0};
    const int32_t twice[] = {-2, 0, -2, 0}, fine[] = {-2, 0, -1, 1};
    DpTerrain *   from = flat(), *into = flat(), *was = flat(), *planted = flat();
    press(from, -2, 0, 0.01f), press(from, -1, 1, 0.02f), press(from, 3, 0, 0.03f);
    press(into, 3, 0, 0.5f), press(was, 3, 0, 0.5f);
    DpTerrainState*      state = state_of(from, into);
    const int32_t* const bad[] = {missing, there, falls, twice, NULL};
    for (int n = 0; n < 5; ++n)
        CHECK(dp_terrain_join(into, state, bad[n], 2) == DP_BAD_ARGUMENT && same(into, was));
    CHECK(dp_terrain_join(into, NULL, fine, 2) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_join(NULL, state, fine, 2) == DP_BAD_ARGUMENT);
    for (long n = 0; n < 2; ++n) {
        dp_alloc_fail_after(n);
        CHECK(dp_terrain_join(into, state, fine, 2) == DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
        CHECK(same(into, was));
    }
    CHECK(dp_terrain_join(into, state, fine, 2) == DP_OK);  // it was still good
    press(was, -2, 0, 0.01f), press(was, -1, 1, 0.02f);
    CHECK(same(into, was));

    CHECK(dp_terrain_set_cover(planted, bare, NULL) == DP_OK);
    DpTerrainState* grown = state_of(planted, planted);
    CHECK(dp_terrain_join(planted, grown, NULL, 0) == DP_BAD_ARGUMENT);
    dp_terrain_state_destroy(grown);
    dp_terrain_destroy(from), dp_terrain_destroy(into);
    dp_terrain_destroy(was), dp_terrain_destroy(planted);
}

int main(void)
{
    RUN(tiles_are_listed_row_by_row);
    RUN(parts_put_together_are_the_ground_pressed_in_one);
    RUN(what_cannot_be_joined_leaves_all_as_it_was);
    return check_done();
}
