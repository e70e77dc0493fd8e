// Resampling: counts, exact cubics, uneven times, rotations the shortest way.
#include "base/vec.h"
#include "check.h"
#include "scene.h"

TEST(counts_samples_that_fit)
{
    CHECK(dp_gait_resample_count(0.0, 1.0, 120.0) == 121);
    CHECK(dp_gait_resample_count(0.0, 0.999, 10.0) == 10);
    CHECK(dp_gait_resample_count(2.0, 2.0, 24.0) == 1);
    CHECK(dp_gait_resample_count(0.0, 7.0 / 24.0, 24.0) == 8);  // rounding keeps the last one
    CHECK(dp_gait_resample_count(0.0, 1.0, 0.0) == 0);
    CHECK(dp_gait_resample_count(1.0, 0.0, 24.0) == 0);
    CHECK(dp_gait_resample_count(0.0, 1e9, 1e9) == 0);
}

static double cubic_path(double t)
{
    return 0.3 + 1.1 * t - 0.7 * t * t + 0.4 * t * t * t;
}

TEST(keeps_cubics_on_uneven_times)
{
    enum
    {
        T = 9
    };
    Scene  s = scene_make(T, 24.0, 1, 1);
    double t = 0.0;
    for (int k = 0; k < T; ++k) {
        s.time[k] = t;
        scene_com(&s, k, cubic_path(t), -cubic_path(t), 1.0);
        scene_put(&s, T, 0, k, 2.0 * cubic_path(t), t, -t);
        t += k % 2 ? 0.05 : 0.03;
    }
    const DpGait* gait = scene_gait(&s, T, 1, 1);
    const double  last = s.time[T - 1];
    enum
    {
        MAX_SAMPLES = 200
    };
    double    time[MAX_SAMPLES], com[3 * MAX_SAMPLES], pose[7 * MAX_SAMPLES];
    const int count = dp_gait_resample_count(0.0, last, 240.0);
    CHECK(count > 60 && count < MAX_SAMPLES);
    CHECK(dp_gait_resample(gait, 240.0, count, time, com, pose) == DP_OK);
    for (int k = 0; k < count; ++k) {
        CHECK_NEAR(time[k], (double)k / 240.0, 1e-12);
        CHECK_NEAR(com[3 * k], cubic_path(time[k]), 1e-12);
        CHECK_NEAR(com[3 * k + 1], -cubic_path(time[k]), 1e-12);
        CHECK_NEAR(pose[7 * k], 2.0 * cubic_path(time[k]), 1e-12);
        CHECK_NEAR(pose[7 * k + 2], -time[k], 1e-12);
    }
    CHECK(dp_gait_resample(gait, 240.0, count + 1, time, com, pose) == DP_BAD_ARGUMENT);
    scene_free(&s);
}

TEST(turns_the_shortest_way)
{
    Scene s = scene_make(2, 1.0, 1, 1);
    // 90 degrees about z; the second quaternion with its sign turned, which is the same rotation
    const double h = sqrt(0.5);
    double*      q = s.pose + 7 + 3;
    q[0] = -h, q[3] = -h;
    const DpGait* gait = scene_gait(&s, 2, 1, 1);
    double        time[11], com[33], pose[77];
    CHECK(dp_gait_resample(gait, 10.0, 11, time, com, pose) == DP_OK);
    for (int k = 0; k < 11; ++k) {
        const double angle = 0.5 * DP_PI / 2.0 * (double)k / 10.0;
        CHECK_NEAR(fabs(pose[7 * k + 3]), cos(angle), 1e-9);
        CHECK_NEAR(fabs(pose[7 * k + 6]), sin(angle), 1e-9);
    }
    scene_free(&s);
}

// the quaternion of a foot that rolls to and fro while it turns to the side, at a time
static DpQuat rolling(double t)
{
    const DpQuat side = dp_quat_about(dp_vec3(0.0, 0.0, 1.0), 0.5 * sin(5.0 * t));
    return dp_quat_product(side, dp_quat_about(dp_vec3(0.0, 1.0, 0.0), 0.8 * sin(9.0 * t)));
}

