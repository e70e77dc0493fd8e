// tests of soil_accumulate.c, soil_heap_rest.c, soil_heap_paper.c: TRAIL (11)-(13), SOFT22
// (12)-(14)
#include "check.h"
#include "ground.h"

static const DpHeapOptions rest = {DP_HEAP_REST, 0.04, 367.0, {0.0, 0.0, 0.0}};
static const DpHeapOptions paper = {DP_HEAP_PAPER, 0.04, 367.0, {0.0, 0.0, 0.0}};

static DpSoil sand(double degrees)
{
    DpSoil soil = dp_soil_default();
    soil.rest_angle = (float)(degrees * DP_PI / 180.0);
    return soil;
}

// touch what the sole covers, without pressing
static void touch(Ground* ground, BoxSole sole, int rings)
{
    ground_sole(ground, sole);
    for (int k = 0; k < ground->patch.nx * ground->patch.ny; ++k)
        ground->imprint.ring[k] = ground->imprint.cover[k] > 0.0f ? 0 : DP_RING_FAR;
    ground_rings(ground, rings);
}

static DpStatus lay(Ground* ground, DpFootForce foot, double volume, const DpHeapOptions* options,
                    double* height)
{
    DpSoilScratch* scratch = dp_soil_scratch_create();
    const DpStatus status = dp_soil_accumulate(&ground->patch, &ground->imprint, &foot, volume,
                                               options, height, scratch);
    dp_soil_scratch_destroy(scratch);
    return status;
}

// steepest slope of soil over what is loose, against its rest slope; 8 neighbours, not under the
// sole
static double steepest(const Ground* ground)
{
    const DpSoilPatch* patch = &ground->patch;
    double             most = -1.0;
    for (int j = 1; j < patch->ny - 1; ++j)
        for (int i = 1; i < patch->nx - 1; ++i) {
            const int p = j * patch->row + i;
            if (patch->heap[p] <= 1e-6f || ground->imprint.ring[p] == 0) continue;
            for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a) {
                    const int q = p + b * patch->row + a;
                    if (q == p || ground->imprint.ring[q] == 0) continue;
                    const double from = (double)(patch->base_height[p] - patch->compression[p]) +
                                        (double)patch->heap[p];
                    const double to = (double)(patch->base_height[q] - patch->compression[q]) +
                                      (double)patch->heap[q];
                    const double far = patch->cell * (a && b ? sqrt(2.0) : 1.0);
                    most = fmax(most, atan((from - to) / far) - atan((double)patch->rest_slope[p]));
                }
        }
    return most;
}

static const BoxSole shoe = {.length = 0.28, .width = 0.10};

TEST(keeps_volume)
{
    const DpHeapOptions* laws[2] = {&rest, &paper};
    for (int law = 0; law < 2; ++law)
        for (int push = 0; push < 3; ++push) {
            Ground ground = ground_make(80, 60, 0.01, sand(20.0));
            touch(&ground, shoe, 6);
            DpFootForce foot = ground_load(700.0);
            foot.force.x = 150.0 * push;
            double height = 0.0, volume = 0.0;
            for (int step = 1; step <= 20; ++step) {
                const double more = 1e-6 * step * step * 0.3;
                CHECK(lay(&ground, foot, more, laws[law], &height) == DP_OK);
                volume += more;
                CHECK_CLOSE(ground_sum(&ground, ground.heap), volume, 1e-6);
            }
            for (int k = 0; k < 80 * 60; ++k)
                CHECK(ground.heap[k] >= 0.0f && (ground.imprint.ring[k] || ground.heap[k] == 0.0f));
            ground_free(&ground);
        }
}

