// tests of soil_rebound.c: MODEL 6.9
#include "check.h"
#include "ground.h"
#include "soil/soil_inside.h"

#define SIDE 8

static float spring[SIDE * SIDE], uneven[SIDE * SIDE];

static Ground springy(double share)
{
    DpSoil soil = dp_soil_default();
    soil.rebound = (float)share;
    Ground ground = ground_make(SIDE, SIDE, 0.01, soil);
    for (int k = 0; k < SIDE * SIDE; ++k) spring[k] = uneven[k] = 0.0f;
    ground.patch.spring = spring;
    return ground;
}

// as a sole leaves a cell: pressed from where it was
static double press(Ground* ground, size_t p, double depth)
{
    const double before = (double)ground->compression[p];
    ground->patch.soils = ground->soil;
    ground->compression[p] = (float)depth;
    return dp_soil_spring_press(&ground->patch, p, before);
}

TEST(a_share_of_the_deepest_comes_back_where_nobody_stands)
{
    Ground ground = springy(0.2);
    for (int k = 0; k < SIDE * SIDE; ++k) ground.imprint.ring[k] = DP_RING_FAR;
    CHECK_NEAR(press(&ground, 10, 0.1), 0.0, 0.0);
    CHECK_NEAR(press(&ground, 20, 0.1), 0.0, 0.0);
    ground.compression[30] = 0.05f;  // nobody has pressed that now
    ground.imprint.ring[20] = 0;
    CHECK_CLOSE(dp_soil_rebound(&ground.patch, &ground.imprint), 0.02 * 1e-4, 1e-5);
    CHECK_CLOSE(ground.compression[10], 0.08, 1e-6);
    CHECK_NEAR(ground.compression[20], 0.1f, 0.0);
    CHECK_CLOSE(dp_soil_rebound(&ground.patch, NULL), 0.02 * 1e-4, 1e-5);  // that sole is gone, too
    CHECK_CLOSE(ground.compression[20], 0.08, 1e-6);
    CHECK_NEAR(ground.compression[30], 0.05f, 0.0);
    CHECK_NEAR(dp_soil_rebound(&ground.patch, NULL), 0.0, 0.0);
    ground_free(&ground);
}

TEST(what_came_back_is_pressed_again_for_nothing)
{
    Ground ground = springy(0.2);
    (void)press(&ground, 10, 0.1);
    (void)dp_soil_rebound(&ground.patch, NULL);
    CHECK_CLOSE(press(&ground, 10, 0.095), 0.015, 1e-4);  // on the way down again
    CHECK_CLOSE(press(&ground, 10, 0.12), 0.005, 1e-4);   // and 2 cm of it anew
    (void)dp_soil_rebound(&ground.patch, NULL);
    CHECK_CLOSE(ground.compression[10], 0.8 * 0.12, 1e-6);
    ground_free(&ground);
}

// a trail that was laid down tells only what is left of it: it was as deep as leaves that
TEST(a_trail_of_before_had_come_back)
{
    Ground ground = springy(0.2);
    ground.compression[10] = 0.08f;
    ground.patch.soils = ground.soil;
    dp_soil_spring_trodden(&ground.patch);
    CHECK_CLOSE(ground.patch.spring[10], 0.02, 1e-6);
    CHECK_NEAR(spring[11], 0.0f, 0.0);
    CHECK_CLOSE(press(&ground, 10, 0.09), 0.01, 1e-4);
    CHECK_CLOSE(press(&ground, 10, 0.11), 0.01, 1e-4);
    ground_free(&ground);
}

// what a wall sheds has left the ground there: it was not pressed deeper than what lies there now and has come back
TEST(what_fell_had_not_come_back)
{
    Ground ground = springy(0.2);
    (void)press(&ground, 10, 0.1);
    (void)dp_soil_rebound(&ground.patch, NULL);
    CHECK_CLOSE(spring[10], 0.02, 1e-6);
    dp_soil_spring_fell(&ground.patch, 10, 0.005);
    CHECK_CLOSE(spring[10], 0.015, 1e-6);
    dp_soil_spring_fell(&ground.patch, 10, 0.05);
    CHECK_NEAR(spring[10], 0.0f, 0.0);
    (void)press(&ground, 20, 0.1);  // one that a sole still stands on keeps how deep it was pressed
    dp_soil_spring_fell(&ground.patch, 20, 0.05);
    CHECK_CLOSE(spring[20], -0.1, 1e-6);
    ground_free(&ground);
}

// a wall that fell into a print has made it shallower: no deeper than it is
TEST(what_is_shallower_already_stays)
{
    Ground ground = springy(0.2);
    (void)press(&ground, 10, 0.1);
    ground.compression[10] = 0.03f;
    CHECK_NEAR(dp_soil_rebound(&ground.patch, NULL), 0.0, 0.0);
    CHECK_NEAR(ground.compression[10], 0.03f, 0.0);
    ground_free(&ground);
}

TEST(the_share_differs_from_place_to_place)
{
    Ground ground = springy(0.2);
    ground.patch.soils = ground.soil;
    ground.patch.uneven = uneven;
    const float  at[4] = {0.25f, -0.25f, -1.0f, 3.0f};
    const double want[4] = {0.2 * 1.4, 0.2 * 0.6, 0.0, 0.9};
    for (int k = 0; k < 4; ++k) {
        uneven[k] = at[k];
        CHECK_NEAR(dp_soil_spring_share(&ground.patch, (size_t)k), want[k], 1e-7);
    }
    ground_free(&ground);
}

int main(void)
{
    RUN(a_share_of_the_deepest_comes_back_where_nobody_stands);
    RUN(what_came_back_is_pressed_again_for_nothing);
    RUN(a_trail_of_before_had_come_back);
    RUN(what_fell_had_not_come_back);
    RUN(what_is_shallower_already_stays);
    RUN(the_share_differs_from_place_to_place);
    return check_done();
}
