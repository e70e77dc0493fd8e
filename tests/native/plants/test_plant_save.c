// What plants have become is kept and taken back: those that go on from it are the same, to the bit.
#include "lawn.h"

#define SIDE 10
#define KINDS 2

static double mound(const void* rise, double x, double y)
{
    return *(const double*)rise * sin(3.0 * x) * cos(2.0 * y);
}

// three kinds of plants on a mound; a third of the ground is told as a grid, the rest is a function
static DpPlants* planted(uint64_t seed)
{
    DpPlants*   plants = dp_plants_create(seed);
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.02f, kind.spread = 0.4f, kind.regrow_rate = 1e-6f;
    for (int s = 0; s < KINDS; ++s) {
        float root[3 * SIDE * SIDE], slope[2 * SIDE * SIDE] = {0}, z[SIDE * SIDE];
        int   stand;
        for (int k = 0; k < SIDE * SIDE; ++k) {
            root[3 * k] = 0.08f * (float)(k % SIDE) + 0.04f * (float)s;
            root[3 * k + 1] = 0.08f * (float)(k / SIDE), root[3 * k + 2] = 0.01f;
            z[k] = (float)(k % 7) - 3.0f;
        }
        CHECK(dp_plants_add(plants, &kind, root, NULL, SIDE * SIDE, &stand) == DP_OK);
        CHECK(dp_plants_slope(plants, stand, slope) == DP_OK);
        if (s == 1) CHECK(dp_plants_vary(plants, stand, z) == DP_OK);
        kind.form = DP_PLANT_TUFT, kind.sheets = 3, kind.curl = 0.1f, kind.height = 0.2f;
    }
    return plants;
}

// a boot goes over them, forth and back, and in frame 50 a month passes
static void walk(DpPlants* plants, int from, int to)
{
    static float        bottom[SOLE_SIDE * SOLE_SIDE];
    float               height[16 * 16];
    const double        rise = 0.02, dt = 1.0 / 60;
    const DpPlantGround all = {.cell = 0.02, .at = mound, .context = &rise};
    for (int k = from; k < to; ++k) {
        const double  x = 0.5 + 0.4 * sin(0.13 * k), y = 0.5 + 0.3 * sin(0.05 * k);
        const double  z = 0.03 + 0.05 * sin(0.3 * k), cell = 0.02;
        DpPlantGround grid = {.nx = 16,
                              .ny = 16,
                              .row = 16,
                              .cell = cell,
                              .x0 = x - 0.16,
                              .y0 = y - 0.16,
                              .height = height,
                              .next = &all,
                              .rose = k % 9 == 0};
        for (int c = 0; c < 256; ++c)
            height[c] =
                (float)(mound(&rise, grid.x0 + c % 16 * cell, grid.y0 + c / 16 * cell) - 0.002);
        DpPlantCollider foot = sole(bottom, 0.01, x, y, z, 0.26, 0.1, 0.1);
        foot.velocity = dp_vec3(0.4 * 0.13 * 60 * cos(0.13 * k), 0.0, 0.0);
        DpPlantsReport report;
        CHECK(dp_plants_follow(plants, &grid) == DP_OK);
        CHECK(dp_plants_step(plants, &grid, &foot, k % 40 < 20, dt, 2, &report) == DP_OK);
        if (k == 50) CHECK(dp_plants_advance_time(plants, 30.0 * 86400) == DP_OK);
    }
}

static void take_over(DpPlants* plants, const DpStateWriter* writer)
{
    DpStateReader  reader = dp_read_open(writer->bytes, writer->size);
    DpPlantsState* state = NULL;
    CHECK(dp_plants_load(plants, &reader, &state) == DP_OK && reader.at == writer->size);
    if (state) dp_plants_restore(plants, state);
}

static bool same(const DpStateWriter* a, const DpStateWriter* b)
{
    return a->status == DP_OK && a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
}

// what is read of every plant
static void check_alike(const DpPlants* a, const DpPlants* b)
{
    static float  at[2][3 * 1024], speed[2][3 * 1024];
    static double strength[2][1024];
    for (int s = 0; s < KINDS; ++s)
        for (int k = 0; k < SIDE * SIDE; ++k) {
            const DpPlantShape shape = dp_plants_shape(a, s);
            const size_t       places = 3 * (size_t)shape.particles * sizeof(float);
            CHECK(dp_plants_read(a, s, k, at[0], speed[0], strength[0]) == DP_OK);
            CHECK(dp_plants_read(b, s, k, at[1], speed[1], strength[1]) == DP_OK);
            CHECK(memcmp(at[0], at[1], places) == 0 && memcmp(speed[0], speed[1], places) == 0);
            CHECK(memcmp(strength[0], strength[1], (size_t)shape.bends * sizeof(double)) == 0);
        }
}

