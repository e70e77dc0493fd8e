// The moment a contact begins: when its fall is fastest, a little later out of a flight; and when it ends.
#include "base/vec.h"
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

#define RATE 960.0
#define TIMES 1440
#define CUTOFF 20.0
#define STOP 800  // the sample at which the ground stops the foot
#define MOVES 0.25
#define FAST 1.2

static double  height[TIMES], rise[TIMES], speed[TIMES];
static uint8_t on[TIMES], flown[TIMES];

// A point that comes down at `fall` [m/s] and stands still from STOP on; its speed is low-passed. Limits said
// that it touches from a thirtieth of a second before.
static void come_down(double fall)
{
    double* scratch = dp_alloc(dp_walker_low_pass_scratch(TIMES, RATE, CUTOFF), sizeof *scratch);
    for (int t = 0; t < TIMES; ++t) {
        height[t] = t < STOP ? fall * (STOP - t) / RATE : 0.0;
        rise[t] = t < STOP ? -fall : 0.0;
        speed[t] = 0.0;
        on[t] = t >= STOP - 32;
    }
    dp_walker_low_pass(rise, TIMES, RATE, CUTOFF, scratch);
    dp_free(scratch);
}

static void move_edges(Scene* s)
{
    const double clearance = 0.0;
    dp_walker_edges(scene_gait(s, TIMES, 1, 1), height, &clearance, rise, speed, MOVES, FAST,
                    CUTOFF, on, flown, RATE);
}

// the last contact's first sample
static int begins(void)
{
    int t = TIMES - 1;
    CHECK(on[t]);
    while (t > 0 && on[t - 1]) --t;
    return t;
}

static int fastest(void)
{
    int at = STOP - 32;
    for (int t = at; t < STOP; ++t)
        if (rise[t] < rise[at]) at = t;
    return at;
}

// a foot that did touch shortly before is lowered by the leg that stands: its fall is fastest as it arrives
TEST(a_step_begins_when_its_fall_is_fastest)
{
    Scene s = scene_make(TIMES, RATE, 1, 1);
    come_down(0.6);
    for (int t = 0; t < STOP - 40; ++t) on[t] = 1;
    move_edges(&s);
    CHECK(begins() == fastest());
    CHECK(fastest() > STOP - 32 && fastest() < STOP - 8);
    scene_free(&s);
}

// one that comes out of a flight is stopped with the whole body: what the filter added is taken out, which is
// 3 ms of the 7 by which a sudden stop is early
TEST(a_sudden_stop_out_of_a_flight_begins_later)
{
    Scene s = scene_make(TIMES, RATE, 1, 1);
    come_down(0.3);  // so slowly that height tells nothing
    move_edges(&s);
    CHECK(begins() - fastest() >= 2 && begins() - fastest() <= 4);
    scene_free(&s);
}

// what comes down so fast that its stop cannot be timed is timed by its height
TEST(a_fast_fall_is_timed_by_its_height)
{
    Scene s = scene_make(TIMES, RATE, 1, 1);
    come_down(4.0);
    move_edges(&s);
    CHECK(begins() <= STOP && height[begins()] <= 0.01);
    CHECK(height[begins() - 1] > 0.01);
    CHECK(begins() > fastest());
    scene_free(&s);
}

// who lets go does so when its ball is lifted and sped up hardest, and not while a point still rests
TEST(a_contact_ends_when_the_ball_is_lifted_hardest)
{
    Scene s = scene_make(TIMES, RATE, 1, 1);
    s.point_role[0] = DP_POINT_BALL;
    for (int t = 0; t < TIMES; ++t) {
        const double since =
            (t - 600) / 48.0;  // from rest to 1 m/s within 50 ms, hardest in their middle
        const double share = dp_clamp(since, 0.0, 1.0);
        height[t] = 0.0, on[t] = t < 660;
        rise[t] = share * share * (3.0 - 2.0 * share);
        speed[t] = 0.0;
    }
    for (int turn = 0; turn < 2; ++turn) {
        for (int t = 0; t < TIMES; ++t) {
            on[t] = t < 660;
            speed[t] =
                turn ? MOVES + 1e-4 * (t - 640) : 1.0;  // it hardly speeds up, and rests till then
        }
        move_edges(&s);
        int end = TIMES;
        while (end > 0 && !on[end - 1]) --end;
        CHECK_NEAR(end, turn ? 640 : 624, 1.0);
    }
    scene_free(&s);
}

// who does not come down as it touches has no stop to be timed, whatever it does next
TEST(what_rises_as_it_touches_begins_there)
{
    Scene s = scene_make(TIMES, RATE, 1, 1);
    for (int t = 0; t < TIMES; ++t) {
        height[t] = t < STOP ? 0.1 : 0.005, speed[t] = 0.0, on[t] = t >= STOP;
        rise[t] = t == STOP ? 0.1 : t > STOP && t < STOP + 10 ? -0.2 : 0.1;
    }
    move_edges(&s);
    CHECK(begins() == STOP);
    scene_free(&s);
}

// a touch that is shorter than what the filter added stays one, and none comes after it
TEST(a_short_touch_stays)
{
    Scene s = scene_make(TIMES, RATE, 1, 1);
    come_down(0.3);
    const int at = fastest();
    for (int t = at + 2; t < TIMES; ++t) on[t] = 0;
    for (int t = 0; t < TIMES; ++t) height[t] = 0.005;
    move_edges(&s);
    int touched = 0;
    for (int t = 0; t < TIMES; ++t) touched += on[t];
    CHECK(touched == 1 && on[at + 1]);
    scene_free(&s);
}

int main(void)
{
    RUN(a_step_begins_when_its_fall_is_fastest);
    RUN(a_sudden_stop_out_of_a_flight_begins_later);
    RUN(a_fast_fall_is_timed_by_its_height);
    RUN(a_contact_ends_when_the_ball_is_lifted_hardest);
    RUN(what_rises_as_it_touches_begins_there);
    RUN(a_short_touch_stays);
    return check_done();
}
