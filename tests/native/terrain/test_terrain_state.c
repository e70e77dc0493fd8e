// tests of terrain_state.c: what walkers made of the ground is kept and taken back, to the bit
#include <limits.h>
#include <string.h>

#include "base/alloc.h"
#include "ground.h"

#define SIDE 230
#define CELLS (SIDE * SIDE)

static void grow(const void* context, double x0, double y0, double cell, int nx, int ny,
                 float* strength, float* roots)
{
    const double share = *(const double*)context;
    for (int n = 0; n < nx * ny; ++n) {
        const double x = x0 + cell * (n % nx), y = y0 + cell * (n / nx);
        strength[n] = (float)(share * fabs(sin(3.0 * x + y)));
        roots[n] = 1e5f * strength[n];
    }
}

static float hills[64];

static DpTerrain* new_terrain(const double* share)
{
    for (int n = 0; n < 64; ++n) hills[n] = n == 9 ? NAN : 0.1f * (float)(n % 5);
    const DpGround ground = ground_heights(8, 8, -0.4, -0.4, 0.25, hills);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.003, -0.002);
    if (share) CHECK(dp_terrain_set_cover(terrain, grow, share) == DP_OK);
    return terrain;
}

static void tread(DpTerrain* terrain, DpCellRect cells, float depth)
{
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, cells, &patch) == DP_OK);
    for (int n = 0; n < patch->row * patch->ny; ++n) {
        patch->compression[n] += depth * (float)(n % 7);
        patch->heap[n] += depth * (float)(n % 3);
        patch->pressure_time[n] += 1e4f * depth * (float)(n % 11);
    }
    dp_terrain_commit(terrain, lease, dp_cells(0, 0, patch->nx, patch->ny));
    dp_lease_destroy(lease);
}

static void tread_some(DpTerrain* terrain)
{
    CHECK(dp_terrain_touch(terrain, (DpCellRect){300, 310, 0, 5}) == DP_OK);  // stays as it was
    tread(terrain, (DpCellRect){-30, 80, -20, 90}, 0.01f);
    tread(terrain, (DpCellRect){120, 131, 5, 8}, 0.02f);
}

static DpStateWriter save(const DpTerrain* terrain)
{
    DpStateWriter writer = {0};
    dp_terrain_save(terrain, &writer);
    CHECK(writer.status == DP_OK && writer.size > 0);
    return writer;
}

static DpStatus take_back(DpTerrain* terrain, const void* bytes, size_t size)
{
    DpStateReader   reader = dp_read_open(bytes, size);
    DpTerrainState* state = NULL;
    const DpStatus  status = dp_terrain_load(terrain, &reader, &state);
    if (status == DP_OK) dp_terrain_restore(terrain, state);
    return status;
}

static bool same(const DpTerrain* a, const DpTerrain* b)
{
    static float one[CELLS], other[CELLS];
    int          fields;
    bool         holds = dp_terrain_tile_count(a) == dp_terrain_tile_count(b);
    for (const DpFieldInfo* f = dp_terrain_fields(&fields); fields-- > 0; ++f) {
        CHECK(dp_terrain_read(a, (DpField)f->field, -70, -60, SIDE, SIDE, one) == DP_OK);
        CHECK(dp_terrain_read(b, (DpField)f->field, -70, -60, SIDE, SIDE, other) == DP_OK);
        holds = holds && memcmp(one, other, sizeof one) == 0;
    }
    for (int n = 0; n < 40; ++n) {  // between cells of touched tiles and beyond them
        const double x = -0.3 + 0.04 * n;
        const double u = dp_terrain_surface_at(a, x, 0.31), v = dp_terrain_surface_at(b, x, 0.31);
        holds = holds && memcmp(&u, &v, sizeof u) == 0;
    }
    return holds;
}

static void count_tile(void* context, long tx, long ty)
{
    (void)tx, (void)ty;
    ++*(int*)context;
}

