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

// the upper envelope by asking every triangle
static double slow_height(int triangles, const int32_t* triangle, const double* vertex, double x,
                          double y)
{
    double top = NAN;
    for (int t = 0; t < triangles; ++t) {
        const double* c[3];
        double        side[3], whole = 0.0;
        for (int k = 0; k < 3; ++k) c[k] = vertex + 3 * triangle[3 * t + k];
        for (int k = 0; k < 3; ++k) {
            const double *a = c[(k + 1) % 3], *b = c[(k + 2) % 3];
            side[k] = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            whole += side[k];
        }
        if (whole == 0.0) continue;
        if (side[0] / whole < 0.0 || side[1] / whole < 0.0 || side[2] / whole < 0.0) continue;
        const double z = (side[0] * c[0][2] + side[1] * c[1][2] + side[2] * c[2][2]) / whole;
        if (!(z <= top)) top = z;
    }
    return top;
}

TEST(the_highest_triangle_counts)
{
    double   vertex[3 * 3 * 60];
    int32_t  triangle[3 * 60];
    unsigned seed = 21;
    int      on = 0;
    for (int round = 0; round < 12; ++round) {
        const int    triangles = 5 * (round + 1);
        const double size = round % 3 ? 4.0 : 1.0;  // some far apart, some over each other
        for (int n = 0; n < 3 * triangles; ++n) {
            const double* first = vertex + 9 * (n / 3);
            const double  big = n / 3 == 7 ? 8.0 : size;  // one huge among the small
            triangle[n] = n;
            if (n % 3 == 0) {
                vertex[3 * n] = 8.0 * check_random(&seed) - 3.0;
                vertex[3 * n + 1] = 6.0 * check_random(&seed) + 100.0;
            } else {
                vertex[3 * n] = first[0] + big * (check_random(&seed) - 0.5);
                vertex[3 * n + 1] = first[1] + big * (check_random(&seed) - 0.5);
            }
            vertex[3 * n + 2] = 5.0 * check_random(&seed);
        }
        const DpGround ground = ground_mesh(3 * triangles, vertex, triangles, triangle);
        DpTerrain*     terrain = ground_terrain(&ground, 0.05, -4.0, 99.0);
        for (int n = 0; n < 3000; ++n) {
            const double x = 10.0 * check_random(&seed) - 4.0, y = 8.0 * check_random(&seed) + 99.0;
            const double want = slow_height(triangles, triangle, vertex, x, y);
            const double got = height_at(terrain, x, y);
            CHECK(isnan(want) == isnan(got));
            if (!isnan(want)) CHECK_NEAR(got, want, 1e-9);
            on += !isnan(want);
        }
        static float cells[200 * 160];  // what kernels see is what points say, to the bit
        CHECK(dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, 0, 0, 200, 160, cells) == DP_OK);
        for (int n = 0; n < 200 * 160; ++n) {
            const float at_point = (float)height_at(terrain, -4.0 + (n % 200 + 0.5) * 0.05,
                                                    99.0 + (n / 200 + 0.5) * 0.05);
            CHECK(isnan(at_point) ? isnan(cells[n]) : cells[n] == at_point);
        }
        dp_terrain_destroy(terrain);
    }
    CHECK(on > 3000);  // of 36,000
}

#define GRID 33

// a square grid of triangles over 0..1, turned and moved
static void make_grid(double* vertex, int32_t* triangle, double angle, double at, double slope)
{
    for (int j = 0; j < GRID; ++j)
        for (int i = 0; i < GRID; ++i) {
            const double u = (double)i / (GRID - 1), v = (double)j / (GRID - 1);
            double*      p = vertex + 3 * (j * GRID + i);
            p[0] = at + u * cos(angle) - v * sin(angle);
            p[1] = at + u * sin(angle) + v * cos(angle);
            p[2] = slope * p[0] + 0.1;
        }
    int t = 0;
    for (int j = 0; j + 1 < GRID; ++j)
        for (int i = 0; i + 1 < GRID; ++i) {
            const int32_t a = j * GRID + i, b = a + 1, c = a + GRID, d = c + 1;
            const int32_t two[2][6] = {{a, b, d, a, d, c}, {b, a, c, b, c, d}};  // both windings
            memcpy(triangle + t, two[(i + j) % 2], sizeof two[0]);
            t += 6;
        }
}

