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

// soil_crust.c: whether the crust carries the load; then the cells on which the sole stands count as pressed. And
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

// targets of several cells, none of them twice
typedef struct Targets
{
    double depth[LANES], stress[LANES], share[LANES];  // as above
    size_t cell[LANES];                                // where in the patch
    int    count;
} Targets;
void dp_press_cells(DpSoilPatch* patch, const Targets* targets, double dt, DpPressed* pressed);

// a cell's target after those there are
static inline void add_target(Targets* targets, size_t cell, Target target)
{
    const int k = targets->count++;
    targets->depth[k] = target.depth, targets->stress[k] = target.stress;
    targets->share[k] = target.share, targets->cell[k] = cell;
}

// soil_cut.c: take loose and firm soil [m] off a column, a share `cut` of it as by a blade, the rest pressed; sums are in
// [m] of columns
typedef struct Cut
{
    double firm, loose;                                      // cut
    double firm_pressed, loose_pressed, elastic, displaced;  // DpPressed has what they are
} Cut;
Cut dp_cut_cell(DpSoilPatch* patch, size_t p, double loose, double firm, double cut);

// soil_plough.c: a law goes twice over what it presses if the sole slides: first it tells the target of each cell, and what is
// in the way is cut; then it presses.
typedef enum Turn
{
    TELLS,
    PRESSES
} Turn;
Turn dp_plough_begin(const DpSoilPatch* patch, DpImprint* imprint);
void dp_plough_press(DpSoilPatch* patch, DpImprint* imprint, const Targets* targets, Turn turn,
                     double dt, DpPressed* pressed);
void dp_plough(DpSoilPatch* patch, const DpImprint* imprint, DpPressed* pressed);

// Begin with a sole: the ground as it would go on where there is none, level with the plane of `normal`.
void dp_columns_begin(Sole* sole, const DpSoilPatch* patch, const DpImprint* imprint,
                      DpVec3 normal);

// Hand the columns out from the first one on.
void dp_columns_rewind(Sole* sole);

// Have the next columns at hand in chunk[0] .. chunk[filled - 1]; false when all have been handed out since
// the last rewind.
bool dp_columns_next(Sole* sole);
