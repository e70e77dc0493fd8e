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

int main(void)
{
    RUN(bad_kinds_and_roots_are_refused);
    return check_done();
}
