// tests of soil_crust.c: MODEL 6.12
#include "check.h"
#include "ground.h"
#include "soil/soil_columns.h"

#define NX 60
#define NY 40
#define CELL 0.01

static uint32_t plate[NX * NY];

static DpSoil crusted(void)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 2e5f, soil.layer_depth = 0.3f, soil.poisson_ratio = 0.1f;
    soil.crust_depth = 0.02f, soil.crust_strength = 3e5f;
    return soil;
}

// level ground on one piece of a crust, and a sole of 20 x 10 cells with its corner at cell (20, 15)
static Ground ground_with_crust(void)
{
    Ground ground = ground_make(NX, NY, CELL, crusted());
    for (int k = 0; k < NX * NY; ++k) plate[k] = 7u;
    ground.patch.plate = plate;
    ground_sole(&ground, (BoxSole){.length = 0.2, .width = 0.1});
    return ground;
}

static DpPressed press(Ground* ground, double load)
{
    const DpFootForce foot = ground_load(load);
    DpPressed         pressed;
    ground->patch.soils = ground->soil;
    CHECK(dp_soil_compress(&ground->patch, &ground->imprint, &foot, DP_CONTACT_SOLE, 0.25,
                           &pressed) == DP_OK);
    return pressed;
}

// Westergaard's own numbers are those of concrete, nu = 0.15: 0.316 P/h^2 (4 lg(l/b) + 1.069)
TEST(stress_is_westergaards)
{
    const DpSoil soil = crusted();
    const double h = 0.02, k = 2e5 / 0.3, load = 80.0, radius[2] = {0.05, 0.02};
    const double l = pow(3e8 * h * h * h / (12.0 * 0.91 * k), 0.25);
    for (int n = 0; n < 2; ++n) {
        const double a = radius[n], b = n == 0 ? a : sqrt(1.6 * a * a + h * h) - 0.675 * h;
        const double concrete = 0.316 * load / (h * h) * (4.0 * log10(l / b) + 1.069);
        const double found = dp_soil_crust_stress(&soil, load, DP_PI * a * a, k, false);
        CHECK_CLOSE(found * 1.15 / 1.3, concrete, 2e-3);
        CHECK_CLOSE(dp_soil_crust_stress(&soil, load, DP_PI * a * a, k, true), 2.0 * found, 1e-12);
    }
    CHECK_NEAR(dp_soil_crust_stress(&soil, load, 100.0, k, false), 0.0, 0.0);  // it does not bend
}

TEST(it_carries_to_the_load_that_bends_it_too_far)
{
    const DpSoil soil = crusted();
    const double most = 3e5 / dp_soil_crust_stress(&soil, 1.0, 0.02, 2e5 / 0.3, false);
    Ground       ground = ground_with_crust();
    DpPressed    pressed = press(&ground, 0.999 * most);
    CHECK_NEAR(ground_max(&ground, ground.compression), 0.0, 0.0);
    CHECK_CLOSE(pressed.area, 0.02, 1e-9);
    CHECK_NEAR(pressed.firm + pressed.displaced, 0.0, 0.0);
    CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 0.999 * most * 0.25, 1e-5);
    pressed = press(&ground, 1.001 * most);
    CHECK(pressed.firm > 0.0 && ground_max(&ground, ground.compression) > 0.0);
    ground_free(&ground);
}

// the half of the sole on a piece that is broken, wherever that was pressed, carries nothing, and its edge is free
TEST(beside_broken_pieces_it_carries_half_as_much)
{
    const DpSoil soil = crusted();
    const double most = 3e5 / dp_soil_crust_stress(&soil, 1.0, 0.01, 2e5 / 0.3, true);
    for (int n = 0; n < 4; ++n) {
        const bool far = n % 2, west = n / 2;
        Ground     ground = ground_with_crust();
        for (int k = 0; k < NX * NY; ++k) plate[k] = k % NX < NX / 2 ? 7u : 9u;
        const int at = far ? 45 : 35;  // beside the sole, or under it
        ground.compression[18 * NX + (west ? NX - 1 - at : at)] = 1e-3f;
        CHECK_CLOSE(press(&ground, 0.999 * most).area, 0.01, 1e-9);
        CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 0.999 * most * 0.25, 1e-5);
        for (int j = 15; j < 25; ++j)
            CHECK(ground.imprint.ring[j * NX + (west ? NX - 36 : 35)] != 0);
        CHECK(press(&ground, 1.001 * most).firm > 0.0);
        ground_free(&ground);
    }
}