// a straight heap against a wall: height sqrt(2 A tan gamma_r), falling at gamma_r, already at rest
TEST(rest_is_a_triangle)
{
    for (int d = 0; d < 3; ++d) {
        const double  degrees[3] = {8.0, 15.0, 32.0};
        Ground        ground = ground_make(160, 120, 0.005, sand(degrees[d]));
        const BoxSole wall = {.length = 2.0, .width = 0.02};
        touch(&ground, wall, 1);
        const double area = 4e-4, slope = tan(degrees[d] * DP_PI / 180.0);
        double       height = 0.0;
        CHECK(lay(&ground, ground_load(1.0), 2.0 * area * 160 * 0.005, &rest, &height) == DP_OK);
        const double top = sqrt(2.0 * area * slope);
        CHECK_NEAR(ground_max(&ground, ground.heap), top, 0.6 * slope * 0.005 + 0.002 * top);
        CHECK_CLOSE(height, ground_max(&ground, ground.heap), 0.01);
        CHECK(steepest(&ground) < 0.1 * DP_PI / 180.0);
        ground_free(&ground);
    }
}

// laid in many steps, with a sole that tilts and a push that turns, it still is at rest
TEST(rest_stays_at_rest)
{
    Ground   ground = ground_make(100, 80, 0.01, sand(15.0));
    unsigned seed = 3;
    for (int k = 0; k < 100 * 80; ++k)
        ground.base_height[k] =
            0.02f * sinf(0.09f * (float)(k % 100)) + (float)(0.0005 * check_random(&seed));
    touch(&ground, shoe, 1);
    double      height = 0.0;
    DpFootForce foot = ground_load(700.0);
    for (int step = 0; step < 24; ++step) {
        foot.force.x = 10.0 * step, foot.force.y = 200.0 - 10.0 * step;
        CHECK(lay(&ground, foot, 4e-5, &rest, &height) == DP_OK);
    }
    CHECK_CLOSE(ground_sum(&ground, ground.heap), 24 * 4e-5, 1e-6);
    CHECK(steepest(&ground) < 0.3 * DP_PI / 180.0);
    ground_free(&ground);
}

// the heap is the same whether it comes at once or in small steps
TEST(steps_do_not_matter)
{
    double top[2];
    for (int m = 0; m < 2; ++m) {
        Ground ground = ground_make(100, 80, 0.01, sand(25.0));
        touch(&ground, shoe, 1);
        double height = 0.0;
        for (int k = 0; k < (m ? 50 : 1); ++k)
            CHECK(lay(&ground, ground_load(700.0), m ? 1e-5 : 5e-4, &rest, &height) == DP_OK);
        top[m] = ground_max(&ground, ground.heap);
        ground_free(&ground);
    }
    CHECK_CLOSE(top[0], top[1], 0.01);
}

// TRAIL (13)
TEST(anisotropy)
{
    CHECK_CLOSE(dp_soil_anisotropy(dp_vec3(30.0, 40.0, 0.0), 100.0), 0.5, 1e-12);
    CHECK(dp_soil_anisotropy(dp_vec3(300.0, 0.0, 0.0), 100.0) == 1.0);
    CHECK(dp_soil_anisotropy(dp_vec3(0.0, 0.0, 0.0), 100.0) == 0.0);
}

// a push above the threshold lays all soil ahead, none behind, and the heap does not run under the
// sole
TEST(push_lays_ahead)
{
    const DpHeapOptions* laws[2] = {&rest, &paper};
    for (int law = 0; law < 2; ++law) {
        Ground ground = ground_make(120, 80, 0.01, sand(12.0));
        touch(&ground, shoe, 6);
        DpFootForce foot = ground_load(700.0);
        foot.force.x = 400.0;
        double height = 0.0;
        CHECK(lay(&ground, foot, 6e-4, laws[law], &height) == DP_OK);
        double ahead = 0.0, behind = 0.0;
        for (int k = 0; k < 120 * 80; ++k) {
            const double x = ground.patch.x0 + (k % 120) * 0.01;
            if (x > 0.0) ahead += (double)ground.heap[k];
            if (x < -0.145) behind += (double)ground.heap[k];
        }
        CHECK_CLOSE(ahead * 1e-4, 6e-4, law ? 1e-6 : 0.2);
        CHECK(behind == 0.0);
        ground_free(&ground);
    }
}

