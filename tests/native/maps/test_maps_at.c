// What planes of cells say at points: in proportion between centres, nothing outside.
#include "check.h"
#include "maps/maps.h"

#define NX 5
#define NY 4
#define CELL 0.5
#define X0 10.0
#define Y0 -3.0

static float first[NX * NY], second[NX * NY];

static DpPlanes planes(double still)
{
    static const float* both[] = {first, second};
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i) {
            first[j * NX + i] = 1.0f + (float)i + 10.0f * (float)j;
            second[j * NX + i] = -2.0f * first[j * NX + i];
        }
    return (DpPlanes){.nx = NX,
                      .ny = NY,
                      .count = 2,
                      .x0 = X0,
                      .y0 = Y0,
                      .cell = CELL,
                      .still = still,
                      .plane = both};
}

// at u, v cells from the centre of cell (0, 0)
static double at(const DpPlanes* asked, double u, double v)
{
    const double   world[3] = {X0 + (u + 0.5) * CELL, Y0 + (v + 0.5) * CELL, 7.0};
    const DpPoints points = {.count = 1, .world = world};
    float          out[2] = {0.0f, 0.0f};
    dp_planes_at(asked, &points, 1, out);
    CHECK(out[1] == -2.0f * out[0]);
    return (double)out[0];
}

TEST(between_centres_in_proportion)
{
    const DpPlanes asked = planes(0.0);
    for (int j = 0; j < NY; ++j)
        for (int i = 0; i < NX; ++i) CHECK(at(&asked, i, j) == 1.0 + i + 10.0 * j);
    CHECK_NEAR(at(&asked, 1.25, 2.0), 22.25, 1e-5);
    CHECK_NEAR(at(&asked, 1.0, 2.25), 24.5, 1e-5);
    CHECK_NEAR(at(&asked, 3.75, 0.5), 9.75, 1e-5);
}

TEST(nothing_outside)
{
    const DpPlanes asked = planes(0.0);
    CHECK_NEAR(at(&asked, -0.25, 0.0), 0.75, 1e-6);  // half of the share lies outside
    CHECK_NEAR(at(&asked, NX - 0.75, 0.0), 0.75 * NX,
               1e-5);  // and so beyond the last cell of a row
    CHECK_NEAR(at(&asked, 0.0, NY - 0.75), 0.75 * 31.0, 1e-5);
    CHECK_NEAR(at(&asked, -0.75, 0.0), 0.25, 1e-6);  // outside, and still nearer than a cell
    CHECK_NEAR(at(&asked, 0.0, -0.75), 0.25, 1e-6);
    CHECK(at(&asked, -1.0, 0.0) == 0.0);
    CHECK(at(&asked, NX, 1.0) == 0.0);
    CHECK(at(&asked, 1.0, -40.0) == 0.0);
    CHECK(at(&asked, 1e300, 1.0) == 0.0);
    CHECK(at(&asked, (double)NAN, 1.0) == 0.0);
}

TEST(near_a_centre_is_on_it)
{
    const DpPlanes asked = planes(0.01);
    CHECK(at(&asked, 2.009, 0.991) == 13.0);
    CHECK(at(&asked, 1.991, 1.009) == 13.0);
    CHECK_NEAR(at(&asked, 2.011, 1.0), 13.011, 1e-4);
    CHECK_NEAR(at(&asked, 1.989, 1.0), 12.989, 1e-4);
}

// own space is turned by a quarter and moved; every worker gets several chunks
TEST(own_space_and_workers_do_not_matter)
{
    enum
    {
        POINTS = 70000
    };
    const DpPlanes asked = planes(0.0);
    const double   place[12] = {0, -1, 0, X0, 1, 0, 0, Y0, 0, 0, 1, 0};
    double*        world = dp_alloc(POINTS, 3 * sizeof *world);
    float*         local = dp_alloc(POINTS, 3 * sizeof *local);
    float*         out[3];
    unsigned       state = 9;
    for (int n = 0; n < POINTS; ++n) {
        local[3 * n] = (float)(check_random(&state) * NY * CELL);
        local[3 * n + 1] = (float)(-check_random(&state) * NX * CELL);
        world[3 * n] = X0 - (double)local[3 * n + 1], world[3 * n + 1] = Y0 + (double)local[3 * n];
    }
    for (int k = 0; k < 3; ++k) {
        const DpPoints points = {
            .count = POINTS, .world = k == 2 ? NULL : world, .local = local, .place = place};
        out[k] = dp_alloc(2 * POINTS, sizeof **out);
        dp_planes_at(&asked, &points, k == 1 ? 3 : 1, out[k]);
    }
    CHECK(memcmp(out[0], out[1], 2 * POINTS * sizeof **out) == 0);
    CHECK(memcmp(out[0], out[2], 2 * POINTS * sizeof **out) == 0);
    CHECK(out[0][POINTS - 1] > 0.0f);
    for (int k = 0; k < 3; ++k) dp_free(out[k]);
    dp_free(world), dp_free(local);
}

int main(void)
{
    RUN(between_centres_in_proportion);
    RUN(nothing_outside);
    RUN(near_a_centre_is_on_it);
    RUN(own_space_and_workers_do_not_matter);
    return check_done();
}