TEST(they_go_on_as_if_they_had_never_stopped)
{
    const int stops[4] = {0, 7, 51, 90};
    DpPlants* whole = planted(5);
    walk(whole, 0, 100);
    DpStateWriter end = {0};
    dp_plants_save(whole, &end);
    for (int n = 0; n < 4; ++n) {
        DpPlants *before = planted(5), *after = planted(5);
        walk(before, 0, stops[n]);
        DpStateWriter at_stop = {0}, again = {0}, at_end = {0};
        dp_plants_save(before, &at_stop);
        take_over(after, &at_stop);
        check_alike(before, after);
        dp_plants_save(after, &again);
        CHECK(same(&at_stop, &again));
        walk(after, stops[n], 100);
        check_alike(whole, after);
        dp_plants_save(after, &at_end);
        CHECK(same(&end, &at_end));
        dp_write_drop(&at_stop), dp_write_drop(&again), dp_write_drop(&at_end);
        dp_plants_destroy(before), dp_plants_destroy(after);
    }
    dp_write_drop(&end);
    dp_plants_destroy(whole);
}

TEST(untrodden_plants_take_next_to_nothing)
{
    DpPlants*     plants = planted(1);
    DpStateWriter writer = {0};
    dp_plants_save(plants, &writer);
    CHECK(writer.size < 120);
    dp_write_drop(&writer);
    dp_plants_destroy(plants);
}

TEST(other_plants_and_trodden_ones_refuse)
{
    DpPlants *plants = planted(1), *other = planted(2), *trodden = planted(1);
    walk(plants, 0, 20), walk(trodden, 0, 20);
    DpStateWriter writer = {0};
    dp_plants_save(plants, &writer);
    DpPlantsState* state = NULL;
    DpStateReader  reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_plants_load(other, &reader, &state) == DP_BAD_FILE && !state);
    reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_plants_load(trodden, &reader, &state) == DP_BAD_ARGUMENT && !state);
    DpPlants*         moved = dp_plants_create(1);
    const DpPlantKind kind = dp_plant_kind_default();
    const float       root[3] = {0.001f, 0.0f, 0.0f};
    int               stand;
    CHECK(dp_plants_add(moved, &kind, root, NULL, 1, &stand) == DP_OK);
    reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_plants_load(moved, &reader, &state) == DP_BAD_FILE && !state);
    CHECK(dp_plants_load(moved, NULL, &state) == DP_BAD_ARGUMENT);
    dp_write_drop(&writer);
    dp_plants_destroy(plants), dp_plants_destroy(other), dp_plants_destroy(trodden);
    dp_plants_destroy(moved);
}

// damage that its checksum does not tell, and memory that ends: refused or lived with, never more
TEST(what_is_damaged_is_refused_or_lived_with)
{
    DpPlants* plants = planted(3);
    walk(plants, 0, 30);
    DpStateWriter writer = {0};
    dp_plants_save(plants, &writer);
    dp_plants_destroy(plants);
    unsigned chance = 1;
    int      refused = 0;
    for (int k = 0; k < 40; ++k) {
        DpStateWriter damaged = {0};
        const size_t  head = 24, size = writer.size - head;
        dp_write_chunk(&damaged, "plnt", 1);
        dp_write_bytes(&damaged, writer.bytes + head, k % 4 ? size : size - (size_t)k - 1);
        const size_t among = k % 2 ? 200 : damaged.size - head;
        for (int n = 0; n < 3; ++n)
            damaged.bytes[head + (size_t)(check_random(&chance) * (double)among)] ^=
                (unsigned char)(1u << (int)(8 * check_random(&chance)));
        dp_write_end(&damaged);
        DpStateReader  reader = dp_read_open(damaged.bytes, damaged.size);
        DpPlantsState* state = NULL;
        plants = planted(3);
        const DpStatus status = dp_plants_load(plants, &reader, &state);
        CHECK(status == DP_OK || status == DP_BAD_FILE);
        CHECK((status == DP_OK) == (state != NULL));
        refused += !state;
        if (state) {
            dp_plants_restore(plants, state);
            walk(plants, 30, 33);
        } else {
            DpStateWriter still = {0};
            dp_plants_save(plants, &still);
            CHECK(still.size < 120);
            dp_write_drop(&still);
        }
        dp_write_drop(&damaged);
        dp_plants_destroy(plants);
    }
    CHECK(refused > 5 && refused < 40);
    plants = planted(3);
    for (long left = 0; left < 10; ++left) {
        DpStateReader  reader = dp_read_open(writer.bytes, writer.size);
        DpPlantsState* state = NULL;
        dp_alloc_fail_after(left);
        const DpStatus status = dp_plants_load(plants, &reader, &state);
        dp_alloc_fail_after(-1);
        CHECK(status == DP_NO_MEMORY && !state);
    }
    dp_write_drop(&writer);
    dp_plants_destroy(plants);
    dp_plants_state_destroy(NULL);
}

int main(void)
{
    RUN(they_go_on_as_if_they_had_never_stopped);
    RUN(untrodden_plants_take_next_to_nothing);
    RUN(other_plants_and_trodden_ones_refuse);
    RUN(what_is_damaged_is_refused_or_lived_with);
    return check_done();
}
