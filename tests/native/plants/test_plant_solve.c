// plants bend and come back. TRAIL (5)
#include "lawn.h"

// a stem bent evenly by `angle` at each bend, towards +x
static void bend(DpPlants* plants, const DpPlantKind* kind, int plant, double angle)
{
    const DpPlantShape shape = dp_plant_shape(kind);
    const double       gap = (double)kind->height / (shape.rows - 2);
    float*             at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    float*             still = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    dp_plants_read(plants, 0, plant, at, NULL, NULL);
    for (int stem = 0; stem < shape.stems; ++stem)
        for (int r = 2; r < shape.rows; ++r) {
            float* p = at + 3 * (stem * shape.rows + r);
            p[0] = p[-3] + (float)(gap * sin(angle * (r - 1)));
            p[1] = p[-2];
            p[2] = p[-1] + (float)(gap * cos(angle * (r - 1)));
        }
    CHECK(dp_plants_write(plants, 0, plant, at, still, NULL) == DP_OK);
    dp_free(at), dp_free(still);
}

TEST(comes_back_to_its_rest_shape)
{
    const double dts[3] = {1.0 / 60, 1.0 / 24, 1.0 / 240};
    for (int form = 0; form < 2; ++form)
        for (int d = 0; d < 3; ++d) {
            DpPlantKind kind = dp_plant_kind_default();
            kind.form = form;
            kind.sheets = 2 + form;
            DpPlants* plants = lawn(&kind, 3, 1, 0.5, 4);
            for (int k = 0; k < 3; ++k) bend(plants, &kind, k, (3.0 + 3.0 * k) * DP_PI / 180);
            CHECK(strain_of(plants, &kind, 3).away > 0.01);
            for (double t = 0.0; t < 4.0; t += dts[d]) step(plants, NULL, 0, dts[d]);
            const Strain s = strain_of(plants, &kind, 3);
            CHECK(s.away < 0.01 * (double)kind.height);
            CHECK_NEAR(s.stem, 1.0, 0.01);
            CHECK_NEAR(dp_plants_alpha(plants, 0, 2), 1.0, 0.0);
            dp_plants_destroy(plants);
        }
}

TEST(curled_kinds_come_back_too)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.form = DP_PLANT_TUFT;
    kind.curl = 0.15f;
    const DpPlantShape shape = dp_plant_shape(&kind);
    DpPlants*          plants = lawn(&kind, 1, 1, 0.5, 4);
    float*             rest = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    float*             at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    float*             speed = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    dp_plants_read(plants, 0, 0, rest, NULL, NULL);
    for (int p = 0; p < shape.particles; ++p)
        if (p % shape.rows > 1) speed[3 * p] = 0.5f, speed[3 * p + 1] = -0.2f;
    dp_plants_write(plants, 0, 0, NULL, speed, NULL);
    double most = 0.0, left = 0.0;
    for (int f = 0; f < 240; ++f) {
        step(plants, NULL, 0, 1.0 / 60);
        dp_plants_read(plants, 0, 0, at, NULL, NULL);
        left = 0.0;
        for (int c = 0; c < 3 * shape.particles; ++c)
            left = fmax(left, fabs((double)(at[c] - rest[c])));
        most = fmax(most, left);
    }
    CHECK(most > 0.01);
    CHECK(left < 0.01 * (double)kind.height);
    dp_free(rest), dp_free(at), dp_free(speed);
    dp_plants_destroy(plants);
}

// time between two passages of the tip through the middle, one way
TEST(sways_at_its_frequency)
{
    const double dts[2] = {1.0 / 60, 1.0 / 240};
    for (int d = 0; d < 2; ++d) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.damping = 0.0f, kind.width = 0.0f;  // a single stem
        DpPlants* plants = lawn(&kind, 1, 1, 1.0, 2);
        bend(plants, &kind, 0, 2.0 * DP_PI / 180);
        double was = 1.0, first = -1.0, last = -1.0;
        int    passages = 0;
        for (double t = 0.0; t < 1.5; t += dts[d]) {
            float at[3 * 7];
            step(plants, NULL, 0, dts[d]);
            dp_plants_read(plants, 0, 0, at, NULL, NULL);
            const double x = (double)(at[18] - at[0]);
            if (was < 0.0 && x >= 0.0) {
                if (first < 0.0)
                    first = t;
                else
                    last = t, ++passages;
            }
            was = x;
        }
        CHECK(passages >= 2);
        // a chain that is held at its foot swings a tenth slower than a mass on one spring
        CHECK_NEAR(passages / (last - first) / (double)kind.sway, 0.895, 0.015);
        dp_plants_destroy(plants);
    }
}

TEST(limp_stems_fall_and_lie)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 1, 1, 1.0, 2);
    double            broken[20] = {0};
    float             at[84], push[84] = {0};
    for (int p = 0; p < 28; ++p) push[3 * p] = p % 7 > 1 ? 0.3f : 0.0f;
    dp_plants_write(plants, 0, 0, NULL, push, broken);
    for (int f = 0; f < 240; ++f) step(plants, NULL, 0, 1.0 / 60);
    dp_plants_read(plants, 0, 0, at, NULL, NULL);
    for (int s = 0; s < 4; ++s) CHECK(at[3 * (7 * s + 6) + 2] < 0.01f);
    const Strain strain = strain_of(plants, &kind, 1);
    CHECK(strain.lowest >= -1e-6);
    CHECK(strain.stem < 1.05);
    CHECK(dp_plants_alpha(plants, 0, 0) <= 0.0);
    dp_plants_destroy(plants);
}

TEST(odd_plants_and_long_steps_stay_numbers)
{
    for (int odd = 0; odd < 4; ++odd) {
        DpPlantKind kind = dp_plant_kind_default();
        if (odd == 0) kind.height = 0.0f;
        if (odd == 1) kind.width = 0.0f;
        if (odd == 2) kind.height = kind.width = kind.radius = 0.0f;
        if (odd == 3) kind.sway = 1000.0f, kind.across = 10000.0f;
        CHECK(dp_plant_kind_check(&kind, NULL) == DP_OK);
        DpPlants* plants = lawn(&kind, 5, 5, 0.05, 2);
        float     bottom[SOLE_SIDE * SOLE_SIDE];
        for (int f = 0; f < 40; ++f) {  // a foot that is now here, now there, or far away
            DpPlantCollider c = sole(bottom, 0.01, f % 3 == 0 ? 0.1 : 0.02 * f, 0.1,
                                     f % 5 == 0 ? 0.05 : 0.0, 0.28, 0.1, 0.0);
            c.velocity = dp_vec3(f % 7 == 0 ? 500.0 : 0.0, 0.0, f % 4 == 0 ? -80.0 : 0.0);
            step(plants, &c, f % 9 != 8, f % 2 ? 1.0 : 1.0 / 60);
            CHECK(strain_of(plants, &kind, 25).finite);
        }
        for (int f = 0; f < 5; ++f) step(plants, NULL, 0, 1.0);
        CHECK(strain_of(plants, &kind, 25).finite);
        CHECK(strain_of(plants, &kind, 25).lowest >= -1e-6);
        dp_plants_destroy(plants);
    }
}

int main(void)
{
    RUN(comes_back_to_its_rest_shape);
    RUN(curled_kinds_come_back_too);
    RUN(sways_at_its_frequency);
    RUN(limp_stems_fall_and_lie);
    RUN(odd_plants_and_long_steps_stay_numbers);
    return check_done();
}
