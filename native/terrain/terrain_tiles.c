// Tiles: a hash finds them, a sorted list fixes the order of sums and visits.
#include <stdlib.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "terrain/terrain_inside.h"

#define MAX_TILES_AT_ONCE (1L << 16)  // 4.5 GB: nobody means that

static size_t first_slot(long tx, long ty, size_t slots)
{
    uint64_t mixed = (uint64_t)tx * 0x9e3779b97f4a7c15u + (uint64_t)ty * 0xc2b2ae3d27d4eb4fu;
    mixed ^= mixed >> 29;
    mixed *= 0xbf58476d1ce4e5b9u;
    mixed ^= mixed >> 32;
    return (size_t)mixed & (slots - 1);
}

// where the tile is, or the empty slot where it belongs
static Tile** find_slot(Tile** slot, size_t slots, long tx, long ty)
{
    size_t at = first_slot(tx, ty, slots);
    while (slot[at] && (slot[at]->tx != tx || slot[at]->ty != ty)) at = (at + 1) & (slots - 1);
    return &slot[at];
}

Tile* dp_tile_find(const DpTerrain* terrain, long tx, long ty)
{
    if (!terrain->slots) return NULL;
    dp_memory_ease(TILE_BYTES);
    return *find_slot(terrain->slot, terrain->slots, tx, ty);
}

TileGrid dp_tile_grid(const DpTerrain* terrain, long tx, long ty)
{
    const TileGrid grid = {terrain->grid, terrain->datum, tx * DP_TILE, ty * DP_TILE};
    return grid;
}

TilePart dp_tile_part(long tx, long ty, DpCellRect cells)
{
    const DpCellRect here = dp_cells(tx * DP_TILE, ty * DP_TILE, DP_TILE, DP_TILE);
    const DpCellRect part = dp_cells_common(cells, here);
    return (TilePart){tx,
                      ty,
                      (int)(part.i0 - cells.i0),
                      (int)(part.j0 - cells.j0),
                      (int)(part.i1 - part.i0),
                      (int)(part.j1 - part.j0),
                      (size_t)(part.j0 - here.j0) * DP_TILE + (size_t)(part.i0 - here.i0)};
}

// ---- creating them -----------------------------------------------------------------------------

// room for `more` tiles in the lists and the hash; without memory all stays as it was
static bool fit_tiles(DpTerrain* terrain, size_t more)
{
    const size_t wanted = terrain->tiles + more;
    if (!dp_make_room(&terrain->sorted, wanted, sizeof *terrain->sorted) ||
        !dp_make_room(&terrain->marked, wanted, sizeof *terrain->marked))
        return false;
    if (2 * wanted > terrain->slots) {
        size_t slots = terrain->slots ? terrain->slots : 64;
        while (slots < 2 * wanted) slots *= 2;
        Tile** slot = dp_alloc(slots, sizeof *slot);
        if (!slot) return false;
        for (size_t t = 0; t < terrain->tiles; ++t) {
            Tile* tile = terrain->sorted[t];
            *find_slot(slot, slots, tile->tx, tile->ty) = tile;
        }
        dp_free(terrain->slot);
        terrain->slot = slot;
        terrain->slots = slots;
    }
    return true;
}

static bool comes_before(const Tile* a, const Tile* b)
{
    return a->ty != b->ty ? a->ty < b->ty : a->tx < b->tx;
}

// two sorted lists become one, from the back
static void merge(Tile** sorted, size_t count, Tile* const* fresh, size_t more)
{
    size_t to = count + more;
    while (more > 0) {
        const bool old = count > 0 && comes_before(fresh[more - 1], sorted[count - 1]);
        sorted[--to] = old ? sorted[--count] : fresh[--more];
    }
}

void dp_tile_cover(const DpTerrain* terrain, long tx, long ty, float* plant)
{
    const double x0 = dp_grid_x(&terrain->grid, tx * DP_TILE);
    const double y0 = dp_grid_y(&terrain->grid, ty * DP_TILE);
    dp_memory_ease(2 * TILE_BYTES);  // of what grows there
    terrain->cover(terrain->cover_context, x0, y0, terrain->grid.cell, DP_TILE, DP_TILE, plant,
                   plant + TILE_CELLS);
}

typedef struct Filling
{
    const DpTerrain* terrain;
    Tile**           tile;
    bool             covered;
} Filling;

static void fill_tile(void* context, int index, int worker)
{
    const Filling*   filling = context;
    const DpTerrain* terrain = filling->terrain;
    Tile*            tile = filling->tile[index];
    const TileGrid   grid = dp_tile_grid(terrain, tile->tx, tile->ty);
    (void)worker;
    dp_memory_ease(TILE_BYTES);
    dp_source_tile(&terrain->source, &grid, tile->base_height, tile->kind);
    tile->revision = terrain->revision;
    if (terrain->rough) dp_rough_tile(terrain, tile);
    if (terrain->crusts) dp_plate_tile(terrain, tile);
    if (filling->covered) dp_tile_cover(terrain, tile->tx, tile->ty, tile->plant);
}

