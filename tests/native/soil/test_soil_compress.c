// tests of soil_compress.c: TRAIL (9) (10), SOFT22 (9)-(12)
#include "check.h"
#include "ground.h"

static DpSoil wet(void)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 0.35e6f;
    soil.settle_time = 0.1f;
    return soil;
}

// stand `newton` on a level box for `seconds` in steps of dt; what all steps pressed
static DpPressed stand(Ground* ground, BoxSole sole, double newton, DpContactLaw law,
                       double seconds, double dt)
{
    const DpFootForce foot = ground_load(newton);
    DpPressed         sum = {0};
    ground_sole(ground, sole);
    for (double t = 0.0; t < seconds - 1e-9; t += dt) {
        DpPressed now;
        CHECK(dp_soil_compress(&ground->patch, &ground->imprint, &foot, law, dt, &now) == DP_OK);
        sum.firm += now.firm, sum.loose += now.loose, sum.displaced += now.displaced;
        sum.area = now.area, sum.sink = now.sink, sum.deepest = now.deepest;
    }
    return sum;
}

static const BoxSole shoe = {.length = 0.275, .width = 0.10};

// MODEL 11.1: c = m g L0/(E A): 75 kg on 0.0275 m^2, 0.35 MPa
TEST(flat_sole_is_trail_10)
{
    for (int law = 0; law < 2; ++law) {
        Ground          ground = ground_make(60, 40, 0.01, wet());
        const DpPressed p = stand(&ground, shoe, 75 * DP_GRAVITY, (DpContactLaw)law, 0.5, 1.0 / 60);
        const double    c = 75 * DP_GRAVITY * 0.30 / (0.35e6 * 0.0275);
        CHECK_CLOSE(c, 0.0229, 0.01);
        CHECK_CLOSE(p.deepest, c, 0.01);
        CHECK_CLOSE(p.deepest, ground_max(&ground, ground.compression), 1e-6);
        CHECK_CLOSE(p.firm, c * 0.0275, 0.01);
        CHECK_CLOSE(p.area, 0.0275, 0.01);
        CHECK_CLOSE(p.displaced, 2 * 0.35 * p.firm, 1e-6);
        CHECK(p.loose == 0.0);
        ground_free(&ground);
    }
}

// with a raster that has the area exactly, the sole law gives (10) to float rounding
TEST(even_ground_is_exact)
{
    Ground          ground = ground_make(60, 40, 0.01, wet());
    const BoxSole   sole = {.x = 0.0025, .y = 0.00125, .length = 0.28, .width = 0.10};
    const DpPressed p = stand(&ground, sole, 600.0, DP_CONTACT_SOLE, 0.3, 0.01);
    CHECK_CLOSE(p.area, 0.028, 1e-9);
    CHECK_CLOSE(p.deepest, 600.0 * 0.30 / (0.35e6 * 0.028), 1e-6);
    CHECK_CLOSE(p.firm, 600.0 * 0.30 / 0.35e6, 1e-6);
    // stress over time: N t/A where the sole covers the cell
    CHECK_CLOSE(ground_max(&ground, ground.pressure_time), 600.0 / 0.028 * 0.3, 1e-5);
    CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 600.0 * 0.3, 1e-5);
    ground_free(&ground);
}

// What would press it twice as far as it can be pressed goes on a hundredth of the rest: MODEL 6.2
TEST(rigid_ground_is_a_hundred_times_as_hard)
{
    DpSoil soil = wet();
    soil.layer_depth = 0.05f;
    const double    rigid = 0.95 * 0.05, load = 2.0 * rigid * 0.35e6 * 0.028 / 0.05;
    const BoxSole   sole = {.x = 0.0025, .y = 0.00125, .length = 0.28, .width = 0.10};
    Ground          ground = ground_make(60, 40, 0.01, soil);
    const DpPressed p = stand(&ground, sole, load, DP_CONTACT_SOLE, 0.3, 0.01);
    CHECK_CLOSE(p.sink, rigid + rigid / 100.0, 1e-6);
    CHECK_CLOSE(p.deepest, rigid, 1e-6);
    CHECK_CLOSE(p.firm, rigid * 0.028, 1e-6);
    ground_free(&ground);
}