TEST(shared_edges_have_no_pinholes)
{
    static double  vertex[3 * GRID * GRID];
    static int32_t triangle[6 * GRID * GRID];
    const int      triangles = 2 * (GRID - 1) * (GRID - 1);
    // cell centres on corners and edges, and grids where rounding decides
    for (int round = 0; round < 24; ++round) {
        const double angle = round < 8 ? 0.0 : 0.1 * round, at = round % 4 * 1000.1;
        make_grid(vertex, triangle, angle, at, 0.0);
        const DpGround ground = ground_mesh(GRID * GRID, vertex, triangles, triangle);
        DpTerrain*     terrain = ground_terrain(&ground, 1.0 / 64.0, at, at);
        unsigned       seed = 5;
        for (int n = 0; n < 4000; ++n) {
            const int i = 1 + (int)(31.0 * check_random(&seed)),
                      j = 1 + (int)(31.0 * check_random(&seed));
            const int di = (int)(3.0 * check_random(&seed)) - 1,
                      dj = (int)(3.0 * check_random(&seed)) - 1;
            const double  w = n % 3 ? check_random(&seed) : 0.0;
            const double* a = vertex + 3 * (j * GRID + i);
            const double* b =
                vertex + 3 * ((j + dj) * GRID + i + di);  // along an edge, from a corner
            CHECK(height_at(terrain, a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1])) == 0.1);
        }
        if (round < 8 && at == 0.0) {
            static float cells[64 * 64];
            CHECK(dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, 0, 0, 64, 64, cells) == DP_OK);
            for (int n = 0; n < 64 * 64; ++n) CHECK(cells[n] == 0.1f);
        }
        dp_terrain_destroy(terrain);
    }
}

TEST(a_needle_between_two_triangles_leaves_no_gap)
{
    // the middle of the long edge is off it by less than anybody can see: T-junctions look like
    // this
    const double   off = 1e-13;
    const double   vertex[] = {0.0, 0.0, 0.0, 1.0, 0.0, 1.0,  0.5, off,
                               0.5, 0.5, 1.0, 0.5, 0.5, -1.0, 0.5};
    const int32_t  triangle[] = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 4};
    const DpGround ground = ground_mesh(5, vertex, 4, triangle);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    unsigned       seed = 6;
    for (int n = 1; n < 2000; ++n) {
        const double x = 0.001 + 0.998 * check_random(&seed);
        CHECK_NEAR(height_at(terrain, x, 0.5 * off * check_random(&seed)), x, 1e-9);
    }
    dp_terrain_destroy(terrain);
}

TEST(slopes_join_and_cells_agree)
{
    static double  vertex[3 * GRID * GRID];
    static int32_t triangle[6 * GRID * GRID];
    make_grid(vertex, triangle, 0.3, -0.2, 0.4);
    const DpGround ground = ground_mesh(GRID * GRID, vertex, 2 * (GRID - 1) * (GRID - 1), triangle);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    DpLease*       lease = dp_lease_create();
    DpSoilPatch*   patch = NULL;
    CHECK(dp_terrain_acquire(terrain, lease, (DpCellRect){-80, 80, -40, 140}, &patch) == DP_OK);
    int on = 0;
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const float rest = patch->base_height[j * patch->row + i];
            if (isnan(rest)) continue;
            ++on;
            CHECK_NEAR(rest, 0.4 * (patch->x0 + i * 0.01) + 0.1, 1e-7);
        }
    CHECK(abs(on - 10000) < 300);
    const DpVec3 normal = dp_terrain_normal(terrain, 0.2, 0.4, 0.1);
    const DpVec3 want = dp_unit(dp_vec3(-0.4, 0.0, 1.0));
    CHECK_NEAR(normal.x, want.x, 1e-9);
    CHECK_NEAR(normal.y, 0.0, 1e-9);
    dp_lease_destroy(lease);
    dp_terrain_destroy(terrain);
}