TEST(goes_on_to_the_bit)
{
    double share = 0.7;
    for (int planted = 0; planted < 2; ++planted) {
        share = 0.7;
        DpTerrain *walked = new_terrain(planted ? &share : NULL), *again;
        tread_some(walked);
        if (planted) {
            share = 0.4;  // worn, but asked for in one tile only
            dp_terrain_refresh_cover(walked, (DpCellRect){0, 20, 0, 20});
        }
        DpStateWriter kept = save(walked);
        again = new_terrain(planted ? &share : NULL);
        CHECK(!same(walked, again));
        CHECK(take_back(again, kept.bytes, kept.size) == DP_OK && same(walked, again));

        int told = 0;
        dp_terrain_changed(again, count_tile, &told);
        CHECK(told == (planted ? 11 : 9));  // one was not trodden, one has no ground there
        tread(walked, (DpCellRect){60, 140, -3, 40}, 0.005f);
        tread(again, (DpCellRect){60, 140, -3, 40}, 0.005f);
        CHECK(same(walked, again));

        DpStateWriter once = save(walked), twice = save(again);
        CHECK(once.size == twice.size && memcmp(once.bytes, twice.bytes, once.size) == 0);
        CHECK(take_back(walked, kept.bytes, kept.size) == DP_OK);  // back in time
        DpStateWriter back = save(walked);
        CHECK(back.size == kept.size && memcmp(back.bytes, kept.bytes, kept.size) == 0);
        dp_write_drop(&kept), dp_write_drop(&once), dp_write_drop(&twice), dp_write_drop(&back);
        dp_terrain_destroy(walked), dp_terrain_destroy(again);
    }
}

TEST(untouched_ground_takes_next_to_nothing)
{
    DpTerrain* terrain = new_terrain(NULL);
    CHECK(dp_terrain_touch(terrain, (DpCellRect){0, 640, 0, 640}) == DP_OK);
    DpStateWriter kept = save(terrain);
    CHECK(kept.size < 100 * 17 + 100);
    CHECK(take_back(terrain, kept.bytes, kept.size) == DP_OK);
    CHECK(dp_terrain_tile_count(terrain) == 100);
    dp_write_drop(&kept);
    dp_terrain_destroy(terrain);
}

TEST(what_is_damaged_or_of_other_ground_is_refused)
{
    DpTerrain *walked = new_terrain(NULL), *other, *untouched = new_terrain(NULL);
    tread_some(walked);
    DpStateWriter kept = save(walked);
    for (size_t k = 0; k < kept.size; k += 1 + kept.size / 300) {
        kept.bytes[k] ^= 0x21;
        CHECK(take_back(untouched, kept.bytes, kept.size) == DP_BAD_FILE);
        kept.bytes[k] ^= 0x21;
        CHECK(take_back(untouched, kept.bytes, k) == DP_BAD_FILE);
    }
    CHECK(dp_terrain_tile_count(untouched) == 0);
    CHECK(take_back(untouched, kept.bytes, kept.size) == DP_OK);

    const DpGround flat = ground_flat(0.25);
    other = ground_terrain(&flat, 0.01, 0.003, -0.002);
    CHECK(take_back(other, kept.bytes, kept.size) == DP_BAD_FILE);
    const double share = 0.5;
    CHECK(dp_terrain_set_cover(untouched, grow, &share) == DP_BAD_ARGUMENT);
    DpTerrain* planted = new_terrain(&share);
    CHECK(take_back(planted, kept.bytes, kept.size) == DP_BAD_FILE);
    dp_write_drop(&kept);
    dp_terrain_destroy(walked), dp_terrain_destroy(untouched);
    dp_terrain_destroy(other), dp_terrain_destroy(planted);
}

// a state of this ground with one tile, written by hand: `tx`, what is kept, and one value of it
static DpStatus take_tile(DpTerrain* terrain, long tx, long next, uint8_t what, float value, int at)
{
    float         grid[DP_TILE * DP_TILE] = {0};
    DpStateWriter head = save(terrain), writer = {0};
    uint64_t      name = 0;
    for (int k = 7; k >= 0; --k) name = name << 8 | head.bytes[24 + k];
    grid[at] = value;
    dp_write_chunk(&writer, "grnd", 1);
    dp_write_u64(&writer, name);
    dp_write_u64(&writer, 3);
    dp_write_u64(&writer, 2);
    for (int t = 0; t < 2; ++t) {
        dp_write_i64(&writer, t ? next : tx);
        dp_write_i64(&writer, 0);
        dp_write_u8(&writer, t ? 0 : what);
        for (int f = 0; f < 3 && !t && (what & 1); ++f)
            dp_write_runs(&writer, grid, DP_TILE * DP_TILE);
    }
    dp_write_end(&writer);
    const DpStatus status = take_back(terrain, writer.bytes, writer.size);
    dp_write_drop(&head), dp_write_drop(&writer);
    return status;
}