// a sole at the edge of the ground, pushing outward: nobody is ahead, all share
TEST(nobody_ahead)
{
    Ground ground = ground_make(60, 60, 0.01, sand(20.0));
    for (int j = 0; j < 60; ++j)
        for (int i = 30; i < 60; ++i) ground.base_height[j * 60 + i] = NAN;
    touch(&ground, (BoxSole){.x = -0.05, .length = 0.10, .width = 2.0}, 1);
    DpFootForce foot = ground_load(700.0);
    foot.force.x = 400.0;
    double height = 0.0;
    CHECK(lay(&ground, foot, 1e-4, &rest, &height) == DP_OK);
    CHECK_CLOSE(ground_sum(&ground, ground.heap), 1e-4, 1e-6);
    ground_free(&ground);
}

// MODEL 6.7: what is pushed ahead by a face flows off at its sides, so that its heap is highest in the middle; one that
// is pressed aside under a load is as high as it says all along
TEST(what_a_face_pushes_is_highest_in_the_middle)
{
    double mid[2], side[2];
    for (int face = 0; face < 2; ++face) {
        const DpHeapOptions ahead = {DP_HEAP_REST, 0.04, 367.0, {face, 0.0, 0.0}};
        Ground              ground = ground_make(120, 80, 0.01, sand(30.0));
        touch(&ground, (BoxSole){.length = 0.20, .width = 0.20}, 6);
        DpFootForce foot = ground_load(700.0);
        foot.force.x = 400.0;
        double height = 0.0;
        CHECK(lay(&ground, foot, 6e-4, &ahead, &height) == DP_OK);
        CHECK_CLOSE(ground_sum(&ground, ground.heap), 6e-4, 1e-6);
        mid[face] = (double)ground.heap[39 * 120 + 70];
        side[face] = (double)ground.heap[31 * 120 + 70];
        if (!face) CHECK_CLOSE(height, ground_max(&ground, ground.heap), 0.02);
        ground_free(&ground);
    }
    CHECK(mid[0] < 1.5 * side[0]);
    CHECK(mid[1] > 1.5 * side[1] && mid[1] > mid[0]);
}

// a face at the edge of the ground that pushes over it: its soil lies around it as if it pushed nowhere
TEST(a_face_with_nobody_ahead_lays_evenly)
{
    float* laid[2];
    for (int push = 0; push < 2; ++push) {
        const DpHeapOptions ahead = {DP_HEAP_REST, 0.04, 367.0, {0.0, 0.0, 0.0}};
        Ground              ground = ground_make(60, 60, 0.01, sand(20.0));
        for (int j = 0; j < 60; ++j)
            for (int i = 30; i < 60; ++i) ground.base_height[j * 60 + i] = NAN;
        touch(&ground, (BoxSole){.x = -0.05, .length = 0.10, .width = 2.0}, 1);
        DpFootForce foot = ground_load(700.0);
        foot.force.x = 400.0 * push;
        double height = 0.0;
        CHECK(lay(&ground, foot, 1e-4, &ahead, &height) == DP_OK);
        laid[push] = ground.heap;
        ground.heap = NULL;
        ground_free(&ground);
    }
    CHECK(memcmp(laid[0], laid[1], 60 * 60 * sizeof(float)) == 0);
    dp_free(laid[0]), dp_free(laid[1]);
}