TEST(paint_follows_the_highest_triangle)
{
    // two squares, the upper one painted with soil 2; the lower one from soil 0 to soil 1 along x
    const double  vertex[] = {0, 0,   0, 1, 0,   0, 1, 1, 0, 0, 1, 0,
                              0, 0.5, 1, 1, 0.5, 1, 1, 1, 1, 0, 1, 1};
    const int32_t triangle[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    const float weight[] = {1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
    DpGround    ground = ground_mesh(8, vertex, 4, triangle);
    ground.kind_count = 3;
    ground.kind_weight = weight;
    DpTerrain* terrain = ground_terrain(&ground, 1.0 / 16.0, 0.0, 0.0);
    float      kind[256], rest[256];
    CHECK(dp_terrain_read(terrain, DP_FIELD_KIND, 0, 0, 16, 16, kind) == DP_OK);
    CHECK(dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, 0, 0, 16, 16, rest) == DP_OK);
    for (int n = 0; n < 256; ++n) {
        const int i = n % 16, j = n / 16;
        CHECK(kind[n] == (j >= 8 ? 2.0f : i < 8 ? 0.0f : 1.0f));
        CHECK(rest[n] == (j >= 8 ? 1.0f : 0.0f));
    }
    float off_ground = 9.0f;
    CHECK(dp_terrain_read(terrain, DP_FIELD_KIND, 99, 0, 1, 1, &off_ground) == DP_OK);
    CHECK(off_ground == 0.0f);
    dp_terrain_destroy(terrain);
}

TEST(any_number_of_workers_gives_the_same_bits)
{
    static double  vertex[3 * GRID * GRID];
    static int32_t triangle[6 * GRID * GRID];
    static float   cells[4][300 * 300];
    make_grid(vertex, triangle, 0.7, 0.0, 0.3);
    unsigned seed = 12;
    for (int n = 0; n < GRID * GRID; ++n) vertex[3 * n + 2] += 0.1 * check_random(&seed);
    const DpGround ground = ground_mesh(GRID * GRID, vertex, 2 * (GRID - 1) * (GRID - 1), triangle);
    for (int w = 0; w < 4; ++w) {
        DpTerrainOptions options = ground_options(0.007, 0.0, 0.0);
        DpTerrain*       terrain = NULL;
        options.workers = w + 1;
        CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_OK);
        if (w % 2) CHECK(dp_terrain_touch(terrain, (DpCellRect){-50, 100, 30, 80}) == DP_OK);
        CHECK(dp_terrain_read(terrain, DP_FIELD_BASE_HEIGHT, -150, -50, 300, 300, cells[w]) ==
              DP_OK);
        CHECK(memcmp(cells[0], cells[w], sizeof cells[0]) == 0);
        dp_terrain_destroy(terrain);
    }
}

TEST(a_large_mesh_among_few_bins_each)
{
    // 100 m of fine triangles and two huge ones under them
    const int side = 201, fine = 2 * (side - 1) * (side - 1);
    double*   vertex = dp_alloc((size_t)(side * side + 4), 3 * sizeof(double));
    int32_t*  triangle = dp_alloc((size_t)(fine + 2), 3 * sizeof(int32_t));
    for (int n = 0; n < side * side; ++n) {
        vertex[3 * n] = 0.5 * (n % side);
        vertex[3 * n + 1] = 0.5 * (n / side);
        vertex[3 * n + 2] = 1.0 + 0.01 * (n % 7);
    }
    int t = 0;
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i) {
            const int32_t a = j * side + i;
            const int32_t two[6] = {a, a + 1, a + side + 1, a, a + side + 1, a + side};
            memcpy(triangle + t, two, sizeof two);
            t += 6;
        }
    const int32_t first = side * side;
    const double  corner[4][2] = {{-5e3, -5e3}, {5e3, -5e3}, {5e3, 5e3}, {-5e3, 5e3}};
    for (int k = 0; k < 4; ++k) {
        vertex[3 * (first + k)] = corner[k][0];
        vertex[3 * (first + k) + 1] = corner[k][1];
    }
    const int32_t two[6] = {first, first + 1, first + 2, first, first + 2, first + 3};
    memcpy(triangle + t, two, sizeof two);
    const size_t   before = dp_bytes_live();
    const DpGround ground = ground_mesh(side * side + 4, vertex, fine + 2, triangle);
    DpTerrain*     terrain = ground_terrain(&ground, 0.01, 0.0, 0.0);
    // a copy of the mesh and a few ints a triangle
    CHECK(dp_bytes_live() - before < (size_t)fine * (12 + 12 + 32) + 10000);
    CHECK(height_at(terrain, -4000.0, 3999.0) == 0.0);
    CHECK(height_at(terrain, 37.5, 62.5) == vertex[3 * (125 * side + 75) + 2]);
    double bounds[4];
    dp_terrain_bounds(terrain, bounds);
    CHECK(bounds[0] == -5e3 && bounds[1] == -5e3 && bounds[2] == 5e3 && bounds[3] == 5e3);
    dp_terrain_destroy(terrain);
    dp_free(vertex);
    dp_free(triangle);
}

