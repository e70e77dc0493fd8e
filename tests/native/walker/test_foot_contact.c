// Contact, TRAIL (4): calibration, hysteresis, ticks and gaps, who carries what does not fall.
#include "check.h"
#include "scene.h"

enum
{
    T = 360,
    LIMBS = 2
};
#define RATE 120.0

// Two feet that take turns: each rests for 0.6 s of a 1 s stride and swings 15 cm high; the whole
// clip hovers by `hover`. The body walks along x.
static Scene walking(double hover, double ramp)
{
    Scene s = scene_make(T, RATE, LIMBS, 1);
    for (int t = 0; t < T; ++t) {
        const double now = (double)t / RATE;
        scene_com(&s, t, 1.2 * now, 0.0, 1.0 + hover);
        for (int p = 0; p < LIMBS; ++p) {
            const double phase = now + 0.5 * (double)p, stride = floor(phase), u = phase - stride;
            const double swing = u < 0.6 ? 0.0 : (u - 0.6) / 0.4;
            const double ease = swing * swing * (3.0 - 2.0 * swing);
            const double x = 1.2 * (stride + ease) - 0.6 * (double)p;
            scene_put(&s, T, p, t, x, p ? -0.1 : 0.1,
                      hover + ramp * x + 0.15 * sin(3.14159265 * swing) * sin(3.14159265 * swing));
            s.ground[p * T + t] = ramp * x;
        }
    }
    return s;
}

static int share_touching(const uint8_t* on)
{
    int sum = 0;
    for (int t = 0; t < T; ++t) sum += on[t];
    return sum;
}

static void check_walk(double hover, double ramp, double drift)
{
    Scene s = walking(hover, ramp);
    for (int k = 0; k < LIMBS * T; ++k)
        s.pose[7 * k + 2] += drift * (s.pose[7 * k] - s.com[3 * (T / 2)]);
    uint8_t               on[LIMBS * T];
    double                clearance[LIMBS];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, T, LIMBS, 1), s.ground, &limits, on, clearance) == DP_OK);
    for (int p = 0; p < LIMBS; ++p) {
        CHECK_NEAR(clearance[p], hover, 2e-3);
        CHECK_CLOSE(share_touching(on + p * T), 0.6 * T, 0.12);
        for (int t = 1; t < T - 1; ++t) {
            const double phase = (double)t / RATE + 0.5 * (double)p, u = phase - floor(phase);
            if (u > 0.02 && u < 0.58) CHECK(on[p * T + t] == 1);
            if (u > 0.70 && u < 0.92) CHECK(on[p * T + t] == 0);
        }
    }
    scene_free(&s);
}

TEST(resting_foot_touches)
{
    check_walk(0.0, 0.0, 0.0);
}

TEST(hovering_clip_touches)
{
    check_walk(0.04, 0.0, 0.0);
    check_walk(-0.03, 0.0, 0.0);
}

TEST(a_long_stay_is_one_stay)
{
    // four steps on the ground, and between the second and the third a wait on the ball of the foot
    enum
    {
        N = 3600
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE, wait = fmin(fmax(now - 2.0, 0.0), 26.0);
        const double at = now - wait, u = at - floor(at);
        const double swing = u < 0.6 ? 0.0 : (u - 0.6) / 0.4, lift = sin(3.14159265 * swing);
        const double high = wait > 0.0 && wait < 26.0 ? 0.02 : 0.15 * lift * lift;
        scene_com(&s, t, 1.2 * at, 0.0, 1.0);
        scene_put(&s, N, 0, t, 1.2 * (floor(at) + swing * swing * (3.0 - 2.0 * swing)), 0.1, high);
        scene_put(&s, N, 1, t, 0.0, -0.1, 0.0);
    }
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
    CHECK_NEAR(clearance[0], 0.0, 2e-3);
    scene_free(&s);
}

TEST(waiting_before_a_walk_in_place_hides_no_belt)
{
    Scene s = walking(0.0, 0.0);
    enum
    {
        N = 3 * T
    };
    Scene                 w = scene_make(N, RATE, LIMBS, 1);
    uint8_t               there[LIMBS * T], here[LIMBS * N];
    double                clearance[LIMBS];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, T, LIMBS, 1), s.ground, &limits, there, clearance) ==
          DP_OK);
    for (int t = 0; t < N; ++t) {
        const int from = t < 2 * T ? 0 : t - 2 * T;
        scene_com(&w, t, 0.0, 0.0, s.com[3 * from + 2]);
        for (int p = 0; p < LIMBS; ++p) {
            const double* at = s.pose + 7 * (p * T + from);
            scene_put(&w, N, p, t, at[0] - s.com[3 * from], at[1], at[2]);
        }
    }
    CHECK(dp_foot_contact(scene_gait(&w, N, LIMBS, 1), w.ground, &limits, here, clearance) ==
          DP_OK);
    int other = 0;
    for (int p = 0; p < LIMBS; ++p)
        for (int t = 10; t < T; ++t) other += there[p * T + t] != here[p * N + 2 * T + t];
    CHECK(other < 12);
    scene_free(&s), scene_free(&w);
}