TEST(what_makes_no_sense_is_refused)
{
    const int      hole = 63 * DP_TILE + 63;
    const double   vertex[9] = {0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0};
    const int32_t  triangle[3] = {0, 1, 2};
    const DpGround ground = ground_mesh(3, vertex, 1, triangle);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    CHECK(take_tile(terrain, 0, 1, 1, 0.25f, 5) == DP_OK);
    CHECK(take_tile(terrain, 0, 1, 1, 0.0f, hole) == DP_OK);
    CHECK(take_tile(terrain, 0, 1, 1, 0.25f, hole) == DP_BAD_FILE);  // no ground there
    CHECK(take_tile(terrain, 0, 1, 1, -0.25f, 5) == DP_BAD_FILE);
    CHECK(take_tile(terrain, 0, 1, 1, NAN, 5) == DP_BAD_FILE);
    CHECK(take_tile(terrain, 0, 1, 1, INFINITY, 5) == DP_BAD_FILE);
    CHECK(take_tile(terrain, 0, 0, 1, 0.25f, 5) == DP_BAD_FILE);   // twice the same
    CHECK(take_tile(terrain, 0, -1, 1, 0.25f, 5) == DP_BAD_FILE);  // out of order
    CHECK(take_tile(terrain, -(LONG_MAX / 8), 1, 1, 0.25f, 5) == DP_BAD_FILE);
    CHECK(take_tile(terrain, 0, 1, 4, 0.0f, 5) == DP_BAD_FILE);
    CHECK(take_tile(terrain, 0, 1, 2, 0.0f, 5) == DP_BAD_FILE);  // nothing grows here
    CHECK(dp_terrain_tile_count(terrain) == 2);
    dp_terrain_destroy(terrain);
}

TEST(without_memory_all_stays)
{
    DpTerrain *walked = new_terrain(NULL), *other = new_terrain(NULL);
    tread_some(walked);
    DpStateWriter kept = save(walked);
    const size_t  before = dp_bytes_live();
    DpStatus      status = DP_NO_MEMORY;
    for (int n = 0; status == DP_NO_MEMORY; ++n) {
        DpStateReader   reader = dp_read_open(kept.bytes, kept.size);
        DpTerrainState* state = NULL;
        dp_alloc_fail_after(n);
        status = dp_terrain_load(other, &reader, &state);
        dp_alloc_fail_after(-1);
        CHECK(n < 100 && (status == DP_OK) == (state != NULL));
        dp_terrain_state_destroy(state);
        CHECK(dp_bytes_live() == before && dp_terrain_tile_count(other) == 0);
    }
    dp_alloc_fail_after(0);
    DpStateWriter none = {0};
    dp_terrain_save(walked, &none);
    dp_alloc_fail_after(-1);
    CHECK(status == DP_OK && none.status == DP_NO_MEMORY);
    dp_write_drop(&none), dp_write_drop(&kept);
    dp_terrain_destroy(walked), dp_terrain_destroy(other);
}

// the same points with other triangles, the last of them turned, are other ground
TEST(a_mesh_of_other_triangles_is_refused)
{
    static const double  vertex[] = {-2, -2, 0, 2, -2, 0.1, 2, 2, 0.4, -2, 2, 0, 0, 0, 0.2};
    static const int32_t face[2][9] = {{0, 1, 4, 1, 2, 4, 2, 3, 4}, {0, 1, 4, 1, 2, 4, 2, 3, 0}};
    DpTerrain*           terrain[3];
    for (int k = 0; k < 3; ++k) {
        const DpGround ground = ground_mesh(5, vertex, 3, face[k / 2]);
        terrain[k] = ground_terrain(&ground, 0.01, 0.0, 0.0);
    }
    tread(terrain[0], dp_cells(0, -50, 20, 20), 0.01f);
    DpStateWriter kept = save(terrain[0]);
    CHECK(take_back(terrain[1], kept.bytes, kept.size) == DP_OK);
    CHECK(take_back(terrain[2], kept.bytes, kept.size) == DP_BAD_FILE);
    dp_write_drop(&kept);
    for (int k = 0; k < 3; ++k) dp_terrain_destroy(terrain[k]);
}

int main(void)
{
    RUN(goes_on_to_the_bit);
    RUN(untouched_ground_takes_next_to_nothing);
    RUN(what_is_damaged_or_of_other_ground_is_refused);
    RUN(what_makes_no_sense_is_refused);
    RUN(without_memory_all_stays);
    RUN(a_mesh_of_other_triangles_is_refused);
    return check_done();
}
