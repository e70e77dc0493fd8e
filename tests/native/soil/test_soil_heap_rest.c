// tests of soil_heap_rest.c: all of a volume is laid, at rest, around the sole and not in its hollow. MODEL 6.3
#include "check.h"
#include "ground.h"
#include "soil/soil_heaps.h"

#define N 60
#define CELL 0.01

// level ground with a box sole that touches all over; border cells around it
static Ground stand(double x, double length, double width)
{
    Ground g = ground_make(N, N, CELL, dp_soil_default());
    ground_sole(&g, (BoxSole){.x = x, .length = length, .width = width});
    for (int k = 0; k < N * N; ++k) g.imprint.ring[k] = g.imprint.cover[k] > 0.0f ? 0 : DP_RING_FAR;
    ground_rings(&g, 1);
    return g;
}

static HeapShares evenly(void)
{
    return (HeapShares){.even = true, .from_x = 0.5 * (N - 1), .from_y = 0.5 * (N - 1)};
}

static double slope_of(const Ground* g)
{
    return tan((double)g->soil[0].rest_angle);
}

static double top(const Ground* g, int k)
{
    return (double)g->base_height[k] - (double)g->compression[k] + (double)g->heap[k];
}

// the steepest way down from soil that was laid, to neighbours that could take it
static double steepest(const Ground* g)
{
    double worst = 0.0;
    for (int j = 1; j + 1 < N; ++j)
        for (int i = 1; i + 1 < N; ++i)
            for (int q = 0; q < 9; ++q) {
                const int k = j * N + i, n = (j + q / 3 - 1) * N + i + q % 3 - 1;
                if (q == 4 || !(g->heap[k] > 0.0f) || g->imprint.ring[n] == 0) continue;
                if (!soil_is_ground(g->base_height[n])) continue;
                const double far = q % 2 ? CELL : sqrt(2.0) * CELL;
                worst = fmax(worst, (top(g, k) - top(g, n)) / far);
            }
    return worst;
}

static DpStatus lay(Ground* g, const HeapShares* shares, double volume, double* height)
{
    DpSoilScratch* scratch = dp_soil_scratch_create();
    const DpStatus status =
        dp_soil_heap_rest(&g->patch, &g->imprint, shares, volume, slope_of(g), height, scratch);
    dp_soil_scratch_destroy(scratch);
    return status;
}

TEST(all_of_it_is_laid_at_rest_and_none_under_the_sole)
{
    const HeapShares shares = evenly();
    for (double volume = 1e-7; volume < 3e-3; volume *= 10.0) {
        Ground   g = stand(0.0, 0.21, 0.09);
        unsigned seed = 11u;
        double   height = 0.0;
        for (int k = 0; k < N * N; ++k) {
            g.base_height[k] = 5.0f + 0.002f * (float)check_random(&seed);
            if (k % 97 == 0 && g.imprint.ring[k] != 0) g.base_height[k] = NAN;
            if (g.imprint.ring[k] == 0) g.compression[k] = 0.03f;
        }
        CHECK(lay(&g, &shares, volume, &height) == DP_OK);
        CHECK_CLOSE(ground_sum(&g, g.heap), volume, 1e-5);
        CHECK(height > 0.0);
        for (int k = 0; k < N * N; ++k) {
            CHECK(g.heap[k] >= 0.0f);
            if (g.imprint.ring[k] == 0 || !soil_is_ground(g.base_height[k]))
                CHECK(g.heap[k] <= 0.0f);
        }
        CHECK(steepest(&g) < 1.002 * slope_of(&g) + 2e-6 / CELL);
        ground_free(&g);
    }
}

