// What broke grows again: logistically, from around, stand beside stand. MODEL 11.8
#include "lawn.h"

TEST(regrowth_is_logistic)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.regrow_rate = (float)(1.02 / (365.25 * 86400));
    const double year = 365.25 * 86400;
    CHECK_NEAR(dp_plant_regrow(&kind, 0.863, year), 0.946, 0.002);
    CHECK_NEAR(dp_plant_regrow(&kind, 0.200, year), 0.409, 0.002);
    CHECK_NEAR(dp_plant_regrow(&kind, dp_plant_regrow(&kind, 0.4, 0.3 * year), 0.7 * year),
               dp_plant_regrow(&kind, 0.4, year), 1e-9);
    CHECK_NEAR(dp_plant_regrow(&kind, 0.0, year), 0.0, 0.0);
    CHECK_NEAR(dp_plant_regrow(&kind, 1.0, year), 1.0, 0.0);
    kind.seed_share = 0.3f;  // seeds come to bare ground, too: r (w + (1 - w) alpha) (1 - alpha)
    CHECK_NEAR(dp_plant_regrow(&kind, 0.0, 1e-3 * year), 0.3 * 1.02e-3, 1e-6);
    CHECK_NEAR(dp_plant_regrow(&kind, 0.5, 1e-3 * year), 0.5 + 0.65 * 0.5 * 1.02e-3, 1e-6);
    CHECK_NEAR(dp_plant_regrow(&kind, dp_plant_regrow(&kind, 0.0, 0.3 * year), 0.7 * year),
               dp_plant_regrow(&kind, 0.0, year), 1e-9);
    CHECK_NEAR(dp_plant_regrow(&kind, 1.0, year), 1.0, 0.0);
    kind.seed_share = 0.0f;

    // a stand does it stem by stem
    kind.root_radius = 0.3f, kind.full_density = 50.0f;
    DpPlants* plants = lawn(&kind, 40, 40, 0.1, 5);
    double    before = 0.0, after = 0.0, none[20] = {0};
    for (int k = 0; k < 1600; ++k)
        if (k * 7 % 10 < 6) dp_plants_write(plants, 0, k, NULL, NULL, none);
    for (int k = 0; k < 1600; ++k) before += dp_plants_alpha(plants, 0, k) / 1600;
    CHECK(dp_plants_advance_time(plants, year) == DP_OK);
    for (int k = 0; k < 1600; ++k) after += dp_plants_alpha(plants, 0, k) / 1600;
    CHECK_NEAR(before, 0.4, 1e-9);
    CHECK_NEAR(after, dp_plant_regrow(&kind, before, year), 0.02);
    // each stem by itself: of four that broke with a plant some are back
    int some = 0;
    for (int k = 0; k < 1600; ++k)
        some += dp_plants_alpha(plants, 0, k) > 0.0 && dp_plants_alpha(plants, 0, k) < 1.0;
    CHECK(some > 960 / 2);
    dp_plants_destroy(plants);
}

// a bare strip among whole plants grows as the stand around it does; a bare field stays bare
TEST(bare_ground_grows_again_from_around)
{
    const double year = 365.25 * 86400;
    double       none[20] = {0};
    for (int whole = 0; whole < 2; ++whole) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.regrow_rate = (float)(1.02 / year);
        DpPlants* plants = lawn(&kind, 40, 40, 0.1, 5);
        double    strip = 0.0;
        for (int k = 0; k < 1600; ++k)  // 0.4 m wide, wider than roots reach
            if (!whole || (k % 40 >= 18 && k % 40 < 22))
                dp_plants_write(plants, 0, k, NULL, NULL, none);
        CHECK(dp_plants_advance_time(plants, year) == DP_OK);
        for (int k = 0; k < 1600; ++k)
            if (k % 40 >= 18 && k % 40 < 22) strip += dp_plants_alpha(plants, 0, k) / 160;
        printf("  after a year %.2f\n", strip);
        CHECK(whole ? strip > 0.2 && strip < 0.9 : !(strip > 0.0));
        dp_plants_destroy(plants);
    }
}

// what grows anew stands where it grows, and still
TEST(what_grows_anew_stands_still)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.regrow_rate = 1.0f, kind.seed_share = 1.0f;
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 5);
    float     rest[84], at[84], speed[84], moved[84];
    double    none[20] = {0}, strength[20];
    CHECK(dp_plants_read(plants, 0, 0, rest, NULL, NULL) == DP_OK);
    for (int k = 0; k < 84; ++k) speed[k] = 0.5f, moved[k] = rest[k] + 0.02f;
    CHECK(dp_plants_write(plants, 0, 0, moved, speed, none) == DP_OK);
    CHECK(dp_plants_advance_time(plants, 1e4) == DP_OK);
    CHECK(dp_plants_read(plants, 0, 0, at, speed, strength) == DP_OK);
    CHECK_NEAR(dp_plants_alpha(plants, 0, 0), 1.0, 0.0);
    for (int k = 0; k < 84; ++k) {
        CHECK_NEAR(at[k], rest[k], 1e-7);
        CHECK(!(speed[k] > 0.0f || speed[k] < 0.0f));
    }
    for (int b = 0; b < 20; ++b) CHECK(strength[b] > 0.0);
    dp_plants_destroy(plants);
}

// kinds that share a ground grow at once: none finds the others grown already
TEST(stands_grow_again_side_by_side)
{
    const double year = 365.25 * 86400, none[20] = {0};
    DpPlantKind  kind = dp_plant_kind_default();
    kind.regrow_rate = (float)(1.02 / year), kind.root_radius = 0.3f, kind.full_density = 50.0f;
    DpPlants* plants = lawn(&kind, 40, 40, 0.1, 5);
    float*    root = dp_alloc(1600, 3 * sizeof(float));
    double    after[2] = {0.0, 0.0};
    int       stand = -1;
    for (int k = 0; k < 1600; ++k)
        root[3 * k] = 0.1f * (float)(k % 40) + 0.05f,
                 root[3 * k + 1] = 0.1f * (float)(k / 40) + 0.05f;
    CHECK(dp_plants_add(plants, &kind, root, NULL, 1600, &stand) == DP_OK);
    for (int k = 0; k < 3200; ++k)
        if (k % 1600 * 7 % 10 < 6) dp_plants_write(plants, k / 1600, k % 1600, NULL, NULL, none);
    CHECK(dp_plants_advance_time(plants, year) == DP_OK);
    for (int k = 0; k < 3200; ++k) after[k / 1600] += dp_plants_alpha(plants, k / 1600, k % 1600);
    CHECK_NEAR(after[0] / 1600, dp_plant_regrow(&kind, 0.4, year), 0.02);
    CHECK_NEAR(after[1] / 1600, dp_plant_regrow(&kind, 0.4, year), 0.02);
    dp_free(root);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(regrowth_is_logistic);
    RUN(bare_ground_grows_again_from_around);
    RUN(stands_grow_again_side_by_side);
    RUN(what_grows_anew_stands_still);
    return check_done();
}
