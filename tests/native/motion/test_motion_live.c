// tests of motion_live.c: of poses that are pushed as they are made, those that are still needed are kept
#include "recording.h"

TEST(a_live_motion_keeps_what_is_needed)
{
    Recording     r;
    DpMotion*     motion = NULL;
    DpPartState   state;
    const uint8_t only_first[WALKERS] = {1, 0};
    fill(&r);
    CHECK(dp_motion_live(&motion, &r.gait) == DP_OK && dp_motion_samples(motion) == 0);
    for (int t = 0; t < 1000; ++t) {
        double        pose[7 * PARTS] = {0}, force[3 * PARTS] = {0}, point[3 * PARTS] = {0};
        const uint8_t touching[PARTS] = {t == 500, t == 400, 0};
        for (int p = 0; p < PARTS; ++p) pose[7 * p + 2] = t + 0.25 * p, pose[7 * p + 3] = 1.0;
        const DpLoadedPoses now = {pose, touching, force, point};
        CHECK(dp_motion_push(motion, 0.1 * t, t < 450 ? only_first : NULL, &now) == DP_OK);
        CHECK(dp_motion_part(motion, 2, t, &state) && state.pose.at.z == t + 0.5);
        CHECK(dp_motion_there(motion, 1, t) == (t >= 450));
        if (t > 0) CHECK(dp_motion_part(motion, 2, t - 1, &state) && state.pose.at.z == t - 0.5);
        CHECK(dp_motion_push(motion, 0.1 * t, NULL, &now) == DP_BAD_ARGUMENT);  // no later
        pose[3] = 2.0;
        CHECK(dp_motion_push(motion, 0.1 * t + 0.05, NULL, &now) == DP_BAD_ARGUMENT);
        dp_motion_forget(motion, t);
    }
    CHECK(dp_motion_samples(motion) == 1000 && dp_motion_time(motion, 999) == 0.1 * 999);
    CHECK(dp_motion_first_touch(motion) == 500.0);  // at 400 walker 1 was not there
    CHECK(!dp_motion_part(motion, 2, 990, &state));
    CHECK(dp_motion_bytes(motion) == 4 * PARTS * (13 * sizeof(double) + 1));
    dp_motion_destroy(motion);
    CHECK(dp_bytes_live() == 0);
}

TEST(absent_walkers_are_not_looked_at_and_the_last_sample_stays)
{
    Recording     r;
    DpMotion*     motion = NULL;
    DpPartState   state;
    const uint8_t only_first[WALKERS] = {1, 0}, only_second[WALKERS] = {0, 1};
    double        pose[7 * PARTS] = {0}, force[3 * PARTS] = {0}, point[3 * PARTS] = {0};
    const uint8_t touching[PARTS] = {1, 1, 1};
    fill(&r);
    for (int p = 0; p < PARTS; ++p) pose[7 * p + 3] = 1.0;
    const DpLoadedPoses now = {pose, touching, force, point};
    CHECK(dp_motion_live(&motion, &r.gait) == DP_OK);
    const int absent = 1;  // the part of walker 1
    pose[7 * absent] = NAN, force[3 * absent] = INFINITY;
    CHECK(dp_motion_push(motion, 0.0, only_first, &now) == DP_OK);
    CHECK(dp_motion_push(motion, 0.1, only_second, &now) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_push(motion, 0.1, NULL, &now) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_push(motion, 0.1, only_first, &now) == DP_OK);
    CHECK(!dp_motion_touching(motion, absent, 1) && dp_motion_samples(motion) == 2);
    dp_motion_forget(motion, 500);
    CHECK(dp_motion_there(motion, 0, 1) && !dp_motion_there(motion, 0, 0));
    CHECK(dp_motion_push(motion, 0.05, only_first, &now) == DP_BAD_ARGUMENT);  // no earlier
    CHECK(dp_motion_push(motion, 0.2, only_first, &now) == DP_OK);
    CHECK(dp_motion_part(motion, 2, 2, &state) && !dp_motion_part(motion, absent, 2, &state));
    dp_motion_destroy(motion);
    CHECK(dp_bytes_live() == 0);
}

// one number for each walker, part and kind of number at a sample
static double of(int t, int part, int which)
{
    return 1000.0 * t + 100.0 * part + which;
}

static DpStatus push(DpMotion* motion, int t, const uint8_t* present)
{
    double  pose[7 * PARTS], force[3 * PARTS], point[3 * PARTS];
    uint8_t touching[PARTS];
    for (int p = 0; p < PARTS; ++p) {
        const double turn = 0.1 * t + p;
        for (int d = 0; d < 3; ++d) {
            pose[7 * p + d] = of(t, p, d), force[3 * p + d] = of(t, p, 10 + d);
            point[3 * p + d] = of(t, p, 20 + d);
        }
        pose[7 * p + 3] = cos(turn), pose[7 * p + 4] = 0.0, pose[7 * p + 5] = 0.0;
        pose[7 * p + 6] = sin(turn);
        touching[p] = (uint8_t)((t + p) % 3 == 0);
    }
    const DpLoadedPoses now = {pose, touching, force, point};
    return dp_motion_push(motion, 0.01 * t, present, &now);
}