TEST(slope_given_as_ground_touches)
{
    check_walk(0.01, 0.2, 0.0);
}

// a capture floor that drops 10 cm over the walk
TEST(leaning_floor_touches)
{
    check_walk(0.02, 0.0, -0.03);
    check_walk(0.0, 0.0, 0.02);
}

TEST(walker_in_place_touches)
{
    Scene                 s = walking(0.01, 0.0);
    uint8_t               there[LIMBS * T], here[LIMBS * T];
    double                clearance[LIMBS];
    const DpContactLimits limits = dp_contact_limits_default();
    const DpGait*         gait = scene_gait(&s, T, LIMBS, 1);
    CHECK(dp_foot_contact(gait, s.ground, &limits, there, clearance) == DP_OK);
    for (int t = 0; t < T; ++t) {
        for (int p = 0; p < LIMBS; ++p) s.pose[7 * (p * T + t)] -= s.com[3 * t];
        s.com[3 * t] = 0.0;
    }
    CHECK(dp_foot_contact(gait, s.ground, &limits, here, clearance) == DP_OK);
    int other = 0;
    for (int k = 0; k < LIMBS * T; ++k) other += there[k] != here[k];
    CHECK(other < 12);
    scene_free(&s);
}

TEST(nothing_touches_where_there_is_no_ground)
{
    Scene s = walking(0.0, 0.0);
    for (int k = 0; k < LIMBS * T; ++k) s.ground[k] = NAN;
    uint8_t               on[LIMBS * T];
    double                clearance[LIMBS];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, T, LIMBS, 1), s.ground, &limits, on, clearance) == DP_OK);
    for (int k = 0; k < LIMBS * T; ++k) CHECK(on[k] == 0);
    for (int p = 0; p < LIMBS; ++p) CHECK(isfinite(clearance[p]));
    scene_free(&s);
}

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
    uint8_t               on[N];
    double                clearance[1];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 1, 1), s.ground, &limits, on, clearance) == DP_OK);
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
    uint8_t               on[N];
    double                clearance[1];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 1, 1), s.ground, &limits, on, clearance) == DP_OK);
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
    uint8_t               on[N];
    double                clearance[1];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 1, 1), s.ground, &limits, on, clearance) == DP_OK);
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
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
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
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
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
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
    CHECK_NEAR(clearance[0], 0.0, 1e-3);
    for (int t = 0; t < N; ++t) {
        if (t < N / 4) CHECK(on[t] == 1 && on[N + t] == 1);
        if (t > N / 2) CHECK(on[t] == 0 && on[N + t] == 0);
    }
    scene_free(&s);
}

TEST(two_feet_on_a_box_both_carry)
{
    enum
    {
        N = 120
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        scene_com(&s, t, 0.0, 0.0, 1.4);
        scene_put(&s, N, 0, t, 0.0, 0.1, 0.4);
        scene_put(&s, N, 1, t, 0.0, -0.1, 0.4 + 0.002 * sin((double)t));
    }
    // the ground's height is that below the box
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    s.point_role[0] = DP_POINT_BALL;
    for (int t = N / 2; t < N; ++t) scene_put(&s, N, 0, t, 0.0, 0.1, 0.0);  // one has stepped down
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
    for (int t = 10; t < N / 2 - 20; ++t) CHECK(on[t] && on[N + t]);
    scene_free(&s);
}

TEST(the_ground_marks_the_edges)
{
    // a heel that skims the ground and falls the last centimetre, ever faster until it is stopped;
    // it stands, and is pulled up ever faster
    enum
    {
        N = 240
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE;
        const double down = now < 0.8 ? 0.8 - now : 0.0, up = now > 1.4 ? now - 1.4 : 0.0;
        const double near = fmin(down, 0.06);
        const double high = down < 0.053 ? 0.36 * down - 3.4 * down * down
                                         : 0.0095 + 0.5 * (down - 0.053) * (down - 0.053);
        scene_com(&s, t, now, 0.0, 1.0);
        scene_put(&s, N, 0, t, up - 15.0 * near * near - 1.8 * (down - near), 0.1,
                  high + 4.0 * up * up);
        scene_put(&s, N, 1, t, 0.0, -0.1, 0.0);  // the other stands
    }
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
    int first = 0, last = N - 1;
    while (!on[first]) ++first;
    while (!on[last]) --last;
    CHECK_NEAR((double)first / RATE, 0.8, 0.021);
    CHECK_NEAR((double)last / RATE, 1.4, 0.035);
    scene_free(&s);
}

