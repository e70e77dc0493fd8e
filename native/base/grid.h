// base/grid.h - cells of the ground: where they lie, rectangles of them, and the tiles that hold them.
#pragma once
#include <math.h>

#include "base/types.h"

// Square cells without end: cell (i, j) has its centre at (x0 + (i + 0.5) cell, y0 + (j + 0.5) cell).
typedef struct DpGrid
{
    double cell;    // side of a cell          [m] > 0
    double x0, y0;  // corner of cell (0, 0)   [m]
} DpGrid;

// Cells i0 <= i < i1, j0 <= j < j1; empty if i0 >= i1 or j0 >= j1.
typedef struct DpCellRect
{
    long i0, i1, j0, j1;
} DpCellRect;

// The middle of a column and of a row of cells [m].
static inline double dp_grid_x(const DpGrid* grid, long i)
{
    return grid->x0 + ((double)i + 0.5) * grid->cell;
}

static inline double dp_grid_y(const DpGrid* grid, long j)
{
    return grid->y0 + ((double)j + 0.5) * grid->cell;
}

// The column and the row a place lies in.
static inline long dp_grid_i(const DpGrid* grid, double x)
{
    return (long)floor((x - grid->x0) / grid->cell);
}

static inline long dp_grid_j(const DpGrid* grid, double y)
{
    return (long)floor((y - grid->y0) / grid->cell);
}

// Which tile holds a column or a row of cells.
static inline long dp_tile_of(long cell)
{
    return cell >= 0 ? cell / DP_TILE : -((-cell - 1) / DP_TILE) - 1;
}

// ---- rectangles -------------------------------------------------------------------------------

// nx x ny cells from cell (i0, j0) on
static inline DpCellRect dp_cells(long i0, long j0, long nx, long ny)
{
    const DpCellRect rect = {i0, i0 + nx, j0, j0 + ny};
    return rect;
}

static inline bool dp_cells_empty(DpCellRect rect)
{
    return rect.i0 >= rect.i1 || rect.j0 >= rect.j1;
}

// the smallest rectangle that holds both
static inline DpCellRect dp_cells_join(DpCellRect a, DpCellRect b)
{
    if (dp_cells_empty(a)) return b;
    if (dp_cells_empty(b)) return a;
    const DpCellRect both = {a.i0 < b.i0 ? a.i0 : b.i0, a.i1 > b.i1 ? a.i1 : b.i1,
                             a.j0 < b.j0 ? a.j0 : b.j0, a.j1 > b.j1 ? a.j1 : b.j1};
    return both;
}

// the cells both have
static inline DpCellRect dp_cells_common(DpCellRect a, DpCellRect b)
{
    const DpCellRect both = {a.i0 > b.i0 ? a.i0 : b.i0, a.i1 < b.i1 ? a.i1 : b.i1,
                             a.j0 > b.j0 ? a.j0 : b.j0, a.j1 < b.j1 ? a.j1 : b.j1};
    return both;
}

static inline bool dp_cells_meet(DpCellRect a, DpCellRect b)
{
    return a.i0 < b.i1 && b.i0 < a.i1 && a.j0 < b.j1 && b.j0 < a.j1;
}

static inline bool dp_cells_hold(DpCellRect outer, DpCellRect inner)
{
    return inner.i0 >= outer.i0 && inner.i1 <= outer.i1 && inner.j0 >= outer.j0 &&
           inner.j1 <= outer.j1;
}

// `by` cells more on every side
static inline DpCellRect dp_cells_grown(DpCellRect rect, long by)
{
    const DpCellRect more = {rect.i0 - by, rect.i1 + by, rect.j0 - by, rect.j1 + by};
    return more;
}

// a rectangle that holds a cell, too
static inline DpCellRect dp_cells_with(DpCellRect rect, long i, long j)
{
    return dp_cells_join(rect, dp_cells(i, j, 1, 1));
}
