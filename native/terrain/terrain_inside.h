// terrain/terrain_inside.h - what the files of this room share. Other rooms come in by terrain.h.
#pragma once
#include <limits.h>
#include <stdatomic.h>

#include "base/memory.h"
#include "terrain/terrain.h"

#define TILE_CELLS (DP_TILE * DP_TILE)
#if LONG_MAX > 0x7fffffff
#define MAX_CELL_INDEX (1L << 52)  // beyond it a cell's position is no longer exact
#else
#define MAX_CELL_INDEX (1L << 30)
#endif

// ---- the ground before any walker: terrain_source.c, _kinds.c, _mesh.c, _bins.c ----------------

#define MAX_GRIDS 16  // of bins: 2^15 bins along a side of the finest, one bin in the coarsest

// one of the grids; grid l has bins 2^l times as wide as the finest
typedef struct BinGrid
{
    int  nx, ny;
    int  first;  // its bin (0, 0) among all bins
    bool used;   // whether any triangle stands in it
} BinGrid;

// triangles in grids of bins: those of bin b are item[start[b]] .. item[start[b + 1] - 1]
typedef struct MeshGround
{
    int      vertex_count, triangle_count;
    double*  vertex;           // [m] (vertex_count, 3)
    int32_t* triangle;         // (triangle_count, 3)
    double   x0, y0, per_bin;  // corner of bin (0, 0) [m]; finest bins in a metre [1/m]
    int      nx, ny;           // finest bins
    BinGrid  grid[MAX_GRIDS];
    int      grids, bins;  // grids there are; bins of all of them
    int32_t* start;        // (bins + 1)
    int32_t* item;         // triangles, ascending within a bin
    double   somewhere;    // height of a corner of one that faces up or down [m]
} MeshGround;

// ground before any walker, as it was given; kind_weight goes by mesh vertex or height sample
typedef struct Source
{
    DpGroundKind kind;
    double       height;
    int          nx, ny;
    double       x0, y0, spacing;
    float*       heights;
    MeshGround   mesh;
    int          kind_count;
    size_t       weights;      // of each kind
    float*       kind_weight;  // (kind_count, weights)
    double       bounds[4];    // {x0, y0, x1, y1} [m]
    double       somewhere;    // height of some point of it [m]
} Source;

DpStatus dp_source_create(Source* source, const DpGround* ground, int workers);
void     dp_source_destroy(Source* source);

// Height at a point, NaN where there is none; the kind of ground there goes to *kind if not NULL.
double dp_source_at(const Source* source, double x, double y, uint8_t* kind);

// Where a tile's cells are. Positions come from the world's cell numbers alone, so a tile
// and a point query see the same numbers.
typedef struct TileGrid
{
    DpGrid world;
    double datum;
    long   i0, j0;  // world cell of the tile's cell (0, 0)
} TileGrid;

// Heights over the datum and kinds of a tile, (DP_TILE, DP_TILE): the bits of (float)(dp_source_at - base) at
// cell centres.
void dp_source_tile(const Source* source, const TileGrid* grid, float* height, uint8_t* kind);

DpStatus dp_mesh_create(MeshGround* mesh, const DpGround* ground, int workers, double bounds[4]);
void     dp_mesh_destroy(MeshGround* mesh);
double   dp_mesh_at(const Source* source, double x, double y, uint8_t* kind);
void     dp_mesh_tile(const Source* source, const TileGrid* grid, float* height, uint8_t* kind);

// Copy the weights of the kinds: `weights` numbers of each.
DpStatus dp_source_copy_weights(Source* source, const DpGround* ground, size_t weights);

// Heaviest of the kinds, the first of equals; kind k weighs sum of share[n] *
// kind_weight[k][of[n]].
uint8_t dp_source_kind(const Source* source, int count, const size_t* of, const double* share);

// ---- tiles: terrain_tiles.c --------------------------------------------------------------------

// places of the kept fields among each other, whatever their numbers are
#define KEPT_PLACE(ID, name, number, unit, equation, meaning) PLACE_##ID,
enum
{
    DP_TERRAIN_FIELDS(KEPT_PLACE, DP_FIELD_NONE) KEPT_FIELDS
};
#define TILE_BYTES ((KEPT_FIELDS + 2) * TILE_CELLS * sizeof(float))  // of a tile's cells, about

