// Ends of contacts that a flight follows: what momentum tells, within half a frame.
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

#define RATE 240.0

enum
{
    N = 480,
    STANCE = 48,  // 0.2 s
    FLIGHT = 60   // 0.25 s
};

// a body on one foot that hops, its force half a sine, contacts as they truly are
static Scene hopping(uint8_t* on)
{
    Scene        s = scene_make(N, RATE, 1, 1);
    const double peak = DP_PI / 2.0 * (double)(STANCE + FLIGHT) / (double)STANCE * DP_GRAVITY;
    double       z = 1.0, v = -0.5 * (double)FLIGHT / RATE * DP_GRAVITY;
    for (int t = 0; t < N; ++t) {
        const int    at = t % (STANCE + FLIGHT);
        const double press = at < STANCE ? peak * sin(DP_PI * ((double)at + 0.5) / STANCE) : 0.0;
        scene_com(&s, t, 2.0 * (double)t / RATE, 0.0, z);
        scene_put(&s, N, 0, t, 2.0 * (double)t / RATE, 0.0, 0.0);
        on[t] = at < STANCE;
        v += (press - DP_GRAVITY) / RATE;
        z += v / RATE;
    }
    return s;
}

// the ends of contacts inside the clip, in samples after the true ones, if the foot tells them `by`
// samples late
static void check_ends(int by, double frame, double most)
{
    static uint8_t on[N], air[N];
    static double  height[N];
    Scene          s = hopping(on);
    for (int t = 1; t < N; ++t) {
        if (on[t] || !on[t - 1]) continue;
        for (int k = by < 0 ? t + by : t; k < (by < 0 ? t : t + by); ++k) on[k] = by > 0;
        if (by > 0) t += by;
    }
    double* scratch = dp_alloc(dp_walker_fly_scratch(N), sizeof(double));
    CHECK(scratch != NULL);
    dp_walker_bounces(scene_gait(&s, N, 1, 1), 0, frame, RATE, on, air, height, scratch);
    int ends = 0;
    for (int t = STANCE + FLIGHT; t < N - FLIGHT; ++t) {
        if (on[t] || !on[t - 1]) continue;
        const int late = (t - STANCE + 30) % (STANCE + FLIGHT) - 30;
        CHECK_NEAR(late, 0.0, most);
        ++ends;
    }
    CHECK(ends == 3);
    dp_free(scratch);
    scene_free(&s);
}

TEST(momentum_ends_a_bounce)
{
    for (int by = -4; by <= 4; ++by) check_ends(by, 1.0 / 24.0, 1.0);
}

TEST(within_half_a_frame)
{
    check_ends(4, 1.0 / 60.0, 2.0 + 1e-9);
    check_ends(-4, 1.0 / 60.0, 2.0 + 1e-9);
    // every sample was seen: the foot knows
    static uint8_t on[N], was[N], air[N];
    static double  height[N];
    Scene          s = hopping(on);
    memmove(on, on + 2, N - 2);
    memcpy(was, on, N);
    double* scratch = dp_alloc(dp_walker_fly_scratch(N), sizeof(double));
    dp_walker_bounces(scene_gait(&s, N, 1, 1), 0, 1.0 / RATE, RATE, on, air, height, scratch);
    CHECK(memcmp(on, was, N) == 0);
    dp_free(scratch);
    scene_free(&s);
}

// Who stands on a box and steps off it loses his whole weight at once.
TEST(who_still_stands_has_not_left)
{
    static uint8_t on[N], air[N];
    static double  height[N];
    Scene          s = scene_make(N, RATE, 1, 1);
    for (int t = 0; t < N; ++t) {
        const double fall = fmax((double)(t - 240) / RATE, 0.0);
        scene_com(&s, t, 0.0, 0.0, 2.0 - 0.5 * DP_GRAVITY * fall * fall);
        on[t] = t < 238;  // the foot was seen to leave two samples early
    }
    double* scratch = dp_alloc(dp_walker_fly_scratch(N), sizeof(double));
    dp_walker_bounces(scene_gait(&s, N, 1, 1), 0, 1.0 / 60.0, RATE, on, air, height, scratch);
    int end = 0;
    while (end < N && on[end]) ++end;
    CHECK(end == 239 || end == 240);
    dp_free(scratch);
    scene_free(&s);
}

// Whether the end of a contact that lasts `force` [of the weight] moves, seen to end at a sample: by how many samples.
static int moved_end(const double* force, int seen)
{
    static uint8_t on[N], air[N];
    static double  height[N];
    Scene          s = scene_make(N, RATE, 1, 1);
    double         z = 2.0, v = 0.0;
    for (int t = 0; t < N; ++t) {
        scene_com(&s, t, 0.0, 0.0, z);
        v += (force[t] - 1.0) * DP_GRAVITY / RATE;
        z += v / RATE;
        on[t] = t < seen;
    }
    double* scratch = dp_alloc(dp_walker_fly_scratch(N), sizeof(double));
    CHECK(scratch != NULL);
    dp_walker_bounces(scene_gait(&s, N, 1, 1), 0, 1.0 / 60.0, RATE, on, air, height, scratch);
    int end = 0;
    while (end < N && on[end]) ++end;
    dp_free(scratch);
    scene_free(&s);
    return end - seen;
}

// A weight is gone when half of what was carried in the last tenth of a second is: what was carried long before
// does not count, and who has let most of it go has left.
TEST(half_of_what_was_carried_in_the_end_is_gone)
{
    static double force[N];
    for (int t = 0; t < N; ++t) {  // a stamp half a second before the step off the box
        force[t] = t < 240 ? 1.0 : 0.0;
        if (t >= 60 && t < 108) force[t] += 3.0 * sin(2.0 * DP_PI * (t - 60) / 48.0);
    }
    CHECK(moved_end(force, 238) >= 1);
    for (int t = 0; t < N; ++t)  // the last third of what goes within 0.1 s
        force[t] = t < 216 ? 2.0 : fmax(2.0 * (240 - t) / 24.0, 0.0);
    CHECK(moved_end(force, 234) == 0);
}

int main(void)
{
    RUN(momentum_ends_a_bounce);
    RUN(within_half_a_frame);
    RUN(who_still_stands_has_not_left);
    RUN(half_of_what_was_carried_in_the_end_is_gone);
    return check_done();
}
