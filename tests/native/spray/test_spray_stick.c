// tests of spray_stick.c: MODEL 6.15
#include "base/vec.h"
#include "check.h"
#include "spray/usual.h"

#define STEP (1.0 / 120.0)

// a plate of 0.3 x 0.1 m, of two triangles
static const float   PLATE[] = {0, 0, 0, 0.3f, 0, 0, 0.3f, 0.1f, 0, 0, 0.1f, 0};
static const int32_t FACES[] = {0, 1, 2, 0, 2, 3};
static const DpMesh  plate = {4, 2, PLATE, FACES};

static double level(const void* context, double x, double y)
{
    (void)context, (void)x, (void)y;
    return 0.0;
}

static const DpSprayGround ground = {.surface = level};

// how much was taken, of how much there is
typedef struct Store
{
    int    taken, left;
    double x, y;  // sums of places
} Store;

static bool dig(void* context, double x, double y, uint8_t* kind)
{
    Store* store = context;
    if (store->left == 0) return false;
    --store->left, ++store->taken;
    store->x += x, store->y += y;
    *kind = 2;
    return true;
}

static DpPose at(double x, double z)
{
    return (DpPose){{x, 0.0, z}, {1, 0, 0, 0}};
}

static DpStatus step(DpCoat* coat, DpCloud* cloud, Store* store, DpPose from, DpPose to, double dt,
                     bool presses)
{
    const DpCoatStep s = {.from = from,
                          .to = to,
                          .dt = dt,
                          .presses = presses,
                          .ground = &ground,
                          .dig = dig,
                          .digger = store};
    return dp_coat_step(coat, &s, cloud);
}

// A plate that has stood on the ground and goes up by 10 cm, slower than anything falls off.
static DpCoat* coated(const DpSprayNumbers* numbers, DpCloud* cloud, Store* store)
{
    DpCoat* coat = NULL;
    CHECK(dp_coat_create(&coat, &plate, numbers, 5u) == DP_OK);
    CHECK(step(coat, cloud, store, at(0, 0), at(0, 0), STEP, true) == DP_OK);
    CHECK(step(coat, cloud, store, at(0, 0), at(0, 0.1), 1.0, true) == DP_OK);
    return coat;
}

