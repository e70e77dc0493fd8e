// The low-pass, rates of change, and recordings that cannot be worked with.
#include "walker/walker_inside.h"

#include "check.h"
#include "scene.h"

#define COUNT 600
#define RATE 120.0

static void low_pass(double* value, double cutoff)
{
    double* scratch = dp_alloc(dp_walker_low_pass_scratch(COUNT, RATE, cutoff), sizeof *scratch);
    dp_walker_low_pass(value, COUNT, RATE, cutoff, scratch);
    dp_free(scratch);
}

// the greatest size in the middle of a sine of this frequency, and where it was greatest at first
static double passed(double frequency, double cutoff, double* late)
{
    double value[COUNT], most = 0.0;
    int    at = 0;
    for (int k = 0; k < COUNT; ++k) value[k] = sin(2.0 * DP_PI * frequency * k / RATE);
    low_pass(value, cutoff);
    const int period = (int)(RATE / frequency), begin = COUNT / 2 / period * period;
    for (int k = begin; k < begin + period; ++k)
        if (value[k] > most) most = value[k], at = k;
    *late = at - begin - 0.25 * period;
    return most;
}

// forward and backward: half the size at the cut-off, a hundredth of a hundredth at ten times it
TEST(slow_passes_fast_does_not_and_nothing_is_late)
{
    double late;
    CHECK_NEAR(passed(1.0, 6.0, &late), 1.0, 0.002);
    CHECK_NEAR(late, 0.0, 1.0);
    CHECK_NEAR(passed(6.0, 6.0, &late), 0.5, 0.005);
    CHECK_NEAR(late, 0.0, 1.0);
    CHECK(passed(30.0, 6.0, &late) < 0.002);
}

TEST(a_motion_under_way_stays_under_way)
{
    double value[COUNT];
    for (int k = 0; k < COUNT; ++k) value[k] = 3.0 + 0.02 * k;
    low_pass(value, 4.0);
    for (int k = 0; k < COUNT; ++k) CHECK_NEAR(value[k], 3.0 + 0.02 * k, 1e-6);
}

TEST(what_cannot_be_filtered_stays)
{
    double value[COUNT];
    for (int k = 0; k < COUNT; ++k) value[k] = k % 2;
    low_pass(value, 0.45 * RATE);
    for (int k = 0; k < COUNT; ++k) CHECK(value[k] == k % 2);
    low_pass(value, 0.0);
    for (int k = 0; k < COUNT; ++k) CHECK(value[k] == k % 2);
}

TEST(parabolas_change_as_they_do)
{
    double value[9];
    for (int k = 0; k < 9; ++k) value[k] = 0.5 * k * k;
    CHECK_NEAR(dp_walker_velocity(value, 9, 4, 10.0), 40.0, 1e-12);
    CHECK_NEAR(dp_walker_velocity(value, 9, 0, 10.0), 5.0, 1e-12);  // to its one neighbour
    CHECK_NEAR(dp_walker_velocity(value, 9, 8, 10.0), 75.0, 1e-12);
    for (int k = 0; k < 9; ++k) CHECK_NEAR(dp_walker_acceleration(value, 9, k, 10.0), 100.0, 1e-9);
    CHECK(dp_walker_velocity(value, 1, 0, 10.0) == 0.0);
    CHECK(dp_walker_acceleration(value, 2, 1, 10.0) == 0.0);
}

TEST(the_middle_is_the_upper_one)
{
    double odd[] = {3.0, -1.0, 2.0}, even[] = {4.0, 1.0, 3.0, 2.0};
    CHECK(dp_walker_median(odd, 3) == 2.0);
    CHECK(dp_walker_median(even, 4) == 3.0);
    for (int k = 0; k < 4; ++k) CHECK(even[k] == k + 1.0);  // sorted on the way
}

TEST(even_times_have_a_rate)
{
    Scene         s = scene_make(5, 50.0, 1, 1);
    const DpGait* gait = scene_gait(&s, 5, 1, 1);
    CHECK_CLOSE(dp_walker_rate(gait), 50.0, 1e-12);
    s.time[2] += 0.9e-3 * 0.02;  // a thousandth of a step is rounding
    CHECK_CLOSE(dp_walker_rate(gait), 50.0, 1e-12);
    s.time[2] += 0.2e-3 * 0.02;
    CHECK(dp_walker_rate(gait) == 0.0);
    s.gait.times = 1;
    CHECK(dp_walker_rate(gait) == 0.0);
    scene_free(&s);
}

TEST(broken_recordings_are_refused)
{
    Scene         s = scene_make(4, 50.0, 2, 2);
    const DpGait* gait = scene_gait(&s, 4, 2, 2);
    CHECK(dp_walker_gait_ok(gait));
    CHECK(!dp_walker_gait_ok(NULL));
    double* const numbers[] = {s.time + 3, s.com + 11, s.pose + 55, s.point + 11, &s.mass};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        const double was = *numbers[k];
        *numbers[k] = (double)NAN;
        CHECK(!dp_walker_gait_ok(gait));
        *numbers[k] = was;
    }
    s.mass = 0.0;
    CHECK(!dp_walker_gait_ok(gait));
    s.mass = 70.0;
    int32_t* const owners[] = {s.limb_walker + 1, s.part_limb + 1, s.point_part + 3,
                               s.point_role + 3};
    const int32_t  owned[] = {1, 2, 2, 3};
    for (size_t k = 0; k < sizeof owners / sizeof *owners; ++k) {
        const int32_t was = *owners[k];
        *owners[k] = owned[k];
        CHECK(!dp_walker_gait_ok(gait));
        *owners[k] = -1;
        CHECK(!dp_walker_gait_ok(gait));
        *owners[k] = was;
    }
    CHECK(dp_walker_gait_ok(gait));
    scene_free(&s);
}

int main(void)
{
    RUN(slow_passes_fast_does_not_and_nothing_is_late);
    RUN(a_motion_under_way_stays_under_way);
    RUN(what_cannot_be_filtered_stays);
    RUN(parabolas_change_as_they_do);
    RUN(the_middle_is_the_upper_one);
    RUN(even_times_have_a_rate);
    RUN(broken_recordings_are_refused);
    return check_done();
}