// TRAIL (12): shares on the rim
TEST(paper_falls_off)
{
    Ground ground = ground_make(60, 60, 0.01, sand(20.0));
    touch(&ground, (BoxSole){.length = 0.10, .width = 0.10}, 8);
    double height = 0.0;
    CHECK(lay(&ground, ground_load(700.0), 1e-4, &paper, &height) == DP_OK);
    const float* row = ground.heap + 30 * 60;
    CHECK(row[35] > 0.0f);
    CHECK_CLOSE(row[36], row[35], 1e-5);
    CHECK_CLOSE(row[37], row[35], 1e-5);
    CHECK_CLOSE(row[38], 0.6 * (double)row[35],
                1e-5);  // of its centimetre 2 mm are full, 8 mm fall to 0
    CHECK(row[39] == 0.0f);
    for (int n = 1; n < 5; ++n) {  // the width is what is said, in metres
        memset(ground.heap, 0, 3600 * sizeof(float));
        const DpHeapOptions wide = {DP_HEAP_PAPER, 0.01 * n, 367.0, {0.0, 0.0, 0.0}};
        CHECK(lay(&ground, ground_load(700.0), 1e-4, &wide, &height) == DP_OK);
        CHECK(row[34 + n] > 0.0f && row[35 + n] == 0.0f);
        CHECK_CLOSE(ground_sum(&ground, ground.heap), 1e-4, 1e-6);
    }
    DpFootForce foot = ground_load(700.0);
    foot.force.x = 183.5;  // beta 0.5: behind half of it, ahead 0.5 cos + 0.5
    memset(ground.heap, 0, 3600 * sizeof(float));
    CHECK(lay(&ground, foot, 1e-4, &paper, &height) == DP_OK);
    const double x = 0.055, y = 0.005;
    CHECK_CLOSE(row[35] / row[24], (0.5 * x / sqrt(x * x + y * y) + 0.5) / 0.5, 1e-5);
    ground_free(&ground);
}

// more soil than the patch has room for at rest: volume is kept all the same
TEST(full_patch)
{
    Ground ground = ground_make(20, 16, 0.01, sand(5.0));
    touch(&ground, (BoxSole){.length = 0.10, .width = 0.10}, 1);
    double height = 0.0;
    CHECK(lay(&ground, ground_load(700.0), 1e-3, &rest, &height) == DP_OK);
    CHECK_CLOSE(ground_sum(&ground, ground.heap), 1e-3, 1e-6);
    CHECK(lay(&ground, ground_load(700.0), 2.0, &rest, &height) == DP_OK);
    CHECK_CLOSE(ground_sum(&ground, ground.heap), 2.001, 1e-5);
    ground_free(&ground);
}

// beside an old print the flat cone alone would fill more than there is: it is laid thinner
TEST(beside_a_pit)
{
    Ground ground = ground_make(80, 60, 0.01, sand(20.0));
    for (int j = 0; j < 60; ++j)
        for (int i = 55; i < 80; ++i) ground.compression[j * 80 + i] = 0.08f;
    touch(&ground, shoe, 1);
    double height = 0.03;
    CHECK(lay(&ground, ground_load(700.0), 1e-6, &rest, &height) == DP_OK);
    CHECK_CLOSE(ground_sum(&ground, ground.heap), 1e-6, 1e-5);
    CHECK(height == 0.0);
    ground_free(&ground);
}

TEST(no_border)
{
    Ground ground = ground_make(20, 16, 0.01, sand(5.0));
    touch(&ground, (BoxSole){.length = 1.0, .width = 1.0}, 1);
    double height = 0.0;
    CHECK(lay(&ground, ground_load(700.0), 1e-3, &rest, &height) == DP_NO_GROUND);
    CHECK(lay(&ground, ground_load(700.0), 1e-3, &paper, &height) == DP_NO_GROUND);
    CHECK(ground_sum(&ground, ground.heap) == 0.0);
    CHECK(lay(&ground, ground_load(700.0), -1.0, &rest, &height) == DP_BAD_ARGUMENT);
    CHECK(lay(&ground, ground_load(700.0), NAN, &rest, &height) == DP_BAD_ARGUMENT);
    touch(&ground, (BoxSole){.length = 0.1, .width = 0.1}, 1);
    dp_alloc_fail_after(1);
    CHECK(lay(&ground, ground_load(700.0), 1e-3, &rest, &height) == DP_NO_MEMORY);
    dp_alloc_fail_after(-1);
    CHECK(ground_sum(&ground, ground.heap) == 0.0);
    ground_free(&ground);
}

