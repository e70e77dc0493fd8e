// tests of spray_fly.c: MODEL 6.15
#include "base/noise.h"
#include "base/vec.h"
#include "check.h"
#include "spray/usual.h"

#define STEP (1.0 / 120.0)
#define HEAVY 20000.0  // [kg/m^3]

static DpSprayNumbers numbers_of(double density)
{
    DpSprayNumbers numbers = usual();
    numbers.particle_density = density;
    if (density >= HEAVY) numbers.particle_size = 0.1;  // which no air holds up
    return numbers;
}

// level ground to x = 100, and none beyond
static double level(const void* height, double x, double y)
{
    (void)y;
    return x < 100.0 ? *(const double*)height : NAN;
}

static double hilly(const void* context, double x, double y)
{
    (void)context;
    return 0.2 * sin(3.0 * x) + 0.1 * cos(5.0 * y);
}

static const double zero = 0.0;

static DpCloud* thrown(double density, DpVec3 at, DpVec3 velocity, double late)
{
    const DpSprayNumbers numbers = numbers_of(density);
    DpCloud*             cloud = dp_cloud_create(&numbers);
    const DpGrain        grain = {at, velocity, 0, 3};
    CHECK(cloud && dp_cloud_add(cloud, &grain, late) == DP_OK);
    return cloud;
}

// Flies until it is down; where, and after how many steps.
static DpLanding land(DpCloud* cloud, const DpSprayGround* ground, double dt, int* steps)
{
    const DpLanding* landing = NULL;
    int              landings = 0;
    for (*steps = 0; landings == 0 && *steps < 100000; ++*steps)
        CHECK(dp_cloud_fly(cloud, ground, dt, 1, &landing, &landings) == DP_OK);
    CHECK(landings == 1 && dp_cloud_count(cloud) == 0);
    return landing[0];
}

// Without air: v^2 sin(2a) / g from the ground, whatever the step.
TEST(goes_as_far_as_a_parabola)
{
    const DpSprayGround ground = {.surface = level, .ground = &zero};
    const double        v = 6.0, a = 0.6, far = v * v * sin(2.0 * a) / DP_GRAVITY;
    for (double dt = 1.0 / 30.0; dt > 1.0 / 300.0; dt *= 0.5) {
        DpCloud* cloud =
            thrown(HEAVY, dp_vec3(1.0, 2.0, 1e-9), dp_vec3(v * cos(a), 0.0, v * sin(a)), 0.0);
        int             steps;
        const DpLanding at = land(cloud, &ground, dt, &steps);
        CHECK_CLOSE(at.x - 1.0, far, 0.002);
        CHECK_NEAR(at.y, 2.0, 0.0);
        CHECK(at.kind == 3 && !at.beside);
        CHECK_NEAR(steps * dt, 2.0 * v * sin(a) / DP_GRAVITY, 1.5 * dt);
        dp_cloud_destroy(cloud);
    }
}

// One that falls for long is as fast as drag and weight allow: sqrt(4/3 rho d g / (rho_air C)).
TEST(falls_no_faster_than_the_air_lets_it)
{
    const DpSprayGround ground = {.surface = level, .ground = &zero};
    DpCloud*            cloud = thrown(100.0, dp_vec3(0, 0, 1000.0), dp_vec3(9.0, 0, 0), 0.0);
    const DpLanding*    landing;
    int                 landings;
    for (int k = 0; k < 1200; ++k)
        CHECK(dp_cloud_fly(cloud, &ground, STEP, 1, &landing, &landings) == DP_OK);
    const DpGrain grain = dp_cloud_grain(cloud, 0);
    CHECK_CLOSE(-grain.velocity.z, sqrt(4.0 / 3.0 * 100.0 * 0.004 * 9.81 / (1.2 * 0.5)), 1e-3);
    CHECK_NEAR(grain.velocity.x, 0.0, 1e-3);
    dp_cloud_destroy(cloud);
}

// Air slows it down along its way alone: it stays in the plane it was thrown in, and steps change its place little.
TEST(steps_hardly_change_where_it_lands)
{
    const DpSprayGround ground = {.surface = level, .ground = &zero};
    double              far[2];
    for (int k = 0; k < 2; ++k) {
        DpCloud* cloud = thrown(300.0, dp_vec3(0, 0, 0.5), dp_vec3(4.0, 4.0, 5.0), 0.0);
        int      steps;
        far[k] = land(cloud, &ground, k ? STEP : STEP / 8.0, &steps).x;
        dp_cloud_destroy(cloud);
    }
    CHECK_CLOSE(far[1], far[0], 1e-3);
    CHECK(far[0] < 4.0 * (5.0 + sqrt(25.0 + 9.81)) / 9.81);  // nearer than without air
}