// A tile, and of its cells where they lie: these may have left memory (base/memory.h), it itself does not.
#define TILE_GRID(ID, name, number, unit, equation, meaning) float* name;
typedef struct Tile
{
    float* base_height;  // over the datum, NaN = no ground [m] (TILE_CELLS)
    DP_TERRAIN_FIELDS(TILE_GRID, DP_FIELD_NONE)
    uint8_t*   kind;
    long       tx, ty;
    int        revision;  // of the soils that its rough grids are of
    atomic_int changed;
    atomic_int measured;  // `highest` is of its cells as they are
    float      highest;   // terrain_grain.c                       [m]
    float*
        plant;  // on planted ground: strength, then E_v [Pa] (2, TILE_CELLS); then tile_rough, _spring, _waves, _plates
} Tile;

struct DpTerrain
{
    DpGrid   grid;
    double   datum;
    int      soil_count, workers;
    DpSoil*  soils;  // as they are now
    DpSoil*  row;    // soils at each time (times, soil_count); NULL = they do not change
    double*  time;   // [s] (times)
    int      times;
    int      revision;  // of what soils are like at rest: goes up when that changes
    float*   slope;     // tan(rest_angle) of each soil
    float*   wall;      // tan(wall_angle) of each soil, +inf = walls stand
    bool     walls;     // those of some soil do not stand
    bool     rough;     // some soil differs from place to place
    bool     springs;   // some soil comes back when a sole lifts
    bool     crusts;    // some soil has a crust
    DpLayer* layers;    // of each soil, terrain.h; NULL = none
    int*     layer_start;
    int      coats;  // soils that stick to soles, now or at another time
    int      coat_soil[DP_MAX_COATS];
    int*     coat_of_soil;  // of each soil, -1 = none
    int*
        name_of_soil;  // which field tells of it where it lies on top: its own, or its topmost layer's
    int    names;
    Source source;

    DpTerrainCover cover;  // NULL = nothing grows here
    const void*    cover_context;

    Tile**        slot;  // hash of (tx, ty): a power of two of slots, at most half of them full
    size_t        slots;
    Tile**        sorted;  // all tiles, ascending (ty, tx)
    Tile**        marked;  // tiles changed since the last dp_terrain_changed, in any order
    size_t        tiles;   // how many there are
    atomic_size_t marks;
};

// terrain_state.c: what a state tells of a tile
typedef enum Kept
{
    KEPT_TRAIL = 1,  // kept fields follow
    KEPT_COVER = 2   // strength and E_v, too
} Kept;

struct DpTerrainState
{
    DpTerrain ground;  // the terrain's own but for its tiles
    uint8_t*  kept;    // what was kept of each
};

// the kept grids of a tile, in the order of their fields
#define TILE_KEPT(ID, name, number, unit, equation, meaning) tile->name,
static inline float* tile_kept(Tile* tile, int k)
{
    float* const grid[] = {DP_TERRAIN_FIELDS(TILE_KEPT, DP_FIELD_NONE)};
    return grid[k];
}

static inline const float* tile_kept_in(const Tile* tile, int k)
{
    const float* const grid[] = {DP_TERRAIN_FIELDS(TILE_KEPT, DP_FIELD_NONE)};
    return grid[k];
}

// on rough ground rest slopes, wall slopes and unevenness of a tile, (ROUGH_GRIDS, TILE_CELLS)
#define ROUGH_GRIDS 3
static inline float* tile_rough(const DpTerrain* terrain, Tile* tile)
{
    return tile->plant + (terrain->cover ? 2 * TILE_CELLS : 0);
}

// where some soil comes back: how cells were pressed (TILE_CELLS), kept as the fields are
static inline float* tile_spring(const DpTerrain* terrain, Tile* tile)
{
    return tile_rough(terrain, tile) + (terrain->rough ? ROUGH_GRIDS * TILE_CELLS : 0);
}

// on rough ground whose soils change: how walls and rests differ there (2, TILE_CELLS), before any roughness
static inline float* tile_waves(const DpTerrain* terrain, Tile* tile)
{
    return tile_spring(terrain, tile) + (terrain->springs ? TILE_CELLS : 0);
}