TEST(a_point_of_no_triangle_may_lie_far_off)
{
    static double  vertex[3 * (GRID * GRID + 1)];
    static int32_t triangle[6 * GRID * GRID];
    const int      triangles = 2 * (GRID - 1) * (GRID - 1);
    make_grid(vertex, triangle, 0.3, 5.0, 0.25);
    for (int k = 0; k < 3; ++k) vertex[3 * GRID * GRID + k] = 1e9;
    double heights[2][100], bounds[2][4];
    for (int far = 0; far < 2; ++far) {
        const DpGround ground = ground_mesh(GRID * GRID + far, vertex, triangles, triangle);
        DpTerrain*     terrain = ground_terrain(&ground, 1.0 / 64.0, 0.0, 0.0);
        dp_terrain_bounds(terrain, bounds[far]);
        for (int n = 0; n < 100; ++n)
            heights[far][n] = height_at(terrain, 4.7 + 0.013 * n, 5.0 + 0.012 * n);
        dp_terrain_destroy(terrain);
    }
    CHECK(memcmp(bounds[0], bounds[1], sizeof bounds[0]) == 0);
    int on = 0;
    for (int n = 0; n < 100; ++n) {
        CHECK(isnan(heights[0][n]) ? isnan(heights[1][n]) : heights[0][n] == heights[1][n]);
        on += !isnan(heights[0][n]);
    }
    CHECK(on > 30);
}

TEST(bad_meshes_are_refused)
{
    double                 vertex[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    int32_t                triangle[6] = {0, 1, 2, 1, 3, 2};
    DpTerrain*             terrain = NULL;
    const DpTerrainOptions options = ground_options(0.01, 0.0, 0.0);
    const DpGround         good = ground_mesh(4, vertex, 2, triangle);
    DpGround               bad = good;
#define STATUS(want) CHECK_REFUSED(terrain, options, bad, good, want)
    vertex[4] = (double)NAN;
    STATUS(DP_BAD_ARGUMENT);
    vertex[4] = (double)-INFINITY;
    STATUS(DP_BAD_ARGUMENT);
    vertex[4] = 0.0;
    triangle[5] = 4;
    STATUS(DP_BAD_ARGUMENT);
    triangle[5] = -1;
    STATUS(DP_BAD_ARGUMENT);
    triangle[5] = 2;
    bad.triangle_count = 0;
    STATUS(DP_BAD_ARGUMENT);
    bad.vertex_count = 0;
    STATUS(DP_BAD_ARGUMENT);
    bad.vertex = NULL;
    STATUS(DP_BAD_ARGUMENT);
    bad.triangle = NULL;
    STATUS(DP_BAD_ARGUMENT);
    bad.kind_count = 1;
    STATUS(DP_BAD_ARGUMENT);
    for (long left = 0; left < 7; ++left) {
        dp_alloc_fail_after(left);
        STATUS(DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
    }
    // upright walls, along the axes and turned, are no ground
    for (int n = 0; n < 8; ++n) {
        const double angle = 0.4 * n;
        for (int k = 0; k < 4; ++k) {
            vertex[3 * k] = 100.0 + (k % 2) * cos(angle);
            vertex[3 * k + 1] = -30.0 + (k % 2) * sin(angle);
            vertex[3 * k + 2] = k / 2;
        }
        STATUS(DP_NO_GROUND);
    }
}

// a point so far off that a metre is less than its last digit; triangles as thin as numbers go
TEST(a_mesh_without_width_has_bins_all_the_same)
{
    const double  at[3] = {0.0, 1e99, -3e60};
    const int32_t triangle[3] = {0, 1, 2};
    for (int n = 0; n < 3; ++n)
        for (int thin = 0; thin < 2; ++thin) {
            double vertex[9] = {0.0};
            for (int k = 0; k < 9; ++k) vertex[k] = at[n] + (thin && k > 4 ? 5e-324 : 0.0);
            const DpGround         ground = ground_mesh(3, vertex, 1, triangle);
            const DpTerrainOptions options = ground_options(0.1, 0.0, 0.0);
            DpTerrain*             terrain = NULL;
            CHECK(dp_terrain_create(&terrain, &options, &ground) == DP_NO_GROUND);
        }
}

int main(void)
{
    RUN(the_highest_triangle_counts);
    RUN(shared_edges_have_no_pinholes);
    RUN(a_needle_between_two_triangles_leaves_no_gap);
    RUN(slopes_join_and_cells_agree);
    RUN(paint_follows_the_highest_triangle);
    RUN(any_number_of_workers_gives_the_same_bits);
    RUN(a_large_mesh_among_few_bins_each);
    RUN(a_point_of_no_triangle_may_lie_far_off);
    RUN(a_mesh_without_width_has_bins_all_the_same);
    RUN(bad_meshes_are_refused);
    return check_done();
}
