// a body goes where it is moved to, and the ground makes way
#include "check.h"
#include "ground.h"

static const DpDescent straight = {1e6, 0.0, 0.0, 0.0}, level = {0.0, 0.0, 0.0, 0.0};

static DpSoil sand(void)
{
    DpSoil soil = dp_soil_default();
    soil.poisson_ratio = 0.35f;
    return soil;
}

static DpCarved carve(Ground* ground, BoxSole sole, DpDescent descent)
{
    DpCarved carved;
    ground_sole(ground, sole);
    CHECK(dp_soil_carve(&ground->patch, &ground->imprint, &descent, 0.01, &carved) == DP_OK);
    return carved;
}

TEST(goes_down_to_the_body)
{
    Ground         g = ground_make(40, 40, 0.01, sand());
    const BoxSole  box = {.z = -0.1, .length = 0.2, .width = 0.1};
    const DpCarved c = carve(&g, box, straight);
    CHECK_NEAR(ground_max(&g, g.compression), 0.1, 1e-7);
    CHECK_NEAR(c.pressed.firm, 0.1 * 0.2 * 0.1, 1e-9);
    CHECK_NEAR(c.pressed.displaced, 0.7 * c.pressed.firm, 1e-9);
    CHECK(c.cut_firm <= 0.0 && c.cut_loose <= 0.0);
    CHECK_NEAR(c.pressed.area, 0.02, 1e-9);
    const DpCarved again = carve(&g, box, straight);
    CHECK(again.pressed.firm <= 0.0 && again.pressed.area > 0.0);  // it stands there, and no more
    ground_free(&g);
}

TEST(what_comes_from_the_side_is_cut)
{
    Ground        g = ground_make(60, 40, 0.01, sand());
    const BoxSole box = {.x = -0.1, .z = -0.03, .length = 0.2, .width = 0.1};
    BoxSole       on = box;
    carve(&g, box, straight);
    on.x += 0.1;
    for (int k = 0; k < 60 * 40; ++k) g.heap[k] = g.compression[k] > 0.0f ? 0.0f : 0.02f;
    const DpCarved c = carve(&g, on, level);
    CHECK(c.pressed.firm <= 0.0 && c.pressed.loose <= 0.0 && c.pressed.displaced <= 0.0);
    CHECK_NEAR(c.cut_firm, 0.03 * 0.1 * 0.1, 1e-9);
    CHECK_NEAR(c.cut_loose, 0.02 * 0.1 * 0.1, 1e-9);
    on.x += 0.1;
    const DpCarved down = carve(&g, on, (DpDescent){0.01, 0.0, 0.0, 0.0});  // and 1 cm down
    CHECK_NEAR(down.cut_firm + down.cut_loose, 0.04 * 0.1 * 0.1, 1e-9);
    CHECK_NEAR(down.pressed.firm + down.pressed.loose, 0.01 * 0.1 * 0.1, 1e-9);
    ground_free(&g);
}

// of what was loose all comes up beside the body, of what was firm 2 nu
TEST(loose_soil_is_pushed_aside_whole)
{
    Ground g = ground_make(40, 40, 0.01, sand());
    for (int k = 0; k < 40 * 40; ++k) g.heap[k] = 0.02f;
    const DpCarved c = carve(&g, (BoxSole){.z = -0.05, .length = 0.2, .width = 0.1}, straight);
    CHECK_CLOSE(c.pressed.loose, 0.02 * 0.02, 1e-6);
    CHECK_CLOSE(c.pressed.firm, 0.05 * 0.02, 1e-6);
    CHECK_CLOSE(c.pressed.displaced, c.pressed.loose + 0.7 * c.pressed.firm, 1e-6);
    ground_free(&g);
}

