// tests of foot_watch.c: TRAIL (4), MODEL 4.2
#include "base/vec.h"
#include "check.h"
#include "scene.h"
#include "walker/foot_watch.h"

#define TIMES 481  // 4 s
#define RATE 120.0

static double ground[TIMES];

static DpWatch watch_of(const DpGait* gait, const DpContactLimits* limits)
{
    DpWatch w = {.gait = gait, .limits = limits, .rate = RATE};
    CHECK(dp_watch_open(&w));
    return w;
}

// a point that goes along a line over ground that lies at 0.1 m, seen from a surface that moves by 0.3 m/s
TEST(heights_and_speeds_are_those_over_the_surface)
{
    Scene                 s = scene_make(TIMES, RATE, 1, 1);
    const DpContactLimits limits = dp_contact_limits_default();
    s.point[2] = -0.05;
    for (int t = 0; t < TIMES; ++t) {
        const double time = t / RATE;
        s.pose[7 * t] = 0.4 * time, s.pose[7 * t + 2] = 1.0 - 0.6 * time;
        s.com[3 * t] = 0.5 * time, s.com[3 * t + 2] = 2.0 - 0.5 * 9.81 * time * time;
        ground[t] = 0.1;
    }
    DpWatch w = watch_of(scene_gait(&s, TIMES, 1, 1), &limits);
    w.belt[0] = dp_vec3(-0.3, 0.0, 0.0);
    dp_watch_point(&w, 0, ground);
    dp_watch_walker(&w, 0);
    for (int t = 100; t < TIMES - 100; ++t) {
        CHECK_NEAR(w.height[t], 0.85 - 0.6 * t / RATE, 1e-12);
        CHECK_NEAR(w.speed[t], hypot(0.7, 0.6), 1e-6);
        CHECK_NEAR(w.rise[t], -0.6, 1e-6);
        CHECK_NEAR(w.drop[t], 0.6 - 0.7, 1e-6);  // flatter than 45 degrees: it does not drop
        CHECK_NEAR(w.fall[t], -9.81, 1e-3);
        // 0.3 m/s and 0.4 of the mass centre's speed over the surface, which falls, too
        CHECK_NEAR(w.gate[t], 0.3 + 0.4 * hypot(0.8, 9.81 * t / RATE), 1e-2);
    }
    dp_watch_close(&w);
    scene_free(&s);
}

// A foot that slides back along the floor at `slide`, and forward through the air, under a body that gets `far`.
static double belt_under(double slide, double far)
{
    Scene                 s = scene_make(TIMES, RATE, 1, 1);
    const DpContactLimits limits = dp_contact_limits_default();
    double                x = 0.0;
    for (int t = 0; t < TIMES; ++t) {
        const bool down = t / 60 % 2 == 0;
        s.pose[7 * t] = x, s.pose[7 * t + 2] = down ? 0.0 : 0.3;
        x += (down ? -slide : slide) / RATE;
        s.com[3 * t] = far * t / (TIMES - 1), s.com[3 * t + 2] = 1.0;
        ground[t] = 0.0;
    }
    DpWatch w = watch_of(scene_gait(&s, TIMES, 1, 1), &limits);
    CHECK(dp_watch_belt(&w, 0, ground) == DP_OK);
    const double found = w.belt[0].x;
    CHECK(w.belt[0].y == 0.0 && w.belt[0].z == 0.0);
    dp_watch_close(&w);
    scene_free(&s);
    return found;
}

// A belt that runs at 1 m/s for 4 s: who gets nowhere walks on it, who gets a quarter of its way, 1 m, walks over ground.
TEST(who_stays_while_low_feet_slide_walks_on_a_belt)
{
    CHECK_NEAR(belt_under(1.0, 0.0), -1.0, 0.02);
    CHECK_NEAR(belt_under(1.0, 0.8), -1.0, 0.02);
    CHECK_NEAR(belt_under(1.0, 1.2), 0.0, 0.0);
    CHECK_NEAR(belt_under(1.0, -1.2), 0.0, 0.0);
    CHECK_NEAR(belt_under(0.3, 0.0), 0.0, 0.0);  // feet slip, and no more
}

int main(void)
{
    RUN(heights_and_speeds_are_those_over_the_surface);
    RUN(who_stays_while_low_feet_slide_walks_on_a_belt);
    return check_done();
}
