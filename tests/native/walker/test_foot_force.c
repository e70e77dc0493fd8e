// Loads: TRAIL (3), SOFT22 (3)-(8) and Newton's law for the whole body.
#include "check.h"
#include "scene.h"

#define RATE 120.0

static void run(Scene* s, int times, int limbs, int points, const uint8_t* on,
                DpLoadOptions options, double* force, double* point)
{
    CHECK(dp_foot_force(scene_gait(s, times, limbs, points), on, s->ground, &options, force,
                        point) == DP_OK);
}

// a body that bobs: F = m (g - a) at every sample, braking and pushing with it
TEST(newton_holds_for_a_bobbing_body)
{
    enum
    {
        N = 240
    };
    Scene        s = scene_make(N, RATE, 2, 1);
    const double w = 2.0 * DP_PI * 1.0, high = 0.03, wide = 0.02;
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE;
        scene_com(&s, t, wide * sin(w * now), 0.0, 1.0 + high * cos(w * now));
        scene_put(&s, N, 0, t, 0.0, 0.15, 0.0);
        scene_put(&s, N, 1, t, 0.0, -0.15, 0.0);
    }
    uint8_t on[2 * N];
    memset(on, 1, sizeof on);
    double force[6 * N], point[6 * N];
    run(&s, N, 2, 1, on, dp_load_options_default(), force, point);
    for (int t = 40; t < N - 40; ++t) {
        const double now = (double)t / RATE;
        const double fx = force[3 * t] + force[3 * (N + t)],
                     fz = force[3 * t + 2] + force[3 * (N + t) + 2];
        CHECK_NEAR(fz, -s.mass * (9.81 - high * w * w * cos(w * now)), 0.01 * s.mass * 9.81);
        CHECK_NEAR(fx, s.mass * wide * w * w * sin(w * now), 0.01 * s.mass * 9.81);
    }
    scene_free(&s);
}

TEST(jump_weighs_right)
{
    // stand, push, fly, land, stand: what the ground gives over the clip is what gravity takes
    enum
    {
        N = 360
    };
    Scene   s = scene_make(N, RATE, 1, 1);
    uint8_t on[N];
    double  v = 0.0, z = 1.0;
    for (int t = 0; t < N; ++t) {
        const double now = (double)t / RATE;
        // 0.3 s push at 1.8 g, 0.48928 s flight, 0.3 s landing at 1.8 g
        const double a = now < 0.8    ? 0.0
                         : now < 1.1  ? 7.848
                         : now < 1.58 ? -9.81
                         : now < 1.88 ? 7.848
                                      : 0.0;
        scene_com(&s, t, 0.0, 0.0, z);
        z += v / RATE + 0.5 * a / RATE / RATE;
        v += a / RATE;
        on[t] = !(now >= 1.1 && now < 1.58);
    }
    double force[3 * N], point[3 * N];
    run(&s, N, 1, 1, on, dp_load_options_default(), force, point);
    double sum = 0.0;
    for (int t = 0; t < N; ++t) {
        sum -= force[3 * t + 2] / (s.mass * DP_GRAVITY) / RATE;
        CHECK(force[3 * t + 2] <= 0.0);
        if (!on[t]) {
            CHECK(force[3 * t + 2] == 0.0);
            CHECK(isnan(point[3 * t]));
        }
    }
    CHECK_NEAR(sum, (double)N / RATE, 0.06);
    scene_free(&s);
}

TEST(ramps_ease_from_foot_to_foot)
{
    // a body over the middle of two feet 20 cm apart, 0.2 s of both down
    enum
    {
        N = 240
    };
    Scene   s = scene_make(N, RATE, 2, 1);
    uint8_t on[2 * N];
    for (int t = 0; t < N; ++t) {
        scene_com(&s, t, 0.1 * sin(0.5 * DP_PI * (double)(t - 120) / 60.0), 0.0, 1.0);
        scene_put(&s, N, 0, t, -0.1, 0.0, 0.0);
        scene_put(&s, N, 1, t, 0.1, 0.0, 0.0);
        on[t] = t < 132;
        on[N + t] = t >= 108;
    }
    double force[6 * N], point[6 * N];
    run(&s, N, 2, 1, on, dp_load_options_default(), force, point);
    double before = -1.0;
    for (int t = 100; t < 140; ++t) {
        const double right = -force[3 * (N + t) + 2] / (s.mass * DP_GRAVITY);
        CHECK(right >= before - 1e-9);
        CHECK(right - before < 0.2 || before < 0.0);
        before = right;
    }
    CHECK_NEAR(-force[3 * (N + 120) + 2] / (s.mass * DP_GRAVITY), 0.5, 0.1);
    scene_free(&s);
}