// what hangs 1 cm over its lowest and more carries nothing, and what it covers in part by its share
TEST(a_sole_stands_on_what_is_lowest)
{
    const DpSoil soil = crusted();
    Ground       ground = ground_with_crust();
    ground_sole(&ground, (BoxSole){.length = 0.2, .width = 0.095, .z = 0.05, .pitch = 0.22});
    // its columns rise by 2.2 mm: five lie within 1 cm of the lowest; at both sides 0.75 of a cell is covered
    const double area = 5 * 9.5 * CELL * CELL;
    const double most = 3e5 / dp_soil_crust_stress(&soil, 1.0, area, 2e5 / 0.3, false);
    CHECK_CLOSE(press(&ground, 0.999 * most).area, area, 1e-9);
    const double first = (double)ground.pressure_time[15 * NX + 20];
    CHECK_CLOSE(
        first,
        (double)ground.imprint.cover[15 * NX + 20] * (double)ground.pressure_time[18 * NX + 20],
        1e-5);
    CHECK(ground.imprint.cover[15 * NX + 20] < 0.9f);
    CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 0.999 * most * 0.25, 1e-5);
    CHECK_NEAR(ground.pressure_time[18 * NX + 30], 0.0, 0.0);
    ground_free(&ground);
}

// A piece of 20 x 10 cells whose left half was pressed to `deep`: the right half hangs at its far edge.
static Ground tilted(uint32_t name, double deep, DpPressed* pressed)
{
    Ground ground = ground_with_crust();
    for (int k = 0; k < NX * NY; ++k) {
        const int i = k % NX, j = k / NX;
        plate[k] = i >= 20 && i < 40 && j >= 15 && j < 25 ? name : 3u;
        const bool under = i >= 20 && i < 30 && j >= 15 && j < 25;
        ground.imprint.ring[k] = under ? 0 : DP_RING_FAR;
        ground.imprint.cover[k] = under ? 1.0f : 0.0f;
        ground.compression[k] = under ? (float)deep : 0.0f;
    }
    ground.imprint.i0 = 20, ground.imprint.i1 = 30;
    ground.imprint.j0 = 15, ground.imprint.j1 = 25;
    ground.patch.soils = ground.soil;
    *pressed = (DpPressed){.deepest = 1e-3};
    dp_crust_tilt(&ground.patch, &ground.imprint, pressed);
    return ground;
}

TEST(a_broken_piece_tilts_into_the_print)
{
    const uint32_t name[3] = {1u, 0x80000000u, 0xFFFFFFFFu};  // chance 0, a half, 1
    const double   slope[3] = {0.15, 0.45, 0.75}, deep = 0.03;
    for (int n = 0; n < 3; ++n) {
        DpPressed    pressed;
        Ground       ground = tilted(name[n], deep, &pressed);
        const double inner = fmin(deep, slope[n] * 10 * CELL);
        double       firm = 0.0;
        for (int j = 0; j < NY; ++j)
            for (int i = 0; i < NX; ++i) {
                const bool   piece = i >= 20 && i < 40 && j >= 15 && j < 25;
                const double want = !piece ? 0.0 : i < 30 ? deep : inner * (39.5 - i) / 10.0;
                CHECK_NEAR(ground.compression[j * NX + i], want, 1e-6);
                if (i >= 30) firm += (double)ground.compression[j * NX + i];
            }
        CHECK_CLOSE(pressed.firm, firm, 1e-6);
        CHECK_CLOSE(pressed.displaced, 2.0 * 0.1 * firm, 1e-6);
        CHECK_NEAR(pressed.deepest, 1e-3, 0.0);  // that is of the sole
        ground_free(&ground);
    }
}

int main(void)
{
    RUN(stress_is_westergaards);
    RUN(it_carries_to_the_load_that_bends_it_too_far);
    RUN(beside_broken_pieces_it_carries_half_as_much);
    RUN(a_sole_stands_on_what_is_lowest);
    RUN(a_broken_piece_tilts_into_the_print);
    return check_done();
}
