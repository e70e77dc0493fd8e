// Who carries how much: ramps, and the place over which the weight must be. MODEL 4.3, SOFT22 (5)
#include "base/vec.h"
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

#define RATE 120.0
#define SPAN 0.3  // support_span [m]

static double sum_of(const double* share, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += share[i];
    return sum;
}

// a = (mu s + 2 lambda q a*) / (mu + 2 lambda q), q = s (1 - s), lambda = d^2 / (d^2 + span^2)
TEST(two_supports_are_the_closed_form)
{
    const double apart[3] = {0.05, 0.3, 1.2}, trust[3] = {0.0, 0.25, 4.0};
    for (int d = 0; d < 3; ++d)
        for (int m = 0; m < 3; ++m)
            for (double ramp = 0.1; ramp < 1.0; ramp += 0.2) {
                const DpVec3 at[2] = {{0.1, 0.2, 0.0}, {0.1 + apart[d], 0.2, 0.0}};
                const double over = 0.7;  // a* of the second support
                const DpVec3 target = {0.1 + over * apart[d], 0.5, 0.3};  // beside their line
                double       share[2] = {1.0 - ramp, ramp};
                const double square = apart[d] * apart[d];
                const double lambda = square / (square + SPAN * SPAN), q = ramp * (1.0 - ramp);
                dp_walker_share(share, at, 2, target, trust[m], SPAN);
                CHECK_NEAR(
                    share[1],
                    (trust[m] * ramp + 2.0 * lambda * q * over) / (trust[m] + 2.0 * lambda * q),
                    1e-6);
                CHECK_NEAR(sum_of(share, 2), 1.0, 1e-12);
            }
}

// a foot whose ramp has not begun carries nothing, though the weight lies over it
TEST(whom_the_ramps_give_nothing_gets_nothing)
{
    const DpVec3 at[3] = {{0.0, 0.0, 0.0}, {0.4, 0.0, 0.0}, {0.2, 0.6, 0.0}};
    double       share[3] = {0.5, 0.5, 0.0};
    dp_walker_share(share, at, 3, at[2], 0.25, SPAN);
    CHECK(!(share[2] > 0.0 || share[2] < 0.0));
    CHECK_NEAR(share[0], 0.5, 1e-9);
    CHECK_NEAR(share[1], 0.5, 1e-9);
}

// without trust in the ramps three supports carry so that their mean lies where it should
TEST(three_supports_meet_the_target)
{
    const DpVec3 at[3] = {{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}};
    const DpVec3 target = {0.6, 0.4, 0.0};
    double       share[3] = {0.4, 0.3, 0.3};
    DpVec3       mean = {0.0, 0.0, 0.0};
    dp_walker_share(share, at, 3, target, 0.0, SPAN);
    for (int i = 0; i < 3; ++i) mean = dp_add(mean, dp_scale(at[i], share[i]));
    CHECK_NEAR(mean.x, target.x, 1e-4);
    CHECK_NEAR(mean.y, target.y, 1e-4);
    CHECK_NEAR(sum_of(share, 3), 1.0, 1e-12);
    double far[3] = {0.4, 0.3, 0.3};
    dp_walker_share(far, at, 3, dp_vec3(-5.0, -5.0, 0.0), 0.0, SPAN);  // outside: nobody pulls
    for (int i = 0; i < 3; ++i) CHECK(far[i] >= 0.0);
    CHECK(far[0] > 0.999);
}

// played backwards, contacts have the same ramps backwards: who lets go does so as who lands
TEST(ramps_are_the_same_backwards)
{
    enum
    {
        FEET = 4,
        MANY = 300
    };
    uint8_t             on[FEET * MANY], back[FEET * MANY];
    double              weight[FEET * MANY], turned[FEET * MANY];
    const DpLoadOptions options = dp_load_options_default();
    unsigned            seed = 3u;
    for (int round = 0; round < 20; ++round) {
        for (int i = 0; i < FEET; ++i)
            for (int t = 0, state = i % 2; t < MANY; state = !state)
                for (int k = 4 + (int)(check_random(&seed) * 50.0); k > 0 && t < MANY; --k, ++t)
                    on[i * MANY + t] = (uint8_t)state;
        for (int i = 0; i < FEET; ++i)
            for (int t = 0; t < MANY; ++t) back[i * MANY + t] = on[i * MANY + MANY - 1 - t];
        dp_walker_ramps(on, FEET, MANY, 120.0, &options, round % 2, weight);
        dp_walker_ramps(back, FEET, MANY, 120.0, &options, round % 2, turned);
        for (int i = 0; i < FEET; ++i)
            for (int t = 0; t < MANY; ++t)
                CHECK_NEAR(turned[i * MANY + t], weight[i * MANY + MANY - 1 - t], 1e-12);
    }
}

