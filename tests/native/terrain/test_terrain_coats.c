// tests of terrain_coats.c: which soils stick, what lies where, and which soil is seen. MODEL 6.16
#include "base/alloc.h"
#include "ground.h"

#define CELL 0.02
#define SIDE 40   // cells that are read, of two tiles and of ground nobody touched
#define FIRST 50  // of them, in both directions
#define COVERS 0.002

// soil 1 sticks, soil 2 does at the second time only
static DpTerrain* sticky(void)
{
    static const double time[2] = {0.0, 10.0};
    static float        flat[4], weight[3][4];
    DpSoil              row[2][3];
    DpTerrain*          terrain = NULL;
    for (int t = 0; t < 2; ++t)
        for (int k = 0; k < 3; ++k) row[t][k] = ground_soils[k];
    row[0][1].adhesion = row[1][1].adhesion = 0.003f;
    row[1][2].adhesion = 0.001f;
    for (int n = 0; n < 4; ++n) {  // soil 0 in the west, then 1, soil 2 in the east
        weight[0][n] = n % 2 ? 0.0f : 3.0f;
        weight[1][n] = 1.9f;
        weight[2][n] = n % 2 ? 3.0f : 0.0f;
    }
    DpGround ground = ground_heights(2, 2, 0.0, 0.0, 2.5, flat);
    ground.kind_count = 3, ground.kind_weight = &weight[0][0];
    DpTerrainOptions options = ground_options(CELL, 0.0, 0.0);
    options.soils = &row[0][0], options.times = 2, options.time = time;
    CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
    return terrain;
}

static float* field(const DpTerrain* terrain, int number)
{
    float* out = dp_alloc(SIDE * SIDE, sizeof *out);
    CHECK(dp_terrain_read(terrain, number, FIRST, FIRST, SIDE, SIDE, out) == DP_OK);
    return out;
}

// what a test lays down on a cell: nothing, thin or thick, of one soil or both [m]
static float lies(int coat, long i, long j)
{
    return (i + j) % 5 == 0 ? 0.0f : (float)((i * 7 + j * 3 + 5 * coat) % 11) * 4e-4f;
}

static void lay(DpTerrain* terrain)
{
    DpLease*     lease = dp_lease_create();
    DpSoilPatch* patch = NULL;
    const long   half = SIDE / 2;  // of the cells read; the others stay bare
    CHECK(dp_terrain_acquire(terrain, lease, dp_cells(FIRST, FIRST, half, SIDE), &patch) == DP_OK);
    CHECK(patch->coat && patch->coat_of_soil[0] == -1 && patch->coat_of_soil[1] == 0 &&
          patch->coat_of_soil[2] == 1);
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i)
            for (int k = 0; k < 2; ++k)
                patch->coat[(size_t)k * patch->coat_stride + (size_t)(j * patch->row + i)] =
                    lies(k, i, j);
    for (int j = 0; j < patch->ny; ++j) patch->heap[j * patch->row] = 0.01f;
    dp_terrain_commit(terrain, lease, dp_cells(0, 0, patch->nx, patch->ny));
    dp_lease_destroy(lease);
}

TEST(soils_that_stick_at_some_time_have_a_coat)
{
    DpTerrain* terrain = sticky();
    const int* soils = NULL;
    CHECK(dp_terrain_coats(terrain, &soils) == 2 && soils[0] == 1 && soils[1] == 2);
    CHECK(dp_terrain_coats(terrain, NULL) == 2);
    int                      count;
    const DpFieldInfo* const fields = dp_terrain_fields(&count);
    for (int f = 0; f < count; ++f) CHECK(dp_terrain_knows(terrain, fields[f].field));
    const int known[] = {DP_FIELD_COMPRESSION, DP_FIELD_HEIGHT_CHANGE, DP_FIELD_SURFACE,
                         DP_FIELD_SURFACE + 2, DP_FIELD_COAT,          DP_FIELD_COAT + 2};
    const int unknown[] = {DP_FIELD_COMPRESSION - 1, DP_FIELD_HEIGHT_CHANGE + 1,
                           DP_FIELD_SURFACE - 1,     DP_FIELD_SURFACE + 3,
                           DP_FIELD_COAT - 1,        DP_FIELD_COAT + 3};
    for (int n = 0; n < 6; ++n) {
        CHECK(dp_terrain_knows(terrain, known[n]));
        CHECK(!dp_terrain_knows(terrain, unknown[n]));
    }
    dp_terrain_destroy(terrain);
}

