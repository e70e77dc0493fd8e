// tests of foot_support.c alone: who carries a body that does not fall. TRAIL (4)
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

enum
{
    TIMES = 60,
    FEET = 2,
    POINTS = 2 * FEET  // a heel and a tip each
};
#define RATE 120.0
#define AT(k, t) ((k)*TIMES + (t))

typedef struct Case
{
    Scene           scene;
    DpContactLimits limits;
    double          height[POINTS * TIMES], speed[POINTS * TIMES], clearance[POINTS], fall[TIMES];
    uint8_t         on[POINTS * TIMES];
} Case;

// Two feet that hover, the first 2 cm lower at its heel, and nobody falls.
static Case hovering(double high)
{
    Case c = {.scene = scene_make(TIMES, RATE, FEET, 2), .limits = dp_contact_limits_default()};
    for (int k = 0; k < POINTS; ++k) {
        c.scene.point_role[k] = k % 2 ? DP_POINT_TIP : DP_POINT_HEEL;
        c.clearance[k] = 0.01;
        for (int t = 0; t < TIMES; ++t) c.height[AT(k, t)] = 0.01 + high + (k ? 0.02 : 0.0);
    }
    return c;
}

static void support(Case* c)
{
    dp_walker_support(scene_gait(&c->scene, TIMES, FEET, 2), 0, c->height, c->speed, c->clearance,
                      c->fall, &c->limits, RATE, c->on);
}

static int touching(const Case* c, int k)
{
    int sum = 0;
    for (int t = 0; t < TIMES; ++t) sum += c->on[AT(k, t)];
    return sum;
}

// a heel, the tip that is hardly higher, and the other foot as slow as the first one
TEST(what_is_about_as_low_and_as_slow_carries_too)
{
    Case c = hovering(0.1);
    CHECK(c.limits.touch_height > 0.02);
    support(&c);
    for (int k = 0; k < POINTS; ++k) CHECK(touching(&c, k) == TIMES);
    scene_free(&c.scene);

    c = hovering(0.1);
    for (int t = 0; t < TIMES; ++t) {
        c.height[AT(1, t)] += c.limits.touch_height;    // now too high
        c.speed[AT(3, t)] = 1.5 * c.limits.slow_speed;  // now too fast, of another foot
    }
    support(&c);
    CHECK(touching(&c, 0) == TIMES && touching(&c, 1) == 0);
    CHECK(touching(&c, 2) == TIMES && touching(&c, 3) == 0);
    scene_free(&c.scene);
}

// the slower foot carries, if it is not much higher: 5 m/s are as much as one metre
TEST(the_slow_foot_carries_before_the_low_one)
{
    Case c = hovering(0.1);
    for (int t = 0; t < TIMES; ++t) c.speed[AT(0, t)] = c.speed[AT(1, t)] = 2.0;
    support(&c);
    CHECK(touching(&c, 0) == 0 && touching(&c, 1) == 0);
    CHECK(touching(&c, 2) == TIMES && touching(&c, 3) == TIMES);
    scene_free(&c.scene);
}

// higher than 0.4 m nothing carries, but beside a sample at which it does a little more is enough, before and after it
TEST(a_stance_as_high_as_feet_may_be_does_not_come_and_go)
{
    Case c = hovering(0.4 + 0.5 * 0.03);
    support(&c);
    for (int k = 0; k < POINTS; ++k) CHECK(touching(&c, k) == 0);
    for (int k = 0; k < POINTS; ++k) c.height[AT(k, 30)] -= 0.03;
    c.limits.touch_height = 0.03;
    support(&c);
    CHECK(touching(&c, 0) == TIMES);
    memset(c.on, 0, sizeof c.on);
    for (int k = 0; k < POINTS; ++k)
        for (int t = 0; t < TIMES; ++t) c.height[AT(k, t)] += t == 30 ? 0.0 : 0.03;
    support(&c);
    CHECK(touching(&c, 0) == 1 && c.on[AT(0, 30)] == 1);
    scene_free(&c.scene);
}

// what falls is carried by nobody, what is carried is left alone; a short gap is a flight's edge, but at the clip's
// ends it hides a foot
TEST(gaps_that_need_somebody_get_somebody)
{
    Case c = hovering(0.1);
    for (int t = 0; t < TIMES; ++t) {
        c.fall[t] = t >= 20 && t < 40 ? -9.81 : 0.0;
        if (t >= 44 && t < 56) c.on[AT(1, t)] = 1;
    }
    support(&c);
    for (int t = 0; t < TIMES; ++t) {
        CHECK(c.on[AT(0, t)] == (t < 20 || t >= 56));  // 40 .. 43: too short
        CHECK(c.on[AT(1, t)] == (t < 20 || t >= 44));
    }
    scene_free(&c.scene);
}

TEST(a_crate_and_feet_over_no_ground_are_left_alone)
{
    Case c = hovering(0.1);
    for (int k = 0; k < POINTS * TIMES; ++k) c.height[k] = NAN;
    support(&c);
    for (int k = 0; k < POINTS; ++k) CHECK(touching(&c, k) == 0);
    scene_free(&c.scene);

    c = hovering(0.1);
    for (int k = 0; k < POINTS; ++k) c.scene.point_role[k] = DP_POINT_HEEL;
    const DpGait* gait = scene_gait(&c.scene, TIMES, 1, POINTS);
    for (int k = 0; k < POINTS; ++k) c.scene.point_part[k] = 0;
    dp_walker_support(gait, 0, c.height, c.speed, c.clearance, c.fall, &c.limits, RATE, c.on);
    for (int k = 0; k < POINTS; ++k) CHECK(touching(&c, k) == 0);
    scene_free(&c.scene);
}

// what falls by half of gravity on an average of a short gap is carried, what falls faster is not
TEST(a_gap_at_an_end_needs_somebody_by_the_mean_of_its_fall)
{
    const double mean[2] = {-4.8, -5.0};
    for (int n = 0; n < 4; ++n) {
        Case      c = hovering(0.1);
        const int begin = n / 2 ? TIMES - 5 : 0;
        for (int t = 0; t < TIMES; ++t) c.on[AT(1, t)] = t < begin || t >= begin + 5;
        for (int t = 0; t < 5; ++t) c.fall[begin + t] = mean[n % 2] + (t - 2.0);
        support(&c);
        CHECK(c.on[AT(0, begin + 2)] == (n % 2 == 0));
        CHECK(touching(&c, 0) == (n % 2 == 0 ? 5 : 0));
        scene_free(&c.scene);
    }
}

int main(void)
{
    RUN(what_is_about_as_low_and_as_slow_carries_too);
    RUN(the_slow_foot_carries_before_the_low_one);
    RUN(a_stance_as_high_as_feet_may_be_does_not_come_and_go);
    RUN(gaps_that_need_somebody_get_somebody);
    RUN(a_crate_and_feet_over_no_ground_are_left_alone);
    RUN(a_gap_at_an_end_needs_somebody_by_the_mean_of_its_fall);
    return check_done();
}
