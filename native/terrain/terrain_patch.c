// Windows: tiles are copied into one dense patch, what changed is copied back, and fields are read.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/assert.h"
#include "base/parallel.h"
#include "base/wide.h"
#include "terrain/terrain_inside.h"

#define ROW_STEP 16           // cells; whole cache lines of floats
#define MAX_CELLS (1L << 28)  // of one patch
#define FLOAT_GRIDS 6

struct DpLease
{
    DpSoilPatch patch;
    long        i0, j0;  // world cell of the patch's cell (0, 0)
    float*      grid;    // base height, compression, heap, pressure_time, modulus, rest_slope
    uint8_t*    kind;
    size_t      room;  // cells of each
};

DpLease* dp_lease_create(void)
{
    return dp_alloc(1, sizeof(DpLease));
}

void dp_lease_destroy(DpLease* lease)
{
    if (!lease) return;
    dp_free(lease->grid);
    dp_free(lease->kind);
    dp_free(lease);
}

static bool make_room(DpLease* lease, size_t cells)
{
    if (cells <= lease->room) return true;
    const size_t room = (cells + cells / 4 + ROW_STEP - 1) / ROW_STEP * ROW_STEP;
    float*       grid = dp_alloc(room, FLOAT_GRIDS * sizeof *grid);
    uint8_t*     kind = dp_alloc(room, sizeof *kind);
    if (!grid || !kind) {
        dp_free(grid);
        dp_free(kind);
        return false;
    }
    dp_free(lease->grid);
    dp_free(lease->kind);
    lease->grid = grid;
    lease->kind = kind;
    lease->room = room;
    return true;
}

static long later(long a, long b)
{
    return a > b ? a : b;
}

static long earlier(long a, long b)
{
    return a < b ? a : b;
}

TilePart dp_tile_part(long tx, long ty, long i0, long i1, long j0, long j1)
{
    const long from_i = later(i0, tx * DP_TILE), to_i = earlier(i1, (tx + 1) * DP_TILE);
    const long from_j = later(j0, ty * DP_TILE), to_j = earlier(j1, (ty + 1) * DP_TILE);
    return (TilePart){tx,
                      ty,
                      (int)(from_i - i0),
                      (int)(from_j - j0),
                      (int)(to_i - from_i),
                      (int)(to_j - from_j),
                      (size_t)(from_j - ty * DP_TILE) * DP_TILE + (size_t)(from_i - tx * DP_TILE)};
}

// what kernels may read beyond the end of a row: no ground, at rest
static void fill_padding(const DpTerrain* terrain, DpLease* lease, float* const* grid)
{
    const DpSoilPatch* patch = &lease->patch;
    const float        pad[FLOAT_GRIDS] = {
               NAN, 0.0f, 0.0f, 0.0f, terrain->soils[0].young_modulus, terrain->slope[0]};
    for (int j = 0; j < patch->ny; ++j) {
        const size_t row = (size_t)j * (size_t)patch->row;
        for (int i = patch->nx; i < patch->row; ++i) {
            for (int g = 0; g < FLOAT_GRIDS; ++g) grid[g][row + (size_t)i] = pad[g];
            lease->kind[row + (size_t)i] = 0;
        }
    }
}

static void copy_in(const DpTerrain* terrain, const Tile* tile, const TilePart* part,
                    DpLease* lease, float* const* grid)
{
    const float* from[4] = {tile->base_height, tile->compression, tile->heap, tile->pressure_time};
    const size_t wide = (size_t)part->nx;
    for (int j = 0; j < part->ny; ++j) {
        const size_t to = (size_t)(part->j + j) * (size_t)lease->patch.row + (size_t)part->i;
        const size_t at = part->in_tile + (size_t)j * DP_TILE;
        for (int g = 0; g < 4; ++g) memcpy(grid[g] + to, from[g] + at, wide * sizeof(float));
        memcpy(lease->kind + to, tile->kind + at, wide);
        const bool painted = terrain->soil_count > 1;  // else all of it is soil 0
        for (size_t i = 0; i < wide; ++i) {
            const size_t kind = painted ? tile->kind[at + i] : 0;
            grid[4][to + i] = terrain->soils[kind].young_modulus;  // TRAIL (9), E_g
            grid[5][to + i] = terrain->slope[kind];
        }
        if (!terrain->cover) continue;
        const float* roots = tile->plant + TILE_CELLS + at;
        for (size_t i = 0; i < wide; ++i) grid[4][to + i] += roots[i];  // TRAIL (9), E_v
    }
}

