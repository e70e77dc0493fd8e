// how much of the ground is held. TRAIL (7), TRAIL (8), MODEL 11.9
#include "lawn.h"
#include "plants/plant_inside.h"

#define N 20

static const DpPlantWindow window = {N, N, N, 0.05, 0.5, 0.5};

static void min_and_max(const float* grid, double* least, double* most)
{
    *least = INFINITY, *most = -INFINITY;
    for (int k = 0; k < N * N; ++k) {
        *least = fmin(*least, (double)grid[k]);
        *most = fmax(*most, (double)grid[k]);
    }
}

TEST(full_cover_is_1_half_broken_is_a_half_none_is_0)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, 25, 25, 0.08, 1);  // 156 a square metre
    float             strength[N * N], modulus[N * N];
    double            low, high, broken[20];
    CHECK(dp_plants_cover(plants, &window, DP_COVER_FULL, strength, modulus) == DP_OK);
    min_and_max(strength, &low, &high);
    CHECK_NEAR(low, 1.0, 1e-6);
    CHECK_NEAR(high, 1.0, 1e-6);
    min_and_max(modulus, &low, &high);
    CHECK_CLOSE(low, 10e6, 1e-6);  // TRAIL (8)
    CHECK_CLOSE(high, 10e6, 1e-6);

    for (int share = 1; share <= 2; ++share) {  // every other stem at its foot, then all
        for (int b = 0; b < 20; ++b) broken[b] = b / 5 % 2 < share && b % 5 == 0 ? 0.0 : 0.1;
        for (int k = 0; k < 625; ++k) dp_plants_write(plants, 0, k, NULL, NULL, broken);
        dp_plants_cover(plants, &window, DP_COVER_FULL, strength, modulus);
        min_and_max(strength, &low, &high);
        CHECK_NEAR(low, 1.0 - 0.5 * share, 1e-6);
        CHECK_NEAR(high, 1.0 - 0.5 * share, 1e-6);
        min_and_max(modulus, &low, &high);
        CHECK_NEAR(high, 10e6 * (1.0 - 0.5 * share), 10.0);
    }
    dp_plants_destroy(plants);

    plants = dp_plants_create(1);  // no plants: 0
    for (int law = 0; law < 2; ++law) {
        CHECK(dp_plants_cover(plants, &window, (DpCoverLaw)law, strength, modulus) == DP_OK);
        min_and_max(strength, &low, &high);
        CHECK_NEAR(high, 0.0, 0.0);
    }
    dp_plants_destroy(plants);
}

TEST(a_thin_stand_covers_less)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.root_radius = 0.4f, kind.full_density = 100.0f;
    DpPlants* plants = lawn(&kind, 20, 20, 0.1414213562, 1);  // 50 a square metre
    float     strength[N * N];
    double    low, high;
    dp_plants_cover(plants, &window, DP_COVER_FULL, strength, NULL);
    min_and_max(strength, &low, &high);
    CHECK_NEAR(low, 0.5, 0.03);
    CHECK_NEAR(high, 0.5, 0.03);
    dp_plants_destroy(plants);
}

TEST(paper_is_as_printed)
{
    const DpPlantKind   kind = dp_plant_kind_default();
    DpPlants*           plants = lawn(&kind, 2, 1, 0.06, 1);
    const DpPlantWindow one = {1, 1, 1, 1.0, 0.03, 0.04};
    float               strength = 0.0f, modulus = 0.0f;
    double              half[20] = {0};
    for (int b = 0; b < 10; ++b) half[b] = 0.1;
    dp_plants_write(plants, 0, 1, NULL, NULL, half);
    dp_plants_cover(plants, &one, DP_COVER_PAPER, &strength, &modulus);
    CHECK_NEAR(strength, 0.5 * (1.0 - 0.05 / 0.15) * 1.5, 1e-6);
    CHECK_CLOSE(modulus, 10e6 * 0.5, 1e-5);
    dp_plants_destroy(plants);
}

// What treading wears rises as its strength comes back, and no faster than it swings; what it does not wear swings.
TEST(what_is_worn_rises_as_it_heals)
{
    float                height[N * N], rate[N * N], heal[N * N], limp[N * N], broken[N * N];
    const DpPlantStature out = {height, rate, heal, limp, broken};
    for (int k = 0; k < 3; ++k) {
        DpPlantKind kind = dp_plant_kind_default();
        kind.degrade_rate = k == 0 ? 0.0f : 0.1f;
        kind.recover_rate = k == 2 ? 100.0f : 0.02f, kind.strength = 0.4f;
        DpPlants*    plants = lawn(&kind, 25, 25, 0.08, 1);
        const double swing = dp_plant_rise_rate(&kind);
        dp_plants_stature(plants, &window, &out);
        for (int n = 0; n < N * N; ++n) {
            CHECK_CLOSE(height[n], (double)kind.height, 1e-5);
            CHECK_CLOSE(rate[n], swing, 1e-5);
            CHECK_CLOSE(heal[n], k == 1 ? 0.02 / 0.4 : swing, 1e-5);
            CHECK_CLOSE(limp[n], 1.0 - cos((double)kind.degrade_angle), 1e-4);
            CHECK_NEAR(broken[n], 0.0, 1e-6);
        }
        dp_plants_destroy(plants);
    }
}

// K / K_ref of one plant wherever the window's cells lie: beside it, at its root, beyond it. TRAIL (7)
TEST(one_plant_covers_as_far_as_its_roots_go)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.root_radius = 0.22f, kind.full_density = 40.0f;
    const double  radius = (double)kind.root_radius, k_ref = 40.0 * DP_PI * radius * radius / 3.0;
    DpPlants*     plants = lawn(&kind, 1, 1, 1.0, 1);
    float         strength[N * N], modulus[N * N];
    DpPlantWindow around = {N, N, N, 0.05, 0.0, 0.0};
    for (int place = 0; place < 9; ++place) {
        around.x0 = -0.9 + 0.43 * (place % 3), around.y0 = -0.9 + 0.43 * (place / 3);
        CHECK(dp_plants_cover(plants, &around, DP_COVER_FULL, strength, modulus) == DP_OK);
        for (int k = 0; k < N * N; ++k) {
            const double x = around.x0 + 0.05 * (k % N), y = around.y0 + 0.05 * (k / N);
            const double want = fmax(1.0 - hypot(x, y) / radius, 0.0) / k_ref;
            CHECK_NEAR(strength[k], want, 1e-6);
            CHECK_NEAR(modulus[k], 10e6 * want, 10.0);
        }
    }
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(full_cover_is_1_half_broken_is_a_half_none_is_0);
    RUN(a_thin_stand_covers_less);
    RUN(paper_is_as_printed);
    RUN(what_is_worn_rises_as_it_heals);
    RUN(one_plant_covers_as_far_as_its_roots_go);
    return check_done();
}
