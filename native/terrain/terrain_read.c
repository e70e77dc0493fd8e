// Fields are read: from tiles, or from the ground where nobody touched it.
#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "terrain/terrain_inside.h"

typedef struct Reading
{
    const DpTerrain* terrain;
    int              field;
    DpCellRect       cells;
    long             tx0, ty0;
    int              tiles_x;
    float*           out;
} Reading;

#define FIELD_INFO(ID, name, number, unit, equation, meaning) \
    {DP_FIELD_##ID, #name, unit, equation, meaning},
static const DpFieldInfo fields[] = {DP_TERRAIN_FIELDS(FIELD_INFO, FIELD_INFO)};

const DpFieldInfo* dp_terrain_fields(int* count)
{
    *count = (int)(sizeof fields / sizeof *fields);
    return fields;
}

// the grid of a tile that a field is copied from; NULL where it is worked out from the soil
static const float* grid_of(const Tile* tile, const float* base_height, int field)
{
#define GRID_OF(ID, name, number, unit, equation, meaning) \
    if (field == DP_FIELD_##ID) return tile->name;
    DP_TERRAIN_FIELDS(GRID_OF, DP_FIELD_NONE)
    return field == DP_FIELD_BASE_HEIGHT ? base_height : NULL;
}

// a tile as its fields are read; what an untouched one is asked for is computed for the moment
typedef struct View
{
    const DpTerrain* terrain;
    const Tile*      tile;  // NULL: untouched
    const float*     base_height;
    const uint8_t*   kind;
    const float*     plant;  // NULL on bare ground
    float            own_base_height[TILE_CELLS];
    uint8_t          own_kind[TILE_CELLS];
    float            own_plant[2 * TILE_CELLS];
} View;

// whether an untouched tile has to be computed for it; ground that is not painted is soil 0 all over
static bool comes_from_ground(const DpTerrain* terrain, int field)
{
    return field == DP_FIELD_BASE_HEIGHT ||
           (terrain->source.kind_count > 0 &&
            (field == DP_FIELD_MODULUS || field == DP_FIELD_KIND || field >= DP_FIELD_SURFACE));
}

static bool is_of_plants(int field)
{
    return field == DP_FIELD_MODULUS || field == DP_FIELD_PLANT_STRENGTH;
}

static void open_view(View* view, const DpTerrain* terrain, long tx, long ty, int field)
{
    const Tile* tile = dp_tile_find(terrain, tx, ty);
    const bool  grows = terrain->cover && is_of_plants(field);
    view->terrain = terrain;
    view->tile = tile;
    view->base_height = tile ? tile->base_height : view->own_base_height;
    view->kind = tile ? tile->kind : view->own_kind;
    view->plant = !grows ? NULL : tile ? tile->plant : view->own_plant;
    if (tile) return;
    if (grows) dp_tile_cover(terrain, tx, ty, view->own_plant);
    if (comes_from_ground(terrain, field)) {
        const TileGrid grid = dp_tile_grid(terrain, tx, ty);
        dp_source_tile(&terrain->source, &grid, view->own_base_height, view->own_kind);
    } else {
        memset(view->own_kind, 0, sizeof view->own_kind);
    }
}

static void read_row(const View* view, int field, size_t at, int count, float* out)
{
    const Tile*  tile = view->tile;
    const bool   there = tile || field == DP_FIELD_BASE_HEIGHT;
    const float* grid = there ? grid_of(tile, view->base_height, field) : NULL;
    if (grid) {
        memcpy(out, grid + at, (size_t)count * sizeof *out);
        if (field != DP_FIELD_BASE_HEIGHT) return;
        const double base = view->terrain->datum;
        for (int i = 0; i < count; ++i) out[i] = (float)((double)out[i] + base);
        return;
    }
    const float*     plant = view->plant ? view->plant + at : NULL;
    const uint8_t*   kind = view->kind + at;
    const DpTerrain* terrain = view->terrain;
    if (field == DP_FIELD_PLANT_STRENGTH && plant) {
        memcpy(out, plant, (size_t)count * sizeof *out);
    } else if (field == DP_FIELD_HEIGHT_CHANGE && tile) {
        for (int i = 0; i < count; ++i)
            out[i] = tile->heap[at + (size_t)i] - tile->compression[at + (size_t)i];
        dp_coats_row(terrain, tile, at, count, field, kind, out);
    } else if (field >= DP_FIELD_SURFACE) {
        dp_coats_row(terrain, tile, at, count, field, kind, out);
    } else if (field == DP_FIELD_KIND) {
        for (int i = 0; i < count; ++i) out[i] = (float)kind[i];
    } else if (field == DP_FIELD_MODULUS) {
        const bool painted = terrain->soil_count > 1;  // else all of it is soil 0
        for (int i = 0; i < count; ++i)
            out[i] = terrain->soils[painted ? kind[i] : 0].young_modulus;          // TRAIL (9), E_g
        for (int i = 0; plant && i < count; ++i) out[i] += plant[TILE_CELLS + i];  // E_v
    } else {
        memset(out, 0, (size_t)count * sizeof *out);
    }
}

// one tile of the rectangle
static void read_tile(void* context, int index, int worker)
{
    const Reading* reading = context;
    const long     tx = reading->tx0 + index % reading->tiles_x;
    const long     ty = reading->ty0 + index / reading->tiles_x;
    View           view;
    (void)worker;
    open_view(&view, reading->terrain, tx, ty, reading->field);
    const TilePart part = dp_tile_part(tx, ty, reading->cells);
    const size_t   nx = (size_t)(reading->cells.i1 - reading->cells.i0);
    for (int j = 0; j < part.ny; ++j) {
        float* out = reading->out + (size_t)(part.j + j) * nx + (size_t)part.i;
        read_row(&view, reading->field, part.in_tile + (size_t)j * DP_TILE, part.nx, out);
    }
}

static bool are_numbers(long first, long count)
{
    return count > 0 && count < MAX_CELL_INDEX && first > -MAX_CELL_INDEX &&
           first < MAX_CELL_INDEX - count;
}

bool dp_terrain_has(long i0, long j0, long nx, long ny)
{
    return are_numbers(i0, nx) && are_numbers(j0, ny);
}

DpStatus dp_terrain_read(const DpTerrain* terrain, int field, long i0, long j0, int nx, int ny,
                         float* out)
{
    if (!dp_terrain_has(i0, j0, nx, ny)) return DP_BAD_ARGUMENT;
    if (!dp_terrain_knows(terrain, field)) return DP_BAD_ARGUMENT;
    Reading reading = {terrain, field, dp_cells(i0, j0, nx, ny), dp_tile_of(i0), dp_tile_of(j0),
                       0,       out};
    reading.tiles_x = (int)(dp_tile_of(i0 + nx - 1) - reading.tx0 + 1);
    const long tiles_y = dp_tile_of(j0 + ny - 1) - reading.ty0 + 1;
    if (tiles_y > INT_MAX / reading.tiles_x) return DP_BAD_ARGUMENT;
    dp_parallel_for(reading.tiles_x * (int)tiles_y, terrain->workers, read_tile, &reading);
    return DP_OK;
}

void dp_terrain_tile(const DpTerrain* terrain, long tx, long ty, int field, float* out, int stride)
{
    View view;
    open_view(&view, terrain, tx, ty, field);
    for (size_t j = 0; j < DP_TILE; ++j, out += DP_TILE * stride) {
        float row[DP_TILE];
        read_row(&view, field, j * DP_TILE, DP_TILE, row);
        for (int i = 0; i < DP_TILE; ++i) out[i * stride] = row[i];
    }
}

// ---- the surface -------------------------------------------------------------------------------

void dp_terrain_surface(const DpTerrain* terrain, long i0, long j0, int nx, int ny, float* out)
{
    const DpCellRect cells = dp_cells(i0, j0, nx, ny);
    for (long ty = dp_tile_of(cells.j0); ty <= dp_tile_of(cells.j1 - 1); ++ty)
        for (long tx = dp_tile_of(cells.i0); tx <= dp_tile_of(cells.i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, cells);
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
        return dp_source_at(&terrain->source, dp_grid_x(&terrain->grid, i),
                            dp_grid_y(&terrain->grid, j), NULL) -
               terrain->datum;
    const long p = (j - tile->ty * DP_TILE) * DP_TILE + (i - tile->tx * DP_TILE);
    return (double)(tile->base_height[p] - tile->compression[p] + tile->heap[p]);
}

double dp_terrain_surface_at(const DpTerrain* terrain, double x, double y)
{
    const double u = (x - terrain->grid.x0) / terrain->grid.cell - 0.5;
    const double v = (y - terrain->grid.y0) / terrain->grid.cell - 0.5;
    if (!(fabs(u) < (double)MAX_CELL_INDEX && fabs(v) < (double)MAX_CELL_INDEX)) return NAN;
    const long   i = (long)floor(u), j = (long)floor(v);
    const double a = u - (double)i, b = v - (double)j;
    double       h[4];
    Tile*        tile = dp_tile_find(terrain, dp_tile_of(i), dp_tile_of(j));
    for (int n = 0; n < 4; ++n) {
        const long ci = i + n % 2, cj = j + n / 2, tx = dp_tile_of(ci), ty = dp_tile_of(cj);
        if (tx != dp_tile_of(i) || ty != dp_tile_of(j))
            h[n] = surface_of(terrain, dp_tile_find(terrain, tx, ty), ci, cj);
        else
            h[n] = surface_of(terrain, tile, ci, cj);
    }
    return (1.0 - b) * ((1.0 - a) * h[0] + a * h[1]) + b * ((1.0 - a) * h[2] + a * h[3]);
}
