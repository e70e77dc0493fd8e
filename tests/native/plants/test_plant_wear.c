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

TEST(above_a_broken_bend_nothing_wears_or_recovers)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.width = 0.0f;
    DpPlants*    plants = lawn(&kind, 1, 1, 1.0, 1);
    const double before[5] = {0.05, 0.1, 0.0, 0.05, 0.03};
    double       after[5];
    CHECK(dp_plants_write(plants, 0, 0, NULL, NULL, before) == DP_OK);
    for (int k = 0; k < 10; ++k) step(plants, NULL, 0, 0.02);
    CHECK(dp_plants_read(plants, 0, 0, NULL, NULL, after) == DP_OK);
    CHECK_NEAR(after[0], 0.05 + 0.1 * 0.2, 1e-9);
    CHECK_NEAR(after[2], 0.0, 0.0);
    CHECK_NEAR(after[3], 0.05, 0.0);
    CHECK_NEAR(after[4], 0.03, 0.0);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(a_stem_held_at_30_degrees_loses_mu_t_and_breaks_at_nothing);
    RUN(recovers_linearly_up_to_its_maximum);
    RUN(a_stand_wears_as_one_bend_does);
    RUN(frames_a_second_do_not_matter);
    RUN(above_a_broken_bend_nothing_wears_or_recovers);
    return check_done();
}
