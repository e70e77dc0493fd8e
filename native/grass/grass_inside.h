// grass/grass_inside.h - what the files of this room share.
#pragma once
#include "base/grid.h"
#include "base/vec.h"
#include "grass/grass.h"

#define CELLS (DP_TILE * DP_TILE)

// A tile, and of its cells where they lie (CELLS each): these may have left memory (base/memory.h), it itself does not.
typedef struct GrassTile
{
    long       tx, ty;
    bool       changed;
    DpCellRect moves;  // what is not at rest
    DpCellRect brisk;  // of it what is held or swings, or may: the others wait until they are due
    float *    lean[2], *crushed;
    float*     deepest;  // crushed when it was let go
    float*     height;   // of the stem, 0 = nothing grows [m]
    float*     rate;     // at which it swings up [1/s]
    float*     heal;     // at which it rises while its crushed is above `limp` [1/s]
    float*     limp;
    float      healing;  // largest of heal [1/s]
    double     waited;   // since slow stems rose [s]
    float*     stays;    // share of stems that is broken
    int32_t*   held;     // the step in which something held it last
    int32_t*   under;    // the step in which a sole lay on it last
} GrassTile;

// A window of the grass's cells around a sole; grids have a border of one cell.
typedef struct GrassPrint
{
    const DpPlantCollider* sole;
    long                   i0, j0;       // world cell of its cell (0, 0)
    int                    nx, ny;       // 0 = the sole meets no grass
    double                 motion[2];    // where the foot goes, shorter when slow
    int32_t *              across, *up;  // to the nearest cell of the other kind, sole or no sole
    float*                 bottom;       // +inf where there is no sole
    uint8_t*               under;        // is there a sole?
} GrassPrint;

struct DpGrass
{
    const DpPlants* plants;
    DpGrid          grid;
    int32_t         step;
    GrassTile**     tile;  // ascending (ty, tx)
    int             tiles;
    GrassPrint*     print;  // of soles, in their order (print_room)
    int             prints, print_room;
};

// ---- grass_tiles.c

// a tile on which nothing grows yet, in no list; NULL without memory
GrassTile* dp_grass_tile_create(long tx, long ty);
void       dp_grass_tile_destroy(GrassTile* tile);  // NULL is fine
// a tile; NULL if nobody touched it
GrassTile* dp_grass_find(const DpGrass* grass, long tx, long ty);
// a tile, created if nobody touched it yet; NULL without memory
GrassTile* dp_grass_touch(DpGrass* grass, long tx, long ty);
// what grows on cells i0 <= i < i1, j0 <= j < j1 of a tile; its stems' size only the first time
void dp_grass_grow(const DpGrass* grass, GrassTile* tile, int i0, int i1, int j0, int j1,
                   bool first);
// a cell of a tile is not at rest
void dp_grass_may_move(GrassTile* tile, int i, int j);

// ---- grass_press.c: where a sole can meet grass; what it covers; then the grass under and beside it

GrassPrint dp_grass_window(const DpGrass* grass, const DpPlantCollider* sole);
DpStatus   dp_grass_look_at(const DpGrass* grass, GrassPrint* print, const DpPlantGround* ground,
                            const DpPlantCollider* sole);
DpStatus   dp_grass_press(DpGrass* grass, const GrassPrint* print, const DpPlantGround* ground);
void       dp_grass_print_drop(GrassPrint* print);
