// tests of soil_stabilize.c, and of the three steps together: TRAIL (14)-(16), MODEL 11.3-11.7, 11.11
#include "check.h"
#include "ground.h"

#define DEGREE (DP_PI / 180.0)
#define TENTH (0.1 * DEGREE)

static DpSoil sand(double degrees)
{
    DpSoil soil = dp_soil_default();
    soil.rest_angle = (float)(degrees * DEGREE);
    soil.young_modulus = 0.35e6f;
    soil.settle_time = 0.05f;
    return soil;
}

static DpSettled settle(Ground* ground, const DpImprint* imprint, const DpCellRect* within,
                        int most)
{
    DpSoilScratch* scratch = dp_soil_scratch_create();
    DpSettled      settled;
    CHECK(dp_soil_stabilize(&ground->patch, imprint, within, TENTH, most, scratch, &settled) ==
          DP_OK);
    dp_soil_scratch_destroy(scratch);
    return settled;
}

// the steepest loose slope over its own rest angle [rad]; films of 2 micrometres do not count
static double steepest(const Ground* ground)
{
    const DpSoilPatch* patch = &ground->patch;
    double             most = -9.0;
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const int p = j * patch->row + i;
            if (patch->heap[p] <= 2e-4f * (float)patch->cell) continue;
            for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a) {
                    if (i + a < 0 || i + a >= patch->nx || j + b < 0 || j + b >= patch->ny)
                        continue;
                    const int q = p + b * patch->row + a;
                    if (q == p || isnan(patch->base_height[q])) continue;
                    const double from = (double)patch->base_height[p] -
                                        (double)patch->compression[p] + (double)patch->heap[p];
                    const double to = (double)patch->base_height[q] -
                                      (double)patch->compression[q] + (double)patch->heap[q];
                    const double far = patch->cell * (a && b ? sqrt(2.0) : 1.0);
                    most = fmax(most, atan((from - to) / far) - atan((double)patch->rest_slope[p]));
                }
        }
    return most;
}

// One footfall: a load that rises and falls, a sole that rolls from heel to toe by `pitch`, heaps
// laid and kept at rest in every frame; lift-off. Adds to `ledger` what sum heap cell^2 must grow
// by.
static double footfall(Ground* ground, BoxSole sole, double newton, DpHeapLaw law, double* ledger)
{
    DpSoilScratch*      scratch = dp_soil_scratch_create();
    const DpHeapOptions options = {law, 0.04, 0.5 * newton, {0.0, 0.0, 0.0}};
    double              height = 0.0, top = 0.0;
    const int           frames = 36;
    for (int f = 0; f < frames; ++f) {
        const double u = (f + 0.5) / frames;
        BoxSole      now = sole;
        now.pitch = sole.pitch * (0.5 - u) * (u < 0.3 || u > 0.7);
        ground_sole(ground, now);
        DpFootForce foot = ground_load(newton * fmin(1.0, 4.0 * fmin(u, 1.0 - u)));
        foot.force.x = 60.0 * (u - 0.5) * cos(sole.heading);
        foot.force.y = 60.0 * (u - 0.5) * sin(sole.heading);
        foot.point = dp_vec3(sole.x, sole.y, 0.0);
        DpPressed p;
        CHECK(dp_soil_compress(&ground->patch, &ground->imprint, &foot, DP_CONTACT_SOLE, 1.0 / 60,
                               &p) == DP_OK);
        *ledger += p.displaced - p.loose;
        if (p.area <= 0.0) continue;
        ground_rings(ground, 6);
        CHECK(dp_soil_accumulate(&ground->patch, &ground->imprint, &foot, p.displaced, &options,
                                 &height, scratch) == DP_OK);
        top = fmax(top, ground_max(ground, ground->heap));
        DpSettled settled;
        dp_soil_stabilize(&ground->patch, &ground->imprint, NULL, TENTH, 20, scratch, &settled);
    }
    dp_soil_scratch_destroy(scratch);
    return top;
}

