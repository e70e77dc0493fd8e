// How grass lies, cell by cell: memory and time where something touched it, rising, wear, reading.
#include "grass/grass.h"
#include "plants/lawn.h"

#define CELL 0.01
#define SIDE 128

static float bottom[SOLE_SIDE * SOLE_SIDE];

// a square lawn of 2 m about the origin, so dense that every cell grows
static DpPlants* meadow(const DpPlantKind* kind)
{
    float*    root = dp_alloc(41 * 41, 3 * sizeof(float));
    DpPlants* plants = dp_plants_create(1);
    int       stand;
    for (int k = 0; k < 41 * 41; ++k) {
        root[3 * k] = (float)(-1.0 + 0.05 * (k % 41));
        root[3 * k + 1] = (float)(-1.0 + 0.05 * (k / 41));
    }
    CHECK(dp_plants_add(plants, kind, root, NULL, 41 * 41, &stand) == DP_OK);
    dp_free(root);
    return plants;
}

static double level(const void* context, double x, double y)
{
    (void)x, (void)y;
    return *(const double*)context;
}

static float crushed_at(const DpGrass* grass, double x, double y)
{
    float crushed = -1.0f;
    dp_grass_read(grass, (long)floor(x / CELL), (long)floor(y / CELL), 1, 1, NULL, NULL, &crushed);
    return crushed;
}

static DpPlantKind unworn(void)
{
    DpPlantKind kind = dp_plant_kind_default();
    kind.degrade_rate = 0.0f;
    return kind;
}

TEST(untouched_grass_takes_no_memory)
{
    const DpPlantKind   kind = unworn();
    const double        zero = 0.0;
    const DpPlantGround ground = {.cell = CELL, .at = level, .context = &zero};
    DpPlants*           plants = meadow(&kind);
    DpGrass*            grass;
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    const size_t before = dp_bytes_live();
    for (int k = 0; k < 10; ++k) CHECK(dp_grass_step(grass, &ground, NULL, 0, 0.1) == DP_OK);
    CHECK(dp_bytes_live() == before);
    const DpPlantCollider high = sole(bottom, CELL, 0.0, 0.0, 0.5, 0.28, 0.1, 0.0);
    CHECK(dp_grass_step(grass, &ground, &high, 1, 0.1) == DP_OK);
    CHECK(!(crushed_at(grass, 0.0, 0.0) > 0.0f));
    const DpPlantCollider away = sole(bottom, CELL, 50.0, 0.0, 0.0, 0.28, 0.1, 0.0);
    CHECK(dp_grass_step(grass, &ground, &away, 1, 0.1) == DP_OK);
    CHECK(!(crushed_at(grass, 50.0, 0.0) > 0.0f));  // nothing grows there
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

static void count_tile(void* context, long tx, long ty)
{
    (void)tx, (void)ty;
    ++*(int*)context;
}

TEST(it_rises_by_its_rate_and_then_costs_nothing)
{
    const DpPlantKind     kind = unworn();
    const double          zero = 0.0, dt = 1.0 / 60;
    const DpPlantGround   ground = {.cell = CELL, .at = level, .context = &zero};
    const DpPlantCollider foot = sole(bottom, CELL, 0.3, 0.3, 0.0, 0.28, 0.1, 0.0);
    DpPlants*             plants = meadow(&kind);
    DpGrass*              grass;
    int                   changed = 0;
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_grass_step(grass, &ground, &foot, 1, dt) == DP_OK);
    CHECK_NEAR(crushed_at(grass, 0.305, 0.305), 1.0, 1e-6);
    dp_grass_changed(grass, count_tile, &changed);
    CHECK(changed == 1);
    for (int k = 1; k <= 60; ++k) {
        CHECK(dp_grass_step(grass, &ground, NULL, 0, dt) == DP_OK);
        if (k % 20 == 0)
            CHECK_CLOSE(crushed_at(grass, 0.305, 0.305), exp(-0.5 * (double)kind.damping * k * dt),
                        1e-3);
    }
    for (int k = 0; k < 200; ++k) CHECK(dp_grass_step(grass, &ground, NULL, 0, dt) == DP_OK);
    float plane[3][SIDE * SIDE];
    dp_grass_read(grass, -64, -64, SIDE, SIDE, plane[0], plane[1], plane[2]);
    float most = 0.0f;
    for (int k = 0; k < 3 * SIDE * SIDE; ++k) most = fmaxf(most, fabsf(plane[k % 3][k / 3]));
    CHECK_NEAR(most, 0.0, 0.0);
    dp_grass_changed(grass, count_tile, &changed);
    changed = 0;
    CHECK(dp_grass_step(grass, &ground, NULL, 0, dt) == DP_OK);
    dp_grass_changed(grass, count_tile, &changed);
    CHECK(changed == 0);
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

TEST(broken_grass_stays_down)
{
    const DpPlantKind     kind = unworn();
    const DpPlantShape    shape = dp_plant_shape(&kind);
    const double          zero = 0.0;
    const DpPlantGround   ground = {.cell = CELL, .at = level, .context = &zero};
    const DpPlantCollider foot = sole(bottom, CELL, 0.0, 0.0, 0.0, 0.28, 0.1, 0.0);
    DpPlants*             plants = meadow(&kind);
    DpGrass*              grass;
    double*               strength = dp_alloc((size_t)shape.bends, sizeof(double));
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_grass_step(grass, &ground, &foot, 1, 0.01) == DP_OK);
    for (int b = 0; b < shape.bends; ++b)  // half of the stems, at their feet
        strength[b] = b / (shape.rows - 2) % 2 ? (double)kind.strength : 0.0;
    for (int k = 0; k < dp_plants_count(plants, 0); ++k)
        CHECK(dp_plants_write(plants, 0, k, NULL, NULL, strength) == DP_OK);
    CHECK(dp_grass_worn(grass, -1.0, -1.0, 1.0, 1.0) == DP_OK);
    for (int k = 0; k < 400; ++k) CHECK(dp_grass_step(grass, &ground, NULL, 0, 0.01) == DP_OK);
    CHECK_NEAR(crushed_at(grass, 0.0, 0.0), 0.5, 1e-3);
    CHECK_NEAR(crushed_at(grass, 0.5, 0.5), 0.0, 0.0);  // nobody pressed it there
    for (int b = 0; b < shape.bends; ++b) strength[b] = (double)kind.strength;
    for (int k = 0; k < dp_plants_count(plants, 0); ++k)
        CHECK(dp_plants_write(plants, 0, k, NULL, NULL, strength) == DP_OK);
    dp_grass_grown(grass, -1.0, -1.0, 1.0, 1.0);
    CHECK(dp_grass_step(grass, &ground, NULL, 0, 100.0) == DP_OK);
    CHECK_NEAR(crushed_at(grass, 0.0, 0.0), 0.0, 0.0);
    dp_free(strength);
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

// windows of any place and size show the same, over tiles and negative cells
TEST(windows_read_alike)
{
    const DpPlantKind     kind = unworn();
    const double          zero = 0.0;
    const DpPlantGround   ground = {.cell = CELL, .at = level, .context = &zero};
    const DpPlantCollider foot = sole(bottom, CELL, 0.0, 0.0, 0.02, 0.28, 0.1, 0.1);
    DpPlants*             plants = meadow(&kind);
    DpGrass*              grass;
    float                 all[SIDE * SIDE], part[23 * 17];
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_grass_step(grass, &ground, &foot, 1, 0.01) == DP_OK);
    dp_grass_read(grass, -64, -64, SIDE, SIDE, NULL, NULL, all);
    int bad = 0;
    for (int at = -40; at <= 20; at += 5) {
        dp_grass_read(grass, at, -at - 10, 23, 17, NULL, NULL, part);
        for (int k = 0; k < 23 * 17; ++k)
            bad += part[k] != all[(k / 23 - at - 10 + 64) * SIDE + k % 23 + at + 64];
    }
    CHECK(bad == 0);
    dp_grass_destroy(grass);
    dp_plants_destroy(plants);
}