// A first touch carries on a twentieth of the sole at least: on less of it, as much less.
TEST(a_first_touch_is_no_needle)
{
    const BoxSole   sole = {.length = 0.28, .width = 0.10, .pitch = 0.5};  // a row of 10 cells
    Ground          ground = ground_make(60, 40, 0.01, wet());
    const DpPressed p = stand(&ground, sole, 5.0, DP_CONTACT_SOLE, 0.3, 0.01);
    CHECK_CLOSE(p.area, 0.001, 1e-6);
    CHECK_CLOSE(p.firm, 5.0 * (0.001 / (0.05 * 0.028)) * 0.30 / 0.35e6, 1e-3);
    ground_free(&ground);
}

// .. but on no more than the sole: one of two cells carries all of its load.
TEST(a_sole_smaller_than_that_carries_its_load)
{
    const BoxSole   sole = {.length = 0.02, .width = 0.01};
    Ground          ground = ground_make(60, 40, 0.01, wet());
    const DpPressed p = stand(&ground, sole, 5.0, DP_CONTACT_SOLE, 0.3, 0.01);
    CHECK_CLOSE(p.area, 0.0002, 1e-6);
    CHECK_CLOSE(p.firm, 5.0 * 0.30 / 0.35e6, 1e-5);
    ground_free(&ground);
}

TEST(proportional)
{
    const BoxSole half = {.length = 0.1375, .width = 0.10};
    for (int law = 0; law < 2; ++law) {
        double depth[5];
        for (int k = 0; k < 5; ++k) {
            DpSoil soil = wet();
            if (k == 2) soil.layer_depth *= 2.0f;
            if (k == 3) soil.young_modulus *= 2.0f;
            Ground ground = ground_make(60, 40, 0.00625, soil);
            depth[k] = stand(&ground, k == 4 ? half : shoe, k == 1 ? 800.0 : 400.0,
                             (DpContactLaw)law, 0.3, 0.02)
                           .deepest;
            ground_free(&ground);
        }
        CHECK_CLOSE(depth[1], 2.0 * depth[0], 1e-5);  // the load
        CHECK_CLOSE(depth[2], 2.0 * depth[0], 1e-5);  // the layer
        CHECK_CLOSE(depth[3], 0.5 * depth[0], 1e-5);  // the stiffness
        CHECK_CLOSE(depth[4], 2.0 * depth[0], 0.01);  // half the area, twice the depth: MODEL 11.7
    }
}

// MODEL 11.2
TEST(frame_rate_does_not_matter)
{
    double       volume[3];
    const double rate[3] = {24.0, 60.0, 240.0};
    for (int k = 0; k < 3; ++k) {
        Ground ground = ground_make(60, 40, 0.01, wet());
        volume[k] = stand(&ground, shoe, 700.0, DP_CONTACT_SOLE, 0.5, 1.0 / rate[k]).firm;
        ground_free(&ground);
    }
    CHECK_CLOSE(volume[0], volume[2], 1e-5);
    CHECK_CLOSE(volume[1], volume[2], 1e-5);
}

// SOFT22 (11): a tenth of tau presses a tenth of the way
TEST(yields_at_its_rate)
{
    Ground          ground = ground_make(60, 40, 0.01, wet());
    const DpPressed whole = stand(&ground, shoe, 700.0, DP_CONTACT_SOLE, 0.01, 0.01);
    CHECK_CLOSE(whole.deepest, 0.1 * 700.0 * 0.30 / (0.35e6 * 0.0275), 0.01);
    ground_free(&ground);
}

// a tilted sole digs in at its low end, and still carries exactly its load
TEST(tilted_sole_digs_in)
{
    Ground        ground = ground_make(60, 40, 0.01, wet());
    const BoxSole sole = {.length = 0.28, .width = 0.10, .pitch = 0.2};
    stand(&ground, sole, 700.0, DP_CONTACT_SOLE, 0.01, 0.01);
    CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 700.0 * 0.01, 1e-5);
    const int mid = 20 * 60 + 30;
    CHECK(ground.compression[mid - 13] > ground.compression[mid - 8]);
    CHECK(ground.compression[mid + 13] == 0.0f);
    CHECK(ground.imprint.ring[mid - 13] == 0 && ground.imprint.ring[mid + 13] == DP_RING_FAR);
    ground_free(&ground);
}

