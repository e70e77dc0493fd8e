#include <math.h>

#include "base/vec.h"
#include "terrain/ground.h"

static double height_at(const DpTerrain* terrain, double x, double y)
{
    const double xy[2] = {x, y};
    double       height = -1.0;
    dp_terrain_base_height(terrain, 1, xy, &height);
    return height;
}

TEST(heights_are_bilinear)
{
    float height[5 * 4];
    for (int n = 0; n < 20; ++n) height[n] = (float)sin(2.3 * n) + 5.0f;
    const DpGround ground = ground_heights(5, 4, -1.0, 2.0, 0.5, height);
    DpTerrain*     terrain = ground_terrain(&ground, 0.0625, -1.0, 2.0);
    unsigned       seed = 2;
    for (int n = 0; n < 2000; ++n) {
        const double u = 4.0 * check_random(&seed), v = 3.0 * check_random(&seed);
        const int    i = (int)u, j = (int)v;
        const double a = u - i, b = v - j;
        const float* h = height + j * 5 + i;
        const double want = (1 - a) * (1 - b) * (double)h[0] + a * (1 - b) * (double)h[1] +
                            (1 - a) * b * (double)h[5] + a * b * (double)h[6];
        CHECK_NEAR(height_at(terrain, -1.0 + 0.5 * u, 2.0 + 0.5 * v), want, 1e-12);
    }
    for (int n = 0; n < 20; ++n)  // samples themselves, the last ones included
        CHECK(height_at(terrain, -1.0 + 0.5 * (n % 5), 2.0 + 0.5 * (n / 5)) == (double)height[n]);
    CHECK(isnan(height_at(terrain, -1.01, 2.1)) && isnan(height_at(terrain, 1.01, 2.1)));
    CHECK(isnan(height_at(terrain, 0.0, 1.99)) && isnan(height_at(terrain, 0.0, 3.51)));
    CHECK(isnan(height_at(terrain, (double)NAN, 2.1)));
    CHECK(isnan(height_at(terrain, 1e300, 2.1)) && isnan(height_at(terrain, 0.0, -1e300)));
    double bounds[4];
    dp_terrain_bounds(terrain, bounds);
    CHECK(bounds[0] == -1.0 && bounds[1] == 2.0 && bounds[2] == 1.0 && bounds[3] == 3.5);

    float cells[32 * 24];  // what kernels see is what points say
    CHECK(dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, 0, 0, 32, 24, cells) == DP_OK);
    for (int n = 0; n < 32 * 24; ++n) {
        const double x = -1.0 + (n % 32 + 0.5) * 0.0625, y = 2.0 + (n / 32 + 0.5) * 0.0625;
        CHECK(cells[n] == (float)height_at(terrain, x, y));
    }
    dp_terrain_destroy(terrain);
}

TEST(level_heights_are_level_to_the_bit)
{
    float height[9];
    for (int n = 0; n < 9; ++n) height[n] = 0.1f;
    const DpGround ground = ground_heights(3, 3, 0.0, 0.0, 0.7, height);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    unsigned       seed = 4;
    for (int n = 0; n < 500; ++n)
        CHECK(height_at(terrain, 1.4 * check_random(&seed), 1.4 * check_random(&seed)) ==
              (double)0.1f);
    const DpVec3 normal = dp_terrain_normal(terrain, 0.7, 0.7, 0.1);
    CHECK(normal.x == 0.0 && normal.y == 0.0 && normal.z == 1.0);
    CHECK(!signbit(normal.x) && !signbit(normal.y));
    dp_terrain_destroy(terrain);
}

TEST(holes_are_holes)
{
    float height[16] = {0.0f};
    height[5] = NAN;
    const DpGround ground = ground_heights(4, 4, 0.0, 0.0, 1.0, height);
    DpTerrain*     terrain = ground_terrain(&ground, 0.1, 0.0, 0.0);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            CHECK(!isnan(height_at(terrain, i + 0.4, j + 0.6)) == !(i < 2 && j < 2));
    dp_terrain_destroy(terrain);
}

