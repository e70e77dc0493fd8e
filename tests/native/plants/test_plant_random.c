// Chances that hang on names alone: evenly spread, and the same whoever asks.
#include "lawn.h"
#include "plants/plant_inside.h"

TEST(reserves_spread_as_told)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.spread = 1.3f;
    DpPlants *a = lawn(&kind, 60, 50, 0.1, 11), *b = lawn(&kind, 60, 50, 0.1, 12);
    double    sum = 0.0, squares = 0.0;
    int       same = 0, near = 0, far = 0;
    for (int k = 0; k < 3000; ++k) {
        const double z = log(dp_plants_reserve(a, 0, k) / 0.1);
        sum += z, squares += z * z;
        near += fabs(z)<0.25 * 1.3, far += fabs(z)> 2.0 * 1.3;
        same += fabs(z - log(dp_plants_reserve(b, 0, k) / 0.1)) < 1e-9;
    }
    CHECK_NEAR(sum / 3000, 0.0, 0.1);
    CHECK_NEAR(sqrt(squares / 3000), 1.3, 0.1);
    // (1 + t) exp(-t) are farther out than t^2 / sqrt(120): t = 1.655 and 4.681
    CHECK_NEAR(near / 3000.0, 1.0 - 2.655 * exp(-1.655), 0.03);
    CHECK_NEAR(far / 3000.0, 5.681 * exp(-4.681), 0.012);
    CHECK(same == 0);

    // or as told, in the order in which they were planted, until somebody treads on them
    float z[3000];
    for (int k = 0; k < 3000; ++k) z[k] = (float)(k % 7 - 3);
    CHECK(dp_plants_vary(a, 0, z) == DP_OK);
    for (int k = 0; k < 3000; ++k)
        CHECK_NEAR(dp_plants_reserve(a, 0, k), 0.1 * exp(1.3 * (double)z[k]), 1e-5);
    CHECK(dp_plants_vary(a, 1, z) == DP_BAD_ARGUMENT && dp_plants_vary(a, 0, NULL) != DP_OK);
    CHECK(dp_plants_write(a, 0, 5, NULL, NULL, NULL) == DP_OK);
    CHECK(dp_plants_vary(a, 0, z) == DP_BAD_ARGUMENT);
    z[9] = NAN;
    CHECK(dp_plants_vary(b, 0, z) == DP_BAD_ARGUMENT);
    dp_plants_destroy(a), dp_plants_destroy(b);
}

TEST(chances_are_even_and_names_go_by_place)
{
    double sum = 0.0, squares = 0.0, pairs = 0.0, was = 0.5;
    for (uint64_t k = 0; k < 20000; ++k) {
        const double chance = dp_plant_hash(7, k / 100, k % 100);
        CHECK(chance >= 0.0 && chance < 1.0 && fabs(dp_plant_vigour(7, k, 1)) <= 8.0);
        sum += chance, squares += chance * chance, pairs += (chance - 0.5) * (was - 0.5);
        was = chance;
    }
    CHECK_NEAR(sum / 20000, 0.5, 0.01);
    CHECK_NEAR(squares / 20000, 1.0 / 3, 0.01);
    CHECK_NEAR(pairs / 20000, 0.0, 0.003);
    CHECK(dp_plant_hash(7, 1, 2) != dp_plant_hash(7, 2, 1));
    CHECK(dp_plant_hash(7, 1, 2) != dp_plant_hash(8, 1, 2));
    CHECK(dp_plant_name(-0.0f, 0.0f) == dp_plant_name(0.0f, -0.0f));
    CHECK(dp_plant_name(1.0f, 2.0f) != dp_plant_name(2.0f, 1.0f));
}

int main(void)
{
    RUN(reserves_spread_as_told);
    RUN(chances_are_even_and_names_go_by_place);
    return check_done();
}
