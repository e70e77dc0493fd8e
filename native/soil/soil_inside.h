// soil/soil_inside.h - what the files of this room share; not a door.
#pragma once
#include <math.h>
#include <stddef.h>

#include "soil/soil.h"

#define SOIL_RIGID 0.95  // share of L0 that can be pressed; rigid ground below

#define SPRING_ROUGH 1.6  // how much the share that comes back differs, by the soil's roughness
#define MAX_SPRING 0.9    // of the depth comes back at most

// soil_rebound.c, of a patch that has springs: a cell was pressed from compression `before` [m] to what it is now, and how
// much of that had come back before [m]; the share of its depth that comes back; `fell` [m] of it have fallen from a wall.
double dp_soil_spring_press(DpSoilPatch* patch, size_t p, double before);
double dp_soil_spring_share(const DpSoilPatch* patch, size_t p);
void   dp_soil_spring_fell(DpSoilPatch* patch, size_t p, double fell);

struct DpSoilScratch
{
    void* block;
};

// At least `bytes` of 64-byte aligned memory, contents undefined; NULL when there is none.
void* dp_soil_scratch_block(DpSoilScratch* scratch, size_t bytes);

// Sums that do not depend on the order of their terms: every term is first put on a grid of powers
// of two, so that adding is exact. Mirrored ground then gives the same bits as the ground itself.
// @param grid  from soil_grid(): 1.5 * 2^52 steps of the grid
static inline double soil_on_grid(double x, double grid)
{
    return (x + grid) - grid;
}

// A grid on which terms up to `largest` keep 32 bits, and 2^21 of them can be added exactly.
static inline double soil_grid(double largest)
{
    int exponent = 0;
    (void)frexp(largest > 1e-200 ? largest : 1e-200, &exponent);
    return ldexp(1.5, 52 + exponent - 32);
}

// Smaller and larger of two numbers, neither of them NaN; one instruction, where fmin is a call.
static inline double soil_min(double a, double b)
{
    return a < b ? a : b;
}

static inline double soil_max(double a, double b)
{
    return a > b ? a : b;
}

static inline bool soil_is_ground(float base_height)
{
    return base_height == base_height;
}

// a grid the kernels can work with
static inline bool soil_patch_ok(const DpSoilPatch* patch)
{
    return patch && patch->nx > 0 && patch->ny > 0 && patch->row >= patch->nx &&
           patch->cell > 0.0 && isfinite(patch->cell) && patch->base_height && patch->compression &&
           patch->heap && patch->modulus && patch->rest_slope && patch->kind && patch->soils &&
           patch->soil_count > 0;
}

// a rectangle of the patch's cells, `by` cells wider on every side where the patch goes on
static inline DpCellRect soil_grown(DpCellRect rect, long by, const DpSoilPatch* patch)
{
    return dp_cells_common(dp_cells_grown(rect, by), dp_cells(0, 0, patch->nx, patch->ny));
}

static inline size_t soil_at(const DpSoilPatch* patch, long i, long j)
{
    return (size_t)j * (size_t)patch->row + (size_t)i;
}

// Does what slides in the middle of a patch take its time? MODEL 6.4
static inline bool soil_takes_time(const DpSoilPatch* patch)
{
    const size_t middle = soil_at(patch, patch->nx / 2, patch->ny / 2);
    return patch->soils[patch->kind[middle]].flow_time > 0.0f;
}
