// Who is at rest sleeps, and has its strength back for the time it slept.
#include "lawn.h"

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

TEST(far_from_the_origin_plants_come_to_rest_too)
{
    const DpPlantKind kind = dp_plant_kind_default();
    float             root[48], speed[84], at[84], rest[84];
    int               stand = 0;
    DpPlantsReport    told = {0};
    for (int k = 0; k < 16; ++k)
        root[3 * k] = 2000.0f + 0.25f * (float)k, root[3 * k + 1] = -3000.0f,
                 root[3 * k + 2] = 512.0f;
    DpPlants* plants = dp_plants_create(3);
    CHECK(dp_plants_add(plants, &kind, root, NULL, 16, &stand) == DP_OK);
    dp_plants_read(plants, 0, 5, rest, NULL, NULL);
    for (int c = 0; c < 84; ++c) speed[c] = c / 3 % 7 > 1 && c % 3 < 2 ? 0.4f : 0.0f;
    for (int k = 0; k < 16; ++k) dp_plants_write(plants, 0, k, NULL, speed, NULL);
    for (int f = 0; f < 240; ++f)
        CHECK(dp_plants_step(plants, NULL, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
    CHECK(told.awake == 0);
    dp_plants_read(plants, 0, 5, at, NULL, NULL);
    for (int c = 0; c < 84; ++c) CHECK_NEAR(at[c], rest[c], 1e-3);
    dp_plants_destroy(plants);
}

// what is above a broken bend gets nothing back, asleep or awake, what is below it does. MODEL 7.3
TEST(above_a_break_nothing_comes_back)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.recover_rate = (float)(0.02 / 86400.0);
    DpPlants*      plants = lawn(&kind, 1, 1, 1.0, 1);
    DpPlantsReport told = {0};
    double         strength[20], now[20];
    for (int b = 0; b < 20; ++b) strength[b] = b % 5 == b / 5 ? 0.0 : 0.05;  // stem s at bend s
    dp_plants_write(plants, 0, 0, NULL, NULL, strength);
    for (int f = 0; f < 1200; ++f)
        CHECK(dp_plants_step(plants, NULL, NULL, 0, 1.0 / 60, 1, &told) == DP_OK);
    CHECK(told.awake == 0);
    CHECK(dp_plants_advance_time(plants, 86400.0) == DP_OK);
    dp_plants_read(plants, 0, 0, NULL, NULL, now);
    for (int b = 0; b < 20; ++b)
        CHECK_NEAR(now[b], b % 5 == b / 5 ? 0.0 : b % 5 > b / 5 ? 0.05 : 0.07, 1e-4);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(sleepers_recover_exactly_what_their_time_gives);
    RUN(far_from_the_origin_plants_come_to_rest_too);
    RUN(above_a_break_nothing_comes_back);
    return check_done();
}
