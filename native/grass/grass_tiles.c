// grass/grass_tiles.c - where the grass keeps its cells, and what grows on them.
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "grass/grass_inside.h"

#define GRIDS 11  // of a tile

GrassTile* dp_grass_tile_create(long tx, long ty)
{
    GrassTile* tile = dp_alloc(1, sizeof *tile);
    float*     cell = dp_alloc(GRIDS * CELLS, sizeof *cell);
    if (!tile || !cell) {
        dp_free(tile), dp_free(cell);
        return NULL;
    }
    *tile = (GrassTile){.tx = tx, .ty = ty, .lean = {cell, cell + CELLS}};
    float** const grid[] = {&tile->crushed, &tile->deepest, &tile->height, &tile->rate,
                            &tile->heal,    &tile->limp,    &tile->stays};
    cell += 2 * CELLS;
    for (size_t g = 0; g < sizeof grid / sizeof *grid; ++g, cell += CELLS) *grid[g] = cell;
    tile->held = (int32_t*)(void*)cell;
    tile->under = tile->held + CELLS;
    return tile;
}

void dp_grass_tile_destroy(GrassTile* tile)
{
    if (!tile) return;
    dp_free(tile->lean[0]);
    dp_free(tile);
}

// where a tile is in the list, or where it belongs
static int place_of(const DpGrass* grass, long tx, long ty)
{
    int low = 0, high = grass->tiles;
    while (low < high) {
        const int        mid = (low + high) / 2;
        const GrassTile* at = grass->tile[mid];
        if (at->ty < ty || (at->ty == ty && at->tx < tx))
            low = mid + 1;
        else
            high = mid;
    }
    return low;
}

GrassTile* dp_grass_find(const DpGrass* grass, long tx, long ty)
{
    const int  at = place_of(grass, tx, ty);
    const bool there = at < grass->tiles && grass->tile[at]->tx == tx && grass->tile[at]->ty == ty;
    if (there) dp_memory_ease(GRIDS * CELLS * sizeof(float));
    return there ? grass->tile[at] : NULL;
}

// what grows on cells i0 <= i < i1, j0 <= j < j1 of a tile; its stems' size only the first time
void dp_grass_grow(const DpGrass* grass, GrassTile* tile, int i0, int i1, int j0, int j1,
                   bool first)
{
    const DpPlantWindow  window = {i1 - i0,
                                   j1 - j0,
                                   DP_TILE,
                                   grass->grid.cell,
                                   dp_grid_x(&grass->grid, tile->tx * DP_TILE + i0),
                                   dp_grid_y(&grass->grid, tile->ty * DP_TILE + j0)};
    const int            at = j0 * DP_TILE + i0;
    const DpPlantStature stature = {first ? tile->height + at : NULL, tile->rate + at,
                                    tile->heal + at, tile->limp + at, tile->stays + at};
    dp_plants_stature(grass->plants, &window, &stature);
    for (size_t p = 0; first && p < CELLS; ++p) tile->healing = fmaxf(tile->healing, tile->heal[p]);
}

GrassTile* dp_grass_touch(DpGrass* grass, long tx, long ty)
{
    GrassTile* tile = dp_grass_find(grass, tx, ty);
    if (tile) return tile;
    if (!dp_make_room(&grass->tile, (size_t)grass->tiles + 1, sizeof *grass->tile)) return NULL;
    tile = dp_grass_tile_create(tx, ty);
    if (!tile) return NULL;
    dp_grass_grow(grass, tile, 0, DP_TILE, 0, DP_TILE, true);
    const int at = place_of(grass, tx, ty);
    memmove(grass->tile + at + 1, grass->tile + at,
            (size_t)(grass->tiles - at) * sizeof *grass->tile);
    grass->tile[at] = tile;
    ++grass->tiles;
    return tile;
}

void dp_grass_may_move(GrassTile* tile, int i, int j)
{
    tile->moves = dp_cells_with(tile->moves, i, j);
    tile->brisk = dp_cells_with(tile->brisk, i, j);
}
