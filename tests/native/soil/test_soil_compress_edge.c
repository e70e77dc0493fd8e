// tests of soil_compress.c: soles over an edge, over a step, over what they have heaped, of many columns and of
// tall ones. TRAIL (10)
#include "check.h"
#include "ground.h"

static DpSoil firm(void)
{
    DpSoil soil = dp_soil_default();
    soil.young_modulus = 0.5e6f, soil.poisson_ratio = 0.35f;
    soil.settle_time = 0.1f, soil.rest_angle = 0.5f;
    return soil;
}

// a sole with half of it over no ground is as deep as a whole one, and what is left of it gets no more
TEST(over_an_edge)
{
    const BoxSole flat = {.length = 0.24, .width = 0.10};
    const DpSoil  soil = firm();
    for (int law = 0; law < 2; ++law)
        for (int tilted = 0; tilted < 2; ++tilted) {
            Ground  whole = ground_make(50, 40, 0.01, soil), half = ground_make(50, 40, 0.01, soil);
            BoxSole sole = flat;
            DpPressed on_whole, on_half;
            for (int j = 0; j < 40; ++j)
                for (int i = 25; i < 50; ++i) half.base_height[j * 50 + i] = NAN;
            sole.pitch = tilted ? -0.1 : 0.0;  // its front, over no ground, is the lower end
            ground_sole(&whole, sole), ground_sole(&half, sole);
            const DpFootForce foot = ground_load(700.0);
            CHECK(dp_soil_compress(&whole.patch, &whole.imprint, &foot, (DpContactLaw)law, 1.0,
                                   &on_whole) == DP_OK);
            CHECK(dp_soil_compress(&half.patch, &half.imprint, &foot, (DpContactLaw)law, 1.0,
                                   &on_half) == DP_OK);
            for (int j = 0; j < 40; ++j)
                for (int i = 0; i < 25; ++i)
                    CHECK_CLOSE(half.compression[j * 50 + i], whole.compression[j * 50 + i], 1e-6);
            for (int k = 0; k < 2000; ++k)
                CHECK(!isnan(half.base_height[k]) || half.compression[k] == 0.0f);
            CHECK(on_whole.deepest > 0.005);
            CHECK_CLOSE(on_half.area, on_whole.area, 1e-9);
            if (!tilted) CHECK_CLOSE(on_half.firm, 0.5 * on_whole.firm, 1e-9);
            ground_free(&whole), ground_free(&half);
        }
}

// lower ground beside a step carries nothing: what stands on the step goes as much deeper as it is less
TEST(over_a_step)
{
    const DpSoil soil = firm();
    for (int law = 0; law < 2; ++law)
        for (int from = 17; from <= 25; from += 4) {
            Ground whole = ground_make(50, 40, 0.01, soil), step = ground_make(50, 40, 0.01, soil);
            DpPressed on_whole, on_step;
            for (int j = 0; j < 40; ++j)
                for (int i = from; i < 50; ++i) step.base_height[j * 50 + i] = -0.3f;
            ground_sole(&whole, (BoxSole){.length = 0.24, .width = 0.10});
            ground_sole(&step, (BoxSole){.length = 0.24, .width = 0.10});
            const DpFootForce foot = ground_load(700.0);
            CHECK(dp_soil_compress(&whole.patch, &whole.imprint, &foot, (DpContactLaw)law, 1.0,
                                   &on_whole) == DP_OK);
            CHECK(dp_soil_compress(&step.patch, &step.imprint, &foot, (DpContactLaw)law, 1.0,
                                   &on_step) == DP_OK);
            CHECK(on_step.area < 0.6 * on_whole.area && on_step.deepest > 1.6 * on_whole.deepest);
            CHECK_CLOSE(on_step.deepest * on_step.area, on_whole.deepest * on_whole.area, 1e-5);
            CHECK_CLOSE(on_step.firm, on_whole.firm, 1e-5);
            for (int j = 0; j < 40; ++j)
                for (int i = from; i < 50; ++i) CHECK(step.compression[j * 50 + i] == 0.0f);
            ground_free(&whole), ground_free(&step);
        }
}

