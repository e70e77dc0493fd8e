// tests of soil_press.c: TRAIL (10) (17), SOFT22 (11) (12), MODEL 6.2
#include "check.h"
#include "ground.h"
#include "soil/soil_columns.h"

#define SIDE 4
#define CELL 5  // the one that is pressed

static Ground soft(void)
{
    DpSoil soil = dp_soil_default();
    soil.poisson_ratio = 0.3f, soil.settle_time = 0.5f;
    return ground_make(SIDE, SIDE, 0.01, soil);
}

static DpPressed press(Ground* ground, double depth, double share, double dt)
{
    DpPressed pressed = {0};
    ground->patch.soils = ground->soil;
    dp_press_cell(&ground->patch, CELL, (Target){depth, 2000.0, share}, dt, &pressed);
    return pressed;
}

TEST(it_goes_evenly_to_its_share_of_the_target_and_not_past_it)
{
    Ground       ground = soft();
    const double goal = 0.75 * 0.04;
    for (int step = 1; step <= 7; ++step) {
        const DpPressed pressed = press(&ground, 0.04, 0.75, 0.1);  // a fifth of tau
        CHECK_CLOSE(ground.compression[CELL], goal * fmin(step / 5.0, 1.0), 1e-6);
        CHECK_NEAR(pressed.firm, step <= 5 ? goal / 5.0 : 0.0, 1e-8);
        CHECK_NEAR(pressed.displaced, 0.6 * pressed.firm, 1e-9);
        CHECK_NEAR(pressed.deepest, ground.compression[CELL], 0.0);
    }
    CHECK_CLOSE(ground.pressure_time[CELL], 2000.0 * 0.75 * 0.7, 1e-6);
    for (int k = 0; k < SIDE * SIDE; ++k)
        CHECK(k == CELL || !(ground.compression[k] + ground.pressure_time[k] > 0.0f));
    ground_free(&ground);
}

TEST(a_step_longer_than_tau_goes_all_the_way)
{
    Ground ground = soft();
    (void)press(&ground, 0.04, 1.0, 2.0);
    CHECK_CLOSE(ground.compression[CELL], 0.04, 1e-6);
    ground_free(&ground);
}

// A heap counts up to its top: 4 cm of target under 1 cm of loose soil are 5 cm to go, loose soil first, and of all that
// is pressed 2 nu is displaced.
TEST(loose_soil_first_and_it_counts_alike)
{
    Ground ground = soft();
    ground.heap[CELL] = 0.01f;
    DpPressed pressed = press(&ground, 0.04, 1.0, 0.1);
    CHECK_CLOSE(pressed.loose, 0.008, 1e-6);  // a fifth of the target
    CHECK_CLOSE(ground.heap[CELL], 0.002, 1e-5);
    CHECK_CLOSE(pressed.displaced, 0.6 * 0.008, 1e-6);
    CHECK_NEAR(ground.compression[CELL], 0.0, 0.0);
    pressed = press(&ground, 0.04, 1.0, 0.5);
    CHECK_NEAR(ground.heap[CELL], 0.0, 1e-9);
    CHECK_CLOSE(pressed.loose, 0.002, 1e-5);
    CHECK_CLOSE(pressed.firm, 0.038, 1e-6);  // tau: as much as the target in one go
    CHECK_CLOSE(pressed.displaced, 0.6 * 0.04, 1e-6);
    CHECK_CLOSE(press(&ground, 0.04, 1.0, 0.5).firm, 0.002, 1e-5);
    CHECK_CLOSE(ground.compression[CELL], 0.04, 1e-6);
    ground.heap[CELL] = 0.01f;  // what slides into a print lies over its target
    CHECK_CLOSE(press(&ground, 0.04, 1.0, 0.5).loose, 0.01, 1e-6);
    CHECK_NEAR(ground.heap[CELL], 0.0, 1e-9);
    ground_free(&ground);
}

TEST(pressure_is_what_the_sole_puts_there_now)
{
    Ground ground = soft();
    float  pressure[SIDE * SIDE] = {0};
    ground.patch.pressure = pressure;
    for (int step = 0; step < 3; ++step) (void)press(&ground, 0.04, 0.25, 0.1);
    CHECK_CLOSE(pressure[CELL], 500.0, 1e-6);
    ground_free(&ground);
}

int main(void)
{
    RUN(it_goes_evenly_to_its_share_of_the_target_and_not_past_it);
    RUN(a_step_longer_than_tau_goes_all_the_way);
    RUN(loose_soil_first_and_it_counts_alike);
    RUN(pressure_is_what_the_sole_puts_there_now);
    return check_done();
}