// a border cell with share omega carries a cone of T sqrt(omega), and so a long straight edge a triangle sqrt(2 A tan)
TEST(along_a_straight_edge_it_is_a_triangle)
{
    const HeapShares shares = evenly();
    Ground           g =
        stand(-1.0, 1.8, 2.0);  // its edge at x = -0.1, from one side of the patch to the other
    const double volume = 3e-4, section = volume / (N * CELL);
    double       height = 0.0;
    CHECK(lay(&g, &shares, volume, &height) == DP_OK);
    const double want = sqrt(2.0 * section * slope_of(&g));
    // its border cells lie half a cell from the edge
    CHECK_CLOSE(height + 0.5 * CELL * slope_of(&g), want, 0.01);
    for (int i = 0; i < N; ++i) {
        const double x = (i - 0.5 * (N - 1)) * CELL + 0.1;  // from the edge
        if (x < 0.0) continue;
        const double over = fmax(want - slope_of(&g) * x, 0.0);
        for (int j = 5; j < N - 5; ++j) CHECK_NEAR(g.heap[j * N + i], over, 0.02 * want);
    }
    ground_free(&g);
}

// the next volume of the same stance is laid on top of the last, and both are as one
TEST(two_volumes_are_laid_as_one)
{
    const HeapShares shares = evenly();
    Ground           one = stand(0.0, 0.2, 0.1), two = stand(0.0, 0.2, 0.1);
    double           at_once = 0.0, height = 0.0, last = 0.0;
    CHECK(lay(&one, &shares, 1e-3, &at_once) == DP_OK);
    for (int n = 0; n < 10; ++n) {
        CHECK(lay(&two, &shares, 1e-4, &height) == DP_OK);
        CHECK(height > last);
        last = height;
    }
    CHECK_CLOSE(height, at_once, 2e-3);
    for (int k = 0; k < N * N; ++k) CHECK_NEAR(two.heap[k], one.heap[k], 2e-4);
    ground_free(&one), ground_free(&two);
}

// untouched cells pressed half as deep as the deepest under the sole are its hollow: they take nothing
TEST(the_hollow_stays_empty_unless_all_is_hollow)
{
    const HeapShares shares = evenly();
    Ground           g = stand(0.05, 0.1, 0.1);
    double           height = 0.0;
    CHECK(isinf(dp_soil_hollow(&g.patch, &g.imprint)));  // nothing is pressed
    for (int k = 0; k < N * N; ++k) {
        const int i = k % N, j = k / N;
        if (g.imprint.ring[k] == 0) g.compression[k] = 0.04f;
        if (g.imprint.ring[k] != 0 && i < 30 && i > 20 && j > 24 && j < 35)
            g.compression[k] = i > 25 ? 0.0201f : 0.0199f;
    }
    g.compression[40 * N + 40] = 0.5f;  // deep, but not under the sole
    CHECK_NEAR(dp_soil_hollow(&g.patch, &g.imprint), 0.02, 1e-7);
    CHECK(lay(&g, &shares, 2e-4, &height) == DP_OK);
    CHECK_CLOSE(ground_sum(&g, g.heap), 2e-4, 1e-5);
    for (int k = 0; k < N * N; ++k)
        if (g.imprint.ring[k] != 0 && g.compression[k] > 0.02f) CHECK(g.heap[k] <= 0.0f);

    for (int k = 0; k < N * N; ++k) {
        g.heap[k] = 0.0f;
        if (g.imprint.ring[k] != 0) g.compression[k] = 0.03f;  // all around
    }
    CHECK(lay(&g, &shares, 2e-4, &height) == DP_OK);
    CHECK_CLOSE(ground_sum(&g, g.heap), 2e-4, 1e-5);
    ground_free(&g);
}

