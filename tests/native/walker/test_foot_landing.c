// How fast a foot comes down: from its last 1/30 s, or in a fall from before its last frames.
#include "base/vec.h"
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

#define RATE 120.0
#define TIMES 121

static const int point = 0;

static DpVec3 landing(const DpGait* gait, const uint8_t* limb_on, int t)
{
    const DpLanding spot = {&point, 1};
    return dp_walker_landing_velocity(gait, &spot, limb_on, 1, RATE, t);
}

// a foot that is slowed all the while: its speed at the last sample, not the mean of the last ones
TEST(a_step_lands_as_fast_as_it_is_then)
{
    Scene   s = scene_make(TIMES, RATE, 1, 1);
    uint8_t on[TIMES] = {0};
    for (int t = 0; t < TIMES; ++t) {
        const double at = t / RATE;
        scene_put(&s, TIMES, 0, t, 1.2 * at, -0.3 * at, 2.0 - 3.0 * at + at * at);
        scene_com(&s, t, 1.2 * at, 0.0, 1.0);
    }
    const DpGait* gait = scene_gait(&s, TIMES, 1, 1);
    for (int t = 10; t < TIMES; t += 37) {
        on[t - 3] = 1;  // no flight is that short
        const DpVec3 v = landing(gait, on, t);
        CHECK_NEAR(v.x, 1.2, 1e-9);
        CHECK_NEAR(v.y, -0.3, 1e-9);
        CHECK_NEAR(v.z, -3.0 + 2.0 * t / RATE, 1e-9);
        on[t - 3] = 0;
    }
    CHECK_NEAR(landing(gait, on, 0).z, -3.0 + 1.0 / RATE, 1e-9);  // there is nothing before it
    scene_free(&s);
}

// one that falls freely until its last frame shows how it is stopped: that frame is not asked
TEST(a_fall_lands_as_fast_as_gravity_has_made_it)
{
    Scene         s = scene_make(TIMES, RATE, 1, 1);
    const uint8_t on[TIMES] = {0};
    const int     last = TIMES - 1, stopped = last - 5;
    for (int t = 0; t < TIMES; ++t) {
        const double at = (t < stopped ? t : stopped) / RATE;
        scene_put(&s, TIMES, 0, t, 0.5 * at, 0.0, 6.0 - 0.5 * DP_GRAVITY * at * at);
        scene_com(&s, t, 0.5 * at, 0.0, 7.0 - 0.5 * DP_GRAVITY * at * at);
    }
    const DpGait* gait = scene_gait(&s, TIMES, 1, 1);
    const DpVec3  v = landing(gait, on, last);
    CHECK_NEAR(v.z, -DP_GRAVITY * last / RATE, 0.01);
    CHECK_NEAR(v.x, 0.5, 1e-9);
    scene_free(&s);
}

// who is let down on a rope is in the air, but does not fall: nothing is added
TEST(who_is_let_down_lands_as_it_moves)
{
    Scene         s = scene_make(TIMES, RATE, 1, 1);
    const uint8_t on[TIMES] = {0};
    for (int t = 0; t < TIMES; ++t) {
        scene_put(&s, TIMES, 0, t, 0.0, 0.0, 3.0 - 0.4 * t / RATE);
        scene_com(&s, t, 0.0, 0.0, 4.0 - 0.4 * t / RATE);
    }
    const DpGait* gait = scene_gait(&s, TIMES, 1, 1);
    CHECK_NEAR(landing(gait, on, TIMES - 1).z, -0.4, 1e-9);
    scene_free(&s);
}

// a body that falls freely, but since 0.1 s: its last samples count, as they do on the ground
TEST(a_hop_is_no_fall)
{
    Scene     s = scene_make(TIMES, RATE, 1, 1);
    uint8_t   on[TIMES] = {0};
    const int last = TIMES - 1, stopped = last - 6;
    for (int t = 0; t < TIMES; ++t) {
        const double at = (t < stopped ? t : stopped) / RATE;
        scene_put(&s, TIMES, 0, t, 0.0, 0.0, 6.0 - 0.5 * DP_GRAVITY * at * at);
        scene_com(&s, t, 0.0, 0.0, 7.0 - 0.5 * DP_GRAVITY * at * at);
        on[t] = t < last - 12;
    }
    CHECK_NEAR(landing(scene_gait(&s, TIMES, 1, 1), on, last).z, 0.0, 1e-9);
    scene_free(&s);
}

int main(void)
{
    RUN(a_step_lands_as_fast_as_it_is_then);
    RUN(a_fall_lands_as_fast_as_gravity_has_made_it);
    RUN(who_is_let_down_lands_as_it_moves);
    RUN(a_hop_is_no_fall);
    return check_done();
}
