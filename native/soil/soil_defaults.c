// soil/soil_defaults.c - one kind of ground to start from, its ranges, and scratch memory.
#include "base/alloc.h"
#include "soil/soil_inside.h"

#define NUMBER(name, unit, lowest, highest, normal, meaning) \
    {#name, unit, lowest, highest, normal, meaning, offsetof(DpSoil, name)},
static const DpSoilNumber numbers[] = {DP_SOIL_NUMBERS(NUMBER)};

const DpSoilNumber* dp_soil_numbers(int* count)
{
    *count = (int)(sizeof numbers / sizeof *numbers);
    return numbers;
}

#define DEFAULT(name, unit, lowest, highest, normal, meaning) .name = (float)(normal),

DpSoil dp_soil_default(void)
{
    const DpSoil soil = {DP_SOIL_NUMBERS(DEFAULT)};
    return soil;
}

static bool in_range(float value, double lowest, double highest)
{
    return value >= (float)lowest && value <= (float)highest;  // false for NaN
}

#define IN_RANGE(name, unit, lowest, highest, normal, meaning) \
    &&in_range(soil->name, lowest, highest)

DpStatus dp_soil_check(const DpSoil* soil)
{
    return soil DP_SOIL_NUMBERS(IN_RANGE) ? DP_OK : DP_BAD_ARGUMENT;
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
