// soil/soil_columns.h - the ground under a sole, column by column.
#pragma once
#include "soil/soil_inside.h"

#define LANES 32   // columns worked on at once
#define CHUNKS 40  // .. that are kept ready: a sole of up to 1280 cells is read only once
#define NOWHERE SIZE_MAX

// Columns of ground under the sole, and of what would be ground; lanes that hold none have share and spring 0.
// They begin on a cache line: read across lines, a sole takes a quarter longer to balance.
typedef struct Columns
{
    _Alignas(64) double gap[LANES];  // g = h0 - underside of the sole, before it sinks     [m]
    double pressed[LANES];           // e = compression - heap as the sole met them         [m]
    double rigid[LANES];             // 0.95 L0                                             [m]
    double share[LANES];             // a                                                   [-]
    double spring[LANES];            // a E/L0 cell^2                                       [N/m]
    size_t cell[LANES];              // where in the patch; NOWHERE = beyond the ground
    int    count;                    // lanes in use
} Columns;

// The ground under a sole as it would go on where there is none: the mean of what there is, level with it.
typedef struct Beyond
{
    double base_height, met;  // at (i, j) [m]
    double i, j;              // [cells]
    double slope_i, slope_j;  // [m per cell]
    double stiffness, depth;  // E/L0 [Pa/m], L0 [m]
    bool   is_there;          // some of the sole has ground
} Beyond;

// The columns of a sole, as many at a time as there is room for.
typedef struct Sole
{
    const DpSoilPatch* patch;
    const DpImprint*   imprint;
    Beyond             beyond;
    int                i, j;      // where to read on
    int                filled;    // chunks that hold columns
    bool               complete;  // all of the sole is held: no need to read again
    bool               shown;     // .. and was handed out in this round
    Columns            chunk[CHUNKS];
} Sole;

// soil_crust.c: whether the crust carries the load; then the cells on which the sole stands are told as pressed. And
// what the sole has broken tilts into its print.
bool dp_crust_carries(DpSoilPatch* patch, DpImprint* imprint, Sole* sole, double load, double dt,
                      DpPressed* pressed);
void dp_crust_tilt(DpSoilPatch* patch, const DpImprint* imprint, DpPressed* pressed);

// soil_press.c: the target of one cell and the stress on it; lower it towards that for dt seconds, SOFT22 (11)
typedef struct Target
{
    double depth;   // t, below h0 under the sole [m]
    double stress;  // sigma [Pa]
    double share;   // a [-]
} Target;
void dp_press_cell(DpSoilPatch* patch, size_t p, Target target, double dt, DpPressed* pressed);

// Begin with a sole: the ground as it would go on where there is none, level with the plane of `normal`.
void dp_columns_begin(Sole* sole, const DpSoilPatch* patch, const DpImprint* imprint,
                      DpVec3 normal);

// Hand the columns out from the first one on.
void dp_columns_rewind(Sole* sole);

// Have the next columns at hand in chunk[0] .. chunk[filled - 1]; false when all have been handed out since
// the last rewind.
bool dp_columns_next(Sole* sole);
