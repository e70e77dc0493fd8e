// tests of terrain_read.c: every field of touched and of untouched ground, cell by cell, tile by tile, and between cells
#include "base/alloc.h"
#include "terrain/ground.h"
#include "terrain/terrain_inside.h"

#define CELL 0.02
#define X0 0.003
#define Y0 (-0.002)
#define SIDE 9      // samples of the ground, half a metre apart
#define HIGH 40.25  // the ground's, above its samples [m]
#define I0 (-20)
#define J0 (-70)
#define NX 119
#define NY 140  // cells that are read: three tiles by four

static float height[SIDE * SIDE], weight[3 * SIDE * SIDE];

static void grow(const void* context, double x0, double y0, double cell, int nx, int ny,
                 float* strength, float* roots)
{
    (void)context;
    for (int n = 0; n < nx * ny; ++n) {
        strength[n] = (float)fabs(sin(x0 + cell * (n % nx)));
        roots[n] = (float)(1e5 * fabs(cos(y0 + cell * (n / nx))));
    }
}

static DpTerrain* painted(bool grows)
{
    for (int n = 0; n < SIDE * SIDE; ++n) {
        const int i = n % SIDE, j = n / SIDE;
        height[n] = 0.3f * (float)i - 0.1f * (float)j + 0.02f * (float)(i * j);
        for (int k = 0; k < 3; ++k)
            weight[k * SIDE * SIDE + n] = (i + 2 * j) % 3 == k ? 1.0f : 0.0f;
    }
    DpGround ground = ground_heights(SIDE, SIDE, -2.0, -2.0, 0.5, height);
    ground.height = HIGH, ground.kind_count = 3, ground.kind_weight = weight;
    DpTerrain* terrain = ground_terrain(&ground, CELL, X0, Y0);
    if (grows) CHECK(dp_terrain_set_cover(terrain, grow, NULL) == DP_OK);
    return terrain;
}

// what is written into a cell
static float compression_of(long i, long j)
{
    return 0.001f * (float)((3 * i + 5 * j) & 31);
}

static float heap_of(long i, long j)
{
    return 0.0005f * (float)((7 * i + j) & 15);
}

static void tread(DpTerrain* terrain, DpCellRect at)
{
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, at, &patch) == DP_OK);
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const int n = j * patch->row + i;
            patch->compression[n] = compression_of(at.i0 + i, at.j0 + j);
            patch->heap[n] = heap_of(at.i0 + i, at.j0 + j);
            patch->pressure_time[n] = 1e4f * heap_of(at.i0 + i, at.j0 + j);
        }
    dp_terrain_commit(terrain, lease, dp_cells(0, 0, patch->nx, patch->ny));
    dp_lease_destroy(lease);
}

static const DpCellRect trail = {10, 70, -30, 20};  // over two tiles by two, each of them in part

static double base_at(const DpTerrain* terrain, long i, long j)
{
    const double xy[2] = {X0 + CELL * ((double)i + 0.5), Y0 + CELL * ((double)j + 0.5)};
    double       z;
    dp_terrain_base_height(terrain, 1, xy, &z);
    return z;
}

// the soil of the sample that is nearest to a cell's centre
static int soil_at(long i, long j)
{
    const long a = lround((X0 + CELL * ((double)i + 0.5) + 2.0) / 0.5);
    const long b = lround((Y0 + CELL * ((double)j + 0.5) + 2.0) / 0.5);
    return (int)((a + 2 * b) % 3);
}

static double wanted(const DpTerrain* terrain, int field, bool grows, long i, long j)
{
    const bool   on = i >= trail.i0 && i < trail.i1 && j >= trail.j0 && j < trail.j1;
    const double pressed = on ? (double)compression_of(i, j) : 0.0;
    const double heap = on ? (double)heap_of(i, j) : 0.0;
    const long   tx0 = dp_tile_of(i) * DP_TILE, ty0 = dp_tile_of(j) * DP_TILE;
    const double x = X0 + CELL * ((double)tx0 + 0.5) + CELL * (double)(i - tx0);
    const double y = Y0 + CELL * ((double)ty0 + 0.5) + CELL * (double)(j - ty0);
    switch (field) {
        case DP_FIELD_COMPRESSION:
            return pressed;
        case DP_FIELD_HEAP:
            return heap;
        case DP_FIELD_PRESSURE_TIME:
            return 1e4 * heap;
        case DP_FIELD_BASE_HEIGHT:
            return base_at(terrain, i, j);
        case DP_FIELD_HEIGHT_CHANGE:
            return heap - pressed;
        case DP_FIELD_KIND:
            return soil_at(i, j);
        case DP_FIELD_PLANT_STRENGTH:
            return grows ? fabs(sin(x)) : 0.0;
        case DP_FIELD_MODULUS:
            return (double)ground_soils[soil_at(i, j)].young_modulus +
                   (grows ? 1e5 * fabs(cos(y)) : 0.0);
        default:
            return NAN;
    }
}

static float value[NX * NY], tile[2 * DP_TILE * DP_TILE];