// One that comes off in the middle of a step flies for the rest of it.
TEST(flies_from_when_it_came_off)
{
    const DpSprayGround ground = {.surface = level, .ground = &zero};
    DpCloud*            cloud = thrown(HEAVY, dp_vec3(0, 0, 50.0), dp_vec3(2.0, 0, 0), 0.75 * STEP);
    const DpLanding*    landing;
    int                 landings;
    CHECK(dp_cloud_fly(cloud, &ground, STEP, 1, &landing, &landings) == DP_OK);
    CHECK_CLOSE(dp_cloud_grain(cloud, 0).at.x, 2.0 * 0.25 * STEP, 1e-3);
    CHECK(dp_cloud_fly(cloud, &ground, STEP, 1, &landing, &landings) == DP_OK);
    CHECK_CLOSE(dp_cloud_grain(cloud, 0).at.x, 2.0 * 1.25 * STEP, 1e-3);
    dp_cloud_destroy(cloud);
}

TEST(what_falls_by_the_ground_is_told)
{
    const DpSprayGround ground = {.surface = level, .ground = &zero};
    DpCloud*            cloud = thrown(1600.0, dp_vec3(99.9, 0, 0.2), dp_vec3(3.0, 0, 0), 0.0);
    int                 steps;
    CHECK(land(cloud, &ground, STEP, &steps).beside);
    CHECK_NEAR(steps * STEP, sqrt(2.0 * DP_SPRAY_FALL / DP_GRAVITY), 0.05);
    dp_cloud_destroy(cloud);
}

static DpCloud* fountain(int count)
{
    const DpSprayNumbers numbers = numbers_of(800.0);
    DpCloud*             cloud = dp_cloud_create(&numbers);
    for (int n = 0; n < count; ++n) {
        const uint32_t bits = dp_noise_bits(n, 1, 7u), more = dp_noise_bits(n, 2, 7u);
        const DpGrain  grain = {
             .at = dp_vec3(0.01 * n, 0.0, 0.5),
             .velocity = dp_vec3(4.0 * dp_noise_unit(bits) - 2.0,
                                 4.0 * dp_noise_unit(bits >> 16) - 2.0, 6.0 * dp_noise_unit(more)),
             .kind = (uint8_t)(n % 5)};
        CHECK(dp_cloud_add(cloud, &grain, STEP * dp_noise_unit(more >> 16)) == DP_OK);
    }
    return cloud;
}

TEST(many_threads_give_the_same_bits)
{
    const DpSprayGround ground = {.surface = hilly};
    DpCloud *           one = fountain(3000), *two = fountain(3000);
    int                 in_all = 0;
    for (int k = 0; k < 200; ++k) {
        const DpLanding *a, *b;
        int              na, nb;
        CHECK(dp_cloud_fly(one, &ground, STEP, 1, &a, &na) == DP_OK);
        CHECK(dp_cloud_fly(two, &ground, STEP, 4, &b, &nb) == DP_OK);
        CHECK(na == nb);
        for (int n = 0; n < na; ++n)
            CHECK(a[n].x == b[n].x && a[n].y == b[n].y && a[n].kind == b[n].kind);
        in_all += na;
        CHECK(in_all + dp_cloud_count(one) == 3000);
    }
    CHECK(in_all == 3000);
    dp_cloud_destroy(one), dp_cloud_destroy(two);
}

TEST(goes_on_from_its_bytes)
{
    const DpSprayGround  ground = {.surface = hilly};
    const DpSprayNumbers numbers = numbers_of(800.0);
    DpCloud *            cloud = fountain(500), *again = NULL;
    const DpLanding*     landing;
    int                  landings;
    for (int k = 0; k < 40; ++k)
        CHECK(dp_cloud_fly(cloud, &ground, STEP, 1, &landing, &landings) == DP_OK);
    DpStateWriter writer = {0};
    dp_write_chunk(&writer, "test", 1);
    dp_cloud_save(cloud, &writer);
    dp_write_end(&writer);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_read_chunk(&reader, "test", 1) == 1);
    CHECK(dp_cloud_load(&again, &numbers, &reader) == DP_OK);
    dp_read_end(&reader);
    CHECK(reader.status == DP_OK && dp_cloud_count(again) == dp_cloud_count(cloud));
    for (int n = 0; n < dp_cloud_count(cloud); ++n) {
        const DpGrain a = dp_cloud_grain(cloud, n), b = dp_cloud_grain(again, n);
        CHECK(memcmp(&a.at, &b.at, sizeof a.at) == 0 && a.name == b.name && a.kind == b.kind);
        CHECK(memcmp(&a.velocity, &b.velocity, sizeof a.velocity) == 0);
    }
    dp_write_drop(&writer);
    dp_cloud_destroy(cloud), dp_cloud_destroy(again);
}

int main(void)
{
    RUN(goes_as_far_as_a_parabola);
    RUN(falls_no_faster_than_the_air_lets_it);
    RUN(steps_hardly_change_where_it_lands);
    RUN(flies_from_when_it_came_off);
    RUN(what_falls_by_the_ground_is_told);
    RUN(many_threads_give_the_same_bits);
    RUN(goes_on_from_its_bytes);
    return check_done();
}
