// terrain/terrain_grain.c - little soil taken from a place, and laid down at one: what sticks, and what flew. MODEL 6.15
#include "base/wide.h"
#include "terrain/terrain_inside.h"

#define RIGID 0.95     // share of the layer, deeper than which nothing is taken
#define WIDE 16        // cells that are compared at once
#define MOST_ALONG 64  // cells along a side of a place

// Cells of a square about a point, each with what of its side lies in the square.
typedef struct Place
{
    DpCellRect cells;
    double     x0, x1, y0, y1;  // [cells]
} Place;

static bool place_at(const DpTerrain* terrain, double x, double y, double width, Place* place)
{
    const double cell = terrain->grid.cell;
    const double u = (x - terrain->grid.x0) / cell, v = (y - terrain->grid.y0) / cell;
    if (!(fabs(u) < (double)(MAX_CELL_INDEX / 2) && fabs(v) < (double)(MAX_CELL_INDEX / 2)))
        return false;
    const double half = 0.5 * fmin(fmax(width / cell, 1.0), (double)MOST_ALONG);
    if (half <= 0.5) {  // one cell, whole
        const long i = (long)floor(u), j = (long)floor(v);
        *place =
            (Place){dp_cells(i, j, 1, 1), (double)i, (double)i + 1.0, (double)j, (double)j + 1.0};
        return true;
    }
    place->x0 = u - half, place->x1 = u + half, place->y0 = v - half, place->y1 = v + half;
    place->cells = (DpCellRect){(long)floor(place->x0), (long)ceil(place->x1),
                                (long)floor(place->y0), (long)ceil(place->y1)};
    return true;
}

// what of a cell lies in the square [cells]
static double share_of(const Place* place, long i, long j)
{
    const double wide = fmin(place->x1, (double)i + 1.0) - fmax(place->x0, (double)i);
    const double high = fmin(place->y1, (double)j + 1.0) - fmax(place->y0, (double)j);
    return fmax(wide, 0.0) * fmax(high, 0.0);
}

// A cell of a place that has ground.
typedef struct Column
{
    Tile*  tile;
    int    at;
    double share;
} Column;

// Number `n` of the place's cells; false: no ground there.
static bool column_of(const DpTerrain* terrain, const Place* place, long i, long j, Column* column)
{
    column->tile = dp_tile_find(terrain, dp_tile_of(i), dp_tile_of(j));
    if (!column->tile) return false;
    column->at = (int)((j - column->tile->ty * DP_TILE) * DP_TILE + i - column->tile->tx * DP_TILE);
    column->share = share_of(place, i, j);
    return column->share > 0.0 && !isnan(column->tile->base_height[column->at]);
}

#define EACH_COLUMN(place, column)                                 \
    for (long j = (place).cells.j0; j < (place).cells.j1; ++j)     \
        for (long i = (place).cells.i0; i < (place).cells.i1; ++i) \
            if (column_of(terrain, &(place), i, j, &(column)))

// what may be taken of a column [m]: its heap, and as much of firm ground as was pressed there
static double loose_of(const DpTerrain* terrain, const Column* column)
{
    const double  pressed = (double)column->tile->compression[column->at];
    const DpSoil* soil = &terrain->soils[column->tile->kind[column->at]];
    return (double)column->tile->heap[column->at] +
           fmax(fmin(pressed, RIGID * (double)soil->layer_depth - pressed), 0.0);
}

bool dp_terrain_dig(DpTerrain* terrain, double x, double y, double width, double volume, DpDug* dug)
{
    Place  place;
    Column column;
    double share = 0.0;
    *dug = (DpDug){0};
    if (!place_at(terrain, x, y, width, &place)) return false;
    EACH_COLUMN(place, column) share += column.share;
    if (!(share > 0.0)) return false;
    const double area = terrain->grid.cell * terrain->grid.cell;
    const double deep = volume / (share * area);  // of a column that lies wholly within [m]
    EACH_COLUMN(place, column) if (loose_of(terrain, &column) < deep * column.share) return false;
    EACH_COLUMN(place, column)
    {
        float*       heap = &column.tile->heap[column.at];
        float*       pressed = &column.tile->compression[column.at];
        const double want = deep * column.share, was = (double)*heap, had = (double)*pressed;
        *heap = (float)fmax(was - want, 0.0);
        const double left = want - (was - (double)*heap);
        if (*heap <= 0.0f && left > 0.0) *pressed = (float)(had + left);
        dug->heap += (was - (double)*heap) * area;
        dug->firm += ((double)*pressed - had) * area;
        dp_tile_mark(terrain, column.tile);
        dug->kind = column.tile->kind[column.at];
    }
    return true;
}

