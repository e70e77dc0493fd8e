// A particle comes out of a sole by the shorter way, or stays between it and the ground.
#include "plants/plant_collide.h"

#include "lawn.h"

#define SIDE 21
#define CELL 0.01

// a block whose ground is level at z = 0
static PlantBlock on_level_ground(void)
{
    PlantBlock block;
    memset(&block, 0, sizeof block);
    for (int l = 0; l < DP_LANES; ++l) block.ceiling[l] = 0.0f;
    return block;
}

// a square sole of 11 cells, its middle at the origin, `low` over the ground and 0.1 m thick
static DpPlantCollider square(float* bottom, float low)
{
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i)
            bottom[j * SIDE + i] = abs(i - 10) <= 5 && abs(j - 10) <= 5 ? low : INFINITY;
    return (DpPlantCollider){.nx = SIDE,
                             .ny = SIDE,
                             .row = SIDE,
                             .cell = CELL,
                             .x0 = -10 * CELL,
                             .y0 = -10 * CELL,
                             .bottom = bottom,
                             .thickness = 0.1,
                             .friction = 0.5};
}

TEST(sides_are_as_far_as_they_are)
{
    float           bottom[SIDE * SIDE], out[(SIDE + 2) * (SIDE + 2)];
    DpPlantCollider sole = square(bottom, 0.02f);
    CHECK(PLANT_SIDE_CELLS(&sole) == (SIDE + 2) * (SIDE + 2));
    dp_plant_side_field(&sole, out);
    for (int j = -1; j <= SIDE; ++j)
        for (int i = -1; i <= SIDE; ++i) {
            const int in = 6 - (abs(i - 10) > abs(j - 10) ? abs(i - 10) : abs(j - 10));
            CHECK_NEAR(out[(j + 1) * (SIDE + 2) + i + 1], in > 0 ? in * CELL : 0.0, 1e-6);
        }
    // a sole that fills its grid ends with it
    for (int k = 0; k < SIDE * SIDE; ++k) bottom[k] = 0.0f;
    dp_plant_side_field(&sole, out);
    CHECK_NEAR(out[(SIDE + 2) + 1], CELL, 1e-6);
    CHECK_NEAR(out[11 * (SIDE + 2) + 11], 11 * CELL, 1e-6);
}

TEST(out_by_the_shorter_way)
{
    float            bottom[SIDE * SIDE], out[(SIDE + 2) * (SIDE + 2)];
    DpPlantCollider  sole = square(bottom, 0.02f);
    const PlantBlock block = on_level_ground();
    dp_plant_side_field(&sole, out);
    const PlantPush  push = {&sole, out, -0.055, -0.055, 0.02, 0.055, 0.055, 0.12};
    const PlantProbe probe = {&push, 1, NULL, &block, 0, 0.005, 0.0, false};

    const DpPlantCollider* by = NULL;
    DpVec3                 p = {0.05, 0.0, 0.09};  // 7 cm over its underside, 1 cm from its side
    CHECK(dp_plant_clear(&probe, &p, &by) > 0.0 && by == &sole);
    CHECK_NEAR(p.z, 0.09, 1e-12);
    CHECK(p.x > 0.055 && p.x < 0.075 && fabs(p.y) < 1e-9);

    p = dp_vec3(0.0, 0.0, 0.03);  // 1 cm over its underside, in the middle
    dp_plant_clear(&probe, &p, &by);
    CHECK_NEAR(p.x, 0.0, 1e-12);
    CHECK(p.z <= 0.02 && p.z >= 0.0);  // down, as far as there is room for its radius

    // 3.5 cm to the side with its radius: down from where that is less, aside from where it is more
    p = dp_vec3(0.03, 0.0, 0.048);
    dp_plant_clear(&probe, &p, &by);
    CHECK_NEAR(p.x, 0.03, 1e-12);
    CHECK(p.z <= 0.02);
    p = dp_vec3(0.03, 0.0, 0.052);
    dp_plant_clear(&probe, &p, &by);
    CHECK_NEAR(p.z, 0.052, 1e-12);
    CHECK(p.x > 0.055);

    PlantProbe down = probe;
    down.only_down = true;
    p = dp_vec3(0.05, 0.0, 0.09);
    dp_plant_clear(&down, &p, &by);
    CHECK_NEAR(p.x, 0.05, 1e-12);
    CHECK(p.z <= 0.02);

    by = NULL;
    p = dp_vec3(0.2, 0.0, 0.01);  // beside the sole nothing happens
    CHECK(!(dp_plant_clear(&probe, &p, &by) > 0.0) && !by);
    CHECK_NEAR(p.z, 0.01, 1e-12);
    p.z = -0.01;  // but nobody stays in the ground
    dp_plant_clear(&probe, &p, &by);
    CHECK_NEAR(p.z, 0.0, 1e-12);
}

// the sole of the step's end was elsewhere before
TEST(a_moving_sole_is_met_where_it_is)
{
    float            bottom[SIDE * SIDE];
    DpPlantCollider  sole = square(bottom, 0.02f);
    const PlantBlock block = on_level_ground();
    sole.velocity = dp_vec3(1.0, 0.0, 0.0);
    const PlantPush  push = {&sole, NULL, -0.155, -0.055, 0.02, 0.055, 0.055, 0.12};
    const PlantProbe now = {&push, 1, NULL, &block, 0, 0.005, 0.0, false};
    PlantProbe       before = now;
    before.left = 0.1;
    const DpVec3 here = {0.0, 0.0, 0.05}, there = {-0.1, 0.0, 0.05};
    CHECK(isfinite(dp_plant_sole_over(&now, &here, NULL)));
    CHECK(!isfinite(dp_plant_sole_over(&now, &there, NULL)));
    CHECK(!isfinite(dp_plant_sole_over(&before, &here, NULL)));
    CHECK(isfinite(dp_plant_sole_over(&before, &there, NULL)));
}

int main(void)
{
    RUN(sides_are_as_far_as_they_are);
    RUN(out_by_the_shorter_way);
    RUN(a_moving_sole_is_met_where_it_is);
    return check_done();
}
