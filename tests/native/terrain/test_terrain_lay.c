// A trail that is laid down reads as it was left, and is ground like any other from then on.
#include <limits.h>
#include <math.h>

#include "terrain/ground.h"

#define NX 150
#define NY 90

static float compression[NX * NY], heap[NX * NY], pressure_time[NX * NY], got[NX * NY];

static DpTrail trail_at(long i0, long j0, int nx, int ny)
{
    return (DpTrail){.i0 = i0,
                     .j0 = j0,
                     .nx = nx,
                     .ny = ny,
                     .compression = compression,
                     .heap = heap,
                     .pressure_time = pressure_time};
}

static void make_trail(void)
{
    for (int n = 0; n < NX * NY; ++n) {
        const bool trodden = n % NX < 80 && n / NX > 20;
        compression[n] = trodden ? 1e-3f * (float)(n % 31) : 0.0f;
        heap[n] = trodden ? 1e-4f * (float)(n % 17) : 0.0f;
        pressure_time[n] = trodden ? (float)(n % 1009) : 0.0f;
    }
}

static void count_tile(void* context, long tx, long ty)
{
    (void)tx, (void)ty;
    ++*(int*)context;
}

TEST(a_trail_reads_as_it_was_left)
{
    const DpGround ground = ground_flat(0.3);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    const DpTrail  trail = trail_at(-70, 13, NX, NY);
    const float*   laid[] = {compression, heap, pressure_time};
    make_trail();
    CHECK(dp_terrain_lay(terrain, &trail) == DP_OK);
    for (DpField field = DP_FIELD_COMPRESSION; field <= DP_FIELD_PRESSURE_TIME; ++field) {
        CHECK(dp_terrain_read(terrain, field, -70, 13, NX, NY, got) == DP_OK);
        CHECK(memcmp(got, laid[field], sizeof got) == 0);
    }
    CHECK_CLOSE(dp_terrain_surface_at(terrain, -0.695 + 0.01 * 30, 0.135 + 0.01 * 40),
                0.3 - (double)compression[40 * NX + 30] + (double)heap[40 * NX + 30], 1e-6);
    int changed = 0;
    dp_terrain_changed(terrain, count_tile, &changed);
    CHECK(changed == (int)dp_terrain_tile_count(terrain));
    CHECK(changed == 6);  // not the tiles right of the trodden part
    dp_terrain_destroy(terrain);
}

TEST(no_ground_stays_no_ground)
{
    static float hole[40 * 40];
    for (int n = 0; n < 40 * 40; ++n) hole[n] = n % 40 < 20 ? 1.0f : NAN;
    const DpGround ground = ground_heights(40, 40, 0.005, 0.005, 0.01, hole);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    for (int n = 0; n < 40 * 40; ++n) compression[n] = 0.02f, heap[n] = pressure_time[n] = 0.0f;
    const DpTrail trail = trail_at(0, 0, 40, 40);
    CHECK(dp_terrain_lay(terrain, &trail) == DP_OK);
    CHECK(dp_terrain_read(terrain, DP_FIELD_COMPRESSION, 0, 0, 40, 40, got) == DP_OK);
    for (int n = 0; n < 40 * 40; ++n) CHECK(got[n] == (n % 40 < 20 ? 0.02f : 0.0f));
    dp_terrain_destroy(terrain);
}

// each of the three fields alone makes a trail, wherever it is; none makes no tile
TEST(any_field_alone_is_a_trail)
{
    float* const field[] = {compression, heap, pressure_time};
    const int    places[] = {0, 39, 837, 1560, 1599};  // corners, and one between them
    for (int k = 0; k < 20; ++k) {
        const int      which = k / 5, at = places[k % 5];
        const DpGround ground = ground_flat(0.0);
        DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
        const DpTrail  trail = trail_at(0, 0, 40, 40);
        for (int f = 0; f < 3; ++f)
            for (int n = 0; n < 40 * 40; ++n) field[f][n] = f == which && n == at ? 0.5f : 0.0f;
        CHECK(dp_terrain_lay(terrain, &trail) == DP_OK);
        CHECK(dp_terrain_tile_count(terrain) == (which < 3 ? 1 : 0));
        for (int f = 0; f < 3; ++f) {
            CHECK(dp_terrain_read(terrain, (DpField)(DP_FIELD_COMPRESSION + f), 0, 0, 40, 40,
                                  got) == DP_OK);
            CHECK(got[at] == (f == which ? 0.5f : 0.0f));
        }
        dp_terrain_destroy(terrain);
    }
}

TEST(nonsense_is_not_laid)
{
    const DpGround ground = ground_flat(0.0);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    const DpTrail  trail = trail_at(0, 0, NX, NY);
    const float    bad[] = {-1e-3f, NAN, INFINITY};
    make_trail();
    for (int k = 0; k < 3; ++k) {
        const float was = heap[77];
        heap[77] = bad[k];
        CHECK(dp_terrain_lay(terrain, &trail) == DP_BAD_ARGUMENT);
        heap[77] = was;
    }
    const DpTrail far = trail_at(LONG_MAX - 255, 0, NX, NY);
    const DpTrail none = trail_at(0, 0, 0, NY);
    CHECK(dp_terrain_lay(terrain, &far) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_lay(terrain, &none) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_tile_count(terrain) == 0);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(a_trail_reads_as_it_was_left);
    RUN(no_ground_stays_no_ground);
    RUN(any_field_alone_is_a_trail);
    RUN(nonsense_is_not_laid);
    return check_done();
}