// stiff ground carries more of the load and yields no less: one sink for all
TEST(one_sink_for_the_sole)
{
    Ground ground = ground_make(60, 40, 0.01, wet());
    ground.soil[1].young_modulus *= 4.0f;
    for (int j = 20; j < 40; ++j)
        for (int i = 0; i < 60; ++i) ground.kind[j * 60 + i] = 1;
    ground_material(&ground);
    const BoxSole sole = {.length = 0.28, .width = 0.10};
    stand(&ground, sole, 700.0, DP_CONTACT_SOLE, 0.4, 0.01);
    const int low = 18 * 60 + 30, high = 21 * 60 + 30;
    CHECK_CLOSE(ground.compression[low], ground.compression[high], 1e-6);
    CHECK_CLOSE(4.0 * (double)ground.pressure_time[low], ground.pressure_time[high], 1e-5);
    CHECK_CLOSE(ground.compression[low], 700.0 * 0.30 / (0.35e6 * 2.5 * 0.028), 0.01);
    ground_free(&ground);
}

// under uniform stress each soil yields by its own stiffness
TEST(one_stress_for_all)
{
    Ground ground = ground_make(60, 40, 0.01, wet());
    ground.soil[1].young_modulus *= 4.0f;
    for (int j = 20; j < 40; ++j)
        for (int i = 0; i < 60; ++i) ground.kind[j * 60 + i] = 1;
    ground_material(&ground);
    stand(&ground, shoe, 100.0, DP_CONTACT_UNIFORM, 0.4, 0.01);
    const int low = 18 * 60 + 30, high = 21 * 60 + 30;
    CHECK_CLOSE(ground.compression[low], 4.0f * ground.compression[high], 1e-5);
    CHECK_CLOSE(ground.pressure_time[low], ground.pressure_time[high], 1e-5);
    ground_free(&ground);
}

// a second stance with the same load adds nothing; more load goes on from there. MODEL 6.6
TEST(same_load_again_adds_nothing)
{
    Ground ground = ground_make(60, 40, 0.01, wet());
    stand(&ground, shoe, 700.0, DP_CONTACT_SOLE, 0.3, 0.01);
    const DpPressed again = stand(&ground, shoe, 700.0, DP_CONTACT_SOLE, 0.3, 0.01);
    CHECK(again.firm < 1e-9);
    CHECK_CLOSE(again.area, 0.0275, 0.03);
    const DpPressed more = stand(&ground, shoe, 770.0, DP_CONTACT_SOLE, 0.3, 0.01);
    CHECK_CLOSE(more.deepest, 770.0 * 0.30 / (0.35e6 * 0.0275), 0.01);
    ground_free(&ground);
}

// lighter than before: the sole still balances, and nothing is pressed
TEST(rises_off_pressed_ground)
{
    Ground ground = ground_make(60, 40, 0.01, wet());
    stand(&ground, shoe, 700.0, DP_CONTACT_SOLE, 0.3, 0.01);
    const double    before = ground_sum(&ground, ground.pressure_time);
    const DpPressed p = stand(&ground, shoe, 350.0, DP_CONTACT_SOLE, 0.01, 0.01);
    CHECK(p.firm == 0.0);
    CHECK_NEAR(ground_sum(&ground, ground.pressure_time) - before, 3.5, 1e-3);
    CHECK_CLOSE(p.sink, 0.5 * ground_max(&ground, ground.compression), 1e-3);
    ground_free(&ground);
}

// loose heap goes first, firm ground after it
TEST(loose_before_firm)
{
    Ground ground = ground_make(60, 40, 0.01, wet());
    for (int k = 0; k < 60 * 40; ++k) ground.heap[k] = 0.004f;
    const BoxSole   sole = {.length = 0.20, .width = 0.10};
    const DpPressed first = stand(&ground, sole, 300.0, DP_CONTACT_SOLE, 0.01, 0.01);
    CHECK(first.loose > 0.0 && first.firm == 0.0);
    const DpPressed p = stand(&ground, sole, 300.0, DP_CONTACT_SOLE, 0.4, 0.01);
    CHECK_CLOSE(first.loose + p.loose, 0.004 * 0.02, 1e-5);
    CHECK_CLOSE(p.firm, 300.0 * 0.30 / 0.35e6, 1e-5);
    CHECK_CLOSE(first.displaced + p.displaced, 0.7 * (first.loose + p.loose + p.firm), 1e-6);
    ground_free(&ground);
}

