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

int main(void)
{
    RUN(roots_follow_the_ground);
    return check_done();
}