TEST(no_more_soils_stick_than_there_is_room_for)
{
    DpSoil soils[20];
    for (int many = DP_MAX_COATS; many <= DP_MAX_COATS + 1; ++many) {
        for (int k = 0; k < 20; ++k) {
            soils[k] = ground_soils[0];
            soils[k].adhesion = k < many ? 0.001f : 0.0f;
        }
        DpTerrainOptions options = ground_options(CELL, 0.0, 0.0);
        options.soils = soils, options.soil_count = 20;
        const DpGround flat = ground_flat(0.0);
        DpTerrain*     terrain = NULL;
        const DpStatus status = dp_terrain_create(&terrain, &options, &flat);
        CHECK(status == (many == DP_MAX_COATS ? DP_OK : DP_BAD_ARGUMENT));
        if (status == DP_OK) CHECK(dp_terrain_coats(terrain, NULL) == many);
        dp_terrain_destroy(terrain);
    }
}

TEST(each_coat_lies_as_thick_as_it_was_left)
{
    DpTerrain* terrain = sticky();
    lay(terrain);
    double volume[2] = {0.0, 0.0};
    for (int soil = 0; soil < 3; ++soil) {
        float* coat = field(terrain, DP_FIELD_COAT + soil);
        for (int j = 0; j < SIDE; ++j)
            for (int i = 0; i < SIDE; ++i) {
                const float want = soil > 0 && i < SIDE / 2 ? lies(soil - 1, i, j) : 0.0f;
                CHECK_NEAR(coat[j * SIDE + i], want, 0.0);
                if (soil > 0) volume[soil - 1] += (double)want * CELL * CELL;
            }
        dp_free(coat);
    }
    CHECK(volume[0] > 0.0 && fabs(volume[0] - volume[1]) > 1e-6);
    for (int k = 0; k < 2; ++k) CHECK_CLOSE(dp_terrain_coat_volume(terrain, k), volume[k], 1e-9);
    dp_terrain_destroy(terrain);
}

TEST(coats_count_in_the_height)
{
    DpTerrain* terrain = sticky();
    lay(terrain);
    float* change = field(terrain, DP_FIELD_HEIGHT_CHANGE);
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const double heap = i == 0 ? 0.01 : 0.0;
            const double coats = i < SIDE / 2 ? (double)lies(0, i, j) + (double)lies(1, i, j) : 0.0;
            CHECK_NEAR(change[j * SIDE + i], heap + coats, 1e-8);
        }
    dp_free(change);
    dp_terrain_destroy(terrain);
}

// shares of what is seen are 1 together: of a coat as thick as it hides what is below, the rest of the ground's own soil
TEST(a_coat_hides_what_it_lies_on)
{
    DpTerrain* terrain = sticky();
    lay(terrain);
    float* kind = field(terrain, DP_FIELD_KIND);
    float* seen[3];
    int    kinds[3] = {0, 0, 0};
    for (int soil = 0; soil < 3; ++soil) seen[soil] = field(terrain, DP_FIELD_SURFACE + soil);
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const int    n = j * SIDE + i;
            const double part[3] = {0.0, i < SIDE / 2 ? (double)lies(0, i, j) : 0.0,
                                    i < SIDE / 2 ? (double)lies(1, i, j) : 0.0};
            const double all = part[1] + part[2], hides = fmin(all / COVERS, 1.0);
            ++kinds[(int)kind[n]];
            for (int soil = 0; soil < 3; ++soil) {
                const double own = (int)kind[n] == soil ? 1.0 - hides : 0.0;
                const double over = all > 0.0 ? hides * part[soil] / all : 0.0;
                CHECK_NEAR(seen[soil][n], own + over, 1e-6);
            }
            CHECK_NEAR(seen[0][n] + seen[1][n] + seen[2][n], 1.0, 1e-6);
        }
    CHECK((kinds[0] > 0) + (kinds[1] > 0) + (kinds[2] > 0) >= 2);  // not all of one soil
    for (int soil = 0; soil < 3; ++soil) dp_free(seen[soil]);
    dp_free(kind);
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(soils_that_stick_at_some_time_have_a_coat);
    RUN(no_more_soils_stick_than_there_is_room_for);
    RUN(each_coat_lies_as_thick_as_it_was_left);
    RUN(coats_count_in_the_height);
    RUN(a_coat_hides_what_it_lies_on);
    return check_done();
}