// A body that travels over two feet, one ahead of the other, both down: fx of each foot and in all.
static void stride(double speed, double wobble, double* behind, double* ahead)
{
    enum
    {
        N = 240
    };
    Scene s = scene_make(N, RATE, 2, 1);
    for (int t = 0; t < N; ++t) {
        const double now = (double)(t - N / 2) / RATE;
        scene_com(&s, t, speed * now + wobble * sin(2.0 * DP_PI * 4.5 * now), 0.0, 1.0);
        scene_put(&s, N, 0, t, -0.3, 0.1, 0.0);
        scene_put(&s, N, 1, t, 0.3, -0.1, 0.0);
    }
    uint8_t on[2 * N];
    memset(on, 1, sizeof on);
    double force[6 * N], point[6 * N];
    run(&s, N, 2, 1, on, dp_load_options_default(), force, point);
    for (int t = 0; t < N; ++t) {
        behind[t] = force[3 * t] / (s.mass * DP_GRAVITY);
        ahead[t] = force[3 * (N + t)] / (s.mass * DP_GRAVITY);
    }
    scene_free(&s);
}

TEST(feet_under_way_oppose_each_other)
{
    double behind[240], ahead[240];
    stride(1.2, 0.0, behind, ahead);
    for (int t = 60; t < 180; ++t) CHECK_NEAR(behind[t] + ahead[t], 0.0, 1e-6);  // nobody speeds up
    // halfway both carry half, 0.3 m from the line under a mass centre 1 m high: on the ground, the
    // foot behind pushes back and the one ahead forward
    CHECK_NEAR(behind[120], -0.5 * 0.3, 0.01);
    CHECK_NEAR(ahead[120], 0.5 * 0.3, 0.01);
    stride(0.0, 0.0, behind, ahead);  // one who stands does not strain
    CHECK_NEAR(ahead[120], 0.0, 1e-9);
}

TEST(level_noise_is_not_a_step)
{
    // 2 mm of wobble at 4.5 Hz would be 0.16 g: walkers do not push like that
    double behind[240], ahead[240], most = 0.0;
    stride(1.2, 0.002, behind, ahead);
    for (int t = 60; t < 180; ++t) most = fmax(most, fabs(behind[t] + ahead[t]));
    CHECK(most < 0.05);
}

TEST(who_flies_falls_freely)
{
    // hops of 0.1 s stance and 0.12 s flight, as in a sprint: a low-pass gives half of a peak away
    enum
    {
        N = 360
    };
    Scene        s = scene_make(N, RATE, 1, 1);
    const double stance = 0.1, period = 0.22, fine = 4800.0;
    uint8_t      on[N];
    double       truth[N], v = 0.0, z = 1.0;
    // the speed at the start of a stance that comes back after a period
    const double most = DP_PI / 2.0 * period / stance;
    v = -DP_GRAVITY * (period - stance) / 2.0;
    int next = 0;
    for (int k = 0; next < N; ++k) {
        const double now = (double)k / fine, in = fmod(now, period);
        const double force = in < stance ? most * sin(DP_PI * in / stance) : 0.0;
        if ((double)next / RATE <= now + 1e-9) {
            scene_com(&s, next, 0.0, 0.0, z);
            on[next] = in < stance;
            truth[next++] = force;
        }
        v += (force - 1.0) * DP_GRAVITY / fine;
        z += v / fine;
    }
    double force[3 * N], point[3 * N], sum = 0.0;
    run(&s, N, 1, 1, on, dp_load_options_default(), force, point);
    for (int t = 40; t < N - 40; ++t) {
        const double error = -force[3 * t + 2] / (s.mass * DP_GRAVITY) - truth[t];
        sum += error * error / (N - 80);
    }
    CHECK(sqrt(sum) < 0.15);  // 0.5 by a low-pass alone
    scene_free(&s);
}

// the same fall at any rate: m (g + v / tau) at impact, TRAIL (3)
static double fall_force(double rate, bool half_sine, double* impulse)
{
    const int times = (int)(2.0 * rate);
    Scene     s = scene_make(times, rate, 1, 1);
    s.mass = 50.0;
    uint8_t*     on = dp_alloc((size_t)times, 1);
    double*      force = dp_alloc(3 * (size_t)times, sizeof(double));
    double*      point = dp_alloc(3 * (size_t)times, sizeof(double));
    const double fall = sqrt(2.0 * 2.5 / 9.81);
    for (int t = 0; t < times; ++t) {
        const double now = (double)t / rate;
        const double z = now < fall ? 2.5 - 0.5 * 9.81 * now * now : 0.0;
        scene_com(&s, t, 0.0, 0.0, z);
        scene_put(&s, times, 0, t, 0.0, 0.0, z);
        on[t] = now >= fall;
    }
    DpLoadOptions options = dp_load_options_default();
    options.model = DP_LOAD_IMPULSE;
    options.half_sine = half_sine;
    run(&s, times, 1, 1, on, options, force, point);
    double most = 0.0;
    *impulse = 0.0;
    for (int t = 0; t < times; ++t) {
        most = fmax(most, -force[3 * t + 2]);
        if (on[t]) *impulse += (-force[3 * t + 2] - s.mass * DP_GRAVITY) / rate;
    }
    dp_free(on), dp_free(force), dp_free(point);
    scene_free(&s);
    return most;
}

