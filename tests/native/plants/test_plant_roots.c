// Roots stand where the ground is.
#include "lawn.h"

TEST(roots_follow_the_ground)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 6, 6, 0.1, 3);
    float             height[30 * 30], at[84];
    DpPlantGround     ground = {
            .nx = 30, .ny = 30, .row = 30, .cell = 0.03, .x0 = -0.2, .y0 = -0.2, .height = height};
    DpPlantsReport told;
    for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 30; ++i) height[j * 30 + i] = (float)(0.3 * (-0.2 + 0.03 * i) - 0.1);
    CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    for (int pass = 0; pass < 2; ++pass) {  // asleep and whole, then after a push and a change
        for (int k = 0; k < 36; ++k) {
            dp_plants_read(plants, 0, k, at, NULL, NULL);
            for (int s = 0; s < 4; ++s) {
                const float* foot = at + 3 * (7 * s + 1);
                CHECK_NEAR(foot[2], 0.3 * (double)foot[0] - 0.1 - 0.02 * pass, 2e-4);
                CHECK_NEAR(foot[3 * 5 + 2] - foot[2], 0.10, 5e-4);
            }
        }
        if (pass) break;
        float speed[84] = {0};
        for (int p = 0; p < 28; ++p) speed[3 * p + 1] = p % 7 > 1 ? 0.3f : 0.0f;
        for (int k = 0; k < 36; ++k) dp_plants_write(plants, 0, k, NULL, speed, NULL);
        for (int f = 0; f < 300; ++f)
            CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
        CHECK(told.awake == 0);
        for (int k = 0; k < 900; ++k) height[k] -= 0.02f;
        CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    }
    for (int k = 0; k < 900; ++k) height[k] = NAN;  // no ground: nothing to follow
    CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    dp_plants_read(plants, 0, 0, at, NULL, NULL);
    CHECK(isfinite(at[2]));
    dp_plants_destroy(plants);
}

// limp plants lie asleep; where soil rose beside their roots, no particle stays below it
TEST(soil_that_rises_lifts_those_who_sleep)
{
    const DpPlantKind kind = dp_plant_kind_default();
    double            strength[20];
    DpPlants*         plants = dp_plants_create(3);
    const float       root[3] = {0.7f, -0.4f, 0.0f};
    float             height[40 * 40] = {0}, at[84], speed[84] = {0};
    int               stand = -1;
    DpPlantsReport    report = {0};
    DpPlantGround     ground = {
            .nx = 40, .ny = 40, .row = 40, .cell = 0.01, .x0 = 0.5, .y0 = -0.6, .height = height};
    CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_OK);
    for (int p = 0; p < 28; ++p) speed[3 * p] = p % 7 > 1 ? 0.5f : 0.0f;
    for (int b = 0; b < 20; ++b) strength[b] = b % 5 ? 0.1 : 0.0;
    CHECK(dp_plants_write(plants, 0, 0, NULL, speed, strength) == DP_OK);
    for (int k = 0; k < 900; ++k)
        CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &report) == DP_OK);
    CHECK(report.awake == 0);
    for (int k = 0; k < 1600; ++k)  // but for a hole of 6 cm around the root; it leans
        if (abs(k % 40 - 20) > 3 || abs(k / 40 - 20) > 3)
            height[k] = 0.05f + 0.004f * (float)(k % 40 - 20) - 0.002f * (float)(k / 40 - 20);
    ground.rose = true;
    CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    CHECK(dp_plants_read(plants, 0, 0, at, NULL, NULL) == DP_OK);
    int lifted = 0;
    for (int p = 0; p < 28; ++p) {
        const float *place = at + 3 * p, x = place[0] - root[0], y = place[1] - root[1];
        if (p % 7 < 2 || (fabsf(x) < 0.05f && fabsf(y) < 0.05f)) continue;
        CHECK(place[2] >= 0.05f + 0.4f * x - 0.2f * y - 1e-5f);
        ++lifted;
    }
    CHECK(lifted > 4);
    dp_plants_destroy(plants);
}

// each plant leans with the ground as it is told for it, no more than 45 degrees to a side
TEST(slopes_are_each_plants_own)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 5, 4, 0.3, 3);
    float             slope[2 * 20], at[84];
    for (int k = 0; k < 20; ++k) slope[2 * k] = 0.05f * (float)k, slope[2 * k + 1] = -0.3f;
    slope[14] = 3.0f, slope[17] = -1.5f;
    CHECK(dp_plants_slope(plants, 0, slope) == DP_OK);
    slope[39] = NAN;
    CHECK(dp_plants_slope(plants, 0, slope) == DP_BAD_ARGUMENT);  // and all is as it was
    CHECK(dp_plants_slope(plants, 1, slope) == DP_BAD_ARGUMENT);
    slope[39] = -0.3f;
    for (int k = 0; k < 20; ++k) {
        const double x = fmin((double)slope[2 * k], 1.0), y = fmax((double)slope[2 * k + 1], -1.0);
        CHECK(dp_plants_read(plants, 0, k, at, NULL, NULL) == DP_OK);
        for (int s = 0; s < 4; ++s) {
            const float* foot = at + 3 * (7 * s + 1);
            const double dx = (double)foot[0] - 0.3 * (k % 5), dy = (double)foot[1] - 0.3 * (k / 5);
            CHECK_NEAR(foot[2], x * dx + y * dy, 1e-6);
        }
    }
    dp_plants_destroy(plants);
}

// no bend is stronger than its plant's reserve, and what is refused changes nothing
TEST(strength_is_written_up_to_the_reserve)
{
    DpPlantKind kind = dp_plant_kind_default();
    DpPlants*   plants = lawn(&kind, 1, 1, 1.0, 3);
    const int   bends = dp_plant_shape(&kind).bends;
    double      strength[64], got[64];
    CHECK(bends <= 64);
    const double reserve = dp_plants_reserve(plants, 0, 0);
    CHECK_NEAR(reserve, kind.strength, 1e-6);
    for (int b = 0; b < bends; ++b) strength[b] = reserve * (b % 3) / 2.0;
    CHECK(dp_plants_write(plants, 0, 0, NULL, NULL, strength) == DP_OK);
    const double bad[] = {1.5 * reserve, 1.001 * reserve, -1e-6, (double)NAN};
    for (int n = 0; n < 4; ++n) {
        double other[64];
        for (int b = 0; b < bends; ++b) other[b] = b == bends - 1 ? bad[n] : 0.5 * reserve;
        CHECK(dp_plants_write(plants, 0, 0, NULL, NULL, other) == DP_BAD_ARGUMENT);
    }
    CHECK(dp_plants_read(plants, 0, 0, NULL, NULL, got) == DP_OK);
    for (int b = 0; b < bends; ++b) CHECK_NEAR(got[b], strength[b], 0.0);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(roots_follow_the_ground);
    RUN(soil_that_rises_lifts_those_who_sleep);
    RUN(slopes_are_each_plants_own);
    RUN(strength_is_written_up_to_the_reserve);
    return check_done();
}
