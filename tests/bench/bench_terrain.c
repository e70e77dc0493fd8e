// tests/bench/bench_terrain.c - what imprints, windows and ground meshes cost. Best of several
// runs.
//
//   cmake -S native -B build && cmake --build build --target bench_terrain && build/bench_terrain
#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "imprint/imprint.h"
#include "soil/soil.h"
#include "terrain/terrain.h"
#include "timing.h"

#define BEST_OF(best, runs, each, work)                        \
    do {                                                       \
        best = INFINITY;                                       \
        for (int run_ = 0; run_ < (runs); ++run_) {            \
            const double from_ = bench_now();                  \
            for (int each_ = 0; each_ < (each); ++each_) work; \
            best = fmin(best, (bench_now() - from_) / (each)); \
        }                                                      \
    } while (0)

// a closed shoe of 28 x 10 cm, flat below, round about: around x along x 2 triangles
static DpMesh shoe(int around, int along)
{
    float*   vertex = dp_alloc((size_t)(around * (along + 1)), 3 * sizeof(float));
    int32_t* triangle = dp_alloc((size_t)(around * along), 6 * sizeof(int32_t));
    int      t = 0;
    for (int a = 0; a <= along; ++a)
        for (int b = 0; b < around; ++b) {
            const double u = 3.14159265 * a / along, v = 6.2831853 * b / around;
            float*       at = vertex + 3 * (a * around + b);
            at[0] = (float)(-0.14 * cos(u));
            at[1] = (float)(0.05 * sqrt(sin(u) + 1e-9) * cos(v));
            at[2] = (float)(0.02 + 0.06 * sqrt(sin(u) + 1e-9) * (sin(v) > -0.3 ? sin(v) : -0.3));
            if (a == along) continue;
            const int32_t p = a * around + b, q = a * around + (b + 1) % around;
            const int32_t two[6] = {p, q, p + around, q, q + around, p + around};
            for (int k = 0; k < 6; ++k) triangle[t++] = two[k];
        }
    const DpMesh mesh = {around * (along + 1), t / 3, vertex, triangle};
    return mesh;
}

static void bench_imprint(void)
{
    enum
    {
        NX = 64,
        NY = 48
    };
    static float   bottom[NX * NY], cover[NX * NY];
    static int32_t ring[NX * NY];
    DpSoilPatch    patch = {0};
    patch.nx = patch.row = NX, patch.ny = NY, patch.cell = 0.01;
    patch.x0 = -0.315, patch.y0 = -0.235;
    DpImprint         imprint = {.bottom = bottom, .cover = cover, .ring = ring};
    DpImprintScratch* scratch = dp_imprint_scratch_create();
    const int         sizes[][2] = {{10, 10}, {50, 30}};
    for (int n = 0; n < 2; ++n) {
        const DpMesh mesh = shoe(sizes[n][0], sizes[n][1]);
        const DpPose pose = {{0.003, 0.001, 0.0}, {cos(0.2), 0.01, 0.02, sin(0.2)}};
        double       best;
        for (int samples = 1; samples <= 4; ++samples) {
            BEST_OF(best, 30, 200,
                    dp_imprint_foot(&imprint, &patch, &mesh, &pose, 1, samples, scratch));
            printf("imprint  %5d triangles, 1 cm, %d x %d samples  %8.2f us\n", mesh.triangle_count,
                   samples, samples, 1e6 * best);
            char what[64];
            snprintf(what, sizeof what, "imprint %d triangles %d samples", mesh.triangle_count,
                     samples);
            bench_keep("terrain", what, best);
        }
        dp_free((void*)mesh.vertex);
        dp_free((void*)mesh.triangle);
    }
    double best;
    BEST_OF(best, 30, 200, {
        for (int c = 0; c < NX * NY; ++c) ring[c] = cover[c] > 0.0f ? 0 : DP_RING_FAR;
        dp_imprint_rings(&imprint, &patch, 12);
    });
    printf("rings    64 x 48 cells, 12 rings                  %8.2f us\n", 1e6 * best);
    bench_keep("terrain", "rings", best);
    dp_imprint_scratch_destroy(scratch);
}