// A heap beside the edge of a body, of which it covers a half, 2 cm over the rest ground: MODEL 6.11
TEST(a_heap_that_is_covered_in_part_is_cut_once)
{
    Ground        g = ground_make(40, 40, 0.01, sand());
    const BoxSole box = {.z = 0.02, .length = 0.21, .width = 0.1};  // half a cell at both ends
    for (int k = 0; k < 40 * 40; ++k) g.heap[k] = 0.05f;
    carve(&g, box, level);
    const int edge = 20 * 40 + g.imprint.i0, middle = 20 * 40 + 20;
    CHECK_NEAR(g.imprint.cover[edge], 0.5, 1e-6);
    CHECK_NEAR(g.heap[edge], 0.02 / 0.5, 1e-6);
    CHECK_NEAR(g.heap[middle], 0.02, 1e-6);
    const DpCarved again = carve(&g, box, level);
    CHECK(again.cut_loose <= 0.0 && again.pressed.loose <= 0.0);
    ground_free(&g);
}

// what was pressed springs back, what is left after a cut does not
TEST(what_was_cut_does_not_spring)
{
    float spring[40 * 40];
    for (int cut = 0; cut < 2; ++cut) {
        DpSoil soil = sand();
        soil.rebound = 0.2f;
        Ground g = ground_make(40, 40, 0.01, soil);
        memset(spring, 0, sizeof spring);
        g.patch.spring = spring;
        carve(&g, (BoxSole){.z = -0.05, .length = 0.2, .width = 0.1}, cut ? level : straight);
        CHECK_NEAR(spring[20 * 40 + 20], cut ? 0.0 : -0.05, 1e-7);
        const double back = dp_soil_rebound(&g.patch, NULL);
        CHECK_NEAR(back, cut ? 0.0 : 0.2 * 0.05 * 0.02, 1e-8);
        ground_free(&g);
    }
}

// how far each point has come down is told along x and along y, from the middle of the patch on
TEST(a_body_that_tips_presses_where_it_came_down)
{
    for (int axis = 0; axis < 2; ++axis) {
        Ground          g = ground_make(41, 41, 0.01, sand());
        const DpDescent tips = {0.0, axis ? 0.0 : 0.5, axis ? 0.5 : 0.0, 0.0};
        const DpCarved  c = carve(&g, (BoxSole){.z = -0.03, .length = 0.2, .width = 0.2}, tips);
        // half of it came down, by 0.5 x, up to the 3 cm that are in its way; the other half has risen
        double pressed = 0.0;
        for (int k = 1; k <= 10; ++k) pressed += fmin(0.5 * 0.01 * k, 0.03) * (k < 10 ? 1.0 : 0.5);
        CHECK_CLOSE(c.pressed.firm, pressed * 0.01 * 0.2, 1e-6);
        CHECK_CLOSE(c.cut_firm, 0.03 * 0.04 - c.pressed.firm, 1e-6);
        CHECK_NEAR(c.x, 0.0, 1e-9);
        CHECK_NEAR(c.y, 0.0, 1e-9);
        ground_free(&g);
    }
}

TEST(cells_do_not_matter)
{
    for (int k = 1; k <= 8; k *= 2) {
        Ground        g = ground_make(8 * k, 8 * k, 0.04 / k, sand());
        const BoxSole box = {.x = 0.003, .z = -0.05, .length = 0.17, .width = 0.11, .heading = 0.4};
        const DpCarved c = carve(&g, box, straight);
        CHECK_CLOSE(c.pressed.firm, 0.05 * 0.17 * 0.11, 0.02);
        for (int more = 0; more < 20; ++more) carve(&g, box, straight);  // no step takes it twice
        CHECK_CLOSE(ground_sum(&g, g.compression), c.pressed.firm, 1e-6);
        ground_free(&g);
    }
}

TEST(no_ground_no_work)
{
    Ground   g = ground_make(20, 20, 0.01, sand());
    DpCarved c;
    for (int k = 0; k < 400; ++k) g.base_height[k] = NAN;
    c = carve(&g, (BoxSole){.z = -0.1, .length = 0.1, .width = 0.1}, straight);
    CHECK(c.pressed.area <= 0.0 && c.pressed.firm <= 0.0);
    CHECK(dp_soil_carve(&g.patch, &g.imprint, &straight, 0.0, &c) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_carve(&g.patch, &g.imprint, NULL, 0.1, &c) == DP_BAD_ARGUMENT);
    ground_free(&g);
}

