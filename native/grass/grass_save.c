// grass/grass_save.c - how grass lies, kept and taken back: tiles that something touched.
#include <limits.h>
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "base/assert.h"
#include "grass/grass_inside.h"

#define NAME "gras"
#define VERSION 1
#define GRIDS 9
#define MIN_TILE 120  // bytes of a tile are no fewer
#define MAX_TILES (1 << 24)
#define MAX_TILE_INDEX (LONG_MAX / (4 * DP_TILE))
#define MAX_STEP (1 << 30)

struct DpGrassState
{
    const DpGrass* grass;
    int32_t        step;
    GrassTile**    tile;
    int            tiles;
};

static float* grid_of(GrassTile* tile, int k)
{
    float* const grid[GRIDS] = {tile->lean[0], tile->lean[1], tile->crushed,
                                tile->deepest, tile->height,  tile->rate,
                                tile->heal,    tile->limp,    tile->stays};
    return grid[k];
}

// largest number that makes sense in a grid
static float max_of(int k)
{
    const float max[GRIDS] = {1.001f, 1.001f, 1.0f, 1.0f, 1e3f, 1e9f, 1e9f, 1.0f, 1.001f};
    return max[k];
}

// ---- saving --------------------------------------------------------------------------------------

static void write_cells(DpStateWriter* writer, DpCellRect rect)
{
    const int32_t side[4] = {(int32_t)rect.i0, (int32_t)rect.i1, (int32_t)rect.j0,
                             (int32_t)rect.j1};
    dp_write_ints(writer, side, 4);
}

static void write_tile(DpStateWriter* writer, const DpGrass* grass, GrassTile* tile)
{
    float under[CELLS];  // does a sole lie on it, as of this step?
    dp_memory_ease((GRIDS + 2) * CELLS * sizeof(float));
    dp_write_i64(writer, tile->ty), dp_write_i64(writer, tile->tx);
    dp_write_u8(writer, tile->changed);
    write_cells(writer, tile->moves), write_cells(writer, tile->brisk);
    dp_write_f64(writer, (double)tile->healing), dp_write_f64(writer, tile->waited);
    for (int k = 0; k < GRIDS; ++k) dp_write_runs(writer, grid_of(tile, k), CELLS);
    for (size_t p = 0; p < CELLS; ++p) under[p] = tile->under[p] == grass->step ? 1.0f : 0.0f;
    dp_write_runs(writer, under, CELLS);
}

void dp_grass_save(const DpGrass* grass, DpStateWriter* writer)
{
    dp_write_chunk(writer, NAME, VERSION);
    dp_write_f64(writer, grass->grid.cell);
    dp_write_f64(writer, grass->grid.x0), dp_write_f64(writer, grass->grid.y0);
    dp_write_i64(writer, grass->step);
    dp_write_u64(writer, (uint64_t)grass->tiles);
    for (int t = 0; t < grass->tiles; ++t) write_tile(writer, grass, grass->tile[t]);
    dp_write_end(writer);
}

// ---- loading -------------------------------------------------------------------------------------

static DpCellRect read_cells(DpStateReader* reader)
{
    int32_t side[4];
    bool    holds = true;
    dp_read_ints(reader, side, 4);
    for (int k = 0; k < 4; ++k) holds = holds && side[k] >= 0 && side[k] <= DP_TILE;
    dp_read_check(reader, holds);
    const DpCellRect rect = {side[0], side[1], side[2], side[3]};
    return rect;
}

static void read_tile(DpStateReader* reader, GrassTile* tile, int32_t step)
{
    float under[CELLS];
    bool  holds = true;
    tile->ty = (long)dp_read_int(reader, -MAX_TILE_INDEX, MAX_TILE_INDEX);
    tile->tx = (long)dp_read_int(reader, -MAX_TILE_INDEX, MAX_TILE_INDEX);
    tile->changed = dp_read_u8(reader) != 0;
    tile->moves = read_cells(reader), tile->brisk = read_cells(reader);
    tile->healing = (float)dp_read_number(reader, 0.0, 1e9);
    tile->waited = dp_read_number(reader, 0.0, 1e15);
    for (int k = 0; k < GRIDS; ++k) {
        float* grid = grid_of(tile, k);
        dp_read_runs(reader, grid, CELLS);
        const float max = max_of(k), min = k < 2 || k == 8 ? -max : 0.0f;
        for (size_t p = 0; p < CELLS; ++p) holds = holds && grid[p] >= min && grid[p] <= max;
    }
    dp_read_runs(reader, under, CELLS);
    for (size_t p = 0; p < CELLS; ++p) tile->under[p] = under[p] > 0.0f ? step : 0;
    dp_read_check(reader, holds);
}

void dp_grass_state_destroy(DpGrassState* state)
{
    if (!state) return;
    for (int t = 0; t < state->tiles; ++t) dp_grass_tile_destroy(state->tile[t]);
    dp_free(state->tile), dp_free(state);
}

// tiles in ascending order; false without memory
static bool read_tiles(DpStateReader* reader, DpGrassState* state)
{
    const int tiles = (int)dp_read_count(reader, MAX_TILES, MIN_TILE);
    if (tiles == 0) return true;
    state->tile = dp_alloc((size_t)tiles, sizeof *state->tile);
    if (!state->tile) return false;
    for (int t = 0; t < tiles && reader->status == DP_OK; ++t) {
        GrassTile* tile = dp_grass_tile_create(0, 0);
        if (!tile) return false;
        state->tile[state->tiles++] = tile;
        read_tile(reader, tile, state->step);
        const GrassTile* last = t > 0 ? state->tile[t - 1] : NULL;
        dp_read_check(
            reader, !last || last->ty < tile->ty || (last->ty == tile->ty && last->tx < tile->tx));
    }
    return true;
}

DpStatus dp_grass_load(const DpGrass* grass, DpStateReader* reader, DpGrassState** state)
{
    if (!grass || !reader || !state) return DP_BAD_ARGUMENT;
    DpGrassState* read = dp_alloc(1, sizeof *read);
    if (!read) return DP_NO_MEMORY;
    read->grass = grass;
    dp_read_chunk(reader, NAME, VERSION);
    dp_read_number(reader, grass->grid.cell, grass->grid.cell);
    dp_read_number(reader, grass->grid.x0, grass->grid.x0);
    dp_read_number(reader, grass->grid.y0, grass->grid.y0);
    read->step = (int32_t)dp_read_int(reader, 0, MAX_STEP);
    const bool room = read_tiles(reader, read);
    if (room) dp_read_end(reader);
    if (!room || reader->status != DP_OK) {
        dp_grass_state_destroy(read);
        return room ? reader->status : DP_NO_MEMORY;
    }
    *state = read;
    return DP_OK;
}

void dp_grass_restore(DpGrass* grass, DpGrassState* state)
{
    DP_ASSERT(state->grass == grass);
    for (int t = 0; t < grass->tiles; ++t) dp_grass_tile_destroy(grass->tile[t]);
    dp_free(grass->tile);
    grass->tile = state->tile, grass->tiles = state->tiles;
    grass->step = state->step, grass->prints = 0;
    state->tile = NULL, state->tiles = 0;  // they are the grass's now
    dp_grass_state_destroy(state);
}