TEST(impulse_of_fall)
{
    double impulse;
    for (double rate = 60.0; rate < 500.0; rate *= 2.0) {
        CHECK_CLOSE(fall_force(rate, false, &impulse), 2241.0, 0.02);
        CHECK_CLOSE(impulse, 50.0 * 7.0036, 0.03);
        CHECK_CLOSE(fall_force(rate, true, &impulse), 50.0 * (9.81 + DP_PI / 2.0 * 7.0036 / 0.2),
                    0.03);
        CHECK_CLOSE(impulse, 50.0 * 7.0036, 0.03);
    }
}

TEST(pressure_rolls_from_heel_to_ball)
{
    // one sole of three points that comes down on its heel, lies flat and lifts off over its ball
    enum
    {
        N = 120
    };
    Scene s = scene_make(N, RATE, 1, 3);
    s.point[3] = 0.18, s.point[6] = 0.25;
    s.point_role[0] = DP_POINT_HEEL, s.point_role[1] = DP_POINT_BALL,
    s.point_role[2] = DP_POINT_TIP;
    uint8_t on[N];
    for (int t = 0; t < N; ++t) {
        on[t] = t >= 10 && t < 110;
        const double tilt = t < 30   ? -0.35 * (30.0 - t) / 20.0
                            : t > 70 ? 0.5 * (t - 70.0) / 40.0
                                     : 0.0;
        double*      q = s.pose + 7 * t + 3;
        q[0] = cos(tilt / 2.0), q[2] = sin(tilt / 2.0);  // about y: nose down is positive
        scene_com(&s, t, 0.1, 0.0, 1.0);
    }
    double force[3 * N], point[3 * N];
    run(&s, N, 1, 3, on, dp_load_options_default(), force, point);
    CHECK_NEAR(point[3 * 14], 0.0, 0.03);
    CHECK_NEAR(point[3 * 100], 0.2, 0.05);
    for (int t = 12; t < 100; ++t) {
        CHECK(point[3 * t] - point[3 * (t - 1)] < 0.03);
        CHECK_NEAR(point[3 * t + 2], 0.0, 1e-12);  // on the ground
    }
    scene_free(&s);
}

TEST(refuses_bad_options_and_missing_memory)
{
    enum
    {
        N = 30
    };
    Scene   s = scene_make(N, RATE, 1, 1);
    uint8_t on[N];
    memset(on, 1, sizeof on);
    double        force[3 * N], point[3 * N];
    DpLoadOptions options = dp_load_options_default();
    const DpGait* gait = scene_gait(&s, N, 1, 1);
    for (long k = 0; k < 16; ++k) {
        dp_alloc_fail_after(k);
        CHECK(dp_foot_force(gait, on, s.ground, &options, force, point) == DP_NO_MEMORY);
    }
    dp_alloc_fail_after(-1);
    CHECK(dp_foot_force(gait, on, s.ground, &options, force, point) == DP_OK);
    options.settle_time = 0.0;
    CHECK(dp_foot_force(gait, on, s.ground, &options, force, point) == DP_BAD_ARGUMENT);
    s.mass = -1.0;
    options = dp_load_options_default();
    CHECK(dp_foot_force(gait, on, s.ground, &options, force, point) == DP_BAD_ARGUMENT);
    scene_free(&s);
}

// who speeds up over four feet weighs on the hind ones: the force points from the zero-moment point to the mass centre,
// x = x_com - a h / g, and by its path to the front where it brakes
TEST(who_speeds_up_weighs_behind)
{
    enum
    {
        N = 120
    };
    const double feet[4][2] = {{0.4, 0.15}, {0.4, -0.15}, {-0.4, 0.15}, {-0.4, -0.15}};
    uint8_t      on[4 * N];
    memset(on, 1, sizeof on);
    for (double a = -1.0; a <= 1.0; a += 1.0) {
        Scene s = scene_make(N, RATE, 4, 1);
        for (int t = 0; t < N; ++t) {
            const double since = (t - N / 2) / RATE;
            scene_com(&s, t, 0.5 * a * since * since, 0.0, 1.0);
            for (int p = 0; p < 4; ++p) scene_put(&s, N, p, t, feet[p][0], feet[p][1], 0.0);
        }
        double        force[3 * 4 * N], point[3 * 4 * N], at = 0.0, total = 0.0;
        DpLoadOptions options = dp_load_options_default();
        options.ramp_trust = 0.0;
        run(&s, N, 4, 1, on, options, force, point);
        for (int p = 0; p < 4; ++p) {
            const double up = -force[3 * (p * N + N / 2) + 2];
            at += up * feet[p][0], total += up;
        }
        CHECK_NEAR(at / total, -a / DP_GRAVITY, 0.005);
        scene_free(&s);
    }
}

int main(void)
{
    RUN(newton_holds_for_a_bobbing_body);
    RUN(jump_weighs_right);
    RUN(ramps_ease_from_foot_to_foot);
    RUN(feet_under_way_oppose_each_other);
    RUN(level_noise_is_not_a_step);
    RUN(who_flies_falls_freely);
    RUN(impulse_of_fall);
    RUN(pressure_rolls_from_heel_to_ball);
    RUN(refuses_bad_options_and_missing_memory);
    RUN(who_speeds_up_weighs_behind);
    return check_done();
}