// a pillar of loose soil becomes a cone at gamma_r + 0.1 degrees, and no grain is lost
TEST(comes_to_rest)
{
    const double degrees[3] = {8.0, 15.0, 32.0};
    for (int d = 0; d < 3; ++d) {
        Ground ground = ground_make(120, 120, 0.01, sand(degrees[d]));
        ground.patch.soils = ground.soil;
        for (int j = 57; j < 63; ++j)
            for (int i = 57; i < 63; ++i) ground.heap[j * 120 + i] = 0.15f;
        const double     before = ground_sum(&ground, ground.heap);
        const DpCellRect within = {57, 63, 57, 63};
        const DpSettled  settled = settle(&ground, NULL, &within, 100000);
        CHECK(settled.at_rest && !settled.at_edge && settled.sweeps > 3);
        CHECK(steepest(&ground) < TENTH);
        CHECK(steepest(&ground) > -0.5 * DEGREE);  // and it did not flow further than it had to
        CHECK_CLOSE(ground_sum(&ground, ground.heap), before, 1e-6);
        CHECK(settled.changed.i0 < 57 && settled.changed.i1 > 63 && settled.changed.i0 > 0);
        for (int k = 0; k < 120 * 120; ++k) {
            const int  i = k % 120, j = k / 120;
            const bool inside = i >= settled.changed.i0 && i < settled.changed.i1 &&
                                j >= settled.changed.j0 && j < settled.changed.j1;
            CHECK(ground.heap[k] >= 0.0f && (inside || ground.heap[k] == 0.0f));
        }
        CHECK(settle(&ground, NULL, NULL, 100).sweeps == 0);
        ground_free(&ground);
    }
}

TEST(keeps_volume)
{
    Ground   ground = ground_make(70, 50, 0.01, sand(20.0));
    unsigned seed = 5;
    ground.patch.soils = ground.soil;
    for (int k = 0; k < 70 * 50; ++k) {
        ground.base_height[k] = (float)(0.1 * check_random(&seed)) + 812.0f;
        ground.compression[k] = (float)(0.05 * check_random(&seed));
        ground.heap[k] = (float)fmax(0.06 * check_random(&seed) - 0.03, 0.0);
    }
    const double before = ground_sum(&ground, ground.heap);
    for (int k = 0; k < 30; ++k) {
        (void)settle(&ground, NULL, NULL, 10);
        CHECK_CLOSE(ground_sum(&ground, ground.heap), before, 1e-6);
    }
    ground_free(&ground);
}

// firm hills steeper than gamma_r stay; soil does not go where there is no ground or a sole
TEST(only_loose_soil_moves)
{
    Ground ground = ground_make(40, 40, 0.01, sand(10.0));
    ground.patch.soils = ground.soil;
    for (int k = 0; k < 1600; ++k) ground.base_height[k] = 0.02f * (float)(k % 40);
    CHECK(settle(&ground, NULL, NULL, 1000).sweeps == 0);
    for (int k = 0; k < 1600; ++k) ground.base_height[k] = 0.0f;
    ground_sole(&ground, (BoxSole){.x = 0.105, .length = 0.10, .width = 0.2});
    for (int k = 0; k < 1600; ++k) {
        ground.imprint.ring[k] = ground.imprint.cover[k] > 0.0f ? 0 : DP_RING_FAR;
        if (k % 40 < 15) ground.base_height[k] = NAN;
    }
    for (int j = 10; j < 30; ++j)
        ground.heap[j * 40 + 20] = 0.05f, ground.heap[j * 40 + 30] = 0.01f;
    const double before = ground_sum(&ground, ground.heap);
    CHECK(settle(&ground, &ground.imprint, NULL, 100000).at_rest);
    CHECK_CLOSE(ground_sum(&ground, ground.heap), before, 1e-6);
    for (int k = 0; k < 1600; ++k) {
        if (k % 40 < 15) CHECK(ground.heap[k] == 0.0f);
        const bool stood = k % 40 == 30 && k / 40 >= 10 && k / 40 < 30;
        if (ground.imprint.ring[k] == 0) CHECK(ground.heap[k] == (stood ? 0.01f : 0.0f));
    }
    ground_free(&ground);
}

// a slide that reaches the side of the patch says so
TEST(tells_of_the_edge)
{
    Ground ground = ground_make(40, 40, 0.01, sand(10.0));
    ground.patch.soils = ground.soil;
    ground.heap[20 * 40 + 5] = 0.3f;
    const DpSettled settled = settle(&ground, NULL, NULL, 100000);
    CHECK(settled.at_rest && settled.at_edge && settled.changed.i0 == 0);
    ground_free(&ground);
}

// what is looked at first, and how much memory there is at first, change nothing
TEST(windows_do_not_matter)
{
    Ground g[2];
    for (int m = 0; m < 2; ++m) {
        g[m] = ground_make(150, 90, 0.01, sand(9.0));
        g[m].patch.soils = g[m].soil;
        for (int j = 40; j < 44; ++j)
            for (int i = 70; i < 75; ++i) g[m].heap[j * 150 + i] = 0.2f;
        const DpCellRect within = {70, 75, 40, 44};
        (void)settle(&g[m], NULL, m ? &within : NULL, 100000);
    }
    CHECK(memcmp(g[0].heap, g[1].heap, 150 * 90 * sizeof(float)) == 0);
    for (int m = 0; m < 2; ++m) ground_free(&g[m]);
}