// where some soil has a crust: the pieces in which it breaks (TILE_CELLS)
static inline uint32_t* tile_plates(const DpTerrain* terrain, Tile* tile)
{
    return (uint32_t*)(void*)(tile_waves(terrain, tile) +
                              (terrain->rough && terrain->row ? 2 * TILE_CELLS : 0));
}

// grids of a tile before those of the coats
static inline size_t tile_grids(const DpTerrain* terrain)
{
    return (terrain->cover ? 2u : 0u) + (terrain->rough ? ROUGH_GRIDS : 0u) +
           (terrain->springs ? 1u : 0u) + (terrain->rough && terrain->row ? 2u : 0u) +
           (terrain->crusts ? 1u : 0u);
}

// what soles left on a tile, of each soil that sticks (coats, TILE_CELLS), kept as the fields are
static inline float* tile_coats(const DpTerrain* terrain, Tile* tile)
{
    return tile->plant + tile_grids(terrain) * TILE_CELLS;
}

static inline const float* tile_coats_in(const DpTerrain* terrain, const Tile* tile)
{
    return tile->plant + tile_grids(terrain) * TILE_CELLS;
}

// terrain_coats.c: which soils stick; more than there can be: DP_BAD_ARGUMENT. What lies on top of a row of a tile's cells.
DpStatus dp_coats_find(DpTerrain* terrain);   // .. at first, each soil by a name of its own
DpStatus dp_coats_count(DpTerrain* terrain);  // .. of soils as they are named
void     dp_coats_row(const DpTerrain* terrain, const Tile* tile, size_t at, int count, int field,
                      const uint8_t* kind, float* out);

// terrain_rough.c: the pieces of a crust, of a tile whose kinds are known
void dp_plate_tile(const DpTerrain* terrain, Tile* tile);

// terrain_rough.c: what soils are like at rest, at all times and now; and from place to place, of a tile whose kinds
// are known; the same once more, where soils have changed since
bool dp_rough_soils(DpTerrain* terrain);
void dp_soil_slopes(DpTerrain* terrain);
void dp_rough_tile(const DpTerrain* terrain, Tile* tile);
void dp_rough_again(const DpTerrain* terrain, Tile* tile);

// terrain_wet.c: a soil with what its wetness makes of its numbers; a dry one as it is
DpSoil dp_wet_soil(const DpSoil* soil);

// terrain_times.c: keep rows of soils, checked; DP_OK where there are none
DpStatus dp_times_keep(DpTerrain* terrain, const DpTerrainOptions* options);

// strength and E_v of all of a tile, (2, TILE_CELLS)
void dp_tile_cover(const DpTerrain* terrain, long tx, long ty, float* plant);

// let the next dp_terrain_changed tell of a tile
void dp_tile_mark(DpTerrain* terrain, Tile* tile);

// the part of a rectangle of cells that one tile holds
typedef struct TilePart
{
    long   tx, ty;
    int    i, j, nx, ny;  // in the rectangle
    size_t in_tile;       // its first cell in the tile
} TilePart;
TilePart dp_tile_part(long tx, long ty, DpCellRect cells);

// A tile of which only the place is known, for dp_tile_adopt; NULL without memory.
Tile* dp_tile_create(const DpTerrain* terrain, long tx, long ty);
void  dp_tile_destroy(Tile* tile);  // NULL is fine

// Take new tiles in, ascending (ty, tx): as the ground is, and as its cover is if `covered`. False without
// memory: then they are still the caller's.
bool dp_tile_adopt(DpTerrain* terrain, Tile** fresh, size_t count, bool covered);

// Number t of all tiles, by (ty, tx), whose cells are looked at.
static inline Tile* tile_at(const DpTerrain* terrain, size_t t)
{
    dp_memory_ease(TILE_BYTES);
    return terrain->sorted[t];
}

// NULL if nobody touched it.
Tile*    dp_tile_find(const DpTerrain* terrain, long tx, long ty);
TileGrid dp_tile_grid(const DpTerrain* terrain, long tx, long ty);

// whether there are cells, and all at numbers whose places are exact
static inline bool are_cells(DpCellRect cells)
{
    const long end = MAX_CELL_INDEX;
    return !dp_cells_empty(cells) && cells.i0 > -end && cells.i1 < end && cells.j0 > -end &&
           cells.j1 < end;
}
