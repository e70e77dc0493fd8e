// paths/paths.h - where walkers go: how long it takes from each place to a goal, and the path there. MODEL 12
//
//   cost of each cell, goals ---arrival---> times ---direction---> where down is
//                                             |
//                              pull of what is worn ---descend---> one walker's path to the goal
//
// Cell (i, j) has its centre at ((i + 0.5) cell, (j + 0.5) cell). Times are in units of cost times metres: where a
// metre costs 1, they are metres. Results are the same bits for mirrored and turned fields.
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

#define DP_MAX_COST 1e20f  // of a metre; the least is 1 / DP_MAX_COST

// A grid of numbers, row by row.
typedef struct DpPathField
{
    int          nx, ny;  // >= 1, and (nx + 8) (ny + 8) < 2^31
    double       cell;    // side of a cell                                [m]   1e-6..1e6
    const float* value;   // costs: of a metre, or +inf or NaN for an obstacle;
                          // times: of an arrival, +inf where there is none  (ny, nx)
} DpPathField;

// Where walkers go to.
typedef struct DpGoals
{
    int            count;  // >= 1
    const int32_t* cell;   // index j nx + i of each                       (count)
    const float*
        start;  // time there, 0..1e30, which holds but where another goal is nearer by a cell; NULL: 0 (count)
} DpGoals;

// The time at which a wave that starts at the goals arrives at each cell: |grad T| = cost. MODEL 12.1
// @param time  (ny, nx), +inf in obstacles and where no path leads
// DP_BAD_ARGUMENT: a size, a goal outside or in an obstacle, a start or a cost out of range.
// On failure `time` stays as it is.
DpStatus dp_paths_arrival(float* time, const DpPathField* cost, const DpGoals* goals);

// Where times fall steepest: unit vectors, 0 in obstacles, where no path leads and where it falls nowhere. MODEL 12.2
// @param direction  (ny, nx, 2) [-]
// DP_BAD_ARGUMENT: a size.
DpStatus dp_paths_direction(float* direction, const DpPathField* time);

// A path from a place to the goal. Zero it before; dp_free gives its points back.
typedef struct DpPath
{
    double* point;  // [m] (count, 2)
    int     count;
} DpPath;

// How a walker strays: nobody turns at once, or goes quite where it means to. MODEL 12.5
typedef struct DpStray
{
    double inertia;  // over which length a heading is kept          [m]   0 = not at all
    const float*
        turn;  // how far each step errs, to the left; again from the first when they end [rad] (count)
    int count;  // 0 = no step errs
} DpStray;

// Go from a place, step by step, along the direction plus the pull, until a cell is reached from which times do not fall.
// MODEL 12.3
// @param pull  what is added to the unit direction, shorter than 1 everywhere; NULL: nothing   [-] (ny, nx, 2)
// @param x, y  where it begins                                                                  [m]
// @param step  length of a step, more than cell / 100 and at most a cell                        [m]
// @param stray NULL: not at all
// DP_BAD_ARGUMENT: a size, a step, an inertia. DP_NO_GROUND: it begins outside, in an obstacle or where no path leads.
// On failure `path` stays empty.
DpStatus dp_paths_descend(DpPath* path, const DpPathField* time, const float* pull, double x,
                          double y, double step, const DpStray* stray);