TEST(share_is_the_projection)
{
    const DpVec3 left = {0.0, 0.1, 0.0}, right = {0.0, -0.1, 0.0};
    CHECK_NEAR(dp_foot_share((DpVec3){3.0, 0.1, 1.0}, left, right), 0.0, 1e-12);  // SOFT22 (5)
    CHECK_NEAR(dp_foot_share((DpVec3){0.0, -0.1, 1.0}, left, right), 1.0, 1e-12);
    CHECK_NEAR(dp_foot_share((DpVec3){0.0, -0.05, 1.0}, left, right), 0.75, 1e-12);
    CHECK_NEAR(dp_foot_share((DpVec3){0.0, -0.5, 1.0}, left, right), 1.0, 1e-12);
    CHECK_NEAR(dp_foot_share(left, right, right), 0.5, 1e-12);
}

// `limbs` feet at given places, a body at rest over (x, y)
static void stand(int limbs, const double (*feet)[2], double x, double y, int model, double* fz,
                  double* balance_x, double* balance_y)
{
    enum
    {
        N = 60
    };
    Scene s = scene_make(N, RATE, limbs, 1);
    for (int t = 0; t < N; ++t) {
        scene_com(&s, t, x, y, 1.0);
        for (int p = 0; p < limbs; ++p) scene_put(&s, N, p, t, feet[p][0], feet[p][1], 0.0);
    }
    uint8_t on[8 * N];
    memset(on, 1, sizeof on);
    double        force[3 * 8 * N], point[3 * 8 * N];
    DpLoadOptions options = dp_load_options_default();
    options.model = (DpLoadModel)model;
    CHECK(dp_foot_force(scene_gait(&s, N, limbs, 1), on, s.ground, &options, force, point) ==
          DP_OK);
    double total = 0.0;
    *balance_x = *balance_y = 0.0;
    for (int p = 0; p < limbs; ++p) {
        fz[p] = -force[3 * (p * N + N / 2) + 2] / (s.mass * DP_GRAVITY);
        CHECK(fz[p] >= -1e-12);
        total += fz[p];
        *balance_x += fz[p] * feet[p][0];
        *balance_y += fz[p] * feet[p][1];
    }
    CHECK_NEAR(total, 1.0, 1e-9);
    scene_free(&s);
}

TEST(two_feet_at_rest_balance)
{
    const double feet[2][2] = {{0.0, 0.15}, {0.0, -0.15}};
    double       fz[2], bx, by;
    for (int model = 0; model < 2; ++model) {
        stand(2, feet, 0.0, 0.0, model, fz, &bx, &by);
        CHECK_NEAR(fz[0], 0.5, 1e-6);
        stand(2, feet, 0.0, 0.075, model, fz, &bx, &by);
        CHECK_NEAR(fz[0], 0.75, 1e-6);
        CHECK_NEAR(by, 0.075, 1e-6);
    }
}

TEST(four_feet_at_rest_balance)
{
    const double feet[4][2] = {{0.4, 0.15}, {0.4, -0.15}, {-0.4, 0.12}, {-0.4, -0.12}};
    double       fz[4], bx, by;
    stand(4, feet, 0.1, 0.03, DP_LOAD_INERTIA, fz, &bx, &by);
    CHECK_NEAR(bx, 0.1, 1e-4);
    CHECK_NEAR(by, 0.03, 1e-4);
    for (int p = 0; p < 4; ++p) CHECK(fz[p] > 0.05);
}

TEST(one_foot_carries_all)
{
    const double feet[1][2] = {{0.3, 0.1}};
    double       fz[1], bx, by;
    stand(1, feet, 0.0, 0.0, DP_LOAD_INERTIA, fz, &bx, &by);
    CHECK_NEAR(fz[0], 1.0, 1e-9);
}

int main(void)
{
    RUN(two_supports_are_the_closed_form);
    RUN(whom_the_ramps_give_nothing_gets_nothing);
    RUN(three_supports_meet_the_target);
    RUN(ramps_are_the_same_backwards);
    RUN(share_is_the_projection);
    RUN(two_feet_at_rest_balance);
    RUN(four_feet_at_rest_balance);
    RUN(one_foot_carries_all);
    return check_done();
}
