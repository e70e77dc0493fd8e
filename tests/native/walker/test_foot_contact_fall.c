// Contact of who flies, falls, glides and hangs. TRAIL (4)
#include "check.h"
#include "scene.h"

enum
{
    T = 360,
    LIMBS = 2
};
#define RATE 120.0

TEST(flight_carries_nobody)
{
    // a ball: rests, jumps for 0.6 s, rests
    enum
    {
        N = 240
    };
    Scene        s = scene_make(N, RATE, 1, 1);
    const double v0 = 9.81 * 0.3;
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE - 0.7;
        const double z = now > 0.0 && now < 0.6 ? v0 * now - 0.5 * 9.81 * now * now : 0.0;
        scene_com(&s, t, 0.0, 0.0, 1.0 + z);
        scene_put(&s, N, 0, t, 0.0, 0.0, z);
    }
    uint8_t on[N];
    double  clearance[1];
    scene_touch(&s, N, 1, 1, on, clearance);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE - 0.7;
        if (now < -0.03 || now > 0.63) CHECK(on[t] == 1);
        if (now > 0.05 && now < 0.55) CHECK(on[t] == 0);
    }
    scene_free(&s);
}

TEST(falling_ball_touches_in_time)
{
    enum
    {
        N = 240
    };
    Scene        s = scene_make(N, RATE, 1, 1);
    const double fall = sqrt(2.0 * 2.5 / 9.81);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE;
        const double z = now < fall ? 2.5 - 0.5 * 9.81 * now * now : 0.0;
        scene_com(&s, t, 0.0, 0.0, z);
        scene_put(&s, N, 0, t, 0.0, 0.0, z);
    }
    uint8_t on[N];
    double  clearance[1];
    scene_touch(&s, N, 1, 1, on, clearance);
    for (int t = 0; t < N; ++t)
        if (fabs((double)t / RATE - fall) > 1.5 / RATE) CHECK(on[t] == ((double)t / RATE > fall));
    scene_free(&s);
}

// A runner's foot that lands sliding, faster than feet that let go, stays on until it has been slower.
TEST(a_foot_that_lands_fast_is_let_go_only_once_it_was_slower)
{
    enum
    {
        N = 192
    };
    Scene  s = scene_make(N, RATE, 1, 1);
    double x = 0.0;
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE;
        const double speed = now < 0.5 ? 5.0 : now < 0.8 ? 1.4 : now < 1.2 ? 0.0 : 5.0;
        const double z = now < 0.5   ? 0.3 - 0.6 * now
                         : now < 1.2 ? 0.0
                                     : fmin(2.0 * (now - 1.2), 0.3);
        scene_com(&s, t, 4.0 * now, 0.0, 1.0);
        scene_put(&s, N, 0, t, x, 0.0, z);
        x += speed / RATE;
    }
    uint8_t on[N];
    double  clearance[1];
    scene_touch(&s, N, 1, 1, on, clearance);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE;
        if (now > 0.55 && now < 1.15) CHECK(on[t]);
        if (now < 0.4 || now > 1.3) CHECK(!on[t]);
    }
    scene_free(&s);
}

TEST(somebody_carries_what_does_not_fall)
{
    // the left foot stands on the ground for 1 s, then on a 30 cm block while the right swings
    enum
    {
        N = 240
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        const double up = t < N / 2 ? 0.0 : 0.3;
        scene_com(&s, t, 0.0, 0.0, 1.0 + 0.3 * (double)t / N);
        scene_put(&s, N, 0, t, 0.0, 0.1, up);
        scene_put(&s, N, 1, t, 1.5 * sin(6.0 * (double)t / RATE), -0.1, t < N / 2 ? 0.25 : 0.55);
    }
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
    CHECK_NEAR(clearance[0], 0.0, 1e-3);
    for (int t = 0; t < N; ++t) {
        if (abs(t - N / 2) < 6) continue;
        CHECK(on[t] == 1);
        CHECK(on[N + t] == 0);
    }
    scene_free(&s);
}