TEST(turns_without_a_jerk_at_frames)
{
    enum
    {
        T = 25,
        FINE = 241
    };
    Scene s = scene_make(T, 24.0, 1, 1);
    for (int k = 0; k < T; ++k) {
        const DpQuat q = rolling((double)k / 24.0);
        double*      out = s.pose + 7 * k + 3;
        const double sign = k % 3 ? 1.0 : -1.0;  // either sign is the same turn
        out[0] = sign * q.w, out[1] = sign * q.x, out[2] = sign * q.y, out[3] = sign * q.z;
    }
    static double time[FINE], com[3 * FINE], pose[7 * FINE];
    CHECK(dp_gait_resample(scene_gait(&s, T, 1, 1), 240.0, FINE, time, com, pose) == DP_OK);
    double worst = 0.0;
    for (int k = 0; k < FINE; ++k) {
        const double* p = pose + 7 * k + 3;
        const DpQuat  q = rolling(time[k]);
        const double  dot = fabs(p[0] * q.w + p[1] * q.x + p[2] * q.y + p[3] * q.z);
        CHECK_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3], 1.0, 1e-12);
        worst = fmax(worst, 2.0 * acos(fmin(dot, 1.0)));
    }
    CHECK(worst < 2e-3);  // [rad]; a slerp from frame to frame is off by 14e-3
    scene_free(&s);
}

TEST(who_tumbles_turns_the_shortest_way)
{
    // a turn of 160 degrees from frame to frame: two frames on nobody knows which way it went
    Scene s = scene_make(4, 1.0, 1, 1);
    for (int k = 0; k < 4; ++k) {
        const DpQuat q = dp_quat_about(dp_vec3(1.0, 0.0, 0.0), 2.8 * (double)k);
        double*      out = s.pose + 7 * k + 3;
        out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
    }
    double time[31], com[93], pose[217];
    CHECK(dp_gait_resample(scene_gait(&s, 4, 1, 1), 10.0, 31, time, com, pose) == DP_OK);
    for (int k = 0; k < 31; ++k) CHECK_NEAR(fabs(pose[7 * k + 3]), fabs(cos(0.14 * k)), 1e-9);
    scene_free(&s);
}

TEST(copies_a_single_sample)
{
    Scene s = scene_make(1, 24.0, 2, 1);
    scene_put(&s, 1, 1, 0, 1.0, 2.0, 3.0);
    scene_com(&s, 0, 4.0, 5.0, 6.0);
    double time[1], com[3], pose[14];
    CHECK(dp_gait_resample(scene_gait(&s, 1, 2, 1), 120.0, 1, time, com, pose) == DP_OK);
    CHECK_NEAR(com[2], 6.0, 0.0);
    CHECK_NEAR(pose[9], 3.0, 0.0);
    CHECK_NEAR(pose[10], 1.0, 0.0);
    scene_free(&s);
}

TEST(refuses_times_that_stand_still)
{
    Scene s = scene_make(3, 24.0, 1, 1);
    s.time[1] = s.time[2];
    double    time[9], com[27], pose[63];
    const int count = dp_gait_resample_count(s.time[0], s.time[2], 24.0);
    CHECK(dp_gait_resample(scene_gait(&s, 3, 1, 1), 24.0, count, time, com, pose) ==
          DP_BAD_ARGUMENT);
    CHECK(dp_gait_resample(NULL, 24.0, count, time, com, pose) == DP_BAD_ARGUMENT);
    scene_free(&s);
}

int main(void)
{
    RUN(counts_samples_that_fit);
    RUN(keeps_cubics_on_uneven_times);
    RUN(turns_the_shortest_way);
    RUN(turns_without_a_jerk_at_frames);
    RUN(who_tumbles_turns_the_shortest_way);
    RUN(copies_a_single_sample);
    RUN(refuses_times_that_stand_still);
    return check_done();
}