// a load that no soft column can carry meets the rigid ground
TEST(rigid_below)
{
    for (int law = 0; law < 2; ++law) {
        Ground          ground = ground_make(60, 40, 0.01, wet());
        const DpPressed p = stand(&ground, shoe, 1e6, (DpContactLaw)law, 0.4, 0.01);
        CHECK_CLOSE(p.deepest, 0.95 * 0.30, 1e-5);
        if (law == DP_CONTACT_SOLE)
            CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 1e6 * 0.4, 1e-4);
        ground_free(&ground);
    }
}

// the first touch of an edge presses on no less than four cells
TEST(first_touch_is_finite)
{
    Ground          ground = ground_make(60, 40, 0.01, wet());
    const BoxSole   sole = {.x = 0.005, .length = 0.28, .width = 0.02, .pitch = 1.0};
    const DpPressed p = stand(&ground, sole, 2.0, DP_CONTACT_SOLE, 0.4, 0.01);
    CHECK(p.area > 0.0 && p.area < 4e-4);
    const double stress = ground_max(&ground, ground.pressure_time) / 0.4;
    CHECK(stress < 2.0 * 2.0 / 4e-4);
    ground_free(&ground);
}

// MODEL 11.6: cells of 4, 2, 1 cm and a sole that lies anywhere
TEST(cells_do_not_matter)
{
    const BoxSole sole = {.x = 0.0137, .y = -0.0071, .length = 0.28, .width = 0.10, .heading = 0.4};
    double        volume[3], depth[3];
    for (int k = 0; k < 3; ++k) {
        const double    cell = 0.04 / (1 << k);
        Ground          ground = ground_make(20 << k, 20 << k, cell, wet());
        const DpPressed p = stand(&ground, sole, 700.0, DP_CONTACT_SOLE, 0.3, 0.01);
        volume[k] = p.firm, depth[k] = p.deepest;
        ground_free(&ground);
    }
    for (int k = 0; k < 2; ++k) {
        CHECK_CLOSE(volume[k], volume[2], 0.03);
        CHECK_CLOSE(depth[k], depth[2], 0.03);
    }
}

// a sole of more cells than are kept ready at once is read again, with the same result
TEST(large_soles)
{
    for (int law = 0; law < 2; ++law) {
        Ground          ground = ground_make(100, 80, 0.01, wet());
        const BoxSole   sole = {.length = 0.80, .width = 0.60};
        const DpPressed p = stand(&ground, sole, 12000.0, (DpContactLaw)law, 0.2, 0.01);
        CHECK_CLOSE(p.area, 0.48, 1e-6);
        CHECK_CLOSE(p.deepest, 12000.0 * 0.30 / (0.35e6 * 0.48), 1e-5);
        CHECK_CLOSE(p.firm, 12000.0 * 0.30 / 0.35e6, 1e-5);
        CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 12000.0 * 0.2, 1e-5);
        ground_free(&ground);
    }
}

// no load, no sole, no ground under it: nothing happens
TEST(nothing_to_press)
{
    Ground ground = ground_make(20, 20, 0.02, wet());
    CHECK(stand(&ground, shoe, 0.0, DP_CONTACT_SOLE, 0.01, 0.01).area == 0.0);
    CHECK(stand(&ground, shoe, -5.0, DP_CONTACT_SOLE, 0.01, 0.01).area == 0.0);
    const BoxSole away = {.x = 9.0, .length = 0.1, .width = 0.1};
    CHECK(stand(&ground, away, 100.0, DP_CONTACT_SOLE, 0.01, 0.01).area == 0.0);
    for (int k = 0; k < 400; ++k) ground.base_height[k] = NAN;
    CHECK(stand(&ground, shoe, 100.0, DP_CONTACT_UNIFORM, 0.01, 0.01).area == 0.0);
    CHECK(ground_max(&ground, ground.compression) == 0.0);
    DpPressed         p;
    const DpFootForce foot = ground_load(1.0);
    CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, 0, 0.0, &p) == DP_BAD_ARGUMENT);
    CHECK(dp_soil_compress(NULL, &ground.imprint, &foot, 0, 0.1, &p) == DP_BAD_ARGUMENT);
    ground_free(&ground);
}

