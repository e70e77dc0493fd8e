// What is asked of a motion, whatever its source.
#include "recording.h"

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

int main(void)
{
    RUN(a_recording_is_given_back);
    return check_done();
}
