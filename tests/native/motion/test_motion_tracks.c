// tests of motion_tracks.c: a place is what was given, who is not there is not, and what cannot be worked with is
// refused with nothing left behind
#include "recording.h"

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

// many short tracks of both walkers in any order: each sample is that of its track
TEST(each_sample_is_that_of_its_track)
{
    enum
    {
        LONG = 60
    };
    Recording r;
    DpMotion* motion = NULL;
    double    time[LONG];
    DpTrack   track[2 * LONG];
    int       of[WALKERS][LONG], count = 0;
    unsigned  seed = 7u;
    fill(&r);
    for (int t = 0; t < LONG; ++t) time[t] = 0.1 * t, of[0][t] = of[1][t] = -1;
    r.gait.times = LONG, r.gait.time = time;
    for (int w = 0; w < WALKERS; ++w)
        for (int t = w; t < LONG; t += (int)(check_random(&seed) * 3.0)) {
            const int many = 1 + (int)(check_random(&seed) * 4.0);
            if (t + many > LONG) break;
            track[count] = (DpTrack){w, t, many, r.poses};
            for (int k = 0; k < many; ++k) of[w][t + k] = t;
            t += many, ++count;
        }
    for (int n = count - 1; n > 0; --n) {
        const int     other = (int)(check_random(&seed) * (n + 1));
        const DpTrack was = track[n];
        track[n] = track[other], track[other] = was;
    }
    CHECK(count > 20 && dp_motion_tracks(&motion, &r.gait, track, count) == DP_OK);
    CHECK(dp_motion_samples(motion) == LONG && dp_motion_time(motion, 59) == time[59]);
    for (int p = 0; p < PARTS; ++p)
        for (int t = 0; t < LONG; ++t) {
            const int   w = p == 1, first = of[w][t];
            DpPartState s;
            CHECK(dp_motion_there(motion, w, t) == (first >= 0));
            CHECK(dp_motion_part(motion, p, t, &s) == (first >= 0));
            if (first < 0) continue;
            int many = 1;  // samples of its track
            while (first + many < LONG && of[w][first + many] == first) ++many;
            const int from = (p == 2) * many + t - first;  // where in the arrays it was given
            CHECK(s.pose.at.x == r.pose[7 * from] && s.pose.at.y == r.pose[7 * from + 1]);
            CHECK(s.force.z == r.force[3 * from + 2] && s.touching == r.touching[from]);
        }
    dp_motion_destroy(motion);
}

TEST(without_memory_there_is_no_recording)
{
    Recording r;
    DpMotion* motion = NULL;
    DpStatus  status = DP_NO_MEMORY;
    fill(&r);
    for (long n = 0; status == DP_NO_MEMORY; ++n) {
        dp_alloc_fail_after(n);
        status = dp_motion_record(&motion, &r.gait, &r.poses);
        dp_alloc_fail_after(-1);
        CHECK((status == DP_OK) == (motion != NULL) && n < 40);
    }
    CHECK(status == DP_OK && dp_motion_there(motion, 1, TIMES - 1));
    dp_motion_destroy(motion);
    const DpLoadedPoses some = {r.pose, r.touching, NULL, r.point};
    CHECK(dp_motion_record(&motion, &r.gait, &some) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_record(&motion, NULL, &r.poses) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_tracks(&motion, &r.gait, NULL, 1) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_tracks(&motion, &r.gait, NULL, -1) == DP_BAD_ARGUMENT);
    r.gait.times = 1;
    CHECK(dp_motion_record(&motion, &r.gait, &r.poses) == DP_BAD_ARGUMENT);
    CHECK(dp_motion_tracks(&motion, &r.gait, NULL, 0) == DP_BAD_ARGUMENT);
}

int main(void)
{
    RUN(who_is_not_there_takes_no_memory);
    RUN(tracks_that_meet_are_one_motion);
    RUN(what_cannot_be_followed_is_refused);
    RUN(each_sample_is_that_of_its_track);
    RUN(without_memory_there_is_no_recording);
    return check_done();
}
