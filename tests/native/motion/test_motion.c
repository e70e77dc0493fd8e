// What must hold of recordings: a place is what was given, who is not there is not, and what cannot be
// worked with is refused with nothing left behind.
#include <math.h>

#include "base/alloc.h"
#include "check.h"
#include "motion/motion.h"

enum
{
    WALKERS = 2,
    PARTS = 3,  // walker 0 owns parts 0 and 2, walker 1 part 1
    TIMES = 10
};

static const float   VERTEX[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const int32_t TRIANGLE[] = {0, 1, 2};

typedef struct Recording
{
    DpGait        gait;
    double        time[TIMES], mass[WALKERS];
    double        pose[7 * PARTS * TIMES], force[3 * PARTS * TIMES], point[3 * PARTS * TIMES];
    uint8_t       touching[PARTS * TIMES];
    int32_t       limb_walker[PARTS], part_limb[PARTS];
    DpMesh        sole[PARTS];
    DpLoadedPoses poses;
} Recording;

static void fill(Recording* r)
{
    *r = (Recording){.mass = {70.0, 80.0}, .limb_walker = {0, 1, 0}, .part_limb = {0, 1, 2}};
    for (int t = 0; t < TIMES; ++t) r->time[t] = 0.1 * t;
    for (int p = 0; p < PARTS; ++p) {
        r->sole[p] = (DpMesh){3, 1, VERTEX, TRIANGLE};
        for (int t = 0; t < TIMES; ++t) {
            const int k = p * TIMES + t;
            r->pose[7 * k] = p, r->pose[7 * k + 1] = t, r->pose[7 * k + 2] = 10 * p + t;
            r->pose[7 * k + 3] = 1.0;
            r->force[3 * k + 2] = -100.0 * p - t;
            r->point[3 * k] = t ? 0.5 : NAN;
            r->touching[k] = (uint8_t)(t > 4 && p != 0);
        }
    }
    r->gait = (DpGait){.times = TIMES,
                       .walkers = WALKERS,
                       .limbs = PARTS,
                       .parts = PARTS,
                       .time = r->time,
                       .mass = r->mass,
                       .pose = r->pose,
                       .limb_walker = r->limb_walker,
                       .part_limb = r->part_limb,
                       .sole = r->sole};
    r->poses = (DpLoadedPoses){r->pose, r->touching, r->force, r->point};
}

TEST(a_recording_is_given_back)
{
    Recording r;
    DpMotion* motion = NULL;
    fill(&r);
    CHECK(dp_motion_record(&motion, &r.gait, &r.poses) == DP_OK);
    CHECK(dp_motion_samples(motion) == TIMES && dp_motion_time(motion, 3) == r.time[3]);
    for (int p = 0; p < PARTS; ++p)
        for (int t = 0; t < TIMES; ++t) {
            const int   k = p * TIMES + t;
            DpPartState state;
            CHECK(dp_motion_part(motion, p, t, &state));
            CHECK(state.pose.at.x == p && state.pose.at.y == t && state.pose.turn.w == 1.0);
            CHECK(state.force.z == r.force[3 * k + 2] && state.touching == r.touching[k]);
            CHECK(dp_motion_pose(motion, p, t).at.z == r.pose[7 * k + 2]);
            CHECK(dp_motion_touching(motion, p, t) == r.touching[k]);
        }
    CHECK(dp_motion_first_touch(motion) == 15.0);  // part 1 at sample 5
    CHECK(!dp_motion_there(motion, 0, TIMES) && dp_motion_there(motion, 1, TIMES - 1));
    dp_motion_destroy(motion);
    CHECK(dp_bytes_live() == 0);
}

TEST(who_is_not_there_takes_no_memory)
{
    Recording r;
    DpMotion* motion = NULL;
    int       first, end;
    fill(&r);
    // walker 0 at samples 6..8 and 0..1, walker 1 at 2..5; only the beginnings of the arrays are read
    const DpTrack tracks[] = {{0, 6, 3, r.poses}, {1, 2, 4, r.poses}, {0, 0, 2, r.poses}};
    CHECK(dp_motion_tracks(&motion, &r.gait, tracks, 3) == DP_OK);
    const bool there[WALKERS][TIMES] = {{1, 1, 0, 0, 0, 0, 1, 1, 1, 0},
                                        {0, 0, 1, 1, 1, 1, 0, 0, 0, 0}};
    for (int w = 0; w < WALKERS; ++w)
        for (int t = 0; t < TIMES; ++t) CHECK(dp_motion_there(motion, w, t) == there[w][t]);
    DpPartState state;
    CHECK(dp_motion_part(motion, 2, 7, &state));
    CHECK(state.pose.at.z == r.pose[7 * (1 * 3 + 1) + 2]);  // the track's second part and sample
    CHECK(!dp_motion_part(motion, 2, 5, &state) && dp_motion_touching(motion, 2, 5) == 0);
    CHECK(dp_motion_stay(motion, 0, 0, &first, &end) && first == 0 && end == 2);
    CHECK(dp_motion_stay(motion, 0, 1, &first, &end) && first == 6 && end == 9);
    CHECK(!dp_motion_stay(motion, 0, 2, &first, &end));
    CHECK(dp_motion_bytes(motion) == (2 * 5 + 4) * (13 * sizeof(double) + 1));
    dp_motion_destroy(motion);
    CHECK(dp_motion_tracks(&motion, &r.gait, NULL, 0) == DP_OK);  // nobody at all
    CHECK(!dp_motion_there(motion, 0, 0) && isnan(dp_motion_first_touch(motion)));
    dp_motion_destroy(motion);
    CHECK(dp_bytes_live() == 0);
}

// a walker's tracks that follow each other without a gap, given in any order, are one motion
TEST(tracks_that_meet_are_one_motion)
{
    Recording r;
    DpMotion* motion = NULL;
    fill(&r);
    const DpTrack  tracks[] = {{1, 6, 3, r.poses}, {1, 0, 2, r.poses}, {1, 2, 4, r.poses}};
    const DpStatus status = dp_motion_tracks(&motion, &r.gait, tracks, 3);
    CHECK(status == DP_OK);
    for (int t = 0; status == DP_OK && t < 9; ++t) {
        const int own = t < 2 ? t : t < 6 ? t - 2 : t - 6;  // sample of its track
        CHECK(dp_motion_there(motion, 1, t));
        CHECK(dp_motion_pose(motion, 1, t).at.y == r.pose[7 * own + 1]);
    }
    CHECK(status != DP_OK || !dp_motion_there(motion, 1, 9));
    dp_motion_destroy(motion);
    CHECK(dp_bytes_live() == 0);
}

TEST(what_cannot_be_followed_is_refused)
{
    Recording r;
    DpMotion* motion = NULL;
    fill(&r);
    const DpTrack bad[][2] = {
        {{0, 0, 4, r.poses}, {0, 3, 2, r.poses}},   // overlap
        {{2, 0, 1, r.poses}, {0, 3, 2, r.poses}},   // no such walker
        {{0, 0, 1, r.poses}, {1, 8, 3, r.poses}},   // beyond the times
        {{0, -1, 2, r.poses}, {1, 8, 1, r.poses}},  //
        {{0, 0, 0, r.poses}, {1, 8, 1, r.poses}},   // empty
        {{0, 0, 1, {r.pose, NULL, r.force, r.point}}, {1, 8, 1, r.poses}},
    };
    for (size_t n = 0; n < sizeof bad / sizeof *bad; ++n)
        CHECK(dp_motion_tracks(&motion, &r.gait, bad[n], 2) == DP_BAD_ARGUMENT && !motion);
    r.pose[7 * 4 + 3] = 1.5;
    CHECK(dp_motion_record(&motion, &r.gait, &r.poses) == DP_BAD_ARGUMENT && !motion);
    fill(&r), r.force[5] = NAN;
    CHECK(dp_motion_record(&motion, &r.gait, &r.poses) == DP_BAD_ARGUMENT && !motion);
    fill(&r), r.time[4] = r.time[3];
    CHECK(dp_motion_record(&motion, &r.gait, &r.poses) == DP_BAD_ARGUMENT && !motion);
    fill(&r);
    for (long n = 0; n < 12; ++n) {
        dp_alloc_fail_after(n);
        const DpTrack  track = {0, 6, 3, r.poses};
        const DpStatus status = dp_motion_tracks(&motion, &r.gait, &track, 1);
        dp_alloc_fail_after(-1);
        CHECK(status == DP_NO_MEMORY || status == DP_OK);
        if (status == DP_OK) dp_motion_destroy(motion);
        motion = NULL;
        CHECK(dp_bytes_live() == 0);
    }
}

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

// poses of who is not there may be anything, and whatever is forgotten, the last sample stays
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

int main(void)
{
    RUN(a_recording_is_given_back);
    RUN(who_is_not_there_takes_no_memory);
    RUN(tracks_that_meet_are_one_motion);
    RUN(what_cannot_be_followed_is_refused);
    RUN(a_live_motion_keeps_what_is_needed);
    RUN(absent_walkers_are_not_looked_at_and_the_last_sample_stays);
    return check_done();
}
