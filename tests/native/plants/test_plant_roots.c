// Where plants stand, how far they reach, what each is given, and how one is read and written.
#include "plants/lawn.h"

TEST(reserves_are_those_that_plants_are_given)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.2f, kind.spread = 1.5f;
    DpPlants* plants = lawn(&kind, 5, 5, 0.1, 7);
    float     z[25];
    for (int k = 0; k < 25; ++k) z[k] = 0.5f * (float)(k - 12) / 12.0f;
    CHECK(dp_plants_vary(plants, 0, z) == DP_OK);
    for (int k = 0; k < 25; ++k)
        CHECK_CLOSE(dp_plants_reserve(plants, 0, k),
                    (double)kind.strength * exp(1.5 * (double)z[k]), 1e-6);
    const double kept = dp_plants_reserve(plants, 0, 3);
    const float  was = z[3];
    for (int turn = 0; turn < 2; ++turn) {
        z[3] = turn ? NAN : 8.1f;
        CHECK(dp_plants_vary(plants, 0, z) == DP_BAD_ARGUMENT);
        CHECK(dp_plants_reserve(plants, 0, 3) == kept);
    }
    z[3] = was;
    CHECK(dp_plants_vary(plants, 1, z) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_vary(plants, -1, z) == DP_BAD_ARGUMENT);
    double strength[64];
    CHECK(dp_plants_read(plants, 0, 3, NULL, NULL, strength) == DP_OK);
    CHECK(strength[0] == kept);
    CHECK(dp_plants_write(plants, 0, 3, NULL, NULL, strength) == DP_OK);
    CHECK(dp_plants_vary(plants, 0, z) == DP_BAD_ARGUMENT);  // somebody has trodden here
    CHECK(dp_plants_reserve(plants, 0, 25) == 0.0);
    dp_plants_destroy(plants);
}

// what is written is what is read, and the plant moves on from there
TEST(one_plant_reads_as_it_was_written)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 3, 3, 0.2, 1);
    const int         particles = dp_plants_shape(plants, 0).particles;
    float             at[3 * 64], speed[3 * 64] = {0}, got[3 * 64], moves[3 * 64];
    CHECK(particles <= 64);
    CHECK(dp_plants_read(plants, 0, 4, at, moves, NULL) == DP_OK);
    for (int p = 0; p < particles; ++p) {
        CHECK(moves[3 * p] == 0.0f);
        if (p % 7 < 2) continue;
        at[3 * p] += 0.01f, speed[3 * p + 1] = 0.2f;
    }
    CHECK(dp_plants_write(plants, 0, 4, at, speed, NULL) == DP_OK);
    CHECK(dp_plants_read(plants, 0, 4, got, moves, NULL) == DP_OK);
    for (int k = 0; k < 3 * particles; ++k) {
        CHECK_NEAR(got[k], at[k], 1e-6);
        CHECK(moves[k] == speed[k]);
    }
    step(plants, NULL, 0, 1.0 / 60.0);
    CHECK(dp_plants_read(plants, 0, 4, got, NULL, NULL) == DP_OK);
    CHECK(got[3 * 6 + 1] > at[3 * 6 + 1] + 5e-4f);  // a tip goes where it went
    CHECK(dp_plants_read(plants, 0, 9, got, NULL, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_read(plants, 1, 0, got, NULL, NULL) == DP_BAD_ARGUMENT);
    at[0] = NAN;
    CHECK(dp_plants_write(plants, 0, 4, at, NULL, NULL) == DP_BAD_ARGUMENT);
    speed[1] = 1e5f;
    CHECK(dp_plants_write(plants, 0, 4, NULL, speed, NULL) == DP_BAD_ARGUMENT);
    dp_plants_destroy(plants);
}

