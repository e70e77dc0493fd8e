// tests of terrain_bins.c: each triangle stands once, in the finest grid in which it ends in its bin or the next one
#include "terrain/terrain_bins.h"

#include "base/alloc.h"
#include "terrain/ground.h"

#define SIDE 60
#define FACES (2 * SIDE * SIDE + 40)

static double  vertex[3 * ((SIDE + 1) * (SIDE + 1) + 200)];
static int32_t triangle[3 * FACES];
static int     points, faces;

static void put(double x, double y, double z)
{
    vertex[3 * points] = x, vertex[3 * points + 1] = y, vertex[3 * points + 2] = z;
    ++points;
}

static void join(int a, int b, int c)
{
    triangle[3 * faces] = a, triangle[3 * faces + 1] = b, triangle[3 * faces + 2] = c;
    ++faces;
}

// a grid of small triangles, larger ones over it, and some that stand upright, which are no ground
static DpGround many(void)
{
    unsigned seed = 11;
    points = faces = 0;
    for (int j = 0; j <= SIDE; ++j)
        for (int i = 0; i <= SIDE; ++i)
            put(3.0 + 0.1 * i + 0.03 * check_random(&seed), -2.0 + 0.1 * j, check_random(&seed));
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const int a = j * (SIDE + 1) + i, b = a + SIDE + 1;
            join(a, a + 1, b + 1), join(b + 1, b, a);
        }
    for (int n = 0; n < 40; ++n) {
        const double x = 3.0 + 4.0 * check_random(&seed), y = -2.0 + 4.0 * check_random(&seed);
        const double wide = 2.0 * check_random(&seed), high = 2.0 * check_random(&seed);
        put(x, y, 0.0), put(x + wide, y + (n % 4 ? 0.3 * high : 0.0), 0.0);
        put(x + 0.5 * wide, y + (n % 4 ? high : 0.0), n % 4 ? 0.0 : 1.0);
        join(points - 3, points - 2, points - 1);
    }
    return ground_mesh(points, vertex, faces, triangle);
}

static double side_of(int t, int axis, bool highest)
{
    double found = highest ? -INFINITY : INFINITY;
    for (int k = 0; k < 3; ++k) {
        const double at = vertex[3 * triangle[3 * t + k] + axis];
        found = highest ? fmax(found, at) : fmin(found, at);
    }
    return found;
}

// the bin of a triangle, and the grid it is of
static void check_bin(const MeshGround* mesh, int t, int l, int bin)
{
    const BinGrid* grid = &mesh->grid[l];
    const double   wide = (double)(1 << l) / mesh->per_bin, spare = 1e-6;
    const int      place[2] = {(bin - grid->first) % grid->nx, (bin - grid->first) / grid->nx};
    const double   from[2] = {mesh->x0, mesh->y0};
    bool           finer = l > 0;
    for (int axis = 0; axis < 2; ++axis) {
        const double low = side_of(t, axis, false), high = side_of(t, axis, true);
        CHECK(low > from[axis] + place[axis] * wide - spare);
        CHECK(low < from[axis] + (place[axis] + 1) * wide + spare);
        CHECK(high < from[axis] + (place[axis] + 2) * wide + spare);
        const double half = 0.5 * wide;  // would it fit two bins of the next finer grid?
        finer = finer && floor((high - from[axis]) / half) - floor((low - from[axis]) / half) < 2;
    }
    CHECK(!finer);
    CHECK(grid->used);
}

TEST(each_triangle_that_is_ground_stands_once)
{
    const DpGround ground = many();
    for (int workers = 1; workers <= 3; workers += 2) {
        MeshGround mesh = {0};
        double     bounds[4];
        int        times[FACES] = {0}, coarse = 0;
        CHECK(dp_mesh_create(&mesh, &ground, workers, bounds) == DP_OK);
        for (int l = 0; l < mesh.grids; ++l) {
            const BinGrid* grid = &mesh.grid[l];
            CHECK(grid->nx == ((mesh.nx - 1) >> l) + 1 && grid->ny == ((mesh.ny - 1) >> l) + 1);
            int here = 0;
            for (int b = grid->first; b < grid->first + grid->nx * grid->ny; ++b)
                for (int32_t n = mesh.start[b]; n < mesh.start[b + 1]; ++n, ++here) {
                    CHECK(n == mesh.start[b] || mesh.item[n] > mesh.item[n - 1]);
                    ++times[mesh.item[n]];
                    check_bin(&mesh, mesh.item[n], l, b);
                }
            CHECK(grid->used == (here > 0));
            coarse += l > 1 ? here : 0;
        }
        CHECK(mesh.start[mesh.bins] == faces - 10 && coarse > 5);
        for (int t = 0; t < faces; ++t)
            CHECK(times[t] == (t < 2 * SIDE * SIDE || (t - 2 * SIDE * SIDE) % 4 ? 1 : 0));
        double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
        for (int t = 0; t < faces; ++t)
            for (int axis = 0; times[t] && axis < 2; ++axis) {
                box[axis] = fmin(box[axis], side_of(t, axis, false));
                box[axis + 2] = fmax(box[axis + 2], side_of(t, axis, true));
            }
        for (int k = 0; k < 4; ++k) CHECK(bounds[k] == box[k]);
        CHECK(mesh.somewhere == vertex[3 * triangle[0] + 2]);
        dp_mesh_destroy(&mesh);
    }
}

TEST(what_is_no_mesh_is_refused)
{
    DpGround       ground = many();
    const DpGround good = ground;
    double         bounds[4];
    for (int n = 0; n < 7; ++n) {
        MeshGround mesh = {0};
        ground = good;
        const double  was = vertex[40];
        const int32_t corner = triangle[100];
        if (n == 0) ground.vertex_count = 2;
        if (n == 1) ground.triangle_count = 0;
        if (n == 2) ground.vertex = NULL;
        if (n == 3) ground.triangle = NULL;
        if (n == 4) vertex[40] = (double)NAN;
        if (n == 5) triangle[100] = points;
        if (n == 6) triangle[100] = -1;
        CHECK(dp_mesh_create(&mesh, &ground, 2, bounds) == DP_BAD_ARGUMENT);
        dp_mesh_destroy(&mesh);
        vertex[40] = was, triangle[100] = corner;
    }
    points = faces = 0;  // a wall is no ground
    put(0, 0, 0), put(1, 0, 0), put(1, 0, 1), join(0, 1, 2);
    MeshGround mesh = {0};
    ground = ground_mesh(points, vertex, faces, triangle);
    CHECK(dp_mesh_create(&mesh, &ground, 1, bounds) == DP_NO_GROUND);
    dp_mesh_destroy(&mesh);
}

int main(void)
{
    RUN(each_triangle_that_is_ground_stands_once);
    RUN(what_is_no_mesh_is_refused);
    return check_done();
}