DpStatus dp_terrain_acquire(DpTerrain* terrain, DpLease* lease, long i0, long i1, long j0, long j1,
                            DpSoilPatch** patch)
{
    if (!is_rectangle(i0, i1, j0, j1)) return DP_BAD_ARGUMENT;
    const long nx = i1 - i0, ny = j1 - j0;
    if (nx > MAX_CELLS || ny > MAX_CELLS || nx + ROW_STEP > MAX_CELLS / ny) return DP_BAD_ARGUMENT;
    const DpStatus status = dp_terrain_touch(terrain, i0, i1, j0, j1);
    if (status != DP_OK) return status;

    const int    row = (int)((nx + ROW_STEP - 1) / ROW_STEP * ROW_STEP);
    const size_t cells = (size_t)row * (size_t)ny;
    if (!make_room(lease, cells)) return DP_NO_MEMORY;
    float* grid[FLOAT_GRIDS];
    for (size_t g = 0; g < FLOAT_GRIDS; ++g) grid[g] = lease->grid + g * lease->room;
    const DpSoilPatch acquired = {(int)nx,
                                  (int)ny,
                                  row,
                                  terrain->cell,
                                  cell_at(terrain->origin_x, terrain->cell, i0),
                                  cell_at(terrain->origin_y, terrain->cell, j0),
                                  grid[0],
                                  grid[1],
                                  grid[2],
                                  grid[3],
                                  grid[4],
                                  grid[5],
                                  lease->kind,
                                  terrain->soils,
                                  terrain->soil_count,
                                  NULL};
    lease->patch = acquired;
    lease->i0 = i0;
    lease->j0 = j0;
    for (long ty = tile_of(j0); ty <= tile_of(j1 - 1); ++ty)
        for (long tx = tile_of(i0); tx <= tile_of(i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, i0, i1, j0, j1);
            copy_in(terrain, dp_tile_find(terrain, tx, ty), &part, lease, grid);
        }
    fill_padding(terrain, lease, grid);
    *patch = &lease->patch;
    return DP_OK;
}

// one row of one grid; cells without ground keep what they have: nothing. Not 0 if any cell is new.
DP_CLONES static int copy_row(float* restrict target, const float* restrict source,
                              const float* restrict base_height, int count)
{
    int differs = 0;
    for (int i = 0; i < count; ++i) {
        const float was = target[i];
        const float now = base_height[i] == base_height[i] ? source[i] : was;
        differs |= now != was;
        target[i] = now;
    }
    return differs;
}

// says whether any cell is new
static bool copy_out(const DpLease* lease, size_t from, Tile* tile, size_t to, int count)
{
    const DpSoilPatch* patch = &lease->patch;
    const float*       base_height = tile->base_height + to;
    int differs = copy_row(tile->compression + to, patch->compression + from, base_height, count);
    differs |= copy_row(tile->heap + to, patch->heap + from, base_height, count);
    differs |= copy_row(tile->pressure_time + to, patch->pressure_time + from, base_height, count);
    return differs != 0;
}

void dp_terrain_commit(DpTerrain* terrain, DpLease* lease, int di0, int di1, int dj0, int dj1)
{
    DP_ASSERT(di0 >= 0 && di1 <= lease->patch.nx && dj0 >= 0 && dj1 <= lease->patch.ny);
    if (di0 >= di1 || dj0 >= dj1) return;
    const long i0 = lease->i0 + di0, i1 = lease->i0 + di1;
    const long j0 = lease->j0 + dj0, j1 = lease->j0 + dj1;
    for (long ty = tile_of(j0); ty <= tile_of(j1 - 1); ++ty)
        for (long tx = tile_of(i0); tx <= tile_of(i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, i0, i1, j0, j1);
            Tile*          tile = dp_tile_find(terrain, tx, ty);
            bool           differs = false;
            for (int j = 0; j < part.ny; ++j) {
                const size_t from =
                    (size_t)(dj0 + part.j + j) * (size_t)lease->patch.row + (size_t)(di0 + part.i);
                differs |= copy_out(lease, from, tile, part.in_tile + (size_t)j * DP_TILE, part.nx);
            }
            if (differs) dp_tile_mark(terrain, tile);
        }
}

