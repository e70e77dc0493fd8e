// soil/soil_defaults.c - one kind of ground to start from, its ranges, and scratch memory.
#include "base/alloc.h"
#include "soil/soil_inside.h"

DpSoil dp_soil_default(void)
{
    const DpSoil soil = {
        .layer_depth = 0.30f,      // TRAIL 4.2: a loose layer of 30 cm
        .young_modulus = 0.75e6f,  // between soil and mud, SOFT22 Table 1
        .poisson_ratio = 0.35f,    // the same table
        .settle_time = 0.05f,      // the same table
        .rest_angle = 0.5585054f,  // 32 degrees, dry sand
        .push_threshold = 0.0f,    // half the walker's weight
        .shear_modulus = 0.0f,     // soles do not slip
    };
    return soil;
}

static bool in_range(float value, float low, float high)
{
    return value >= low && value <= high;  // false for NaN
}

DpStatus dp_soil_check(const DpSoil* soil)
{
    const float tiny = 1e-6f;
    if (!soil) return DP_BAD_ARGUMENT;
    const bool good =
        in_range(soil->layer_depth, tiny, 1e3f) && in_range(soil->young_modulus, tiny, 1e15f) &&
        in_range(soil->poisson_ratio, 0.0f, 0.5f) && in_range(soil->settle_time, tiny, 1e6f) &&
        in_range(soil->rest_angle, 1e-4f, 1.5533430f) &&  // 89 degrees
        in_range(soil->push_threshold, 0.0f, 1e15f) && in_range(soil->shear_modulus, 0.0f, 0.1f);
    return good ? DP_OK : DP_BAD_ARGUMENT;
}

DpSoilScratch* dp_soil_scratch_create(void)
{
    return dp_alloc(1, sizeof(DpSoilScratch));
}

void dp_soil_scratch_destroy(DpSoilScratch* scratch)
{
    if (!scratch) return;
    dp_free(scratch->block);
    dp_free(scratch);
}

void* dp_soil_scratch_block(DpSoilScratch* scratch, size_t bytes)
{
    if (scratch->bytes >= bytes) return scratch->block;
    void* block = dp_alloc(bytes + bytes / 2, 1);
    if (!block) return NULL;
    dp_free(scratch->block);
    scratch->block = block;
    scratch->bytes = bytes + bytes / 2;
    return block;
}