TEST(who_glides_stands_on_both_feet)
{
    // a skater at 2 m/s, faster than any foot that touches, and the clip hovers: the right foot a hair behind the left
    enum
    {
        N = 240
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        const double along = 2.0 * (double)t / RATE;
        scene_com(&s, t, along, 0.0, 1.1);
        scene_put(&s, N, 0, t, along, 0.1, 0.1);
        scene_put(&s, N, 1, t, along + 0.001 * sin(0.3 * (double)t), -0.1, 0.1);
    }
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
    CHECK_NEAR(clearance[0], 0.1, 1e-3);  // no point ever rests: the lowest it goes
    CHECK_NEAR(clearance[1], 0.1, 1e-3);
    for (int t = 0; t < N; ++t) CHECK(on[t] == 1 && on[N + t] == 1);
    scene_free(&s);
}

TEST(who_hangs_presses_nothing)
{
    // it stands for 1 s, is drawn up by 60 cm within another, and hangs there
    enum
    {
        N = 480
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        const double w = fmin(fmax(((double)t - N / 4.0) / (N / 4.0), 0.0), 1.0);
        const double up = 0.6 * w * w * (3.0 - 2.0 * w);
        scene_com(&s, t, 0.0, 0.0, 1.0 + up);
        scene_put(&s, N, 0, t, 0.0, 0.1, up);
        scene_put(&s, N, 1, t, 0.0, -0.1, up);
    }
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
    CHECK_NEAR(clearance[0], 0.0, 1e-3);
    for (int t = 0; t < N; ++t) {
        if (t < N / 4) CHECK(on[t] == 1 && on[N + t] == 1);
        if (t > N / 2) CHECK(on[t] == 0 && on[N + t] == 0);
    }
    scene_free(&s);
}

TEST(a_sudden_stop_out_of_a_flight_is_timed)
{
    // a low-pass makes a slope of the stop and moves the fastest fall 17 ms ahead of it
    enum
    {
        N = 480
    };
    Scene s = scene_make(N, 2.0 * RATE, 1, 1);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / (2.0 * RATE), down = now < 1.0 ? 1.0 - now : 0.0;
        const double near = fmin(down, 0.1);
        scene_com(&s, t, 0.0, 0.0, 6.0 - 0.5 * DP_GRAVITY * fmin(now * now, 1.0));
        scene_put(&s, N, 0, t, 0.0, 0.0, 0.2 * down + near * (0.8 - 4.0 * near));
    }
    uint8_t on[N];
    double  clearance[1];
    scene_touch(&s, N, 1, 1, on, clearance);
    int first = 0;
    while (first < N && !on[first]) ++first;
    CHECK_NEAR((double)first / (2.0 * RATE), 1.0, 0.0135);
    scene_free(&s);
}

TEST(toes_that_are_lifted_in_a_fall_touch_where_they_land)
{
    // they come down slower for the last 40 ms, since the foot turns about them
    enum
    {
        N = 480
    };
    Scene s = scene_make(N, 2.0 * RATE, 1, 1);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / (2.0 * RATE), down = now < 1.0 ? 1.0 - now : 0.0;
        const double near = fmin(down, 0.04);
        scene_com(&s, t, 0.0, 0.0, 6.0 - 0.5 * DP_GRAVITY * fmin(now * now, 1.0));
        scene_put(&s, N, 0, t, 0.0, 0.0, 0.7 * near + 1.6 * (down - near));
    }
    uint8_t on[N];
    double  clearance[1];
    scene_touch(&s, N, 1, 1, on, clearance);
    int first = 0;
    while (first < N && !on[first]) ++first;
    CHECK_NEAR((double)first / (2.0 * RATE), 1.0, 0.02);
    scene_free(&s);
}

int main(void)
{
    RUN(flight_carries_nobody);
    RUN(falling_ball_touches_in_time);
    RUN(a_foot_that_lands_fast_is_let_go_only_once_it_was_slower);
    RUN(somebody_carries_what_does_not_fall);
    RUN(who_glides_stands_on_both_feet);
    RUN(who_hangs_presses_nothing);
    RUN(a_sudden_stop_out_of_a_flight_is_timed);
    RUN(toes_that_are_lifted_in_a_fall_touch_where_they_land);
    return check_done();
}