TEST(more_strength_than_a_reserve_is_refused)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 2, 1, 0.2, 1);
    const int         bends = dp_plants_shape(plants, 0).bends;
    double            strength[64], got[64];
    const double      reserve = dp_plants_reserve(plants, 0, 1);
    for (int b = 0; b < bends; ++b) strength[b] = reserve * b / bends;
    CHECK(dp_plants_write(plants, 0, 1, NULL, NULL, strength) == DP_OK);
    CHECK(dp_plants_read(plants, 0, 1, NULL, NULL, got) == DP_OK);
    for (int b = 0; b < bends; ++b) CHECK_NEAR(got[b], strength[b], 1e-15);
    CHECK(dp_plants_alpha(plants, 0, 1) < 1.0);  // the first bend is broken
    CHECK(dp_plants_alpha(plants, 0, 0) == 1.0);
    strength[0] = 1.01 * reserve;
    CHECK(dp_plants_write(plants, 0, 1, NULL, NULL, strength) == DP_BAD_ARGUMENT);
    strength[0] = -1e-9;
    CHECK(dp_plants_write(plants, 0, 1, NULL, NULL, strength) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_alpha(plants, 0, 2) == 0.0);
    dp_plants_destroy(plants);
}

// Stems of a sleeper that was bent go up and down with the ground, whole; a rim that rises on it lifts
// what would lie below.
TEST(bent_sleepers_rise_and_sink_whole)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.break_angle = kind.degrade_angle = 0.0f;  // what bends breaks, and lies where it fell
    DpPlants*     plants = lawn(&kind, 1, 1, 0.1, 3);
    const int     particles = dp_plants_shape(plants, 0).particles;
    float         height[40 * 40] = {0}, before[3 * 64], after[3 * 64], push[3 * 64] = {0};
    DpPlantGround ground = {
        .nx = 40, .ny = 40, .row = 40, .cell = 0.02, .x0 = -0.4, .y0 = -0.4, .height = height};
    DpPlantsReport report = {0};
    CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    for (int p = 0; p < particles; ++p) push[3 * p] = p % 7 > 1 ? 1.5f : 0.0f;
    CHECK(dp_plants_write(plants, 0, 0, NULL, push, NULL) == DP_OK);
    for (int f = 0; f < 900; ++f)
        CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &report) == DP_OK);
    CHECK(report.awake == 0);
    CHECK(dp_plants_read(plants, 0, 0, before, NULL, NULL) == DP_OK);
    CHECK(before[3 * 6 + 2] < 0.06f);  // it lies
    for (int k = 0; k < 1600; ++k) height[k] = -0.03f;
    CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    CHECK(dp_plants_read(plants, 0, 0, after, NULL, NULL) == DP_OK);
    for (int p = 0; p < particles; ++p) {
        CHECK_NEAR(after[3 * p + 2], before[3 * p + 2] - 0.03f, 1e-5);
        CHECK_NEAR(after[3 * p], before[3 * p], 1e-6);
    }
    dp_plants_destroy(plants);
}

TEST(reach_is_that_of_the_largest)
{
    DpPlantKind kind = dp_plant_kind_default(), high = kind;
    high.height = 0.3f, high.spacing = 0.03f, high.root_radius = 0.05f;
    DpPlants* plants = lawn(&kind, 2, 2, 0.1, 1);
    float     root[3] = {1.0f, 0.0f, 0.0f};
    int       name = -1;
    CHECK_NEAR(dp_plants_root_radius(plants), (double)kind.root_radius, 1e-7);
    const double small = dp_plants_extent(plants);
    CHECK(small >= (double)kind.height && small < 2.0 * (double)(kind.height + kind.width));
    CHECK(dp_plants_add(plants, &high, root, NULL, 1, &name) == DP_OK && name == 1);
    CHECK(dp_plants_extent(plants) >= 0.3);
    CHECK_NEAR(dp_plants_root_radius(plants), (double)kind.root_radius,
               1e-7);  // that of the others
    CHECK_NEAR(dp_plants_height(plants), 0.3, 1e-6);
    const float slope[2] = {NAN, 0.0f};
    CHECK(dp_plants_slope(plants, 1, slope) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_slope(plants, 2, slope) == DP_BAD_ARGUMENT);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(reserves_are_those_that_plants_are_given);
    RUN(one_plant_reads_as_it_was_written);
    RUN(more_strength_than_a_reserve_is_refused);
    RUN(bent_sleepers_rise_and_sink_whole);
    RUN(reach_is_that_of_the_largest);
    return check_done();
}
