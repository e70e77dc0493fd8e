// tests of foot_clearance.c: TRAIL (4), MODEL 4.2
#include "check.h"
#include "scene.h"
#include "walker/foot_watch.h"

#define TIMES 200
#define RATE 100.0
#define POINTS 2

// two points of a walker; each sample fast and high until it is laid down
static Scene   s;
static DpWatch w;
static double  clearance[POINTS];

static const DpContactLimits limits = {.touch_height = 0.03, .slow_speed = 0.25};

static void open_watch(void)
{
    s = scene_make(TIMES, RATE, 1, POINTS);
    w = (DpWatch){.gait = scene_gait(&s, TIMES, 1, POINTS), .limits = &limits, .rate = RATE};
    CHECK(dp_watch_open(&w));
    for (int k = 0; k < POINTS * TIMES; ++k) w.height[k] = 0.5, w.speed[k] = 2.0;
    for (int t = 0; t < TIMES; ++t) w.gate[t] = 0.7;
}

static void close_watch(void)
{
    dp_watch_close(&w);
    scene_free(&s);
}

static void lay(int point, int from, int end, double height, double speed)
{
    for (int t = from; t < end; ++t)
        w.height[point * TIMES + t] = height, w.speed[point * TIMES + t] = speed;
}

// Stays of 0.2 s at 1, 2, 3 and 9 cm: the middle of those within 3 cm of the lowest, whatever is fast.
TEST(the_middle_of_what_is_slow_and_low)
{
    open_watch();
    for (int k = 0; k < 4; ++k) lay(0, 50 * k, 50 * k + 20, k < 3 ? 0.01 * (k + 1) : 0.09, 0.1);
    lay(0, 180, 200, -0.2, 0.3);  // below all, but not slow
    lay(1, 0, 20, 0.02, 0.1);
    dp_watch_clearance(&w, clearance);
    CHECK_NEAR(clearance[0], 0.02, 0.0);
    CHECK_NEAR(clearance[1], 0.02, 0.0);
    close_watch();
}

// one stay of 1 s counts as 0.2 s: two others outvote it
TEST(a_long_stay_is_one_stay)
{
    open_watch();
    lay(0, 0, 100, 0.03, 0.1);
    lay(0, 120, 140, 0.01, 0.1);
    lay(0, 160, 180, 0.01, 0.1);
    lay(1, 0, 20, 0.01, 0.1);
    dp_watch_clearance(&w, clearance);
    CHECK_NEAR(clearance[0], 0.01, 0.0);
    close_watch();
}

TEST(who_is_never_slow_is_asked_where_he_might_land)
{
    open_watch();
    lay(0, 0, 40, 0.015, 0.6);
    lay(1, 0, 40, 0.02, 0.1);
    dp_watch_clearance(&w, clearance);
    CHECK_NEAR(clearance[0], 0.015, 0.0);
    close_watch();
}

// 8 cm over the lowest is a foot on something; more is one that hangs in the air
TEST(a_foot_that_hangs_rests_where_the_lowest_does)
{
    const double high[2] = {0.085, 0.095};
    for (int k = 0; k < 2; ++k) {
        open_watch();
        lay(0, 0, 40, 0.01, 0.1);
        lay(1, 0, 40, high[k], 0.1);
        dp_watch_clearance(&w, clearance);
        CHECK_NEAR(clearance[1], k == 0 ? 0.085 : 0.01, 0.0);
        close_watch();
    }
    open_watch();  // one that never rests, and then nobody does: as low as they get
    lay(0, 0, 40, 0.01, 0.1);
    dp_watch_clearance(&w, clearance);
    CHECK_NEAR(clearance[1], 0.01, 0.0);
    lay(0, 0, 40, 0.04, 2.0);
    w.height[3] = NAN;
    dp_watch_clearance(&w, clearance);
    CHECK_NEAR(clearance[0], 0.04, 0.0);
    CHECK_NEAR(clearance[1], 0.04, 0.0);
    close_watch();
}

// of 33 votes one stray is less than a twentieth, and passed over; two of 34 are more. A stay is 20 votes at most.
TEST(strays_are_passed_over)
{
    for (int strays = 1; strays <= 2; ++strays) {
        open_watch();
        lay(0, 0, 100, 0.01, 0.1);
        lay(0, 110, 120, 0.02, 0.1);
        for (int n = 0; n < strays; ++n) lay(0, 130 + 10 * n, 131 + 10 * n, -0.1, 0.1);
        lay(1, 0, 20, -0.05, 0.1);
        dp_watch_clearance(&w, clearance);
        CHECK_NEAR(clearance[0], strays == 1 ? 0.01 : -0.1, 0.0);
        close_watch();
    }
}

int main(void)
{
    RUN(the_middle_of_what_is_slow_and_low);
    RUN(a_long_stay_is_one_stay);
    RUN(who_is_never_slow_is_asked_where_he_might_land);
    RUN(a_foot_that_hangs_rests_where_the_lowest_does);
    RUN(strays_are_passed_over);
    return check_done();
}