Tile* dp_tile_create(const DpTerrain* terrain, long tx, long ty)
{
    const size_t grids = tile_grids(terrain) + (size_t)terrain->coats;
    Tile*        tile = dp_alloc(1, sizeof *tile);
    float*       cell = dp_alloc((KEPT_FIELDS + 1 + grids) * sizeof(float) + 1, TILE_CELLS);
    if (!tile || !cell) {
        dp_free(tile), dp_free(cell);
        return NULL;
    }
    tile->tx = tx, tile->ty = ty;
    tile->base_height = cell;
#define TILE_NEXT(ID, name, number, unit, equation, meaning) tile->name = cell += TILE_CELLS;
    DP_TERRAIN_FIELDS(TILE_NEXT, DP_FIELD_NONE)
    tile->plant = cell + TILE_CELLS;
    tile->kind = (uint8_t*)(tile->plant + grids * TILE_CELLS);
    return tile;
}

void dp_tile_destroy(Tile* tile)
{
    if (!tile) return;
    dp_free(tile->base_height);
    dp_free(tile);
}

bool dp_tile_adopt(DpTerrain* terrain, Tile** fresh, size_t count, bool covered)
{
    if (!fit_tiles(terrain, count)) return false;
    Filling filling = {terrain, fresh, covered && terrain->cover};
    dp_parallel_for((int)count, terrain->workers, fill_tile, &filling);
    for (size_t t = 0; t < count; ++t)
        *find_slot(terrain->slot, terrain->slots, fresh[t]->tx, fresh[t]->ty) = fresh[t];
    merge(terrain->sorted, terrain->tiles, fresh, count);
    terrain->tiles += count;
    return true;
}

DpStatus dp_terrain_touch(DpTerrain* terrain, DpCellRect cells)
{
    if (!are_cells(cells)) return DP_BAD_ARGUMENT;
    const long tx0 = dp_tile_of(cells.i0), tx1 = dp_tile_of(cells.i1 - 1);
    const long ty0 = dp_tile_of(cells.j0), ty1 = dp_tile_of(cells.j1 - 1);
    if (tx1 - tx0 >= MAX_TILES_AT_ONCE || ty1 - ty0 >= MAX_TILES_AT_ONCE ||
        (tx1 - tx0 + 1) * (ty1 - ty0 + 1) > MAX_TILES_AT_ONCE)
        return DP_NO_MEMORY;

    size_t missing = 0;
    for (long ty = ty0; ty <= ty1; ++ty)
        for (long tx = tx0; tx <= tx1; ++tx) {
            Tile* tile = dp_tile_find(terrain, tx, ty);
            missing += !tile;
            if (tile && tile->revision != terrain->revision) dp_rough_again(terrain, tile);
        }
    if (missing == 0) return DP_OK;

    Tile** fresh = dp_alloc(missing, sizeof *fresh);
    size_t created = 0;
    bool   enough = fresh != NULL;
    for (long ty = ty0; ty <= ty1 && enough; ++ty)
        for (long tx = tx0; tx <= tx1 && enough; ++tx) {
            if (dp_tile_find(terrain, tx, ty)) continue;
            Tile* tile = dp_tile_create(terrain, tx, ty);
            enough = tile != NULL;
            if (enough) fresh[created++] = tile;
        }
    enough = enough && dp_tile_adopt(terrain, fresh, missing, true);
    for (size_t t = 0; t < created && !enough; ++t) dp_tile_destroy(fresh[t]);
    dp_free(fresh);
    return enough ? DP_OK : DP_NO_MEMORY;
}

// ---- which have changed ------------------------------------------------------------------------

static int by_row(const void* a, const void* b)
{
    const Tile* const one = *(Tile* const*)a;
    const Tile* const two = *(Tile* const*)b;
    return comes_before(one, two) ? -1 : comes_before(two, one) ? 1 : 0;
}

void dp_tile_mark(DpTerrain* terrain, Tile* tile)
{
    atomic_store(&tile->measured, 0);
    if (atomic_exchange(&tile->changed, 1) == 0)
        terrain->marked[atomic_fetch_add(&terrain->marks, 1)] = tile;
}

void dp_terrain_changed(DpTerrain* terrain, DpTileVisit visit, void* context)
{
    const size_t count = atomic_load(&terrain->marks);
    if (count == 0) return;
    qsort(terrain->marked, count, sizeof(Tile*), by_row);
    for (size_t t = 0; t < count; ++t) atomic_store(&terrain->marked[t]->changed, 0);
    atomic_store(&terrain->marks, 0);
    for (size_t t = 0; t < count; ++t)
        visit(context, terrain->marked[t]->tx, terrain->marked[t]->ty);
}