TEST(bad_steps_are_refused_and_memory_may_end)
{
    const DpPlantKind     kind = unworn();
    const double          zero = 0.0;
    const DpPlantGround   ground = {.cell = CELL, .at = level, .context = &zero};
    const DpPlantCollider foot = sole(bottom, CELL, 0.0, 0.0, 0.0, 0.28, 0.1, 0.0);
    DpPlants*             plants = meadow(&kind);
    DpGrass*              grass = NULL;
    CHECK(dp_grass_create(&grass, NULL, (DpGrid){CELL, 0.0, 0.0}) == DP_BAD_ARGUMENT);
    CHECK(dp_grass_create(&grass, plants, (DpGrid){0.0, 0.0, 0.0}) == DP_BAD_ARGUMENT);
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, NAN, 0.0}) == DP_BAD_ARGUMENT);
    CHECK(dp_grass_create(&grass, plants, (DpGrid){CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_grass_step(grass, &ground, &foot, 1, 0.0) == DP_BAD_ARGUMENT);
    CHECK(dp_grass_step(grass, &ground, NULL, 1, 0.1) == DP_BAD_ARGUMENT);
    CHECK(dp_grass_worn(grass, 1.0, 0.0, 0.0, 0.0) == DP_BAD_ARGUMENT);
    for (long k = 0; k < 8; ++k) {
        dp_alloc_fail_after(k);
        const DpStatus status = dp_grass_step(grass, &ground, &foot, 1, 0.1);
        dp_alloc_fail_after(-1);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
        CHECK(k > 0 || status == DP_NO_MEMORY);
    }
    dp_grass_destroy(grass);
    dp_grass_destroy(NULL);
    dp_plants_destroy(plants);
}

int main(void)
{
    RUN(untouched_grass_takes_no_memory);
    RUN(it_rises_by_its_rate_and_then_costs_nothing);
    RUN(broken_grass_stays_down);
    RUN(windows_read_alike);
    RUN(bad_steps_are_refused_and_memory_may_end);
    return check_done();
}
