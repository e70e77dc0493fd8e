// How the ground accelerates a body: low-passed by how often it steps, in free fall where it flies.
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

int main(void)
{
    RUN(the_shorter_of_two_steps_counts);
    RUN(two_limbs_step_twice_as_often);
    RUN(who_stands_is_smoothed_most);
    RUN(who_falls_flies);
    return check_done();
}