// MODEL 11.4: mirrored and turned input gives the same bits, mirrored and turned
TEST(mirrored_to_the_bit)
{
    enum
    {
        SIDE = 48
    };
    Ground g[4];
    for (int m = 0; m < 4; ++m) g[m] = ground_make(SIDE, SIDE, 0.01, wet());
    unsigned seed = 7;
    ground_sole(&g[0],
                (BoxSole){.x = 0.003, .length = 0.27, .width = 0.11, .heading = 0.3, .pitch = 0.1});
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const int   at[4] = {j * SIDE + i, j * SIDE + SIDE - 1 - i, (SIDE - 1 - j) * SIDE + i,
                                 i * SIDE + SIDE - 1 - j};
            const float rest = (float)(0.01 * check_random(&seed)),
                        heap = (float)(0.003 * check_random(&seed));
            for (int m = 0; m < 4; ++m) {
                g[m].base_height[at[m]] = rest, g[m].heap[at[m]] = heap;
                g[m].imprint.cover[at[m]] = g[0].imprint.cover[at[0]];
                g[m].imprint.bottom[at[m]] = g[0].imprint.bottom[at[0]];
                g[m].imprint.i0 = g[m].imprint.j0 = 0;
                g[m].imprint.i1 = g[m].imprint.j1 = SIDE;
            }
        }
    for (int law = 0; law < 2; ++law) {
        DpPressed p[4];
        for (int step = 0; step < 10; ++step)
            for (int m = 0; m < 4; ++m) {
                const DpFootForce foot = ground_load(700.0 - 60.0 * step);
                g[m].patch.soils = g[m].soil;
                dp_soil_compress(&g[m].patch, &g[m].imprint, &foot, (DpContactLaw)law, 0.01, &p[m]);
            }
        for (int m = 1; m < 4; ++m) {
            CHECK(p[m].displaced == p[0].displaced && p[m].sink == p[0].sink);
            int unlike = 0;
            for (int j = 0; j < SIDE; ++j)
                for (int i = 0; i < SIDE; ++i) {
                    const int at[4] = {j * SIDE + i, j * SIDE + SIDE - 1 - i,
                                       (SIDE - 1 - j) * SIDE + i, i * SIDE + SIDE - 1 - j};
                    unlike += g[m].compression[at[m]] != g[0].compression[at[0]];
                    unlike += g[m].pressure_time[at[m]] != g[0].pressure_time[at[0]];
                    unlike += g[m].imprint.ring[at[m]] != g[0].imprint.ring[at[0]];
                }
            CHECK(unlike == 0);
        }
    }
    CHECK(ground_max(&g[0], g[0].compression) > 0.01);
    for (int m = 0; m < 4; ++m) ground_free(&g[m]);
}

int main(void)
{
    RUN(flat_sole_is_trail_10);
    RUN(even_ground_is_exact);
    RUN(rigid_ground_is_a_hundred_times_as_hard);
    RUN(a_first_touch_is_no_needle);
    RUN(a_sole_smaller_than_that_carries_its_load);
    RUN(proportional);
    RUN(frame_rate_does_not_matter);
    RUN(yields_at_its_rate);
    RUN(tilted_sole_digs_in);
    RUN(one_sink_for_the_sole);
    RUN(one_stress_for_all);
    RUN(same_load_again_adds_nothing);
    RUN(rises_off_pressed_ground);
    RUN(loose_before_firm);
    RUN(rigid_below);
    RUN(first_touch_is_finite);
    RUN(cells_do_not_matter);
    RUN(large_soles);
    RUN(nothing_to_press);
    RUN(mirrored_to_the_bit);
    return check_done();
}