TEST(normal_fits_the_slope)
{
    float height[21 * 21];
    for (int n = 0; n < 441; ++n)
        height[n] = 0.3f * (float)(n % 21) * 0.1f - 0.2f * (float)(n / 21) * 0.1f;
    DpGround     ground = ground_heights(21, 21, 0.0, 0.0, 0.1, height);
    DpTerrain*   terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    const DpVec3 want = dp_unit(dp_vec3(-0.3, 0.2, 1.0));
    const DpVec3 middle = dp_terrain_normal(terrain, 0.93, 1.12, 0.25);
    const DpVec3 edge =
        dp_terrain_normal(terrain, 0.0, 0.05, 0.25);  // half the disc is off the ground
    CHECK_NEAR(middle.x, want.x, 1e-6);
    CHECK_NEAR(middle.y, want.y, 1e-6);
    CHECK_NEAR(middle.z, want.z, 1e-6);
    CHECK_NEAR(dp_length(middle), 1.0, 1e-12);
    CHECK_NEAR(edge.x, want.x, 1e-6);
    CHECK_NEAR(edge.y, want.y, 1e-6);
    const DpVec3 off = dp_terrain_normal(terrain, 50.0, 50.0, 0.25);
    CHECK(off.x == 0.0 && off.y == 0.0 && off.z == 1.0);
    const DpVec3 point = dp_terrain_normal(terrain, 1.0, 1.0, 0.0);
    CHECK(point.x == 0.0 && point.y == 0.0 && point.z == 1.0);
    dp_terrain_destroy(terrain);

    // a ripple much shorter than the disc is smoothed away
    float ripple[81 * 81];
    for (int n = 0; n < 81 * 81; ++n) ripple[n] = 0.01f * (float)(((n % 81) + (n / 81)) % 2);
    ground = ground_heights(81, 81, 0.0, 0.0, 0.025, ripple);
    terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    CHECK(dp_terrain_normal(terrain, 1.003, 1.011, 0.5).z > 0.999);
    dp_terrain_destroy(terrain);
}

TEST(bad_heights_are_refused)
{
    float                  height[9] = {0.0f};
    float                  weight[18] = {0.0f};
    DpTerrain*             terrain = NULL;
    const DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    const DpGround         good = ground_heights(3, 3, 0.0, 0.0, 1.0, height);
    DpGround               bad = good;
#define STATUS(want) CHECK_REFUSED(terrain, options, bad, good, want)
    bad.nx = 1;
    STATUS(DP_BAD_ARGUMENT);
    bad.ny = 0;
    STATUS(DP_BAD_ARGUMENT);
    bad.spacing = 0.0;
    STATUS(DP_BAD_ARGUMENT);
    bad.x0 = (double)NAN;
    STATUS(DP_BAD_ARGUMENT);
    bad.heights = NULL;
    STATUS(DP_BAD_ARGUMENT);
    height[3] = INFINITY;
    STATUS(DP_BAD_ARGUMENT);
    height[3] = 0.0f;
    height[4] = NAN;  // every square has it
    STATUS(DP_NO_GROUND);
    height[4] = 0.0f;
    bad.kind_count = 2;
    STATUS(DP_BAD_ARGUMENT);
    bad.kind_count = 2, bad.kind_weight = weight, weight[11] = -1.0f;
    STATUS(DP_BAD_ARGUMENT);
    bad.kind_count = 2, bad.kind_weight = weight, weight[11] = NAN;
    STATUS(DP_BAD_ARGUMENT);
    weight[11] = 0.0f;
    for (long left = 0; left < 5; ++left) {
        bad.kind_count = 2, bad.kind_weight = weight;
        dp_alloc_fail_after(left);
        STATUS(DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
    }
}

// many points at once are as each of them alone
TEST(points_are_asked_for_one_by_one_or_all_at_once)
{
    float height[5 * 4];
    for (int n = 0; n < 20; ++n) height[n] = (float)sin(2.3 * n) + 5.0f;
    const DpGround ground = ground_heights(5, 4, -1.0, 2.0, 0.5, height);
    DpTerrain*     terrain = ground_terrain(&ground, 0.0625, -1.0, 2.0);
    double         xy[2 * 50], all[50];
    unsigned       seed = 5;
    for (int n = 0; n < 50; ++n)
        xy[2 * n] = -1.0 + 2.0 * check_random(&seed), xy[2 * n + 1] = 2.0 + check_random(&seed);
    dp_terrain_base_height(terrain, 50, xy, all);
    for (int n = 0; n < 50; ++n) CHECK(all[n] == height_at(terrain, xy[2 * n], xy[2 * n + 1]));
    dp_terrain_destroy(terrain);
}

int main(void)
{
    RUN(heights_are_bilinear);
    RUN(level_heights_are_level_to_the_bit);
    RUN(holes_are_holes);
    RUN(normal_fits_the_slope);
    RUN(bad_heights_are_refused);
    RUN(points_are_asked_for_one_by_one_or_all_at_once);
    return check_done();
}
