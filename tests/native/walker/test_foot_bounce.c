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

int main(void)
{
    RUN(momentum_ends_a_bounce);
    RUN(within_half_a_frame);
    RUN(who_still_stands_has_not_left);
    return check_done();
}
