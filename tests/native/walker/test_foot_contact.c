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
    uint8_t on[LIMBS * T];
    double  clearance[LIMBS];
    scene_touch(&s, T, LIMBS, 1, on, clearance);
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
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
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
    uint8_t on[LIMBS * T];
    double  clearance[LIMBS];
    scene_touch(&s, T, LIMBS, 1, on, clearance);
    for (int k = 0; k < LIMBS * T; ++k) CHECK(on[k] == 0);
    for (int p = 0; p < LIMBS; ++p) CHECK(isfinite(clearance[p]));
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
    uint8_t on[2 * N];
    double  clearance[2];
    s.point_role[0] = DP_POINT_BALL;
    for (int t = N / 2; t < N; ++t) scene_put(&s, N, 0, t, 0.0, 0.1, 0.0);  // one has stepped down
    scene_touch(&s, N, 2, 1, on, clearance);
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
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
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
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
    int last = N - 1;
    while (!on[last]) --last;
    CHECK_NEAR((double)last / (2.0 * RATE), 1.41, 0.015);
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
    uint8_t on[2 * N];
    double  clearance[2];
    scene_touch(&s, N, 2, 1, on, clearance);
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
    RUN(two_feet_on_a_box_both_carry);
    RUN(the_ground_marks_the_edges);
    RUN(a_foot_that_is_drawn_ahead_leaves_as_it_is_sped_up);
    RUN(short_ticks_and_gaps_close);
    RUN(refuses_uneven_times_and_missing_memory);
    return check_done();
}
