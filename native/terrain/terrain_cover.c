// Planted ground: what grows on a tile. Cover is asked for, never worked out here: who plants the
// ground knows its plants.
#include "terrain/terrain_inside.h"

DpStatus dp_terrain_set_cover(DpTerrain* terrain, DpTerrainCover cover, const void* context)
{
    if (!terrain || terrain->tiles > 0) return DP_BAD_ARGUMENT;
    terrain->cover = cover;
    terrain->cover_context = context;
    return DP_OK;
}

// a part of a tile, anew
static void replant(DpTerrain* terrain, Tile* tile, const TilePart* part)
{
    float      fresh[2 * TILE_CELLS];
    const long i0 = tile->tx * DP_TILE + (long)(part->in_tile % DP_TILE);
    const long j0 = tile->ty * DP_TILE + (long)(part->in_tile / DP_TILE);
    float*     roots = fresh + part->nx * part->ny;
    bool       differs = false;
    terrain->cover(terrain->cover_context, dp_grid_x(&terrain->grid, i0),
                   dp_grid_y(&terrain->grid, j0), terrain->grid.cell, part->nx, part->ny, fresh,
                   roots);
    for (int j = 0; j < part->ny; ++j)
        for (int i = 0; i < part->nx; ++i) {
            const int    from = j * part->nx + i;
            const size_t to = part->in_tile + (size_t)j * DP_TILE + (size_t)i;
            differs = differs || fresh[from] < tile->plant[to] || fresh[from] > tile->plant[to];
            tile->plant[to] = fresh[from];
            tile->plant[TILE_CELLS + to] = roots[from];
        }
    if (differs) dp_tile_mark(terrain, tile);
}

void dp_terrain_refresh_cover(DpTerrain* terrain, DpCellRect cells)
{
    if (!terrain->cover || !are_cells(cells)) return;
    for (size_t t = 0; t < terrain->tiles; ++t) {
        Tile* tile = terrain->sorted[t];
        if (!dp_cells_meet(cells,
                           dp_cells(tile->tx * DP_TILE, tile->ty * DP_TILE, DP_TILE, DP_TILE)))
            continue;
        const TilePart part = dp_tile_part(tile->tx, tile->ty, cells);
        replant(terrain, tile, &part);
    }
}