// MODEL 11.4, to the bit: a print and its mirror, a quarter turn; an even push
TEST(mirrored_to_the_bit)
{
    enum
    {
        SIDE = 64
    };
    for (int law = 0; law < 2; ++law) {
        Ground g[3];
        for (int m = 0; m < 3; ++m) g[m] = ground_make(SIDE, SIDE, 0.01, sand(15.0));
        for (int m = 0; m < 3; ++m) g[m].patch.soils = g[m].soil;
        ground_sole(&g[0], (BoxSole){.x = 0.004, .length = 0.25, .width = 0.09, .heading = 0.5});
        unsigned seed = 11;
        for (int j = 0; j < SIDE; ++j)
            for (int i = 0; i < SIDE; ++i) {
                const int at[3] = {j * SIDE + i, j * SIDE + SIDE - 1 - i, i * SIDE + SIDE - 1 - j};
                const float high = (float)(0.005 * check_random(&seed));
                for (int m = 0; m < 3; ++m) {
                    g[m].base_height[at[m]] = high;
                    g[m].imprint.cover[at[m]] = g[0].imprint.cover[at[0]];
                    g[m].imprint.ring[at[m]] = g[0].imprint.cover[at[0]] > 0.0f ? 0 : DP_RING_FAR;
                    g[m].imprint.i0 = g[m].imprint.j0 = 0;
                    g[m].imprint.i1 = g[m].imprint.j1 = SIDE;
                }
            }
        double height[3] = {0};
        for (int step = 0; step < 8; ++step)
            for (int m = 0; m < 3; ++m) {
                if (step == 0) ground_rings(&g[m], 6);
                DpFootForce  foot = ground_load(700.0);
                const double x = 0.01 + 0.002 * step, y = 0.007;
                foot.point = m == 0   ? dp_vec3(x, y, 0)
                             : m == 1 ? dp_vec3(-x, y, 0)
                                      : dp_vec3(-y, x, 0);
                foot.force.x = m == 0 ? 90.0 : m == 1 ? -90.0 : -40.0;
                foot.force.y = m == 2 ? 90.0 : 40.0;
                CHECK(lay(&g[m], foot, 3e-5, law ? &paper : &rest, &height[m]) == DP_OK);
            }
        for (int m = 1; m < 3; ++m) {
            CHECK(height[m] == height[0]);
            int unlike = 0;
            for (int j = 0; j < SIDE; ++j)
                for (int i = 0; i < SIDE; ++i) {
                    const int at[3] = {j * SIDE + i, j * SIDE + SIDE - 1 - i,
                                       i * SIDE + SIDE - 1 - j};
                    unlike += g[m].heap[at[m]] != g[0].heap[at[0]];
                }
            CHECK(unlike == 0);
        }
        for (int m = 0; m < 3; ++m) ground_free(&g[m]);
    }
}

// a foot whose pressure lies beyond the patch lays soil as steep as the nearest cell of it rests
TEST(beyond_the_patch_the_nearest_cell_tells_the_slope)
{
    double height[3];
    for (int n = 0; n < 3; ++n) {
        Ground      ground = ground_make(80, 60, 0.01, sand(12.0));
        DpFootForce foot = ground_load(700.0);
        touch(&ground, shoe, 1);
        for (int j = 0; j < 60; ++j) {  // steep along one side
            const size_t at = (size_t)(j * 80 + 79);
            ground.rest_slope[at] = (float)tan(30.0 * DP_PI / 180.0);
        }
        foot.point.x = n == 0 ? 0.395 : n == 1 ? 0.42 : 0.0;
        height[n] = 0.0;
        CHECK(lay(&ground, foot, 1e-4, &rest, &height[n]) == DP_OK);
        ground_free(&ground);
    }
    CHECK(height[1] == height[0]);
    CHECK(height[0] > 1.2 * height[2]);  // T goes with the root of the slope: MODEL 6.3
}

int main(void)
{
    RUN(keeps_volume);
    RUN(rest_is_a_triangle);
    RUN(rest_stays_at_rest);
    RUN(steps_do_not_matter);
    RUN(anisotropy);
    RUN(push_lays_ahead);
    RUN(nobody_ahead);
    RUN(what_a_face_pushes_is_highest_in_the_middle);
    RUN(a_face_with_nobody_ahead_lays_evenly);
    RUN(paper_falls_off);
    RUN(full_patch);
    RUN(beside_a_pit);
    RUN(no_border);
    RUN(mirrored_to_the_bit);
    RUN(beyond_the_patch_the_nearest_cell_tells_the_slope);
    return check_done();
}