TEST(a_foot_that_is_drawn_ahead_leaves_as_it_is_sped_up)
{
    // the ball is lifted a little as the foot rolls over its toes, and drawn ahead 50 ms later
    enum
    {
        N = 480
    };
    Scene  s = scene_make(N, 2.0 * RATE, 2, 1);
    double x = 0.0, speed = 0.0, z = 0.0, rise = 0.0;
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / (2.0 * RATE);
        const double roll = (now - 1.34) / 0.04, draw = (now - 1.39) / 0.04;
        if (roll > 0.0 && roll < 1.0) rise += 8.0 * sin(3.14159265 * roll) / (2.0 * RATE);
        if (draw > 0.0 && draw < 1.0) speed += 60.0 * sin(3.14159265 * draw) / (2.0 * RATE);
        x += speed / (2.0 * RATE), z += rise / (2.0 * RATE);
        scene_com(&s, t, now, 0.0, 1.0);
        scene_put(&s, N, 0, t, x, 0.1, z);
        scene_put(&s, N, 1, t, 0.0, -0.1, 0.0);
    }
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
    int last = N - 1;
    while (!on[last]) --last;
    CHECK_NEAR((double)last / (2.0 * RATE), 1.41, 0.015);
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
    uint8_t               on[N];
    double                clearance[1];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 1, 1), s.ground, &limits, on, clearance) == DP_OK);
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
    uint8_t               on[N];
    double                clearance[1];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 1, 1), s.ground, &limits, on, clearance) == DP_OK);
    int first = 0;
    while (first < N && !on[first]) ++first;
    CHECK_NEAR((double)first / (2.0 * RATE), 1.0, 0.02);
    scene_free(&s);
}

TEST(short_ticks_and_gaps_close)
{
    // a foot at rest that is lifted for 2 samples, and one in the air that dips for 2
    enum
    {
        N = 120
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        scene_com(&s, t, 0.0, 0.0, 1.0);
        scene_put(&s, N, 0, t, 0.0, 0.1, 0.0);
        scene_put(&s, N, 1, t, 0.0, -0.1, 0.06);
        s.ground[t] = t == 60 || t == 61 ? -0.05 : 0.0;
        s.ground[N + t] = t > 20 && t < 23 ? 0.06 : t < 10 ? 0.06 : 0.0;
    }
    uint8_t               on[2 * N];
    double                clearance[2];
    const DpContactLimits limits = dp_contact_limits_default();
    CHECK(dp_foot_contact(scene_gait(&s, N, 2, 1), s.ground, &limits, on, clearance) == DP_OK);
    for (int t = 0; t < N; ++t) CHECK(on[t] == 1);
    for (int t = 12; t < N; ++t) CHECK(on[N + t] == 0);
    scene_free(&s);
}

TEST(refuses_uneven_times_and_missing_memory)
{
    Scene                 s = walking(0.0, 0.0);
    uint8_t               on[LIMBS * T];
    double                clearance[LIMBS];
    const DpContactLimits limits = dp_contact_limits_default();
    const DpGait*         gait = scene_gait(&s, T, LIMBS, 1);
    for (long k = 0; k < 13; ++k) {
        dp_alloc_fail_after(k);
        CHECK(dp_foot_contact(gait, s.ground, &limits, on, clearance) == DP_NO_MEMORY);
    }
    dp_alloc_fail_after(-1);
    CHECK(dp_foot_contact(gait, s.ground, &limits, on, clearance) == DP_OK);
    s.pose[5] = NAN;
    CHECK(dp_foot_contact(gait, s.ground, &limits, on, clearance) == DP_BAD_ARGUMENT);
    s.pose[5] = 0.0;
    s.time[3] += 0.004;
    CHECK(dp_foot_contact(gait, s.ground, &limits, on, clearance) == DP_BAD_ARGUMENT);
    scene_free(&s);
}

int main(void)
{
    RUN(resting_foot_touches);
    RUN(hovering_clip_touches);
    RUN(a_long_stay_is_one_stay);
    RUN(waiting_before_a_walk_in_place_hides_no_belt);
    RUN(slope_given_as_ground_touches);
    RUN(leaning_floor_touches);
    RUN(walker_in_place_touches);
    RUN(nothing_touches_where_there_is_no_ground);
    RUN(flight_carries_nobody);
    RUN(falling_ball_touches_in_time);
    RUN(a_foot_that_lands_fast_is_let_go_only_once_it_was_slower);
    RUN(somebody_carries_what_does_not_fall);
    RUN(who_glides_stands_on_both_feet);
    RUN(who_hangs_presses_nothing);
    RUN(two_feet_on_a_box_both_carry);
    RUN(the_ground_marks_the_edges);
    RUN(a_foot_that_is_drawn_ahead_leaves_as_it_is_sped_up);
    RUN(a_sudden_stop_out_of_a_flight_is_timed);
    RUN(toes_that_are_lifted_in_a_fall_touch_where_they_land);
    RUN(short_ticks_and_gaps_close);
    RUN(refuses_uneven_times_and_missing_memory);
    return check_done();
}
