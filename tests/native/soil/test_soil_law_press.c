// tests of soil_law_press.c: a sole sinks until what it stands on carries the load. MODEL 6.2, MODEL 6.14
#include "check.h"
#include "ground.h"
#include "law.h"
#include "soil/soil_law.h"

TEST(a_sole_goes_as_deep_as_the_law_says_and_no_deeper_than_the_layer)
{
    const DpSoil soils[] = {snow(100.0f), measured(2e3f, 5e5f, 0.4f), measured(0.0f, 2e6f, 1.6f)};
    for (int k = 0; k < 3; ++k)
        for (double load = 100.0; load < 1e7; load *= 10.0) {
            Ground      g = ground_make(40, 40, 0.01, soils[k]);
            DpPressed   pressed;
            DpFootForce foot = {{0.0, 0.0, -load}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
            ground_sole(&g, (BoxSole){.length = 0.2, .width = 0.1});
            CHECK(dp_soil_compress(&g.patch, &g.imprint, &foot, DP_CONTACT_SOLE, 10.0, &pressed) ==
                  DP_OK);
            const double depth = dp_law_depth(&soils[k], 0.1, load / 0.02);
            CHECK_CLOSE(ground_max(&g, g.compression), depth, 1e-5);
            CHECK_NEAR(pressed.area, 0.02, 1e-6);
            ground_free(&g);
        }
}

static void press_box(Ground* g, double x, double length, double load)
{
    DpPressed         pressed;
    const DpFootForce foot = {{0.0, 0.0, -load}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    ground_sole(g, (BoxSole){.x = x, .length = length, .width = 0.1});
    CHECK(dp_soil_compress(&g->patch, &g->imprint, &foot, DP_CONTACT_SOLE, 10.0, &pressed) ==
          DP_OK);
}

TEST(what_was_pressed_deeper_carries_nothing)
{
    const DpSoil soils[] = {snow(100.0f), measured(0.0f, 5e5f, 1.0f)};
    for (int k = 0; k < 2; ++k) {
        Ground g = ground_make(60, 40, 0.01, soils[k]);
        press_box(&g, -0.1, 0.2, 20e3 * 0.02);  // one half of the next sole's ground
        const double deep = ground_max(&g, g.compression);
        press_box(&g, 0.0, 0.4, 5e3 * 0.02);
        const double found = (double)g.compression[soil_at(&g.patch, 40, 20)];
        CHECK_CLOSE(found, dp_law_depth(&soils[k], 0.1, 5e3), 1e-5);
        CHECK(found < 0.9 * deep);
        CHECK_NEAR(ground_max(&g, g.compression), deep, 1e-9);
        ground_free(&g);
    }
}

// what ground carries under a sole that has come to stand in it, cell by cell, by the law alone [N]
static double carried(const Ground* g, double width)
{
    const double area = g->patch.cell * g->patch.cell;
    double       sum = 0.0;
    for (int k = 0; k < g->patch.nx * g->patch.ny; ++k) {
        if (g->imprint.ring[k] != 0) continue;
        const double depth = (double)g->compression[k] / (double)g->imprint.cover[k];
        sum += dp_law_pressure(&g->soil[g->kind[k]], width, depth) *
               (double)(g->modulus[k] / g->soil[g->kind[k]].young_modulus) * area *
               (double)g->imprint.cover[k];
    }
    return sum;
}

// a tilted sole, on two kinds of ground, half of it with roots: forces balance, and its underside stays a plane
TEST(forces_balance_under_a_tilted_sole_on_several_kinds)
{
    for (double load = 200.0; load < 1e4; load *= 4.0) {
        Ground g = ground_make(50, 40, 0.01, measured(2e3f, 4e5f, 0.8f));
        g.soil[1] = snow(250.0f);
        g.soil[1].young_modulus = g.soil[0].young_modulus;
        for (int k = 0; k < 50 * 40; ++k) g.kind[k] = k % 50 > 27;
        ground_material(&g);
        for (int k = 0; k < 50 * 40; ++k) g.modulus[k] *= k / 50 > 20 ? 1.7f : 1.0f;
        ground_sole(&g, (BoxSole){.length = 0.2, .width = 0.1, .pitch = 0.05});
        DpPressed         pressed;
        const DpFootForce foot = {{0.0, 0.0, -load}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
        const double      width = dp_law_width(&g.patch, &g.imprint);
        CHECK(dp_soil_compress(&g.patch, &g.imprint, &foot, DP_CONTACT_SOLE, 10.0, &pressed) ==
              DP_OK);
        CHECK_CLOSE(carried(&g, width), load, 1e-4);
        double area = 0.0;
        for (int k = 0; k < 50 * 40; ++k) {
            const double under = pressed.sink - (double)g.imprint.bottom[k];
            const bool   touches = g.imprint.cover[k] > 0.0f && under > 0.0;
            CHECK((g.imprint.ring[k] == 0) == touches);
            if (touches) area += (double)g.imprint.cover[k] * 1e-4;
            if (touches)
                CHECK_NEAR((double)g.compression[k] / (double)g.imprint.cover[k],
                           fmin(under, 0.95 * 0.3), 1e-5);
        }
        CHECK_CLOSE(pressed.area, area, 1e-6);
        ground_free(&g);
    }
}

// a sole that touches with an edge only is carried by at least four cells or 5 % of it: its load is made less
TEST(a_small_contact_does_not_bear_all)
{
    Ground            g = ground_make(50, 40, 0.01, measured(0.0f, 5e7f, 1.0f));
    const DpFootForce foot = {{0.0, 0.0, -400.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    DpPressed         pressed;
    ground_sole(&g, (BoxSole){.length = 0.3, .width = 0.2, .pitch = 1.0});
    const double width = dp_law_width(&g.patch, &g.imprint);
    CHECK(dp_soil_compress(&g.patch, &g.imprint, &foot, DP_CONTACT_SOLE, 10.0, &pressed) == DP_OK);
    const double borne = carried(&g, width);
    CHECK(borne < 399.0 && borne > 100.0 && pressed.area < 0.05 * 0.06);
    // the share of the load is that of the area the whole load would have had
    double sink = pressed.sink, area = 0.0, force = 0.0;
    for (double step = 0.01; step > 1e-12; step *= 0.5) {
        force = area = 0.0;
        for (int k = 0; k < 50 * 40; ++k) {
            const double depth = sink + step - (double)g.imprint.bottom[k];
            if (!(g.imprint.cover[k] > 0.0f) || !(depth > 0.0)) continue;
            force += 5e7 * depth * 1e-4 * (double)g.imprint.cover[k];
            area += 1e-4 * (double)g.imprint.cover[k];
        }
        if (force <= 400.0) sink += step;
    }
    CHECK_CLOSE(borne, 400.0 * area / (0.05 * 0.06), 0.02);
    ground_free(&g);
}

// ground yields in its time: after tau ln 2 half of the way is made, SOFT22 (11)
TEST(it_takes_its_time)
{
    Ground            g = ground_make(40, 40, 0.01, snow(150.0f));
    const DpFootForce foot = {{0.0, 0.0, -300.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    DpPressed         pressed;
    for (int k = 0; k < 4; ++k) g.soil[k].settle_time = 0.5f;
    ground_sole(&g, (BoxSole){.length = 0.2, .width = 0.1});
    const double full = dp_law_depth(&g.soil[0], 0.1, 300.0 / 0.02);
    CHECK(dp_soil_compress(&g.patch, &g.imprint, &foot, DP_CONTACT_SOLE, 0.1, &pressed) == DP_OK);
    const double soon = ground_max(&g, g.compression);
    CHECK(soon > 0.0 && soon < 0.5 * full);
    for (int n = 0; n < 40; ++n)
        CHECK(dp_soil_compress(&g.patch, &g.imprint, &foot, DP_CONTACT_SOLE, 0.1, &pressed) ==
              DP_OK);
    CHECK_CLOSE(ground_max(&g, g.compression), full, 1e-3);
    ground_free(&g);
}

// half beyond the ground's edge it stands as on ground that goes on; nowhere over ground it presses nothing
TEST(beyond_the_edge_ground_goes_on)
{
    double depth[2];
    for (int cut = 0; cut < 2; ++cut) {
        Ground            g = ground_make(60, 40, 0.01, measured(0.0f, 5e5f, 1.0f));
        const DpFootForce foot = {{0.0, 0.0, -500.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
        DpPressed         pressed;
        for (int k = 0; k < 60 * 40; ++k)
            if (cut && k % 60 >= 30) g.base_height[k] = NAN;
        ground_sole(&g, (BoxSole){.length = 0.2, .width = 0.1});
        CHECK(dp_soil_compress(&g.patch, &g.imprint, &foot, DP_CONTACT_SOLE, 10.0, &pressed) ==
              DP_OK);
        depth[cut] = ground_max(&g, g.compression);
        for (int k = 0; k < 60 * 40; ++k)
            if (cut && k % 60 >= 30) CHECK(g.imprint.ring[k] != 0 && g.compression[k] <= 0.0f);
        ground_free(&g);
    }
    CHECK_CLOSE(depth[1], depth[0], 0.1);
}

int main(void)
{
    RUN(a_sole_goes_as_deep_as_the_law_says_and_no_deeper_than_the_layer);
    RUN(what_was_pressed_deeper_carries_nothing);
    RUN(forces_balance_under_a_tilted_sole_on_several_kinds);
    RUN(a_small_contact_does_not_bear_all);
    RUN(it_takes_its_time);
    RUN(beyond_the_edge_ground_goes_on);
    return check_done();
}
