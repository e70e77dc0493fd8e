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
    CHECK_NEAR(ground_most(&g, g.compression), 0.1, 1e-7);
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

int main(void)
{
    RUN(goes_down_to_the_body);
    RUN(what_comes_from_the_side_is_cut);
    RUN(cells_do_not_matter);
    RUN(no_ground_no_work);
    RUN(mirrored_to_the_bit);
    return check_done();
}