static bool is_kept(const DpMotion* motion, int part, int t)
{
    DpPartState  s;
    const double turn = 0.1 * t + part;
    if (!dp_motion_part(motion, part, t, &s)) return false;
    CHECK(s.pose.at.x == of(t, part, 0) && s.pose.at.y == of(t, part, 1));
    CHECK(s.pose.at.z == of(t, part, 2) && s.pose.turn.w == cos(turn) &&
          s.pose.turn.z == sin(turn));
    CHECK(s.force.x == of(t, part, 10) && s.force.y == of(t, part, 11));
    CHECK(s.force.z == of(t, part, 12) && s.pressure_point.x == of(t, part, 20));
    CHECK(s.pressure_point.y == of(t, part, 21) && s.pressure_point.z == of(t, part, 22));
    CHECK(s.touching == ((t + part) % 3 == 0) && dp_motion_touching(motion, part, t) == s.touching);
    CHECK(dp_motion_time(motion, t) == 0.01 * t);
    return true;
}

// however much is kept, and wherever it begins when the room for it grows, all of it is as it was pushed
TEST(what_is_kept_is_whole_while_its_room_grows)
{
    for (int late = 1; late <= 40; late += 3) {
        Recording r;
        DpMotion* motion = NULL;
        int       first, end, oldest = 0;
        fill(&r);
        CHECK(dp_motion_live(&motion, &r.gait) == DP_OK);
        for (int t = 0; t < 90; ++t) {
            const uint8_t present[WALKERS] = {1, t % 4 != 2};
            CHECK(push(motion, t, present) == DP_OK);
            // now and then nothing is forgotten for a while
            if (t % 17 > 5) dp_motion_forget(motion, t - late);
            if (t % 17 > 5 && t - late > oldest) oldest = t - late;
            for (int k = 0; k < 92; ++k)
                for (int p = 0; p < PARTS; ++p) {
                    const bool there = k >= oldest && k <= t && (p != 1 || k % 4 != 2);
                    CHECK(is_kept(motion, p, k) == there);
                    CHECK(dp_motion_there(motion, p == 1, k) == there);
                }
        }
        CHECK(dp_motion_stay(motion, 0, 0, &first, &end) && first == oldest && end == 90);
        CHECK(!dp_motion_stay(motion, 0, 1, &first, &end));
        dp_motion_destroy(motion);
    }
}

TEST(without_memory_nothing_was_pushed)
{
    Recording r;
    DpMotion* motion = NULL;
    fill(&r);
    CHECK(dp_motion_live(&motion, &r.gait) == DP_OK);
    for (int t = 0; t < 4; ++t) CHECK(push(motion, t, NULL) == DP_OK);
    for (long n = 0; n < 6; ++n) {
        dp_alloc_fail_after(n);
        CHECK(push(motion, 4, NULL) == DP_NO_MEMORY);  // its room is full
        dp_alloc_fail_after(-1);
        CHECK(dp_motion_samples(motion) == 4);
    }
    CHECK(push(motion, 4, NULL) == DP_OK && dp_motion_samples(motion) == 5);
    for (int t = 0; t < 5; ++t) CHECK(is_kept(motion, 0, t) && is_kept(motion, 1, t));
    dp_motion_destroy(motion);
}

TEST(only_a_live_motion_is_pushed_and_forgets)
{
    Recording r;
    DpMotion* motion = NULL;
    fill(&r);
    CHECK(dp_motion_record(&motion, &r.gait, &r.poses) == DP_OK);
    CHECK(!dp_motion_is_live(motion) && push(motion, 1000, NULL) == DP_BAD_ARGUMENT);
    dp_motion_forget(motion, 5);
    CHECK(dp_motion_there(motion, 0, 0) && dp_motion_samples(motion) == TIMES);
    dp_motion_destroy(motion);
    CHECK(dp_motion_live(&motion, &r.gait) == DP_OK && dp_motion_is_live(motion));
    dp_motion_forget(motion, 5);  // of nothing
    CHECK(push(motion, 0, NULL) == DP_OK && dp_motion_there(motion, 1, 0));
    const DpLoadedPoses none = {NULL, NULL, NULL, NULL};
    CHECK(dp_motion_push(motion, 1.0, NULL, &none) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_push(motion, 1.0, NULL, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_push(motion, (double)NAN, NULL, &r.poses) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_push(NULL, 1.0, NULL, &r.poses) == DP_BAD_ARGUMENT);
    dp_motion_destroy(motion);
}

int main(void)
{
    RUN(a_live_motion_keeps_what_is_needed);
    RUN(absent_walkers_are_not_looked_at_and_the_last_sample_stays);
    RUN(what_is_kept_is_whole_while_its_room_grows);
    RUN(without_memory_nothing_was_pushed);
    RUN(only_a_live_motion_is_pushed_and_forgets);
    return check_done();
}
