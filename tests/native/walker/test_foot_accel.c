// How the ground accelerates a body: low-passed by how often it steps, in free fall where it flies.
#include "base/vec.h"
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

#define RATE 240.0
#define TIMES 1200
#define SIZE 0.001  // of what shakes the body [m]

static double accel[3 * TIMES], velocity[2 * TIMES];

// a foot that touches down at these times [s], a tenth of a second after it let go
static void step_at(uint8_t* on, const double* when, int count)
{
    memset(on, 1, TIMES);
    for (int k = 0; k < count; ++k)
        for (int t = (int)(when[k] * RATE) - (int)(0.1 * RATE); t < (int)(when[k] * RATE); ++t)
            on[t] = 0;
}

// what a second-order low-pass, there and back, leaves of a frequency
static double left_of(double hertz, double cutoff)
{
    return 1.0 / (1.0 + pow(hertz / cutoff, 4.0));
}

// greatest acceleration along an axis in the middle, by what a shake of `hertz` has
static double left(const uint8_t* on, int limbs, int axis, double hertz)
{
    Scene               s = scene_make(TIMES, RATE, limbs, 1);
    const DpGait*       gait = scene_gait(&s, TIMES, limbs, 1);
    const DpLoadOptions options = dp_load_options_default();
    double              most = 0.0;
    for (int t = 0; t < TIMES; ++t) {
        const double shake = SIZE * sin(2.0 * DP_PI * hertz * t / RATE);
        scene_com(&s, t, axis == 0 ? shake : 0.0, axis == 1 ? shake : 0.0,
                  1.0 + (axis == 2 ? shake : 0.0));
    }
    CHECK(dp_walker_accelerate(gait, 0, on, limbs, RATE, &options, accel, velocity) == DP_OK);
    for (int t = TIMES / 3; t < 2 * TIMES / 3; ++t)
        most = fmax(most, fabs(accel[axis * TIMES + t]));
    scene_free(&s);
    return most / (SIZE * pow(2.0 * DP_PI * hertz, 2.0));
}

// A limb that comes down after half a second and after 0.9 s steps every half second: who waits between
// steps steps no slower. Three times as often up and down, two times as often over the ground.
TEST(the_shorter_of_two_steps_counts)
{
    static uint8_t on[TIMES];
    const double   when[] = {1.5, 2.0, 2.9};
    step_at(on, when, 3);
    CHECK_CLOSE(left(on, 1, 2, 5.5), left_of(5.5, 6.0), 0.03);
    CHECK_CLOSE(left(on, 1, 0, 5.5), left_of(5.5, 4.0), 0.03);
    CHECK_CLOSE(left(on, 1, 1, 2.0), left_of(2.0, 4.0), 0.03);
}

// of two limbs each comes down every other step; one that comes down once tells with the other
TEST(two_limbs_step_twice_as_often)
{
    static uint8_t on[2 * TIMES];
    const double   left_foot[] = {1.0, 1.8, 2.6}, right_foot[] = {1.4, 2.2, 3.0};
    step_at(on, left_foot, 3), step_at(on + TIMES, right_foot, 3);
    CHECK_CLOSE(left(on, 2, 2, 7.0), left_of(7.0, 3.0 / 0.4), 0.03);
    step_at(on, left_foot, 1), step_at(on + TIMES, right_foot, 1);
    CHECK_CLOSE(left(on, 2, 2, 7.0), left_of(7.0, 3.0 / 0.4), 0.03);
}

// no step is known: the lower bound holds
TEST(who_stands_is_smoothed_most)
{
    static uint8_t on[TIMES];
    memset(on, 1, TIMES);
    CHECK_CLOSE(left(on, 1, 2, 5.0), left_of(5.0, 5.0), 0.03);
    CHECK_CLOSE(left(on, 1, 0, 5.0), left_of(5.0, 5.0 * 2.0 / 3.0), 0.03);
}

// in the air, but not falling, as on a box that the ground does not show; then falling
TEST(who_falls_flies)
{
    enum
    {
        COUNT = 120
    };
    uint8_t air[COUNT];
    double  high[COUNT];
    for (int falls = 0; falls < 2; ++falls) {
        for (int t = 0; t < COUNT; ++t) {
            const double since = fmax((t - 40) / RATE, 0.0);
            air[t] = t >= 20 && t < 110;
            high[t] = 2.0 - (falls ? 0.5 * DP_GRAVITY * since * since : 0.1 * since);
        }
        CHECK(dp_walker_falls(air, high, COUNT, RATE) == (falls == 1));
        int count = 0;
        for (int t = 0; t < COUNT; ++t) count += air[t];
        if (!falls) {
            CHECK(count == 0);
            continue;
        }
        CHECK(air[109] && !air[110] && !air[20]);
        for (int t = 50; t < 110; ++t) CHECK(air[t]);
        CHECK(count >= 60 && count <= 80);
    }
}