static DpTerrain* terrain_on(const DpGround* ground, double* seconds)
{
    const DpSoil           soil = dp_soil_default();
    const DpTerrainOptions options = {{0.01, 0.0, 0.0}, &soil, 1, 1, 0, NULL};
    DpTerrain*             terrain = NULL;
    const double           from = bench_now();
    if (dp_terrain_create(&terrain, &options, ground) != DP_OK) printf("no terrain\n");
    *seconds = bench_now() - from;
    return terrain;
}

static void bench_windows(void)
{
    const DpGround ground = {.kind = DP_GROUND_FLAT};
    double         seconds, best;
    DpTerrain*     terrain = terrain_on(&ground, &seconds);
    DpLease*       lease = dp_lease_create();
    DpSoilPatch*   patch;
    BEST_OF(best, 30, 200,
            dp_terrain_acquire(terrain, lease, (DpCellRect){40, 104, 30, 78}, &patch));
    printf("lend     64 x 48 cells over 4 tiles               %8.2f us\n", 1e6 * best);
    bench_keep("terrain", "lend", best);
    BEST_OF(best, 30, 200, dp_terrain_commit(terrain, lease, (DpCellRect){0, 64, 0, 48}));
    printf("give     64 x 48 cells over 4 tiles               %8.2f us\n", 1e6 * best);
    bench_keep("terrain", "give back", best);
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

static void keep_mesh(const DpGround* ground, const char* part, double seconds)
{
    char what[64];
    snprintf(what, sizeof what, "mesh of %d: %s", ground->triangle_count, part);
    bench_keep("terrain", what, seconds);
}

static void bench_mesh(int side, double size)
{
    double*  vertex = dp_alloc((size_t)side * (size_t)side, 3 * sizeof(double));
    int32_t* triangle = dp_alloc((size_t)(side - 1) * (size_t)(side - 1), 6 * sizeof(int32_t));
    size_t   t = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            double* at = vertex + 3 * ((size_t)j * (size_t)side + (size_t)i);
            at[0] = size * i / (side - 1), at[1] = size * j / (side - 1);
            at[2] = 0.1 * sin(3.0 * at[0]) * cos(2.0 * at[1]);
            if (i + 1 == side || j + 1 == side) continue;
            const int32_t a = j * side + i;
            const int32_t two[6] = {a, a + 1, a + side + 1, a, a + side + 1, a + side};
            for (int k = 0; k < 6; ++k) triangle[t++] = two[k];
        }
    DpGround ground = {.kind = DP_GROUND_MESH};
    ground.vertex_count = side * side, ground.triangle_count = (int)(t / 3);
    ground.vertex = vertex, ground.triangle = triangle;

    const size_t before = dp_bytes_live();
    double       seconds, best;
    DpTerrain*   terrain = terrain_on(&ground, &seconds);
    printf("mesh     %7d triangles on %g m: built in    %8.1f ms, %.1f bytes a triangle\n",
           ground.triangle_count, size, 1e3 * seconds,
           (double)(dp_bytes_live() - before) / ground.triangle_count);
    keep_mesh(&ground, "built", seconds);
    const long   middle = (long)(size / 0.02);
    static float cells[512 * 512];
    BEST_OF(best, 3, 1,
            dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, middle, middle, 512, 512, cells));
    printf("         one tile of heights, mean over 512 x 512 %8.1f us\n", 1e6 * best / 64.0);
    keep_mesh(&ground, "a tile of heights", best / 64.0);
    enum
    {
        POINTS = 4096
    };
    static double xy[2 * POINTS], height[POINTS];
    for (int n = 0; n < POINTS; ++n)
        xy[2 * n] = 0.5 * size + 0.01 * (n % 64), xy[2 * n + 1] = 0.5 * size + 0.01 * (n / 64);
    BEST_OF(best, 5, 4, dp_terrain_base_height(terrain, POINTS, xy, height));
    printf("         one point                                %8.1f ns\n", 1e9 * best / POINTS);
    keep_mesh(&ground, "a point", best / POINTS);
    BEST_OF(best, 5, 1000, dp_terrain_normal(terrain, 0.5 * size, 0.5 * size, 0.25));
    printf("         one normal                               %8.2f us\n", 1e6 * best);
    keep_mesh(&ground, "a normal", best);
    dp_terrain_destroy(terrain);
    dp_free(vertex);
    dp_free(triangle);
}

int main(void)
{
    bench_imprint();
    bench_windows();
    bench_mesh(9, 10.0);
    bench_mesh(129, 10.0);
    bench_mesh(1001, 10.0);
    return 0;
}