// heaps laid at rest stand at gamma_r to the last bit: a nanometre of rounding must not change who
// slides where (a hard count of lower neighbours made 1.3 mm of it). Not of a sole that lies along the
// grid: its straight rim begins to slide as a whole, a frame earlier or later, and as much comes of it.
TEST(rounding_does_not_matter)
{
    for (int turn = 1; turn < 9; ++turn) {
        Ground   g[2];
        unsigned seed = 17;
        for (int m = 0; m < 2; ++m) {
            g[m] = ground_make(110, 80, 0.01, sand(turn % 2 ? 15.0 : 30.0));
            for (int k = 0; k < 110 * 80 && m == 1; ++k)
                g[m].base_height[k] = (float)(2e-9 * check_random(&seed));
            double        ledger = 0.0;
            const BoxSole sole = {
                .length = 0.28, .width = 0.10, .heading = 0.1 * turn, .pitch = 0.3};
            footfall(&g[m], sole, 750.0, DP_HEAP_REST, &ledger);
            (void)settle(&g[m], NULL, NULL, 100000);
        }
        double most = 0.0;
        for (int k = 0; k < 110 * 80; ++k)
            most = fmax(most, fabs((double)g[0].heap[k] - (double)g[1].heap[k]));
        CHECK(most < 4e-4);
        CHECK(ground_max(&g[0], g[0].heap) > 0.01);
        for (int m = 0; m < 2; ++m) ground_free(&g[m]);
    }
}

TEST(mirrored_to_the_bit)
{
    enum
    {
        SIDE = 60
    };
    Ground g[3];
    for (int m = 0; m < 3; ++m) g[m] = ground_make(SIDE, SIDE, 0.01, sand(15.0));
    unsigned seed = 11;
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const int   at[3] = {j * SIDE + i, j * SIDE + SIDE - 1 - i, i * SIDE + SIDE - 1 - j};
            const float high = (float)(0.02 * check_random(&seed)),
                        heap = (float)(0.03 * check_random(&seed));
            for (int m = 0; m < 3; ++m) {
                g[m].base_height[at[m]] = high, g[m].heap[at[m]] = heap;
                g[m].patch.soils = g[m].soil;
            }
        }
    int sweeps[3];
    for (int m = 0; m < 3; ++m) sweeps[m] = settle(&g[m], NULL, NULL, 200).sweeps;
    for (int m = 1; m < 3; ++m) {
        int unlike = 0;
        for (int j = 0; j < SIDE; ++j)
            for (int i = 0; i < SIDE; ++i) {
                const int at[3] = {j * SIDE + i, j * SIDE + SIDE - 1 - i, i * SIDE + SIDE - 1 - j};
                unlike += g[m].heap[at[m]] != g[0].heap[at[0]];
            }
        CHECK(unlike == 0 && sweeps[m] == sweeps[0] && sweeps[0] > 10);
    }
    for (int m = 0; m < 3; ++m) ground_free(&g[m]);
}

// MODEL 11.3 over overlapping prints, MODEL 11.5 at the end
TEST(ledger_of_many_prints)
{
    for (int law = 0; law < 2; ++law) {
        Ground ground = ground_make(150, 110, 0.01, sand(15.0));
        double ledger = 0.0;
        for (int n = 0; n < 4; ++n) {
            const BoxSole sole = {.x = -0.1 + 0.07 * n,
                                  .y = 0.05 * (n % 2),
                                  .length = 0.28,
                                  .width = 0.10,
                                  .heading = 0.3 * n,
                                  .pitch = 0.15};
            footfall(&ground, sole, 750.0, law ? DP_HEAP_PAPER : DP_HEAP_REST, &ledger);
            CHECK_CLOSE(ground_sum(&ground, ground.heap), ledger, 1e-6);
            const DpSettled settled = settle(&ground, NULL, NULL, 100000);
            CHECK(settled.at_rest && !settled.at_edge);
            CHECK_CLOSE(ground_sum(&ground, ground.heap), ledger, 1e-6);
            CHECK(steepest(&ground) < TENTH);
        }
        CHECK(ledger > 1e-4);
        ground_free(&ground);
    }
}

// MODEL 11.6: cells of 4, 2, 1 cm
TEST(cells_do_not_matter)
{
    double volume[3], rim[3];
    for (int k = 0; k < 3; ++k) {
        Ground ground = ground_make(40 << k, 30 << k, 0.04 / (1 << k), sand(12.0));
        double ledger = 0.0;
        footfall(&ground, (BoxSole){.length = 0.32, .width = 0.16}, 3000.0, DP_HEAP_REST, &ledger);
        volume[k] = ground_sum(&ground, ground.compression);
        (void)settle(&ground, NULL, NULL, 100000);
        rim[k] = ground_max(&ground, ground.heap);
        ground_free(&ground);
    }
    for (int k = 0; k < 2; ++k) {
        CHECK_CLOSE(volume[k], volume[2], 0.03);
        CHECK_CLOSE(rim[k], rim[2], 0.10);
    }
}

