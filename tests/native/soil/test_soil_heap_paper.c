// tests of soil_heap_paper.c: TRAIL (12), and the bulge of MODEL 6.3
#include "check.h"
#include "ground.h"
#include "soil/soil_heaps.h"

#define SIDE 101
#define CELL 0.01

// a wall of touched cells, left of column `edge`, whose last column is covered by the share `cover`
static Ground beside_a_wall(int edge, float cover)
{
    Ground ground = ground_make(SIDE, SIDE, CELL, dp_soil_default());
    ground.patch.soils = ground.soil;
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const bool under = k % SIDE < edge;
        ground.imprint.ring[k] = under ? 0 : k % SIDE == edge ? 1 : DP_RING_FAR;
        ground.imprint.cover[k] = !under ? 0.0f : k % SIDE == edge - 1 ? cover : 1.0f;
    }
    ground.imprint.i1 = edge, ground.imprint.j1 = SIDE;
    return ground;
}

static const HeapShares alike = {.even = true};

// h(e) = exp(-(e/w)^1.4) - exp(-4^1.4), e from the sole's true edge to the middle of the cell
TEST(a_bulge_falls_off_as_the_model_says)
{
    const float cover[3] = {1.0f, 0.5f, 0.25f};
    for (int n = 0; n < 3; ++n) {
        const double   wide = 0.08, volume = 2e-4, end = exp(-pow(4.0, 1.4));
        Ground         ground = beside_a_wall(20, cover[n]);
        DpSoilScratch* scratch = dp_soil_scratch_create();
        CHECK(dp_soil_heap_bulge(&ground.patch, &ground.imprint, &alike, volume, wide, scratch) ==
              DP_OK);
        CHECK_CLOSE(ground_sum(&ground, ground.heap), volume, 1e-6);
        const double first = (double)ground.heap[50 * SIDE + 20];
        const double top = exp(-pow((1.5 - (double)cover[n]) * CELL / wide, 1.4)) - end;
        for (int i = 20; i < SIDE; ++i) {
            const double e = ((i - 19 + 0.5) - (double)cover[n]) * CELL;
            const double want = fmax(exp(-pow(e / wide, 1.4)) - end, 0.0) / top;
            // read between 64 known heights: to h''/8 of their distance, which is 1/16 of w
            CHECK_NEAR((double)ground.heap[50 * SIDE + i] / first, want, 2e-3);
        }
        dp_soil_scratch_destroy(scratch);
        ground_free(&ground);
    }
}

TEST(nothing_is_laid_in_the_hollow_unless_there_is_no_other_place)
{
    for (int all = 0; all < 2; ++all) {
        Ground         ground = beside_a_wall(20, 1.0f);
        DpSoilScratch* scratch = dp_soil_scratch_create();
        for (int k = 0; k < SIDE * SIDE; ++k)
            ground.compression[k] = k % SIDE < 20 ? 0.04f : k / SIDE < 50 || all ? 0.03f : 0.0f;
        CHECK(dp_soil_heap_bulge(&ground.patch, &ground.imprint, &alike, 1e-4, 0.05, scratch) ==
              DP_OK);
        CHECK_CLOSE(ground_sum(&ground, ground.heap), 1e-4, 1e-6);
        for (int j = 0; j < 50; ++j) CHECK((ground.heap[j * SIDE + 21] > 0.0f) == (all == 1));
        CHECK(ground.heap[70 * SIDE + 21] > 0.0f);
        dp_soil_scratch_destroy(scratch);
        ground_free(&ground);
    }
}

// around one touched cell distances are the same in all eight directions and their mirrors
TEST(a_rim_is_as_far_out_on_all_sides)
{
    Ground         ground = ground_make(SIDE, SIDE, CELL, dp_soil_default());
    DpSoilScratch* scratch = dp_soil_scratch_create();
    ground.patch.soils = ground.soil;
    for (int k = 0; k < SIDE * SIDE; ++k) ground.imprint.ring[k] = DP_RING_FAR;
    ground.imprint.ring[50 * SIDE + 50] = 0, ground.imprint.cover[50 * SIDE + 50] = 1.0f;
    ground.imprint.i0 = ground.imprint.j0 = 50, ground.imprint.i1 = ground.imprint.j1 = 51;
    CHECK(dp_soil_heap_paper(&ground.patch, &ground.imprint, &alike, 1e-4, 0.1, scratch) == DP_OK);
    CHECK_CLOSE(ground_sum(&ground, ground.heap), 1e-4, 1e-6);
    for (int y = -14; y <= 14; ++y)
        for (int x = -14; x <= 14; ++x) {
            const float here = ground.heap[(50 + y) * SIDE + 50 + x];
            CHECK(here == ground.heap[(50 + x) * SIDE + 50 + y]);
            CHECK(here == ground.heap[(50 + y) * SIDE + 50 - x]);
            // it begins half a cell out, where the sole ends midway, and is 10 cells wide
            const int    far = abs(x) > abs(y) ? abs(x) : abs(y), aslant = abs(x) + abs(y) - far;
            const double to = far - aslant + sqrt(2.0) * aslant - 0.5;
            CHECK((here > 0.0f) == (to > 0.0 && to < 10.5));
        }
    dp_soil_scratch_destroy(scratch);
    ground_free(&ground);
}

int main(void)
{
    RUN(a_bulge_falls_off_as_the_model_says);
    RUN(nothing_is_laid_in_the_hollow_unless_there_is_no_other_place);
    RUN(a_rim_is_as_far_out_on_all_sides);
    return check_done();
}
