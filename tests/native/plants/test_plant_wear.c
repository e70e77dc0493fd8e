// what bending costs. TRAIL (6), MODEL 11.8
#include "lawn.h"

#define DEG (DP_PI / 180.0)

TEST(a_stem_held_at_30_degrees_loses_mu_t_and_breaks_at_nothing)
{
    const DpPlantKind kind = dp_plant_kind_default();
    const double      dts[4] = {1.0 / 240, 1.0 / 60, 1.0 / 24, 0.7};
    for (int d = 0; d < 4; ++d) {
        double strength = 0.1, broke_at = -1.0;
        for (int k = 1; k * dts[d] < 1.6; ++k) {
            strength = dp_plant_wear(&kind, 0.1, strength, 30.0 * DEG, dts[d]);
            const double left = 0.1 - 0.1 * k * dts[d];
            CHECK_NEAR(strength, left > 0.0 ? left : 0.0, 1e-8);
            if (strength <= 0.0 && broke_at < 0.0) broke_at = k * dts[d];
        }
        CHECK(broke_at >= 1.0 - 1e-6 && broke_at < 1.0 + dts[d] + 1e-6);
        CHECK_NEAR(dp_plant_wear(&kind, 0.1, strength, 0.0, 100.0), 0.0, 0.0);  // stays broken
    }
}

TEST(recovers_linearly_up_to_its_maximum)
{
    const DpPlantKind kind = dp_plant_kind_default();
    double            strength = 0.02;
    for (int k = 1; k <= 120; ++k) {
        strength = dp_plant_wear(&kind, 0.1, strength, 5.0 * DEG, 1.0 / 60);
        CHECK_NEAR(strength, fmin(0.02 + 0.1 * k / 60.0, 0.1), 1e-8);
    }
    CHECK_NEAR(dp_plant_wear(&kind, 0.1, 0.1, 71.0 * DEG, 1e-9), 0.0, 0.0);
    CHECK(dp_plant_wear(&kind, 0.1, 0.1, 69.0 * DEG, 1e-9) > 0.0999);
    CHECK(dp_plant_wear(&kind, 0.1, 0.05, 9.9 * DEG, 0.01) > 0.05);
    CHECK(dp_plant_wear(&kind, 0.1, 0.05, 10.1 * DEG, 0.01) < 0.05);
}

// the same in a stand: a stem that is put back at 30 degrees before each of many short steps
static double held(double dt, double seconds, double* strongest)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.width = 0.0f, kind.spread = 0.8f, kind.strength = 0.3f;
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 21);
    float     at[21], still[21] = {0};
    double    strength[5];
    for (double t = 0.5 * dt; t < seconds; t += dt) {
        for (int r = 0; r < 7; ++r) {
            const double along = 0.02 * fmax(r - 1.0, 0.0);
            at[3 * r] = (float)(sin(30 * DEG) * along), at[3 * r + 1] = 0.0f;
            at[3 * r + 2] = (float)(r < 1 ? -0.02 : cos(30 * DEG) * along);
        }
        dp_plants_write(plants, 0, 0, at, still, NULL);
        step(plants, NULL, 0, dt);
    }
    dp_plants_read(plants, 0, 0, NULL, NULL, strength);
    *strongest = dp_plants_reserve(plants, 0, 0);
    dp_plants_destroy(plants);
    return strength[0];
}

TEST(a_stand_wears_as_one_bend_does)
{
    double       reserve = 0.0;
    const double left = held(1.0 / 480, 0.5, &reserve);
    CHECK(fabs(reserve - 0.3) > 1e-3);  // its own reserve
    CHECK_NEAR(left, reserve - 0.1 * 0.5, 0.1 / 480 + 1e-6);
}

TEST(sleepers_recover_exactly_what_their_time_gives)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.recover_rate = (float)(0.02 / 86400.0);  // a day is a fifth of the reserve
    DpPlants* plants = lawn(&kind, 1, 1, 1.0, 1);
    double    strength[20], now[20];
    for (int b = 0; b < 20; ++b) strength[b] = b > 15 ? 0.0 : 0.01 + 0.001 * b;
    dp_plants_write(plants, 0, 0, NULL, NULL, strength);
    DpPlantsReport told = {0};
    double         time = 0.0;
    for (int f = 0; f < 600; ++f) {  // falls asleep on the way
        CHECK(dp_plants_step(plants, NULL, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
        time += 1.0 / 60;
    }
    CHECK(told.awake == 0);
    CHECK(dp_plants_advance_time(plants, 86400.0) == DP_OK);
    time += 86400.0;
    const double rate = (double)kind.recover_rate;
    for (int again = 0; again < 2; ++again) {
        dp_plants_read(plants, 0, 0, NULL, NULL, now);
        for (int b = 0; b < 20; ++b)
            CHECK_NEAR(now[b], b > 15 ? 0.0 : fmin(strength[b] + rate * time, 0.1), 1e-9);
        dp_plants_write(plants, 0, 0, NULL, NULL, NULL);  // waking tells the same
    }
    dp_plants_advance_time(plants, 86400.0 * 30);
    dp_plants_read(plants, 0, 0, NULL, NULL, now);
    CHECK_NEAR(now[0], 0.1, 1e-8);
    dp_plants_destroy(plants);
}

TEST(frames_a_second_do_not_matter)
{
    double alpha[2];
    for (int r = 0; r < 2; ++r) {
        const double rate = r ? 60.0 : 30.0;
        DpPlantKind  kind = dp_plant_kind_default();
        kind.break_angle = 10.0f, kind.spread = 1.0f;  // wears only
        DpPlants* plants = lawn(&kind, 10, 5, 0.05, 5);
        float     bottom[SOLE_SIDE * SOLE_SIDE];
        for (int f = 0; f < (int)(3.0 * rate); ++f) {
            const double    z = f / rate < 2.4 ? 0.0 : 0.3;
            DpPlantCollider c = sole(bottom, 0.01, 0.25, 0.1, z, 0.28, 0.10, 0.0);
            step(plants, &c, 1, 1.0 / rate);
        }
        alpha[r] = 0.0;
        for (int k = 0; k < 50; ++k) alpha[r] += dp_plants_alpha(plants, 0, k) / 50;
        dp_plants_destroy(plants);
    }
    CHECK(alpha[0] < 0.97 && alpha[0] > 0.5);
    printf("    alpha %.4f at 30 Hz, %.4f at 60 Hz\n", alpha[0], alpha[1]);
    CHECK_NEAR(alpha[0], alpha[1], 0.03);
}

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
    RUN(a_stem_held_at_30_degrees_loses_mu_t_and_breaks_at_nothing);
    RUN(recovers_linearly_up_to_its_maximum);
    RUN(a_stand_wears_as_one_bend_does);
    RUN(sleepers_recover_exactly_what_their_time_gives);
    RUN(frames_a_second_do_not_matter);
    RUN(regrowth_is_logistic);
    RUN(bare_ground_grows_again_from_around);
    RUN(stands_grow_again_side_by_side);
    return check_done();
}