// `uniform` asks where the body meets the ground that was there before it came
TEST(met_ground_counts)
{
    const DpSoil soil = firm();
    Ground       ground = ground_make(50, 40, 0.01, soil);
    float        met[2000] = {0.0f};
    ground_sole(&ground, (BoxSole){.length = 0.24, .width = 0.10});
    DpPressed         fresh, now;
    const DpFootForce foot = ground_load(700.0);
    CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, DP_CONTACT_UNIFORM, 0.02,
                           &fresh) == DP_OK);
    for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 50; ++i)
            if (i < 20) ground.heap[j * 50 + i] += 0.03f;  // its own rim falls under the sole
    CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, DP_CONTACT_UNIFORM, 0.02, &now) ==
          DP_OK);
    CHECK(now.area < 0.5 * fresh.area);
    ground.imprint.met = met;
    CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, DP_CONTACT_UNIFORM, 0.02, &now) ==
          DP_OK);
    CHECK_CLOSE(now.area, fresh.area, 1e-9);
    ground_free(&ground);
}

// the load is carried by what its sum can tell, so that a sole of many columns needs few rounds, as one of few does
TEST(many_columns_do_not_take_longer)
{
    const DpSoil snow = {.layer_depth = 0.5f,
                         .settle_time = 0.1f,
                         .rest_angle = 0.5f,
                         .snow_density = 150.0f,
                         .young_modulus = 0.3e6f,
                         .wall_angle = 1.5707964f};
    DpSoil       sand = dp_soil_default();
    sand.young_modulus = 0.6e6f;
    for (int law = 0; law < 2; ++law)
        for (int k = 0; k < 24; ++k) {  // rolls over its ball
            const double cell = k % 2 ? 0.01 : 0.004;
            const int    nx = (int)(0.36 / cell), ny = (int)(0.16 / cell);
            Ground       ground = ground_make(nx, ny, cell, law ? snow : sand);
            DpPressed    pressed;
            ground_sole(&ground, (BoxSole){.length = 0.28, .width = 0.1, .pitch = -0.02 * (k - 6)});
            const DpFootForce foot = ground_load(600.0 + 11.0 * k);
            CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, DP_CONTACT_SOLE, 1.0,
                                   &pressed) == DP_OK);
            CHECK(pressed.rounds > 0 && pressed.rounds <= 40);
            CHECK_CLOSE(ground_sum(&ground, ground.pressure_time), 600.0 + 11.0 * k, 1e-5);
            ground_free(&ground);
        }
}

// what reaches up by more than a metre: the lower part alone carries
TEST(tall_soles_stand_on_what_is_low)
{
    Ground    ground = ground_make(50, 40, 0.01, dp_soil_default());
    DpPressed pressed, low;
    ground_sole(&ground, (BoxSole){.length = 0.24, .width = 0.10});
    const DpFootForce foot = ground_load(700.0);
    for (int j = 0; j < 40; ++j)
        for (int i = 20; i < 50; ++i)
            if (ground.imprint.cover[j * 50 + i] > 0.0f) ground.imprint.bottom[j * 50 + i] = 9.0f;
    CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, DP_CONTACT_SOLE, 10.0,
                           &pressed) == DP_OK);
    ground_free(&ground);
    ground = ground_make(50, 40, 0.01, dp_soil_default());
    ground_sole(&ground, (BoxSole){.x = -0.085, .length = 0.07, .width = 0.10});
    CHECK(dp_soil_compress(&ground.patch, &ground.imprint, &foot, DP_CONTACT_SOLE, 10.0, &low) ==
          DP_OK);
    CHECK_CLOSE(pressed.area, low.area, 1e-6);
    CHECK_CLOSE(pressed.deepest, low.deepest, 1e-6);
    ground_free(&ground);
}

int main(void)
{
    RUN(many_columns_do_not_take_longer);
    RUN(tall_soles_stand_on_what_is_low);
    RUN(over_an_edge);
    RUN(over_a_step);
    RUN(met_ground_counts);
    return check_done();
}