// as rows of cells, and as a tile among the channels of a picture
TEST(fields_are_what_the_ground_and_its_trail_are)
{
    static const int field[] = {
        DP_FIELD_COMPRESSION,   DP_FIELD_HEAP, DP_FIELD_PRESSURE_TIME,  DP_FIELD_BASE_HEIGHT,
        DP_FIELD_HEIGHT_CHANGE, DP_FIELD_KIND, DP_FIELD_PLANT_STRENGTH, DP_FIELD_MODULUS};
    for (int grows = 0; grows < 2; ++grows) {
        DpTerrain* terrain = painted(grows);
        tread(terrain, trail);
        const size_t tiles = dp_terrain_tile_count(terrain);
        for (size_t f = 0; f < sizeof field / sizeof *field; ++f) {
            CHECK(dp_terrain_read(terrain, (DpField)field[f], I0, J0, NX, NY, value) == DP_OK);
            int wrong = 0;
            for (int n = 0; n < NX * NY; ++n) {
                const double want = wanted(terrain, field[f], grows, I0 + n % NX, J0 + n / NX);
                wrong += !(fabs((double)value[n] - want) <= 1e-5 + 1e-6 * fabs(want));
            }
            CHECK(wrong == 0);
            for (long t = 0; t < 4; ++t) {  // two that are there, two that are not
                const long tx = t % 2 ? 0 : -1, ty = t / 2 ? 0 : -1;
                for (int n = 0; n < 2 * DP_TILE * DP_TILE; ++n) tile[n] = -7.0f;
                dp_terrain_tile(terrain, tx, ty, (DpField)field[f], tile + 1, 2);
                wrong = 0;
                for (int n = 0; n < DP_TILE * DP_TILE; ++n) {
                    const double want = wanted(terrain, field[f], grows, tx * DP_TILE + n % DP_TILE,
                                               ty * DP_TILE + n / DP_TILE);
                    const double is = (double)tile[2 * n + 1];
                    wrong += tile[2 * n] != -7.0f;
                    wrong += !(fabs(is - want) <= 1e-5 + 1e-6 * fabs(want));
                }
                CHECK(wrong == 0);
            }
        }
        CHECK(dp_terrain_tile_count(terrain) == tiles);  // whoever reads touches nothing
        dp_terrain_destroy(terrain);
    }
}

static double cell_at(const DpTerrain* terrain, long i, long j)
{
    return base_at(terrain, i, j) - dp_terrain_datum(terrain) +
           wanted(terrain, DP_FIELD_HEIGHT_CHANGE, false, i, j);
}

// between the centres of four cells in proportion, of whichever tiles they are, heights over the datum
TEST(the_surface_goes_evenly_from_cell_to_cell)
{
    DpTerrain* terrain = painted(false);
    unsigned   seed = 3;
    tread(terrain, trail);
    for (int n = 0; n < 4000; ++n) {
        const double x = 1.8 * check_random(&seed) - 0.2, y = 1.4 * check_random(&seed) - 0.9;
        const double u = (x - X0) / CELL - 0.5, v = (y - Y0) / CELL - 0.5;
        const long   i = (long)floor(u), j = (long)floor(v);
        const double a = u - (double)i, b = v - (double)j;
        const double low = (1 - a) * cell_at(terrain, i, j) + a * cell_at(terrain, i + 1, j);
        const double high =
            (1 - a) * cell_at(terrain, i, j + 1) + a * cell_at(terrain, i + 1, j + 1);
        CHECK_NEAR(dp_terrain_surface_at(terrain, x, y), (1 - b) * low + b * high, 2e-5);
    }
    CHECK(isnan(dp_terrain_surface_at(terrain, 1e18, 0.0)));
    CHECK(isnan(dp_terrain_surface_at(terrain, 0.0, (double)NAN)));
    CHECK(isnan(dp_terrain_surface_at(terrain, 5.0, 0.0)));  // beyond the ground
    dp_terrain_surface(terrain, I0, J0, NX, NY, value);
    for (int n = 0; n < NX * NY; ++n) {  // touched tiles only
        const long i = I0 + n % NX, j = J0 + n / NX;
        const bool there = i >= 0 && i < 2 * DP_TILE && j >= -DP_TILE && j < DP_TILE;
        CHECK(there ? fabs((double)value[n] - cell_at(terrain, i, j)) < 2e-5 : isnan(value[n]));
    }
    dp_terrain_destroy(terrain);
}

TEST(what_cannot_be_read_is_refused)
{
    DpTerrain* terrain = painted(false);
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, 0, 0, 0, 1, value) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, 0, 0, 1, -1, value) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, LONG_MAX - 5, 0, 9, 1, value) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_read(terrain, DP_FIELD_HEAP, 0, LONG_MIN, 1, 1, value) == DP_BAD_ARGUMENT);
    CHECK(dp_terrain_read(terrain, (DpField)(DP_FIELD_COMPRESSION - 1), 0, 0, 1, 1, value) ==
          DP_BAD_ARGUMENT);
    CHECK(dp_terrain_read(terrain, (DpField)(DP_FIELD_HEIGHT_CHANGE + 1), 0, 0, 1, 1, value) ==
          DP_BAD_ARGUMENT);
    dp_terrain_destroy(terrain);
}

// cells are there as long as the number of the last is exact, too
TEST(windows_end_where_cells_end)
{
    const long end = MAX_CELL_INDEX;
    CHECK(dp_terrain_has(end - 21, 0, 20, 1) && !dp_terrain_has(end - 20, 0, 20, 1));
    CHECK(dp_terrain_has(0, end - 21, 1, 20) && !dp_terrain_has(0, end - 20, 1, 20));
    CHECK(dp_terrain_has(1 - end, 1 - end, 20, 20) && !dp_terrain_has(-end, 0, 20, 1));
    CHECK(!dp_terrain_has(0, 0, 0, 1) && !dp_terrain_has(0, 0, 1, -1));
    CHECK(!dp_terrain_has(0, 0, end, 1) && dp_terrain_has(0, 0, 1, 1));
}

int main(void)
{
    RUN(fields_are_what_the_ground_and_its_trail_are);
    RUN(the_surface_goes_evenly_from_cell_to_cell);
    RUN(what_cannot_be_read_is_refused);
    RUN(windows_end_where_cells_end);
    return check_done();
}