// a foot that bounces as it lands has not made a step, nor have two that land together
TEST(what_lands_at_once_is_one_step)
{
    static uint8_t on[2 * TIMES];
    const double   when[] = {1.0, 1.5, 2.0, 2.5, 3.0, 3.5};
    step_at(on, when, 6);
    for (int k = 0; k < 6; ++k) {
        const int again = (int)((when[k] + 0.05) * RATE);
        on[again - 1] = on[again - 2] = 0;
    }
    CHECK_CLOSE(left(on, 1, 2, 5.5), left_of(5.5, 3.0 / 0.45), 0.03);
    const double first = 1.0, second = 1.05;
    step_at(on, &first, 1), step_at(on + TIMES, &second, 1);
    CHECK_CLOSE(left(on, 2, 2, 5.0), left_of(5.0, 5.0), 0.03);  // none is known
}

// A body jumps off a box at 2 m/s and is caught within 0.06 s; greatest acceleration upward when it lands.
static double jump(const DpLoadOptions* options)
{
    static uint8_t on[TIMES];
    Scene          s = scene_make(TIMES, RATE, 1, 1);
    const DpGait*  gait = scene_gait(&s, TIMES, 1, 1);
    const double   flight = 0.4, fall = 0.5 * DP_GRAVITY * flight * flight, caught = 0.06;
    for (int t = 0; t < TIMES; ++t) {
        const double at = t / RATE - 2.0, since = dp_clamp(at, 0.0, flight);
        const double down = dp_clamp(at - flight, 0.0, caught);
        const double speed = DP_GRAVITY * flight;
        on[t] = (at < 0.0 && (at < -1.6 || at > -1.5)) ||
                at >= flight;  // it has stepped before, long ago
        scene_com(
            &s, t, 2.0 * at, -1.0 * at,
            2.0 - 0.5 * DP_GRAVITY * since * since - speed * down * (1.0 - 0.5 * down / caught));
    }
    CHECK(fall > 0.5);
    CHECK(dp_walker_accelerate(gait, 0, on, 1, RATE, options, accel, velocity) == DP_OK);
    double most = 0.0;
    for (int t = 0; t < TIMES; ++t) most = fmax(most, accel[2 * TIMES + t]);
    scene_free(&s);
    return most;
}

// who flies falls, and goes on over the ground as fast as before
TEST(in_the_air_nothing_but_weight_pulls)
{
    const DpLoadOptions options = dp_load_options_default();
    jump(&options);
    for (int t = (int)(2.1 * RATE); t < (int)(2.3 * RATE); ++t) {
        CHECK_NEAR(accel[2 * TIMES + t], -DP_GRAVITY, 0.3);
        CHECK_NEAR(accel[t], 0.0, 0.05);
        CHECK_NEAR(accel[TIMES + t], 0.0, 0.05);
        CHECK_NEAR(velocity[t], 2.0, 0.02);
        CHECK_NEAR(velocity[TIMES + t], -1.0, 0.02);
    }
}

// who flies is caught by knocks, however seldom it steps: a bound of its own
TEST(a_landing_has_a_bound_of_its_own)
{
    DpLoadOptions options = dp_load_options_default();
    options.cutoff_low = 2.0, options.cutoff_high = 9.0;
    options.cutoff_knock = 1.0;  // nothing sharper than the bound
    options.cutoff_flight = 3.0;
    const double smooth = jump(&options);
    options.cutoff_flight = 9.0;
    const double sharp = jump(&options);
    printf("    %.2f %.2f\n", smooth, sharp);
    CHECK(sharp > 1.2 * smooth);
}

// the last of a fall counts as its last tenth of a second does, 25 samples, though the nearest to the ground show none:
// the parabola through those has 0.52 g, that through 24 of them 0.48 g
TEST(a_fall_lasts_until_it_touches)
{
    enum
    {
        COUNT = 120,
        END = 90,
        EVEN = 12
    };
    uint8_t air[COUNT];
    double  high[COUNT];
    for (int t = 0; t < COUNT; ++t) {
        const double fall = 0.897 * DP_GRAVITY, since = fmin(t, END - EVEN) / RATE;
        const double rest = fmax(t - (END - EVEN), 0.0) / RATE;
        air[t] = t < END;
        high[t] = 5.0 - 0.5 * fall * since * since - fall * since * rest;
    }
    CHECK(dp_walker_falls(air, high, COUNT, RATE));
    for (int t = 0; t < COUNT; ++t) CHECK(air[t] == (t < END));
}

int main(void)
{
    RUN(the_shorter_of_two_steps_counts);
    RUN(two_limbs_step_twice_as_often);
    RUN(who_stands_is_smoothed_most);
    RUN(who_falls_flies);
    RUN(what_lands_at_once_is_one_step);
    RUN(in_the_air_nothing_but_weight_pulls);
    RUN(a_landing_has_a_bound_of_its_own);
    RUN(a_fall_lasts_until_it_touches);
    return check_done();
}
