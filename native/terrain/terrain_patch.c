// Patches: tiles are copied into one dense window, and what changed is copied back.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/assert.h"
#include "base/wide.h"
#include "terrain/terrain_inside.h"

#define ROW_STEP 16              // cells; whole cache lines of floats
#define MAX_CELLS (1L << 28)     // of one patch
#define WALLS (KEPT_FIELDS + 3)  // after base height, those that are kept, modulus, rest slope
#define UNEVEN (KEPT_FIELDS + 4)
#define SPRING (KEPT_FIELDS + 5)
#define PLATES (KEPT_FIELDS + 6)  // .. of names, as large as floats
#define FLOAT_GRIDS (KEPT_FIELDS + 7)

struct DpLease
{
    DpSoilPatch patch;
    long        i0, j0;  // world cell of the patch's cell (0, 0)
    float*      grid;    // (FLOAT_GRIDS, cells)
    uint8_t*    kind;
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

// what kernels may read beyond the end of a row: no ground, at rest
static void fill_padding(const DpTerrain* terrain, DpLease* lease, float* const* grid)
{
    const DpSoilPatch* patch = &lease->patch;
    float              pad[FLOAT_GRIDS] = {NAN};
    pad[KEPT_FIELDS + 1] = terrain->soils[0].young_modulus;
    pad[KEPT_FIELDS + 2] = terrain->slope[0];
    pad[WALLS] = INFINITY;
    const int grids = terrain->rough ? UNEVEN + 1 : terrain->walls ? UNEVEN : WALLS;
    for (int j = 0; j < patch->ny; ++j) {
        const size_t row = (size_t)j * (size_t)patch->row;
        for (int i = patch->nx; i < patch->row; ++i) {
            for (int g = 0; g < grids; ++g) grid[g][row + (size_t)i] = pad[g];
            lease->kind[row + (size_t)i] = 0;
        }
    }
}

// what rests and stands where soils differ from place to place, or let walls slide
static void copy_rough(const DpTerrain* terrain, Tile* tile, size_t at, size_t to, size_t wide,
                       float* const* grid)
{
    if (!terrain->rough) {
        for (size_t i = 0; i < wide; ++i)
            grid[WALLS][to + i] = terrain->wall[terrain->soil_count > 1 ? tile->kind[at + i] : 0];
        return;
    }
    const float* rough = tile_rough(terrain, tile) + at;
    for (int k = 0; k < ROUGH_GRIDS; ++k)
        memcpy(grid[KEPT_FIELDS + 2 + k] + to, rough + k * TILE_CELLS, wide * sizeof(float));
}

static void copy_in(const DpTerrain* terrain, Tile* tile, const TilePart* part, DpLease* lease,
                    float* const* grid)
{
    const size_t wide = (size_t)part->nx;
    float*       modulus = grid[KEPT_FIELDS + 1];
    for (int j = 0; j < part->ny; ++j) {
        const size_t to = (size_t)(part->j + j) * (size_t)lease->patch.row + (size_t)part->i;
        const size_t at = part->in_tile + (size_t)j * DP_TILE;
        memcpy(grid[0] + to, tile->base_height + at, wide * sizeof(float));
        for (int k = 0; k < KEPT_FIELDS; ++k)
            memcpy(grid[k + 1] + to, tile_kept_in(tile, k) + at, wide * sizeof(float));
        memcpy(lease->kind + to, tile->kind + at, wide);
        const bool painted = terrain->soil_count > 1;  // else all of it is soil 0
        for (size_t i = 0; i < wide; ++i) {
            const size_t kind = painted ? tile->kind[at + i] : 0;
            modulus[to + i] = terrain->soils[kind].young_modulus;  // TRAIL (9), E_g
            grid[KEPT_FIELDS + 2][to + i] = terrain->slope[kind];
        }
        if (terrain->walls || terrain->rough) copy_rough(terrain, tile, at, to, wide, grid);
        if (terrain->springs)
            memcpy(grid[SPRING] + to, tile_spring(terrain, tile) + at, wide * sizeof(float));
        if (terrain->crusts)
            memcpy(grid[PLATES] + to, tile_plates(terrain, tile) + at, wide * sizeof(float));
        for (int k = 0; k < terrain->coats; ++k)
            memcpy(lease->patch.coat + (size_t)k * lease->patch.coat_stride + to,
                   tile_coats(terrain, tile) + (size_t)k * TILE_CELLS + at, wide * sizeof(float));
        if (!terrain->cover) continue;
        const float* roots = tile->plant + TILE_CELLS + at;
        for (size_t i = 0; i < wide; ++i) modulus[to + i] += roots[i];  // TRAIL (9), E_v
    }
}

#define PATCH_GRID(ID, name, number, unit, equation, meaning) .name = grid[PLACE_##ID + 1],

DpStatus dp_terrain_acquire(DpTerrain* terrain, DpLease* lease, DpCellRect cells,
                            DpSoilPatch** patch)
{
    if (!are_cells(cells)) return DP_BAD_ARGUMENT;
    const long nx = cells.i1 - cells.i0, ny = cells.j1 - cells.j0;
    if (nx > MAX_CELLS || ny > MAX_CELLS || nx + ROW_STEP > MAX_CELLS / ny) return DP_BAD_ARGUMENT;
    const DpStatus status = dp_terrain_touch(terrain, cells);
    if (status != DP_OK) return status;

    const int    row = (int)((nx + ROW_STEP - 1) / ROW_STEP * ROW_STEP);
    const size_t room = (size_t)row * (size_t)ny;
    const size_t grids = FLOAT_GRIDS + (size_t)terrain->coats;
    if (!dp_make_room(&lease->grid, room, grids * sizeof *lease->grid) ||
        !dp_make_room(&lease->kind, room, sizeof *lease->kind))
        return DP_NO_MEMORY;
    float* grid[FLOAT_GRIDS];
    for (size_t g = 0; g < FLOAT_GRIDS; ++g) grid[g] = lease->grid + g * room;
    const DpSoilPatch acquired = {.nx = (int)nx,
                                  .ny = (int)ny,
                                  .row = row,
                                  .cell = terrain->grid.cell,
                                  .x0 = dp_grid_x(&terrain->grid, cells.i0),
                                  .y0 = dp_grid_y(&terrain->grid, cells.j0),
                                  .base_height = grid[0],
                                  .modulus = grid[KEPT_FIELDS + 1],
                                  .rest_slope = grid[KEPT_FIELDS + 2],
                                  .kind = lease->kind,
                                  .soils = terrain->soils,
                                  .soil_count = terrain->soil_count,
                                  .wall_slope = terrain->walls ? grid[WALLS] : NULL,
                                  .uneven = terrain->rough ? grid[UNEVEN] : NULL,
                                  .spring = terrain->springs ? grid[SPRING] : NULL,
                                  .plate = terrain->crusts ? (uint32_t*)(void*)grid[PLATES] : NULL,
                                  .coat = terrain->coats ? lease->grid + FLOAT_GRIDS * room : NULL,
                                  .coat_stride = room,
                                  .layers = terrain->layers,
                                  .layer_start = terrain->layer_start,
                                  .coat_soil = terrain->coat_soil,
                                  .coat_of_soil = terrain->coat_of_soil,
                                  DP_TERRAIN_FIELDS(PATCH_GRID, DP_FIELD_NONE)};
    lease->patch = acquired;
    lease->i0 = cells.i0;
    lease->j0 = cells.j0;
    for (long ty = dp_tile_of(cells.j0); ty <= dp_tile_of(cells.j1 - 1); ++ty)
        for (long tx = dp_tile_of(cells.i0); tx <= dp_tile_of(cells.i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, cells);
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
    int                differs = 0;
#define COPY_OUT(ID, name, number, unit, equation, meaning) \
    differs |= copy_row(tile->name + to, patch->name + from, base_height, count);
    DP_TERRAIN_FIELDS(COPY_OUT, DP_FIELD_NONE)
    return differs != 0;
}

void dp_terrain_commit(DpTerrain* terrain, DpLease* lease, DpCellRect within)
{
    DP_ASSERT(dp_cells_empty(within) ||
              dp_cells_hold(dp_cells(0, 0, lease->patch.nx, lease->patch.ny), within));
    if (dp_cells_empty(within)) return;
    const DpCellRect cells = {lease->i0 + within.i0, lease->i0 + within.i1, lease->j0 + within.j0,
                              lease->j0 + within.j1};
    for (long ty = dp_tile_of(cells.j0); ty <= dp_tile_of(cells.j1 - 1); ++ty)
        for (long tx = dp_tile_of(cells.i0); tx <= dp_tile_of(cells.i1 - 1); ++tx) {
            const TilePart part = dp_tile_part(tx, ty, cells);
            Tile*          tile = dp_tile_find(terrain, tx, ty);
            bool           differs = false;
            for (int j = 0; j < part.ny; ++j) {
                const size_t from = (size_t)(within.j0 + part.j + j) * (size_t)lease->patch.row +
                                    (size_t)(within.i0 + part.i);
                const size_t to = part.in_tile + (size_t)j * DP_TILE;
                differs |= copy_out(lease, from, tile, to, part.nx);
                if (terrain->springs)
                    memcpy(tile_spring(terrain, tile) + to, lease->patch.spring + from,
                           (size_t)part.nx * sizeof(float));
                for (int k = 0; k < terrain->coats; ++k)
                    differs |=
                        copy_row(tile_coats(terrain, tile) + (size_t)k * TILE_CELLS + to,
                                 lease->patch.coat + (size_t)k * lease->patch.coat_stride + from,
                                 tile->base_height + to, part.nx) != 0;
            }
            if (differs) dp_tile_mark(terrain, tile);
        }
}