TEST(a_layer_sticks_as_thick_as_told)
{
    const DpSprayNumbers numbers = usual();
    DpCloud*             cloud = dp_cloud_create(&numbers);
    Store                store = {.left = 1 << 20};
    DpCoat*              coat = coated(&numbers, cloud, &store);
    CHECK_CLOSE(dp_coat_held(coat) * dp_spray_volume(&numbers), 0.03 * numbers.adhesion, 1e-3);
    CHECK(dp_coat_held(coat) == store.taken);
    CHECK_NEAR(store.x / store.taken, 0.15, 0.005);  // evenly
    CHECK_NEAR(store.y / store.taken, 0.05, 0.002);
    // what has its grain takes no other
    const int held = store.taken;
    CHECK(step(coat, cloud, &store, at(0, 0.1), at(0, 0), 1.0, true) == DP_OK);
    CHECK(step(coat, cloud, &store, at(0, 0), at(0, 0.1), 1.0, true) == DP_OK);
    CHECK(store.taken == held && dp_cloud_count(cloud) == 0);
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

TEST(no_more_sticks_than_there_is)
{
    const DpSprayNumbers numbers = usual();
    DpCloud*             cloud = dp_cloud_create(&numbers);
    Store                store = {.left = 100};
    DpCoat*              coat = coated(&numbers, cloud, &store);
    CHECK(dp_coat_held(coat) == 100 && store.left == 0);
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

TEST(one_that_stands_throws_nothing)
{
    const DpSprayNumbers numbers = usual();
    DpCloud*             cloud = dp_cloud_create(&numbers);
    Store                store = {.left = 1 << 20};
    DpCoat*              coat = NULL;
    CHECK(dp_coat_create(&coat, &plate, &numbers, 5u) == DP_OK);
    for (int k = 0; k < 50; ++k)
        CHECK(step(coat, cloud, &store, at(0, 0), at(0, 0), STEP, true) == DP_OK);
    CHECK(store.taken == 0 && dp_cloud_count(cloud) == 0);
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

// dv = v (e^-(t-tc)/h - e^-(t-tc+dt)/h), whatever the steps; all of it in the end, with the velocity it had.
TEST(falls_off_by_the_law)
{
    DpSprayNumbers numbers = usual();
    numbers.scatter = 0.0, numbers.adhesion = 0.01;
    for (int many = 1; many <= 4; many *= 2) {
        DpCloud*     cloud = dp_cloud_create(&numbers);
        Store        store = {.left = 1 << 20};
        DpCoat*      coat = coated(&numbers, cloud, &store);
        const int    v = dp_coat_held(coat);
        const double dt = STEP / many, speed = 8.0;
        for (int k = 1; k <= 240 * many; ++k) {
            const double x = speed * dt * k;
            CHECK(step(coat, cloud, &store, at(x - speed * dt, 0.1), at(x, 0.1), dt, false) ==
                  DP_OK);
            const double expected = v * (1.0 - exp(-k * dt / numbers.hold_time));
            CHECK_NEAR(dp_cloud_count(cloud), expected, 2.0 * sqrt((double)v));
            CHECK(dp_cloud_count(cloud) + dp_coat_held(coat) == v);
        }
        CHECK(dp_coat_held(coat) <= 2);
        const DpGrain grain = dp_cloud_grain(cloud, v / 2);
        CHECK_NEAR(grain.velocity.x, speed, 1e-9);
        CHECK_NEAR(grain.at.z, 0.1, 1e-9);
        CHECK(grain.kind == 2);
        dp_coat_destroy(coat), dp_cloud_destroy(cloud);
    }
}

TEST(what_moves_slowly_keeps_it)
{
    const DpSprayNumbers numbers = usual();
    DpCloud*             cloud = dp_cloud_create(&numbers);
    Store                store = {.left = 1 << 20};
    DpCoat*              coat = coated(&numbers, cloud, &store);
    const double         slow = 0.99 * numbers.slow_speed * STEP;
    for (int k = 0; k < 100; ++k)
        CHECK(step(coat, cloud, &store, at(slow * k, 0.1), at(slow * (k + 1), 0.1), STEP, false) ==
              DP_OK);
    CHECK(dp_cloud_count(cloud) == 0 && dp_coat_held(coat) == store.taken);
    // half way up to the fast one, half as much falls off in a time that is short
    const double speed = 0.5 * (numbers.slow_speed + numbers.fast_speed);
    const double dt = 0.1 * numbers.hold_time;
    CHECK(step(coat, cloud, &store, at(0, 0.1), at(speed * dt, 0.1), dt, false) == DP_OK);
    CHECK_NEAR(dp_cloud_count(cloud), store.taken * (1.0 - exp(-0.05)),
               2.0 * sqrt(0.05 * store.taken));
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

// Grains of a disc that turns fly off along its rim.
TEST(flies_off_a_wheel_along_its_rim)
{
    DpSprayNumbers numbers = usual();
    numbers.scatter = 0.0;
    DpCloud*     cloud = dp_cloud_create(&numbers);
    Store        store = {.left = 1 << 20};
    DpCoat*      coat = coated(&numbers, cloud, &store);
    const double turn = 0.02;
    const DpPose from = {{0, 0, 1.0}, dp_quat_about(dp_vec3(0, 0, 1), 0.0)};
    const DpPose to = {{0, 0, 1.0}, dp_quat_about(dp_vec3(0, 0, 1), turn)};
    const double dt = turn * 0.1 / 10.0;  // 10 m/s at 0.1 m
    CHECK(step(coat, cloud, &store, from, to, dt, false) == DP_OK);
    CHECK(dp_cloud_count(cloud) > 0);
    for (int n = 0; n < dp_cloud_count(cloud); ++n) {
        const DpGrain grain = dp_cloud_grain(cloud, n);
        const double  r = hypot(grain.at.x, grain.at.y);
        CHECK_CLOSE(dp_length(grain.velocity), turn / dt * r, 1e-3);
        CHECK_NEAR(grain.velocity.x * grain.at.x + grain.velocity.y * grain.at.y, 0.0,
                   0.03 * r * r * turn / dt);
    }
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

// It comes off within the step, and flies for the rest of it: without air it stays beside its place.
TEST(flies_on_from_where_it_came_off)
{
    DpSprayNumbers numbers = usual();
    numbers.scatter = 0.0, numbers.particle_density = 1e9;  // air is nothing to it
    DpCloud*         cloud = dp_cloud_create(&numbers);
    Store            store = {.left = 1 << 20};
    DpCoat*          coat = coated(&numbers, cloud, &store);
    const double     dt = 0.1, far = 8.0 * dt;  // more than the plate is long
    const DpLanding* landing;
    int              landings;
    CHECK(step(coat, cloud, &store, at(0, 10), at(far, 10), dt, false) == DP_OK);
    CHECK(dp_cloud_fly(cloud, &ground, dt, 1, &landing, &landings) == DP_OK && landings == 0);
    CHECK(dp_cloud_count(cloud) > 1000);
    for (int n = 0; n < dp_cloud_count(cloud); ++n) {
        const double x = dp_cloud_grain(cloud, n).at.x - far;
        CHECK(x > -1e-4 && x < 0.3 + 1e-4);
    }
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

// What has touched the ground again is held as if it had just come up.
TEST(a_touch_holds_anew)
{
    const DpSprayNumbers numbers = usual();
    DpCloud*             cloud = dp_cloud_create(&numbers);
    Store                store = {.left = 1 << 20};
    DpCoat*              coat = coated(&numbers, cloud, &store);
    const double         dt = 0.4 * numbers.hold_time, far = 20.0 * dt;
    CHECK(step(coat, cloud, &store, at(0, 0.1), at(far, 0.1), dt, false) == DP_OK);
    const int gone = dp_cloud_count(cloud);
    CHECK(gone > 100);
    store.left = 0;  // nothing sticks anew
    CHECK(step(coat, cloud, &store, at(far, 0), at(far, 0), STEP, true) == DP_OK);
    CHECK(step(coat, cloud, &store, at(far, 0), at(far, 0.1), 1.0, true) == DP_OK);
    CHECK(step(coat, cloud, &store, at(0, 0.1), at(0.9 * far, 0.1), 0.9 * dt, false) == DP_OK);
    CHECK(dp_cloud_count(cloud) == gone);  // those that are left have held on for longer than that
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

// Who is put elsewhere has not gone there.
TEST(a_jump_throws_nothing)
{
    const DpSprayNumbers numbers = usual();
    DpCloud*             cloud = dp_cloud_create(&numbers);
    Store                store = {.left = 1 << 20};
    DpCoat*              coat = coated(&numbers, cloud, &store);
    const DpCoatStep     jump = {.from = at(0, 0.1),
                                 .to = at(100, 0.1),
                                 .dt = STEP,
                                 .jumps = true,
                                 .ground = &ground,
                                 .dig = dig,
                                 .digger = &store};
    CHECK(dp_coat_step(coat, &jump, cloud) == DP_OK);
    CHECK(dp_cloud_count(cloud) == 0 && dp_coat_held(coat) == store.taken);
    dp_coat_destroy(coat), dp_cloud_destroy(cloud);
}

TEST(goes_on_from_its_bytes)
{
    const DpSprayNumbers numbers = usual();
    DpCloud *            cloud = dp_cloud_create(&numbers), *other = dp_cloud_create(&numbers);
    Store                store = {.left = 1 << 20};
    DpCoat *             coat = coated(&numbers, cloud, &store), *again = NULL;
    CHECK(step(coat, cloud, &store, at(0, 0.1), at(0.1, 0.1), STEP, false) == DP_OK);
    DpStateWriter writer = {0};
    dp_write_chunk(&writer, "test", 1);
    dp_coat_save(coat, &writer), dp_coat_save(NULL, &writer);
    dp_write_end(&writer);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    DpCoat*       none = coat;
    CHECK(dp_read_chunk(&reader, "test", 1) == 1);
    CHECK(dp_coat_load(&again, &plate, &numbers, 5u, &reader) == DP_OK);
    CHECK(dp_coat_load(&none, &plate, &numbers, 5u, &reader) == DP_OK && !none);
    dp_read_end(&reader);
    CHECK(reader.status == DP_OK && dp_coat_held(again) == dp_coat_held(coat));
    const int before = dp_cloud_count(cloud);
    CHECK(step(coat, cloud, &store, at(0.1, 0.1), at(0.2, 0.1), STEP, false) == DP_OK);
    CHECK(step(again, other, &store, at(0.1, 0.1), at(0.2, 0.1), STEP, false) == DP_OK);
    CHECK(dp_cloud_count(other) == dp_cloud_count(cloud) - before && dp_cloud_count(other) > 0);
    for (int n = 0; n < dp_cloud_count(other); ++n)
        CHECK(dp_cloud_grain(other, n).at.x == dp_cloud_grain(cloud, before + n).at.x);
    dp_write_drop(&writer);
    dp_coat_destroy(coat), dp_coat_destroy(again);
    dp_cloud_destroy(cloud), dp_cloud_destroy(other);
}

TEST(too_many_places_are_refused)
{
    DpSprayNumbers numbers = usual();
    numbers.particle_size = 0.0005, numbers.adhesion = 0.05;
    DpCoat* coat = NULL;
    CHECK(dp_coat_create(&coat, &plate, &numbers, 0u) == DP_BAD_ARGUMENT && !coat);
}

int main(void)
{
    RUN(a_layer_sticks_as_thick_as_told);
    RUN(no_more_sticks_than_there_is);
    RUN(one_that_stands_throws_nothing);
    RUN(falls_off_by_the_law);
    RUN(what_moves_slowly_keeps_it);
    RUN(flies_off_a_wheel_along_its_rim);
    RUN(flies_on_from_where_it_came_off);
    RUN(a_touch_holds_anew);
    RUN(a_jump_throws_nothing);
    RUN(goes_on_from_its_bytes);
    RUN(too_many_places_are_refused);
    return check_done();
}
