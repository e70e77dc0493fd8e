// Smoothing a body that flies: free fall in the air, a low-pass where it is carried.
#include "walker/walker_inside.h"

#include "check.h"

#define COUNT 240
#define RATE 120.0
#define GRAVITY 9.81

static uint8_t air[COUNT];
static double  value[COUNT], clean[COUNT];

// stands, jumps for half a second from sample 90 on, stands; `noise` [m] on every sample
static void jump(double noise)
{
    unsigned state = 3;
    for (int k = 0; k < COUNT; ++k) {
        const double t = (double)(k - 90) / RATE;
        air[k] = k > 90 && k < 150;
        clean[k] = air[k] ? 0.9 + 0.5 * GRAVITY * t * (0.5 - t) : 0.9;
        value[k] = clean[k] + noise * (check_random(&state) - 0.5);
    }
}

static void fly(double cutoff)
{
    double* scratch = dp_alloc(dp_walker_fly_scratch(COUNT), sizeof *scratch);
    dp_walker_fly(value, air, COUNT, RATE, cutoff, -GRAVITY, scratch);
    dp_free(scratch);
}

TEST(who_is_in_the_air_falls)
{
    jump(0.004);
    fly(8.0);
    for (int k = 93; k < 148; ++k) {  // the noise alone would be 4 mm * RATE^2, six times g
        const double fall = (value[k + 1] - 2.0 * value[k] + value[k - 1]) * RATE * RATE;
        CHECK_NEAR(fall, -GRAVITY, 0.5);
        CHECK_NEAR(value[k], clean[k], 0.008);  // the corners at its ends are rounded
    }
}

TEST(a_parabola_stays_one)
{
    for (int k = 0; k < COUNT; ++k) {
        const double t = k / RATE;
        air[k] = 1, value[k] = clean[k] = 2.0 + 3.0 * t - 0.5 * GRAVITY * t * t;
    }
    fly(8.0);
    for (int k = 0; k < COUNT; ++k) CHECK_NEAR(value[k], clean[k], 1e-6);
}

// weights of stances give the low-pass's bandwidth: half the size at the cut-off
TEST(who_stands_is_smoothed)
{
    const double pi = DP_PI;
    for (int turn = 0; turn < 2; ++turn) {
        const double hertz = turn ? 30.0 : 1.0;
        double       most = 0.0;
        for (int k = 0; k < COUNT; ++k)
            air[k] = 0, value[k] = sin(2.0 * pi * hertz * k / RATE + 0.3);
        fly(6.0);
        for (int k = COUNT / 3; k < 2 * COUNT / 3; ++k) most = fmax(most, fabs(value[k]));
        if (turn)
            CHECK(most < 0.01);
        else
            CHECK_NEAR(most, 1.0, 0.01);
    }
}

TEST(a_cut_off_too_near_to_half_the_rate_leaves_it)
{
    jump(0.01);
    double was[COUNT];
    memcpy(was, value, sizeof was);
    fly(0.45 * RATE);
    CHECK(memcmp(was, value, sizeof was) == 0);
}

int main(void)
{
    RUN(who_is_in_the_air_falls);
    RUN(a_parabola_stays_one);
    RUN(who_stands_is_smoothed);
    RUN(a_cut_off_too_near_to_half_the_rate_leaves_it);
    return check_done();
}
