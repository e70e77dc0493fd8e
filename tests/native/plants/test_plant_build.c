// Plants from roots: what cannot be planted is refused, and nothing is lost when memory ends.
#include "lawn.h"

TEST(bad_kinds_and_roots_are_refused)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.spacing = 0.0f;
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    kind = dp_plant_kind_default(), kind.sway = NAN;
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    kind = dp_plant_kind_default(), kind.break_angle = 0.1f;
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    kind = dp_plant_kind_default(), kind.height = 9.0f;  // too many rows
    CHECK(dp_plant_kind_check(&kind, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_plant_kind_check(NULL, NULL) == DP_BAD_ARGUMENT);

    kind = dp_plant_kind_default();
    float     root[3] = {0.0f, NAN, 0.0f};
    int       stand = 0;
    DpPlants* plants = dp_plants_create(0);
    CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_BAD_ARGUMENT);
    CHECK(dp_plants_add(plants, &kind, root, NULL, 0, &stand) == DP_BAD_ARGUMENT);
    root[1] = 0.0f;
    for (long passes = 0; passes < 12; ++passes) {  // memory gives out anywhere
        dp_alloc_fail_after(passes);
        CHECK(dp_plants_add(plants, &kind, root, NULL, 1, &stand) == DP_NO_MEMORY);
    }
    dp_alloc_fail_after(-1);
    CHECK(dp_plants_count(plants, -1) == 0);
    CHECK(dp_plants_read(plants, 0, 0, NULL, NULL, NULL) == DP_BAD_ARGUMENT);
    dp_plants_destroy(plants);
}

// three plants in a block of eight lanes: each by its own number, and no others
TEST(blocks_that_are_not_full_hold_no_more)
{
    const DpPlantKind kind = dp_plant_kind_default();
    const float       root[9] = {0.3f, 0.0f, 0.0f, 0.1f, 0.0f, 0.0f, 0.2f, 0.0f, 0.0f};
    DpPlants*         plants = dp_plants_create(1);
    DpPlantsReport    report;
    float             at[84];
    int               stand;
    CHECK(dp_plants_add(plants, &kind, root, NULL, 3, &stand) == DP_OK);
    for (int k = 0; k < 3; ++k) {
        double middle = 0.0;
        CHECK(dp_plants_read(plants, stand, k, at, NULL, NULL) == DP_OK);
        for (int p = 0; p < 28; ++p) middle += (double)at[3 * p] / 28;
        CHECK_NEAR(middle, root[3 * k], 1e-5);
    }
    CHECK(dp_plants_write(plants, stand, 0, NULL, NULL, NULL) == DP_OK);
    CHECK(dp_plants_step(plants, NULL, NULL, 0, 0.01, 1, &report) == DP_OK);
    CHECK(report.awake == 3 && dp_plants_count(plants, -1) == 3);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(bad_kinds_and_roots_are_refused);
    RUN(blocks_that_are_not_full_hold_no_more);
    return check_done();
}
