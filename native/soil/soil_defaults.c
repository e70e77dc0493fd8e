// soil/soil_defaults.c - one kind of ground to start from, its ranges, and scratch memory.
#include "base/alloc.h"
#include "soil/soil_inside.h"

#define NUMBER(...) DP_NUMBER_ROW(DpSoil, __VA_ARGS__)
static const DpNumber numbers[] = {DP_SOIL_NUMBERS(NUMBER)};
#define COUNT ((int)(sizeof numbers / sizeof *numbers))

const DpNumber* dp_soil_numbers(int* count)
{
    *count = COUNT;
    return numbers;
}

DpSoil dp_soil_default(void)
{
    DpSoil soil;
    dp_numbers_usual(&soil, numbers, COUNT);
    return soil;
}

DpStatus dp_soil_check(const DpSoil* soil, DpReason* reason)
{
    if (soil) return dp_numbers_check(soil, numbers, COUNT, reason);
    dp_reason(reason, "there is no soil");
    return DP_BAD_ARGUMENT;
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
    return dp_make_room(&scratch->block, bytes, 1) ? scratch->block : NULL;
}
