// tests/native/grass/bed.h - a bed of plants with grass between them, shown, and a boot that goes over
// it; what it has become as a stream.
#pragma once
#include "grass/grass.h"
#include "plants/lawn.h"

#define BED_SIDE 9
#define BED_CELL 0.01

typedef struct Bed
{
    DpPlants*       plants;
    DpGrass*        grass;
    DpPlantDisplay* display;
} Bed;

static inline DpStemLean bed_lean(const void* grass, double x, double y)
{
    return dp_grass_stem_at(grass, x, y);
}

static inline Bed bed_create(void)
{
    Bed         bed = {dp_plants_create(4), NULL, NULL};
    DpPlantKind kind = dp_plant_kind_default();
    kind.strength = 0.03f, kind.recover_rate = 0.001f;
    for (int s = 0; s < 2; ++s) {
        float root[3 * BED_SIDE * BED_SIDE] = {0};
        int   stand;
        for (int k = 0; k < BED_SIDE * BED_SIDE; ++k) {
            root[3 * k] = 0.1f * (float)(k % BED_SIDE) + 0.05f * (float)s;
            root[3 * k + 1] = 0.1f * (float)(k / BED_SIDE);
        }
        CHECK(dp_plants_add(bed.plants, &kind, root, NULL, BED_SIDE * BED_SIDE, &stand) == DP_OK);
        kind.form = DP_PLANT_TUFT, kind.height = 0.15f;
    }
    CHECK(dp_grass_create(&bed.grass, bed.plants, (DpGrid){BED_CELL, 0.0, 0.0}) == DP_OK);
    CHECK(dp_plant_display_create(&bed.display, bed.plants, bed_lean, bed.grass) == DP_OK);
    return bed;
}

static inline void bed_destroy(Bed* bed)
{
    dp_plant_display_destroy(bed->display);
    dp_grass_destroy(bed->grass);
    dp_plants_destroy(bed->plants);
}

static inline double bed_level(const void* context, double x, double y)
{
    (void)context, (void)x, (void)y;
    return 0.0;
}

// frames from..to - 1: the boot treads every other second, and goes on in between
static inline void bed_walk(Bed* bed, int from, int to)
{
    static float        bottom[SOLE_SIDE * SOLE_SIDE];
    const double        dt = 1.0 / 30;
    const DpPlantGround ground = {.cell = BED_CELL, .at = bed_level};
    for (int k = from; k < to; ++k) {
        const double    x = 0.4 + 0.3 * sin(0.2 * k), y = 0.4 + 0.3 * sin(0.07 * k);
        DpPlantCollider foot = sole(bottom, BED_CELL, x, y, 0.01, 0.24, 0.1, 0.05);
        DpPlantsReport  report;
        const int       feet = k % 20 < 10;
        foot.velocity = dp_vec3(0.3 * 0.2 * 30 * cos(0.2 * k), 0.0, 0.0);
        CHECK(dp_plants_step(bed->plants, &ground, &foot, feet, dt, 1, &report) == DP_OK);
        CHECK(dp_grass_step(bed->grass, &ground, &foot, feet, dt) == DP_OK);
        for (int n = 0; n < report.changes; ++n) {
            const DpPlantBox box = report.box[n];
            CHECK(dp_grass_worn(bed->grass, box.x0, box.y0, box.x1, box.y1) == DP_OK);
        }
        CHECK(dp_plant_display_step(bed->display) == DP_OK);
    }
}

static inline DpStateWriter bed_save(const Bed* bed)
{
    DpStateWriter writer = {0};
    dp_plants_save(bed->plants, &writer);
    dp_grass_save(bed->grass, &writer);
    dp_plant_display_save(bed->display, &writer);
    return writer;
}

// all or nothing
static inline DpStatus bed_load(Bed* bed, const void* bytes, size_t size)
{
    DpStateReader        reader = dp_read_open(bytes, size);
    DpPlantsState*       plants = NULL;
    DpGrassState*        grass = NULL;
    DpPlantDisplayState* display = NULL;
    DpStatus             status = dp_plants_load(bed->plants, &reader, &plants);
    if (status == DP_OK) status = dp_grass_load(bed->grass, &reader, &grass);
    if (status == DP_OK) status = dp_plant_display_load(bed->display, &reader, &display);
    if (status == DP_OK) {
        dp_plants_restore(bed->plants, plants);
        dp_grass_restore(bed->grass, grass);
        dp_plant_display_restore(bed->display, display);
        return DP_OK;
    }
    dp_plants_state_destroy(plants);
    dp_grass_state_destroy(grass);
    dp_plant_display_state_destroy(display);
    return status;
}
