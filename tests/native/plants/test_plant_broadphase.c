// Which plants a collider can meet: those within what it goes through, and no others.
#include "lawn.h"
#include "plants/plant_inside.h"

static PlantPush push_of(const DpPlantCollider* collider, double dt)
{
    PlantPush push = {.collider = collider};
    CHECK(dp_plant_sweep(&push, dt));
    return push;
}

TEST(colliders_go_through_a_box)
{
    float           bottom[SOLE_SIDE * SOLE_SIDE];
    DpPlantCollider foot = sole(bottom, 0.01, 1.0, 2.0, 0.5, 0.1, 0.06, 0.0);
    foot.velocity = dp_vec3(1.0, -2.0, -4.0);
    PlantPush push = push_of(&foot, 0.1);  // it comes from behind, beside and above
    CHECK_NEAR(push.x0, 1.0 - 0.055 - 0.1, 1e-6);
    CHECK_NEAR(push.x1, 1.0 + 0.055, 1e-6);
    CHECK_NEAR(push.y0, 2.0 - 0.035, 1e-6);
    CHECK_NEAR(push.y1, 2.0 + 0.035 + 0.2, 1e-6);
    CHECK_NEAR(push.z0, 0.5, 1e-6);
    CHECK_NEAR(push.z1, 0.5 + 0.12 + 0.4, 1e-6);
    for (int k = 0; k < SOLE_SIDE * SOLE_SIDE; ++k) bottom[k] = INFINITY;
    CHECK(!dp_plant_sweep(&push, 0.1));  // it is nowhere

    const DpPlantCollider leg = {.from = {0, 0, 0}, .to = {0, 0, 1}, .radius = 0.2};
    push = push_of(&leg, 0.1);
    CHECK_NEAR(push.x0, -0.2, 1e-9);
    CHECK_NEAR(push.z1, 1.2, 1e-9);
}

TEST(bad_colliders_are_told)
{
    float                 bottom[SOLE_SIDE * SOLE_SIDE];
    const DpPlantCollider good = sole(bottom, 0.01, 0.0, 0.0, 0.0, 0.1, 0.1, 0.0);
    DpPlantCollider       bad = good;
    CHECK(dp_plant_collider_ok(&good));
    bad.row = bad.nx - 1;
    CHECK(!dp_plant_collider_ok(&bad));
    bad = good, bad.velocity.x = NAN;
    CHECK(!dp_plant_collider_ok(&bad));
    bad = good, bad.thickness = 0.0;
    CHECK(!dp_plant_collider_ok(&bad));
    bad = (DpPlantCollider){.from = {0, 0, 0}, .to = {0, 0, 1}, .radius = 0.0};
    CHECK(!dp_plant_collider_ok(&bad));
}

// plants in a row: a sole meets those whose leaves it can come to, from the side and from above
TEST(plants_are_touched_as_far_as_they_stand)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, DP_LANES, 1, 0.5, 1);
    PlantStand*       stand = &plants->stand[0];
    PlantBlock*       block = &stand->block[0];
    float             bottom[SOLE_SIDE * SOLE_SIDE];
    DpPlantCollider   foot = sole(bottom, 0.01, 1.0, 0.0, 0.05, 0.1, 0.1, 0.0);
    PlantPush         push = push_of(&foot, 0.01);
    dp_plant_touch(stand, block, &push, 1, 0.01);
    for (int l = 0; l < DP_LANES; ++l) CHECK(block->touched_lane[l] == (l == 2));
    CHECK(block->touched);
    push.z0 = 0.2;  // above its leaves
    dp_plant_touch(stand, block, &push, 1, 0.01);
    CHECK(!block->touched && !block->touched_lane[2]);
    push = push_of(&foot, 0.01);
    push.x0 += 0.18, push.x1 += 0.18;  // beside them
    dp_plant_touch(stand, block, &push, 1, 0.01);
    CHECK(!block->touched);
    dp_plant_touch(stand, block, &push, 1, 0.2);  // who could come there in a longer step
    CHECK(block->touched);

    const double span = dp_plant_span(stand);
    CHECK(span > 0.1 && span < 0.2);
    PlantPush two[2] = {push_of(&foot, 0.01), push_of(&foot, 0.01)};
    two[0].x0 = two[0].x1 = -10.0, two[1].x0 = two[1].x1 = 10.0;
    CHECK(!dp_plant_meets_any(stand->box, two, 2, span));  // between the two
    two[1].x0 = two[1].x1 = 3.5 + 0.9 * span;
    CHECK(dp_plant_meets_any(stand->box, two, 2, span));
    two[1].x0 = two[1].x1 = 3.5 + 1.1 * span;
    CHECK(!dp_plant_meets_any(stand->box, two, 2, span));
    dp_plants_destroy(plants);
}

// one that lies down is met where it lies: to the side to which it leans
TEST(plants_are_touched_where_they_lie)
{
    const DpPlantKind kind = dp_plant_kind_default();
    DpPlants*         plants = lawn(&kind, DP_LANES, 1, 0.05, 1);
    PlantBlock*       block = &plants->stand[0].block[0];
    float             at[84], bottom[SOLE_SIDE * SOLE_SIDE];
    for (int side = -1; side <= 1; side += 2) {
        CHECK(dp_plants_read(plants, 0, 1, at, NULL, NULL) == DP_OK);
        for (int p = 0; p < 28; ++p)
            if (p % 7 > 1) at[3 * p] = 0.05f + 0.02f * (float)(side * (p % 7 - 1));
        CHECK(dp_plants_write(plants, 0, 1, at, NULL, NULL) == DP_OK);
        const DpPlantCollider foot =
            sole(bottom, 0.005, 0.05 + 0.1 * side, 0.0, 0.0, 0.06, 0.06, 0.0);
        const PlantPush push = push_of(&foot, 1e-4);
        dp_plant_touch(&plants->stand[0], block, &push, 1, 1e-4);
        CHECK(block->touched_lane[1]);
        CHECK(!block->touched_lane[5]);
    }
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(colliders_go_through_a_box);
    RUN(bad_colliders_are_told);
    RUN(plants_are_touched_as_far_as_they_stand);
    RUN(plants_are_touched_where_they_lie);
    return check_done();
}
