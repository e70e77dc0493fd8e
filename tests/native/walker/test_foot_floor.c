// tests of foot_floor.c: MODEL 4.2
#include "check.h"
#include "scene.h"
#include "walker/walker_inside.h"

#define TIMES 601
#define RATE 100.0
#define STEPS 10

static double height[2 * TIMES], speed[2 * TIMES];

// Two feet step 0.6 m a second apart along y, each rests for 0.4 s; foot 1 hovers 2 cm higher. `floor_at` tells how
// high the floor lies at a place; `change`: by how much heights are changed.
static DpStatus walk(double (*floor_at)(double), double change[2 * TIMES])
{
    Scene s = scene_make(TIMES, RATE, 2, 1);
    for (int t = 0; t < TIMES; ++t) {
        s.com[3 * t + 1] = 0.6 * t / RATE;
        for (int k = 0; k < 2; ++k) {
            const int    beat = (t + 50 * k) / 100, since = (t + 50 * k) % 100;
            const bool   rests = since < 40;
            const double y = rests ? 0.6 * beat : 0.6 * (beat + (since - 40) / 60.0);
            s.pose[7 * (k * TIMES + t) + 1] = y - 0.3 * k;
            height[k * TIMES + t] = floor_at(y - 0.3 * k) + 0.02 * k + (rests ? 0.0 : 0.1);
            speed[k * TIMES + t] = rests ? 0.05 : 2.0;
            change[k * TIMES + t] = height[k * TIMES + t];
        }
    }
    const DpStatus status =
        dp_walker_level_floor(scene_gait(&s, TIMES, 2, 1), 0, height, speed, 0.25, RATE);
    for (int k = 0; k < 2; ++k)
        for (int t = 0; t < TIMES; ++t) {
            change[k * TIMES + t] = height[k * TIMES + t] - change[k * TIMES + t];
        }
    scene_free(&s);
    return status;
}

static double leaning(double y)
{
    return 0.03 * y + 0.2;
}

static double steep(double y)
{
    return 0.13 * y;
}

static double hardly(double y)
{
    return 0.0025 * y;  // 9 mm over the path
}

static double stairs(double y)
{
    return 0.15 * floor((y + 0.9) / 1.2) * 0.5;
}

TEST(a_floor_that_leans_is_levelled)
{
    double change[2 * TIMES];
    CHECK(walk(leaning, change) == DP_OK);
    for (int k = 0; k < 2; ++k)
        for (int t = 0; t < TIMES; ++t)
            if (speed[k * TIMES + t] < 1.0)
                CHECK_NEAR(height[k * TIMES + t], leaning(1.8) + 0.02 * k, 1e-9);
}

TEST(other_floors_are_as_they_are)
{
    double (*const floors[3])(double) = {steep, hardly, stairs};
    double change[2 * TIMES];
    for (int n = 0; n < 3; ++n) {
        CHECK(walk(floors[n], change) == DP_OK);
        for (int k = 0; k < 2 * TIMES; ++k) CHECK(change[k] == 0.0);
    }
}

int main(void)
{
    RUN(a_floor_that_leans_is_levelled);
    RUN(other_floors_are_as_they_are);
    return check_done();
}
