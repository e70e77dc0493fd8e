// tests of soil_slide_read.c: TRAIL (14), MODEL 6.4, MODEL 6.8
#include "check.h"
#include "ground.h"
#include "soil/soil_slide.h"

TEST(rows_are_read_as_the_patch_has_them)
{
    float       firm[4], height[4], heap[4], fall[4], slack[4], base[4], steep[4], slack_of_wall[4];
    double      sum[4];
    const float at[4] = {1.5f, NAN, 2.0f, 1.0f}, pressed[4] = {0.1f, 0.0f, 0.0f, 0.2f};
    const float loose[4] = {0.02f, 0.0f, 0.03f, 0.0f}, slope[4] = {0.5f, 0.5f, 0.5f, 1.0f};
    const float wall[4] = {2.0f, 2.0f, 2.0f, INFINITY};
    const int32_t ring[4] = {DP_RING_FAR, DP_RING_FAR, 0, 3};
    const Row     row = {firm, height, heap, fall, slack, sum};
    const Walls   walls = {base, steep, slack_of_wall};
    dp_slide_fill(&row, at, pressed, loose, slope, ring, 4, 0.01, 1.0, 0.002);
    dp_walls_fill(&walls, at, wall, ring, 4, 0.01, 1.0, 0.002);
    CHECK_NEAR(firm[0], 0.4, 1e-7);
    CHECK_NEAR(height[0], 0.42, 1e-7);
    CHECK(heap[0] == 0.02f && sum[0] == (double)0.02f);
    CHECK_NEAR(fall[0], 0.005, 1e-9);
    CHECK_NEAR(slack[0], 0.002 * 1.25 * 0.01, 1e-11);
    CHECK_NEAR(slack[3], 0.002 * 2.0 * 0.01, 1e-11);
    CHECK_NEAR(firm[3], -0.2, 1e-7);
    for (int k = 1; k < 3; ++k) {  // no ground, and under a sole
        CHECK(firm[k] == BARRIER && height[k] == BARRIER);
        CHECK(heap[k] == 0.0f && fall[k] == 0.0f && slack[k] == 0.0f);
        CHECK(base[k] == 0.0f && steep[k] == BARRIER);
    }
    CHECK_NEAR(base[0], 0.5, 1e-7);
    CHECK_NEAR(steep[0], 0.02, 1e-9);
    CHECK_NEAR(slack_of_wall[0], 0.002 * 5.0 * 0.01, 1e-10);
    CHECK(steep[3] == BARRIER);
}

static bool same(DpCellRect a, DpCellRect b)
{
    return a.i0 == b.i0 && a.i1 == b.i1 && a.j0 == b.j0 && a.j1 == b.j1;
}

// loose soil can move, and firm ground beside what was pressed where it has walls
TEST(what_is_loose_or_has_a_wall_can_move)
{
    Ground           ground = ground_make(40, 30, 0.01, dp_soil_default());
    const DpCellRect all = dp_cells(0, 0, 40, 30), part = dp_cells(0, 0, 20, 30);
    float            wall[1200] = {0.0f};
    CHECK(dp_cells_empty(dp_slide_movable(&ground.patch, all)));
    ground.heap[5 * 40 + 7] = 0.01f, ground.heap[9 * 40 + 33] = 1e-6f;
    CHECK(same(dp_slide_movable(&ground.patch, all), (DpCellRect){7, 34, 5, 10}));
    CHECK(same(dp_slide_movable(&ground.patch, part), (DpCellRect){7, 8, 5, 6}));
    ground.compression[20 * 40 + 39] = 0.1f;
    CHECK(same(dp_slide_movable(&ground.patch, all), (DpCellRect){7, 34, 5, 10}));
    ground.patch.wall_slope = wall;
    CHECK(same(dp_slide_movable(&ground.patch, all), (DpCellRect){7, 40, 5, 22}));
    ground_free(&ground);
}

// whole metres at or below the highest ground there is
TEST(heights_are_told_from_near_the_ground)
{
    Ground           ground = ground_make(40, 30, 0.01, dp_soil_default());
    const DpCellRect all = dp_cells(0, 0, 40, 30);
    for (int k = 0; k < 1200; ++k) ground.base_height[k] = NAN;
    CHECK(dp_slide_level(&ground.patch, all) == 0.0);
    ground.base_height[17 * 40 + 37] = 712.6f, ground.base_height[3] = -20.0f;
    CHECK(dp_slide_level(&ground.patch, all) == 712.0);
    CHECK(dp_slide_level(&ground.patch, dp_cells(0, 0, 37, 30)) == -20.0);
    ground_free(&ground);
}

int main(void)
{
    RUN(rows_are_read_as_the_patch_has_them);
    RUN(what_is_loose_or_has_a_wall_can_move);
    RUN(heights_are_told_from_near_the_ground);
    return check_done();
}
