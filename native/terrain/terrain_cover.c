// Planted ground: what grows on a tile, and the surface plants stand on. Cover is asked for, never
// worked out here: who plants the ground knows its plants.
#include <math.h>
#include <string.h>

#include "terrain/terrain_inside.h"

DpStatus dp_terrain_set_cover(DpTerrain* terrain, DpTerrainCover cover, const void* context)
{
    if (!terrain || terrain->tiles > 0) return DP_BAD_ARGUMENT;
    terrain->cover = cover;
    terrain->cover_context = context;
    return DP_OK;
}

void dp_tile_cover(const DpTerrain* terrain, long tx, long ty, float* plant)
{
    const double x0 = cell_at(terrain->origin_x, terrain->cell, tx * DP_TILE);
    const double y0 = cell_at(terrain->origin_y, terrain->cell, ty * DP_TILE);
    terrain->cover(terrain->cover_context, x0, y0, terrain->cell, DP_TILE, DP_TILE, plant,
                   plant + TILE_CELLS);
}

// a part of a tile, anew
static void replant(DpTerrain* terrain, Tile* tile, const TilePart* part)
{
    float      fresh[2 * TILE_CELLS];
    const long i0 = tile->tx * DP_TILE + (long)(part->in_tile % DP_TILE);
    const long j0 = tile->ty * DP_TILE + (long)(part->in_tile / DP_TILE);
    float*     roots = fresh + part->nx * part->ny;
    bool       differs = false;
    terrain->cover(terrain->cover_context, cell_at(terrain->origin_x, terrain->cell, i0),
                   cell_at(terrain->origin_y, terrain->cell, j0), terrain->cell, part->nx, part->ny,
                   fresh, roots);
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

void dp_terrain_refresh_cover(DpTerrain* terrain, long i0, long i1, long j0, long j1)
{
    if (!terrain->cover || !is_rectangle(i0, i1, j0, j1)) return;
    for (size_t t = 0; t < terrain->tiles; ++t) {
        Tile* tile = terrain->sorted[t];
        if (tile->ty < tile_of(j0) || tile->ty > tile_of(j1 - 1) || tile->tx < tile_of(i0) ||
            tile->tx > tile_of(i1 - 1))
            continue;
        const TilePart part = dp_tile_part(tile->tx, tile->ty, i0, i1, j0, j1);
        replant(terrain, tile, &part);
    }
}

void dp_terrain_surface(const DpTerrain* terrain, long i0, long j0, int nx, int ny, float* out)
{
    const long i1 = i0 + nx, j1 = j0 + ny;
    for (long ty = tile_of(j0); ty <= tile_of(j1 - 1); ++ty)
        for (long tx = tile_of(i0); tx <= tile_of(i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, i0, i1, j0, j1);
            const Tile*    tile = dp_tile_find(terrain, tx, ty);
            for (int j = 0; j < part.ny; ++j) {
                float*       to = out + (size_t)(part.j + j) * (size_t)nx + (size_t)part.i;
                const size_t at = part.in_tile + (size_t)j * DP_TILE;
                for (int i = 0; i < part.nx; ++i) {
                    const size_t p = at + (size_t)i;
                    to[i] =
                        tile ? tile->base_height[p] - tile->compression[p] + tile->heap[p] : NAN;
                }
            }
        }
}

// height of a cell's surface
static double surface_of(const DpTerrain* terrain, const Tile* tile, long i, long j)
{
    if (!tile)
        return dp_source_at(&terrain->source, cell_at(terrain->origin_x, terrain->cell, i),
                            cell_at(terrain->origin_y, terrain->cell, j), NULL) -
               terrain->datum;
    const long p = (j - tile->ty * DP_TILE) * DP_TILE + (i - tile->tx * DP_TILE);
    return (double)(tile->base_height[p] - tile->compression[p] + tile->heap[p]);
}

double dp_terrain_surface_at(const DpTerrain* terrain, double x, double y)
{
    const double u = (x - terrain->origin_x) / terrain->cell - 0.5;
    const double v = (y - terrain->origin_y) / terrain->cell - 0.5;
    if (!(fabs(u) < (double)MAX_CELL_INDEX && fabs(v) < (double)MAX_CELL_INDEX)) return NAN;
    const long   i = (long)floor(u), j = (long)floor(v);
    const double a = u - (double)i, b = v - (double)j;
    double       h[4];
    Tile*        tile = dp_tile_find(terrain, tile_of(i), tile_of(j));
    for (int n = 0; n < 4; ++n) {
        const long ci = i + n % 2, cj = j + n / 2, tx = tile_of(ci), ty = tile_of(cj);
        if (tx != tile_of(i) || ty != tile_of(j))
            h[n] = surface_of(terrain, dp_tile_find(terrain, tx, ty), ci, cj);
        else
            h[n] = surface_of(terrain, tile, ci, cj);
    }
    return (1.0 - b) * ((1.0 - a) * h[0] + a * h[1]) + b * ((1.0 - a) * h[2] + a * h[3]);
}
