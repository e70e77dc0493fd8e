// plants/plant_lean_inside.h - what the files of the lean share.
#pragma once
#include "plants/plant_inside.h"

#define CELLS (DP_TILE * DP_TILE)

// cells of a tile: i0 <= i < i1, j0 <= j < j1; empty if i0 >= i1
typedef struct LeanBox
{
    int i0, i1, j0, j1;
} LeanBox;

typedef struct LeanTile
{
    long    tx, ty;
    bool    changed;
    LeanBox moves;  // what is not at rest
    LeanBox brisk;  // of it what is held or swings, or may: the others wait until they are due
    float   lean[2][CELLS], crushed[CELLS];
    float   most[CELLS];    // crushed when it was let go
    float   height[CELLS];  // of the stem, 0 = nothing grows [m]
    float   rate[CELLS];    // at which it swings up [1/s]
    float   heal[CELLS];    // at which it rises while its crushed is above `limp` [1/s]
    float   limp[CELLS];
    float   healing;       // the most of heal [1/s]
    double  waited;        // since slow stems rose [s]
    float   stays[CELLS];  // share of stems that is broken
    int32_t held[CELLS];   // the step in which something held it last
    int32_t under[CELLS];  // the step in which a sole lay on it last
} LeanTile;

// A window of the lean's cells around a sole; grids have a border of one cell.
typedef struct LeanPrint
{
    const DpPlantCollider* sole;
    long                   i0, j0;       // world cell of its cell (0, 0)
    int                    nx, ny;       // 0 = the sole meets no grass
    double                 motion[2];    // where the foot goes, shorter when slow
    int32_t *              across, *up;  // to the nearest cell of the other kind, sole or no sole
    float*                 bottom;       // +inf where there is no sole
    uint8_t*               under;        // is there a sole?
    size_t                 room;
} LeanPrint;

struct DpLean
{
    const DpPlants* plants;
    double          cell, origin[2];
    int32_t         step;
    LeanTile**      tile;  // ascending (ty, tx)
    int             tiles, room;
    LeanPrint*      print;  // of soles, in their order (print_room)
    int             prints, print_room;
};

static inline double lean_centre(const DpLean* lean, int axis, long cell)
{
    return lean->origin[axis] + ((double)cell + 0.5) * lean->cell;
}

static inline long lean_cell(const DpLean* lean, int axis, double at)
{
    return (long)floor((at - lean->origin[axis]) / lean->cell);
}

static inline long lean_tile(long cell)
{
    return cell >= 0 ? cell / DP_TILE : -((-cell - 1) / DP_TILE) - 1;
}

// a tile, made if nobody touched it yet; NULL without memory
LeanTile* dp_lean_touch(DpLean* lean, long tx, long ty);
// a cell of a tile is not at rest
void dp_lean_may_move(LeanTile* tile, int i, int j);
// How the whole stems of a cell lie; those that are broken lie by themselves.
typedef struct LeanStem
{
    double down;     // share of height that is lost; 0 = it stands
    double lean[2];  // which way
    bool   pressed;  // a sole lies on it
} LeanStem;
LeanStem dp_lean_stem_at(const DpLean* lean, double x, double y);
// plant_part.c: where a sole can meet grass; what it covers; then the grass under and beside it
LeanPrint dp_lean_window(const DpLean* lean, const DpPlantCollider* sole);
DpStatus  dp_lean_look_at(const DpLean* lean, LeanPrint* print, const DpPlantGround* ground,
                          const DpPlantCollider* sole);
DpStatus  dp_lean_press_print(DpLean* lean, const LeanPrint* print, const DpPlantGround* ground);
void      dp_lean_drop_print(LeanPrint* print);