TEST(mirrored_to_the_bit)
{
    enum
    {
        SIDE = 40
    };
    Ground   g[2] = {ground_make(SIDE, SIDE, 0.01, sand()), ground_make(SIDE, SIDE, 0.01, sand())};
    unsigned seed = 11;
    DpCarved c[2];
    ground_sole(&g[0],
                (BoxSole){.z = -0.02, .length = 0.2, .width = 0.1, .heading = 0.3, .pitch = 0.2});
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const int   at[2] = {j * SIDE + i, j * SIDE + SIDE - 1 - i};
            const float rest = (float)(0.01 * check_random(&seed));
            const float heap = (float)(0.01 * check_random(&seed));
            for (int m = 0; m < 2; ++m) {
                g[m].base_height[at[m]] = rest, g[m].heap[at[m]] = heap;
                g[m].imprint.cover[at[m]] = g[0].imprint.cover[at[0]];
                g[m].imprint.bottom[at[m]] = g[0].imprint.bottom[at[0]];
            }
        }
    for (int m = 0; m < 2; ++m) {
        g[m].patch.soils = g[m].soil;
        g[m].imprint.i0 = g[m].imprint.j0 = 0, g[m].imprint.i1 = g[m].imprint.j1 = SIDE;
        const DpDescent descent = {0.01, m ? -0.07 : 0.07, 0.03, 0.1};
        CHECK(dp_soil_carve(&g[m].patch, &g[m].imprint, &descent, 0.01, &c[m]) == DP_OK);
    }
    CHECK(c[0].cut_firm == c[1].cut_firm && c[0].pressed.displaced == c[1].pressed.displaced);
    CHECK(c[0].cut_firm > 0.0 && c[0].pressed.firm > 0.0);
    int unlike = 0;
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const int a = j * SIDE + i, b = j * SIDE + SIDE - 1 - i;
            unlike += g[0].compression[a] != g[1].compression[b] || g[0].heap[a] != g[1].heap[b];
        }
    CHECK(unlike == 0);
    ground_free(&g[0]), ground_free(&g[1]);
}

TEST(what_cannot_be_carved_is_refused)
{
    Ground                 g = ground_make(20, 20, 0.01, sand());
    const DpDescent* const descent = &straight;
    DpCarved               carved;
    ground_sole(&g, (BoxSole){.z = -0.1, .length = 0.1, .width = 0.1});
    CHECK(dp_soil_carve(&g.patch, NULL, descent, 0.01, &carved) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_carve(&g.patch, &g.imprint, NULL, 0.01, &carved) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_carve(&g.patch, &g.imprint, descent, 0.01, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_carve(&g.patch, &g.imprint, descent, 0.0, &carved) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_carve(&g.patch, &g.imprint, descent, INFINITY, &carved) == DP_BAD_ARGUMENT);
    DpSoilPatch bad = g.patch;
    bad.row = bad.nx - 1;
    CHECK(dp_soil_carve(&bad, &g.imprint, descent, 0.01, &carved) == DP_BAD_ARGUMENT);
    CHECK(ground_max(&g, g.compression) <= 0.0);
    ground_free(&g);
}

int main(void)
{
    RUN(goes_down_to_the_body);
    RUN(what_comes_from_the_side_is_cut);
    RUN(loose_soil_is_pushed_aside_whole);
    RUN(a_heap_that_is_covered_in_part_is_cut_once);
    RUN(what_was_cut_does_not_spring);
    RUN(a_body_that_tips_presses_where_it_came_down);
    RUN(cells_do_not_matter);
    RUN(no_ground_no_work);
    RUN(mirrored_to_the_bit);
    RUN(what_cannot_be_carved_is_refused);
    return check_done();
}