// MODEL 11.11, SOFT22 Fig. 7: depth up with load, down with E, unchanged by nu; rim up with nu
TEST(trends_of_soft22)
{
    double depth[4], rim[4];
    for (int k = 0; k < 4; ++k) {
        DpSoil soil = sand(30.0);
        soil.young_modulus = k == 2 ? 2e6f : 1e6f;
        soil.poisson_ratio = k == 3 ? 0.45f : 0.3f;
        Ground ground = ground_make(60, 60, 0.01, soil);
        double ledger = 0.0;
        rim[k] = footfall(&ground, (BoxSole){.length = 0.2, .width = 0.2}, k == 1 ? 4482.0 : 2241.0,
                          DP_HEAP_REST, &ledger);
        depth[k] = ground_max(&ground, ground.compression);
        ground_free(&ground);
    }
    CHECK(depth[1] > 1.8 * depth[0] && depth[2] < 0.6 * depth[0]);
    CHECK_CLOSE(depth[3], depth[0], 1e-5);
    CHECK(rim[1] > rim[0] && rim[3] > 1.1 * rim[0] && rim[2] < rim[0]);
}

TEST(bad_arguments)
{
    Ground         ground = ground_make(8, 8, 0.01, sand(10.0));
    DpSoilScratch* scratch = dp_soil_scratch_create();
    DpSettled      settled;
    ground.patch.soils = ground.soil;
    CHECK(dp_soil_stabilize(&ground.patch, NULL, NULL, 0.0, 9, scratch, &settled) ==
          DP_BAD_ARGUMENT);
    CHECK(dp_soil_stabilize(&ground.patch, NULL, NULL, TENTH, -1, scratch, &settled) ==
          DP_BAD_ARGUMENT);
    CHECK(dp_soil_stabilize(NULL, NULL, NULL, TENTH, 9, scratch, &settled) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_stabilize(&ground.patch, NULL, NULL, TENTH, 9, scratch, &settled) == DP_OK &&
          settled.at_rest && settled.sweeps == 0);  // nothing lies loose
    ground.heap[ground.patch.row + 1] = 0.1f;
    dp_alloc_fail_after(0);
    CHECK(dp_soil_stabilize(&ground.patch, NULL, NULL, TENTH, 9, scratch, &settled) ==
          DP_NO_MEMORY);
    dp_alloc_fail_after(-1);
    const DpCellRect none = {5, 5, 0, 8};
    CHECK(dp_soil_stabilize(&ground.patch, NULL, &none, TENTH, 9, scratch, &settled) == DP_OK &&
          settled.at_rest);
    dp_soil_scratch_destroy(scratch);
    dp_soil_scratch_destroy(NULL);
    ground_free(&ground);
}

TEST(soil_ranges)
{
    DpReason reason;
    DpSoil   soil = dp_soil_default();
    CHECK(dp_soil_check(&soil, NULL) == DP_OK && dp_soil_check(NULL, NULL) == DP_BAD_ARGUMENT);
    soil.poisson_ratio = 0.51f;
    CHECK(dp_soil_check(&soil, &reason) == DP_BAD_ARGUMENT);
    CHECK(strcmp(reason.text, "poisson_ratio of 0.51 - is out of its range, 0 to 0.5") == 0);
    soil = dp_soil_default(), soil.rest_angle = NAN;
    CHECK(dp_soil_check(&soil, NULL) == DP_BAD_ARGUMENT);
    int count;
    for (const DpNumber* n = dp_soil_numbers(&count); count-- > 0; ++n) {  // each has its ends
        soil = dp_soil_default();
        CHECK(dp_number_holds(n, dp_number_get(&soil, n)));
        for (int end = 0; end < 2; ++end) {
            const float at = (float)(end ? n->high : n->low);
            dp_number_set(&soil, n, (double)at);
            CHECK(dp_soil_check(&soil, NULL) == DP_OK);
            dp_number_set(&soil, n, (double)nextafterf(at, end ? INFINITY : -INFINITY));
            CHECK(dp_soil_check(&soil, NULL) == DP_BAD_ARGUMENT);
        }
    }
}

int main(void)
{
    RUN(comes_to_rest);
    RUN(keeps_volume);
    RUN(only_loose_soil_moves);
    RUN(tells_of_the_edge);
    RUN(windows_do_not_matter);
    RUN(rounding_does_not_matter);
    RUN(mirrored_to_the_bit);
    RUN(ledger_of_many_prints);
    RUN(cells_do_not_matter);
    RUN(trends_of_soft22);
    RUN(bad_arguments);
    RUN(soil_ranges);
    return check_done();
}