// a sole in another corner of the patch, mirrored and turned, has the same heap to the bit
TEST(mirrored_and_turned_it_is_the_same)
{
    const HeapShares shares = evenly();
    Ground           g = stand(0.0, 0.25, 0.09);
    unsigned         seed = 4u;
    double           height = 0.0;
    for (int k = 0; k < N * N; ++k) g.base_height[k] = 0.02f * (float)check_random(&seed);
    for (int k = 0; k < N * N; ++k) g.compression[k] = g.imprint.ring[k] == 0 ? 0.02f : 0.0f;
    CHECK(lay(&g, &shares, 4e-4, &height) == DP_OK);
    for (int turn = 0; turn < 4; ++turn) {
        Ground other = stand(0.0, 0.25, 0.09);
        double again = 0.0;
        int    to[N * N];
        for (int k = 0; k < N * N; ++k) {
            const int i = k % N, j = k / N;
            to[k] = turn == 0   ? j * N + N - 1 - i
                    : turn == 1 ? (N - 1 - j) * N + i
                    : turn == 2 ? i * N + j
                                : (N - 1 - i) * N + j;
            other.base_height[to[k]] = g.base_height[k];
            other.compression[to[k]] = g.compression[k];
            other.imprint.ring[to[k]] = g.imprint.ring[k];
            other.imprint.cover[to[k]] = g.imprint.cover[k];
        }
        DpImprint* at = &other.imprint;
        at->i0 = at->j0 = 0, at->i1 = at->j1 = N;
        CHECK(lay(&other, &shares, 4e-4, &again) == DP_OK && again == height);
        for (int k = 0; k < N * N; ++k) CHECK(other.heap[to[k]] == g.heap[k]);
        ground_free(&other);
    }
    ground_free(&g);
}

TEST(without_ground_or_memory_nothing_is_laid)
{
    const HeapShares shares = evenly();
    Ground           g = stand(0.0, 0.2, 0.1);
    DpSoilScratch*   scratch = dp_soil_scratch_create();
    double           height = 0.5;
    dp_alloc_fail_after(0);
    CHECK(dp_soil_heap_rest(&g.patch, &g.imprint, &shares, 1e-4, slope_of(&g), &height, scratch) ==
          DP_NO_MEMORY);
    dp_alloc_fail_after(-1);
    dp_soil_scratch_destroy(scratch);
    for (int k = 0; k < N * N; ++k)
        if (g.imprint.ring[k] != 0) g.base_height[k] = NAN;
    CHECK(lay(&g, &shares, 1e-4, &height) == DP_NO_GROUND);
    CHECK(height == 0.5 && ground_max(&g, g.heap) <= 0.0);
    ground_free(&g);
}

// Where all but a sliver of what lies ahead is hollow the heap is laid in the hollow; it would be a needle else.
TEST(a_sliver_of_level_ground_does_not_take_it_all)
{
    Ground         g = stand(0.0, 0.20, 0.10);
    double         height = 0.0;
    const double   aslant = 1e-6;
    DpSoilScratch* scratch = dp_soil_scratch_create();
    for (int k = 0; k < N * N; ++k)
        g.compression[k] = g.imprint.ring[k] == 0 || k % N > N / 2 + 6 ? 0.05f : 0.0f;
    const HeapShares shares = {.cut = 1.0,
                               .cut_x = sqrt(1.0 - aslant * aslant),
                               .cut_y = aslant,
                               .left = -INFINITY,
                               .right = INFINITY,
                               .imprint = &g.imprint};
    CHECK(dp_soil_heap_rest(&g.patch, &g.imprint, &shares, 1e-5, slope_of(&g), &height, scratch) ==
          DP_OK);
    CHECK(height < 0.1);
    CHECK_CLOSE(ground_sum(&g, g.heap), 1e-5, 1e-6);
    CHECK(ground_max(&g, g.heap) < 0.02);
    dp_soil_scratch_destroy(scratch);
    ground_free(&g);
}

int main(void)
{
    RUN(a_sliver_of_level_ground_does_not_take_it_all);
    RUN(all_of_it_is_laid_at_rest_and_none_under_the_sole);
    RUN(along_a_straight_edge_it_is_a_triangle);
    RUN(two_volumes_are_laid_as_one);
    RUN(the_hollow_stays_empty_unless_all_is_hollow);
    RUN(mirrored_and_turned_it_is_the_same);
    RUN(without_ground_or_memory_nothing_is_laid);
    return check_done();
}