DpStatus dp_terrain_drop(DpTerrain* terrain, double x, double y, double width, double volume,
                         DpCellRect* cells, double* laid)
{
    Place  place;
    Column column;
    double share = 0.0;
    *laid = 0.0, *cells = (DpCellRect){0, 0, 0, 0};
    if (!place_at(terrain, x, y, width, &place)) return DP_OK;
    const DpStatus status = dp_terrain_touch(terrain, place.cells);
    if (status != DP_OK) return status;
    EACH_COLUMN(place, column) share += column.share;
    if (!(share > 0.0)) return DP_OK;
    const double area = terrain->grid.cell * terrain->grid.cell;
    EACH_COLUMN(place, column)
    {
        float*       heap = &column.tile->heap[column.at];
        const double was = (double)*heap;
        *heap = (float)(was + volume * column.share / (share * area));
        *laid += ((double)*heap - was) * area;
        dp_tile_mark(terrain, column.tile);
    }
    *cells = place.cells;
    return DP_OK;
}

// the height of a neighbour's surface; NaN: none is known
static double height_of(const DpTerrain* terrain, long i, long j)
{
    const Tile* tile = dp_tile_find(terrain, dp_tile_of(i), dp_tile_of(j));
    if (!tile) return NAN;
    const long p = (j - tile->ty * DP_TILE) * DP_TILE + i - tile->tx * DP_TILE;
    return (double)(tile->base_height[p] - tile->compression[p] + tile->heap[p]);
}

bool dp_terrain_steep(const DpTerrain* terrain, DpCellRect cells)
{
    const Place place = {cells, (double)cells.i0, (double)cells.i1, (double)cells.j0,
                         (double)cells.j1};
    Column      column;
    EACH_COLUMN(place, column)
    {
        const Tile*   tile = column.tile;
        const DpSoil* soil = &terrain->soils[tile->kind[column.at]];
        const double  slope = tan((double)soil->rest_angle) * (1.0 - (double)soil->roughness);
        const double  here = height_of(terrain, i, j);
        for (int n = 0; n < 9; ++n) {
            const int    di = n % 3 - 1, dj = n / 3 - 1;
            const double far = terrain->grid.cell * sqrt((double)(di * di + dj * dj));
            if (here - height_of(terrain, i + di, j + dj) > slope * far) return true;
        }
    }
    return false;
}

// the highest of a tile's cells; of those without ground nothing is known
DP_CLONES static float highest_of(const float* restrict base_height,
                                  const float* restrict compression, const float* restrict heap)
{
    float most[WIDE];
    for (int k = 0; k < WIDE; ++k) most[k] = -INFINITY;
    for (int n = 0; n < TILE_CELLS; n += WIDE)
        for (int k = 0; k < WIDE; ++k) {
            const float height = base_height[n + k] - compression[n + k] + heap[n + k];
            most[k] = height > most[k] ? height : most[k];
        }
    float found = -INFINITY;
    for (int k = 0; k < WIDE; ++k) found = most[k] > found ? most[k] : found;
    return found;
}

double dp_terrain_highest(DpTerrain* terrain, long tx, long ty)
{
    const DpCellRect cells = dp_cells(tx * DP_TILE, ty * DP_TILE, DP_TILE, DP_TILE);
    if (dp_terrain_touch(terrain, cells) != DP_OK) return INFINITY;
    Tile* tile = dp_tile_find(terrain, tx, ty);
    if (!atomic_load(&tile->measured)) {
        tile->highest = highest_of(tile->base_height, tile->compression, tile->heap);
        atomic_store(&tile->measured, 1);
    }
    return (double)tile->highest;
}
