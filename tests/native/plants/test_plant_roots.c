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
    DpPlants*         plants = lawn(&kind, 1, 1, 1.0, 3);
    float             height[40 * 40] = {0}, at[84], speed[84] = {0};
    DpPlantsReport    report = {0};
    DpPlantGround     ground = {
            .nx = 40, .ny = 40, .row = 40, .cell = 0.01, .x0 = -0.2, .y0 = -0.2, .height = height};
    for (int p = 0; p < 28; ++p) speed[3 * p] = p % 7 > 1 ? 0.5f : 0.0f;
    for (int b = 0; b < 20; ++b) strength[b] = b % 5 ? 0.1 : 0.0;
    CHECK(dp_plants_write(plants, 0, 0, NULL, speed, strength) == DP_OK);
    for (int k = 0; k < 900; ++k)
        CHECK(dp_plants_step(plants, &ground, NULL, 0, 1.0 / 60, 1, &report) == DP_OK);
    CHECK(report.awake == 0);
    for (int k = 0; k < 1600; ++k)  // but for a hole of 6 cm around the root
        if (abs(k % 40 - 20) > 3 || abs(k / 40 - 20) > 3) height[k] = 0.05f;
    ground.rose = true;
    CHECK(dp_plants_follow(plants, &ground) == DP_OK);
    CHECK(dp_plants_read(plants, 0, 0, at, NULL, NULL) == DP_OK);
    int lifted = 0;
    for (int p = 0; p < 28; ++p) {
        const float* place = at + 3 * p;
        if (p % 7 < 2 || (fabsf(place[0]) < 0.05f && fabsf(place[1]) < 0.05f)) continue;
        CHECK(place[2] >= 0.05f - 1e-5f);
        ++lifted;
    }
    CHECK(lifted > 4);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(roots_follow_the_ground);
    RUN(soil_that_rises_lifts_those_who_sleep);
    return check_done();
}
