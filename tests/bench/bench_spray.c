// bench_spray.c - a frame of 100,000 grains that fly, over level ground and over hills that were trodden.
//
//   scripts/bench spray
#include <math.h>

#include "base/alloc.h"
#include "base/noise.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "desire_path.h"
#include "timing.h"

#define GRAINS 100000
#define STEPS 5    // of a frame, at 120 steps and 24 frames a second
#define SIDE 512   // samples of the hills
#define WIDE 10.0  // [m]

static double surface(const void* terrain, double x, double y)
{
    return dp_terrain_surface_at(terrain, x, y);
}

static double highest(void* terrain, long tx, long ty)
{
    double found = -INFINITY;
    for (int n = 0; n < 9; ++n)
        found = fmax(found, dp_terrain_highest(terrain, tx + n % 3 - 1, ty + n / 3 - 1));
    return found;
}

static DpTerrain* field(bool hilly)
{
    static float  heights[SIDE * SIDE];
    static DpSoil soil;
    soil = dp_soil_default();
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i)
            heights[j * SIDE + i] = (float)(0.3 * sin(0.05 * i) * cos(0.04 * j));
    const DpTerrainOptions options = {
        .grid = {0.01, 0.0, 0.0}, .soils = &soil, .soil_count = 1, .workers = dp_parallel_width()};
    const DpGround hills = {.kind = DP_GROUND_HEIGHTS,
                            .nx = SIDE,
                            .ny = SIDE,
                            .spacing = WIDE / (SIDE - 1),
                            .heights = heights};
    const DpGround level = {.kind = DP_GROUND_FLAT};
    DpTerrain*     terrain = NULL;
    if (dp_terrain_create(&terrain, &options, hilly ? &hills : &level) != DP_OK) return NULL;
    if (dp_terrain_touch(terrain, dp_cells(0, 0, (long)(WIDE / 0.01), (long)(WIDE / 0.01))) !=
        DP_OK) {
        dp_terrain_destroy(terrain);
        return NULL;
    }
    return terrain;
}

// all over the ground, up to 1.5 m high and up to 6 m/s fast
static DpCloud* cloud_of(void)
{
    DpSprayNumbers  numbers;
    int             count;
    const DpNumber* table = dp_spray_numbers(&count);
    dp_numbers_usual(&numbers, table, count);
    DpCloud* cloud = dp_cloud_create(&numbers);
    for (int n = 0; cloud && n < GRAINS; ++n) {
        double r[6];
        for (int k = 0; k < 6; ++k) r[k] = dp_noise_unit(dp_noise_bits(n, k, 3u));
        const DpGrain grain = {
            .at = dp_vec3(WIDE * (0.1 + 0.8 * r[0]), WIDE * (0.1 + 0.8 * r[1]), 0.35 + 1.2 * r[2]),
            .velocity = dp_vec3(6.0 * r[3] - 3.0, 6.0 * r[4] - 3.0, 1.0 + 5.0 * r[5])};
        if (dp_cloud_add(cloud, &grain, 0.0) != DP_OK) break;
    }
    return cloud;
}

// the first frame, of all of them [s]
static double frame(DpTerrain* terrain, int* left)
{
    const DpSprayGround ground = {.surface = surface,
                                  .ground = terrain,
                                  .highest = highest,
                                  .context = terrain,
                                  .side = 0.01 * DP_TILE};
    DpCloud*            cloud = cloud_of();
    const double        begun = bench_now();
    for (int k = 0; cloud && k < STEPS; ++k) {
        const DpLanding* landing;
        int              landings;
        dp_cloud_fly(cloud, &ground, 1.0 / 120.0, dp_parallel_width(), &landing, &landings);
    }
    const double took = bench_now() - begun;
    *left = cloud ? dp_cloud_count(cloud) : 0;
    dp_cloud_destroy(cloud);
    return took;
}

int main(void)
{
    for (int hilly = 0; hilly < 2; ++hilly) {
        DpTerrain* terrain = field(hilly);
        int        left = 0;
        if (!terrain) return 1;
        double best = INFINITY;
        for (int n = 0; n < 5; ++n) best = fmin(best, frame(terrain, &left));
        printf("%-6s %d grains, a frame of %d steps: %.2f ms; %d fly on\n",
               hilly ? "hills" : "level", GRAINS, STEPS, 1e3 * best, left);
        bench_keep("spray", hilly ? "a frame over hills" : "a frame over level ground", best);
        dp_terrain_destroy(terrain);
    }
    return 0;
}