// ---- reading ----------------------------------------------------------------------------------

typedef struct Reading
{
    const DpTerrain* terrain;
    DpField          field;
    long             i0, i1, j0, j1;
    long             tx0, ty0;
    int              tiles_x;
    float*           out;
} Reading;

// the grid of a tile that a field is copied from; NULL where it is worked out from the soil
static const float* grid_of(const Tile* tile, const float* base_height, DpField field)
{
    switch (field) {
        case DP_FIELD_COMPRESSION:
            return tile->compression;
        case DP_FIELD_HEAP:
            return tile->heap;
        case DP_FIELD_PRESSURE_TIME:
            return tile->pressure_time;
        case DP_FIELD_BASE_HEIGHT:
            return base_height;
        case DP_FIELD_MODULUS:
        case DP_FIELD_KIND:
        case DP_FIELD_PLANT_STRENGTH:
        case DP_FIELD_HEIGHT_CHANGE:
            break;
    }
    return NULL;
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
static bool comes_from_ground(const DpTerrain* terrain, DpField field)
{
    return field == DP_FIELD_BASE_HEIGHT || (terrain->source.kind_count > 0 &&
                                             (field == DP_FIELD_MODULUS || field == DP_FIELD_KIND));
}

static bool is_of_plants(DpField field)
{
    return field == DP_FIELD_MODULUS || field == DP_FIELD_PLANT_STRENGTH;
}

static void open_view(View* view, const DpTerrain* terrain, long tx, long ty, DpField field)
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

static void read_row(const View* view, DpField field, size_t at, int count, float* out)
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
    const TilePart part = dp_tile_part(tx, ty, reading->i0, reading->i1, reading->j0, reading->j1);
    const size_t   nx = (size_t)(reading->i1 - reading->i0);
    for (int j = 0; j < part.ny; ++j) {
        float* out = reading->out + (size_t)(part.j + j) * nx + (size_t)part.i;
        read_row(&view, reading->field, part.in_tile + (size_t)j * DP_TILE, part.nx, out);
    }
}

static bool are_cells(long first, long count)
{
    return count > 0 && count < MAX_CELL_INDEX && first > -MAX_CELL_INDEX &&
           first < MAX_CELL_INDEX - count;
}

bool dp_terrain_has(long i0, long j0, long nx, long ny)
{
    return are_cells(i0, nx) && are_cells(j0, ny);
}

DpStatus dp_terrain_read(const DpTerrain* terrain, DpField field, long i0, long j0, int nx, int ny,
                         float* out)
{
    if (!dp_terrain_has(i0, j0, nx, ny)) return DP_BAD_ARGUMENT;
    if (field < DP_FIELD_COMPRESSION || field > DP_FIELD_HEIGHT_CHANGE) return DP_BAD_ARGUMENT;
    Reading reading = {terrain, field, i0, i0 + nx, j0, j0 + ny, tile_of(i0), tile_of(j0), 0, out};
    reading.tiles_x = (int)(tile_of(reading.i1 - 1) - reading.tx0 + 1);
    const long tiles_y = tile_of(reading.j1 - 1) - reading.ty0 + 1;
    if (tiles_y > INT_MAX / reading.tiles_x) return DP_BAD_ARGUMENT;
    dp_parallel_for(reading.tiles_x * (int)tiles_y, terrain->workers, read_tile, &reading);
    return DP_OK;
}

void dp_terrain_tile(const DpTerrain* terrain, long tx, long ty, DpField field, float* out,
                     int stride)
{
    View view;
    open_view(&view, terrain, tx, ty, field);
    for (size_t j = 0; j < DP_TILE; ++j, out += DP_TILE * stride) {
        float row[DP_TILE];
        read_row(&view, field, j * DP_TILE, DP_TILE, row);
        for (int i = 0; i < DP_TILE; ++i) out[i * stride] = row[i];
    }
}
