// What of a limb carries: its points that touch and are not lifted, toes a quarter as much as heels.
#include "walker/foot_load.h"

#include "check.h"
#include "scene.h"

#define TIMES 3
#define POINTS 4

// heel, two balls, tip in a row; the tip 3 cm higher at sample 1 and 5 cm at sample 2
static Scene foot(void)
{
    static const int32_t role[POINTS] = {DP_POINT_HEEL, DP_POINT_BALL, DP_POINT_BALL, DP_POINT_TIP};
    Scene                s = scene_make(TIMES, 50.0, 1, POINTS);
    for (int k = 0; k < POINTS; ++k) {
        s.point_role[k] = role[k];
        s.point[3 * k] = 0.1 * k;
    }
    for (int t = 0; t < TIMES; ++t) scene_put(&s, TIMES, 0, t, 1.0, 2.0, 0.5);
    for (int k = 0; k < POINTS; ++k)
        for (int t = 0; t < TIMES; ++t)
            s.ground[k * TIMES + t] =
                0.48 - (k == 3 ? (double)(t == 1) * 0.03 + (t == 2) * 0.05 : 0.0);
    return s;
}

static void gather(Scene* s, const uint8_t* touching, DpLoad* load)
{
    static DpLoadOptions options;
    options = dp_load_options_default();
    *load = (DpLoad){.gait = scene_gait(s, TIMES, 1, POINTS),
                     .options = &options,
                     .ground = s->ground,
                     .rate = 50.0};
    CHECK(dp_load_open(load));
    dp_load_gather(load, 0, touching);
}

TEST(roles_share_what_suits_them)
{
    Scene         s = foot();
    const uint8_t touching[TIMES] = {1, 1, 1};
    DpLoad        load;
    gather(&s, touching, &load);
    CHECK(load.limbs == 1 && load.points == POINTS && load.first[0] == 0 &&
          load.first[1] == POINTS);
    const double capacity[POINTS] = {1.0, 0.5, 0.5, 0.25};
    for (int k = 0; k < POINTS; ++k) CHECK_NEAR(load.capacity[k], capacity[k], 1e-12);
    for (int k = 0; k < POINTS; ++k) {  // put down on the ground
        CHECK_NEAR(load.place[k * TIMES].x, 1.0 + 0.1 * k, 1e-12);
        CHECK_NEAR(load.place[k * TIMES + 2].z, k == 3 ? 0.43 : 0.48, 1e-12);
    }
    dp_load_close(&load);
    scene_free(&s);
}

TEST(lifted_points_carry_nothing)
{
    Scene         s = foot();
    const uint8_t touching[TIMES] = {1, 1, 1};
    DpLoad        load;
    gather(&s, touching, &load);
    for (int t = 0; t < TIMES; ++t) {
        for (int k = 0; k < 3; ++k) CHECK(load.point_on[k * TIMES + t]);
        CHECK(load.point_on[3 * TIMES + t] == (t < 2));
        CHECK(load.limb_on[t]);
    }
    dp_load_close(&load);
    scene_free(&s);
}

TEST(what_does_not_touch_carries_nothing)
{
    Scene         s = foot();
    const uint8_t touching[TIMES] = {1, 0, 0};
    DpLoad        load;
    gather(&s, touching, &load);
    CHECK(load.limb_on[0] && !load.limb_on[1] && !load.limb_on[2]);
    CHECK(load.limb_weight[0] > 0.0 && load.limb_weight[1] == 0.0);
    for (int k = 0; k < POINTS; ++k) CHECK(!load.point_on[k * TIMES + 1]);
    dp_load_close(&load);
    scene_free(&s);
}

int main(void)
{
    RUN(roles_share_what_suits_them);
    RUN(lifted_points_carry_nothing);
    RUN(what_does_not_touch_carries_nothing);
    return check_done();
}
