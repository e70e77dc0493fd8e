// terrain/terrain.h - ground without end: sparse tiles inside, dense patches leased. MODEL 6.1
//
//   ground (flat | heights | mesh) ---first touch---> tile of DP_TILE x DP_TILE cells
//   tiles ---acquire---> DpSoilPatch ---kernels---> commit ---> tiles changed
//
// Cells may have negative numbers; tile (tx, ty) holds cells tx * DP_TILE .. + DP_TILE - 1. A tile nobody
// touched takes no memory. Asking for a height allocates nothing.
#pragma once
#include "base/grid.h"
#include "base/status.h"
#include "base/stream.h"
#include "base/types.h"
#include "terrain/terrain_fields.h"

typedef struct DpTerrain DpTerrain;

// Where the ground is before any walker, its base height. Arrays are copied.
typedef enum DpGroundKind
{
    DP_GROUND_FLAT = 0,
    DP_GROUND_HEIGHTS = 1,  // a regular grid of heights, bilinear between samples
    DP_GROUND_MESH = 2      // triangles; the upper envelope counts
} DpGroundKind;

typedef struct DpGround
{
    DpGroundKind kind;
    double       height;  // flat: its height; heights: added to every sample [m]

    int          nx, ny;           // heights: samples
    double       x0, y0, spacing;  // heights: position of sample (0, 0), step        [m]
    const float* heights;          // heights: NaN = no ground                        [m] (ny, nx)

    int            vertex_count;  // mesh
    int            triangle_count;
    const double*  vertex;    // mesh, world frame                               [m] (n, 3)
    const int32_t* triangle;  // mesh                                            (m, 3)

    int          kind_count;   // soils the ground is painted with, 0 = all of it is soil 0
    const float* kind_weight;  // weight of each soil per mesh vertex or height sample
                               //   [-] >= 0 (kind_count, n); the heaviest wins, the first of equals
} DpGround;

typedef struct DpTerrainOptions
{
    DpGrid        grid;   // its cells
    const DpSoil* soils;  // copied; kinds index it; with times a row for each (times, soil_count)
    int           soil_count;  // 1..255
    int           workers;     // threads for filling tiles, >= 1

    int times;           // soils that change over time: so many rows; 0 = they do not    MODEL 6.10
    const double* time;  // of each row, never falling [s] (times)
} DpTerrainOptions;

DpStatus dp_terrain_create(DpTerrain** terrain, const DpTerrainOptions* options,
                           const DpGround* ground);
void     dp_terrain_destroy(DpTerrain* terrain);

DpGrid        dp_terrain_grid(const DpTerrain* terrain);
int           dp_terrain_soil_count(const DpTerrain* terrain);
const DpSoil* dp_terrain_soils(
    const DpTerrain* terrain);  // as they are at the time at hand, and as wet, MODEL 6.13
// From now on soils are as they are at a time [s], MODEL 6.10; before the first row and after the last they stay. What
// is pressed stays as it is. No patch may be out.
void dp_terrain_set_time(DpTerrain* terrain, double time);
#define DP_MAX_COATS 16  // soils that stick; more: DP_BAD_ARGUMENT
#define DP_COVERS 0.002  // so thick a coat, or layer, hides what lies below, MODEL 6.16, 6.17 [m]
// How many soils stick to soles, now or at another time, and which; how much of each lies on the ground as coats [m^3].
int    dp_terrain_coats(const DpTerrain* terrain, const int** soils);
double dp_terrain_coat_volume(const DpTerrain* terrain, int coat);
// From now on ground lies in layers, before any tile is there: those of soil k, from the top down with the ground below as
// the last, are layers[start[k]] .. [start[k + 1] - 1], at most 4; soils[k] is the topmost with the thickness of all of
// them as its L0. start (soil_count + 1) begins with 0. Not of soils that change over time. Soils whose topmost layers have
// one name are one soil to what sticks, and fields of a soil count by names from then on. MODEL 6.17
DpStatus dp_terrain_set_layers(DpTerrain* terrain, const DpLayer* layers, const int* start);
// The layers of a kind of ground; NULL where it is one soil.
const DpLayer* dp_terrain_layers(const DpTerrain* terrain, int kind, int* count);
// Whether some soil comes back when a sole lifts, now or at another time.
bool dp_terrain_springs(const DpTerrain* terrain);
// World box of the ground: {x0, y0, x1, y1} [m]; infinite for flat ground.
void dp_terrain_bounds(const DpTerrain* terrain, double bounds[4]);

// The datum: heights on tiles are floats and count from here [m], a multiple of 16 near the ground, so
// that prints are as exact far up as at sea level. While there is neither a tile nor a plant it can be
// moved near to `height`.
double dp_terrain_datum(const DpTerrain* terrain);
void   dp_terrain_move_datum(DpTerrain* terrain, double height);

// Height of the ground before any walker at `count` points xy (count, 2) [m]; NaN where there is none.
void dp_terrain_base_height(const DpTerrain* terrain, int count, const double* xy, double* height);

// Normal of the plane that fits the base heights best in a disc of `radius` [m] about (x, y);
// +Z where there is no ground.
DpVec3 dp_terrain_normal(const DpTerrain* terrain, double x, double y, double radius);

// Allocate the tiles of a rectangle of cells, in parallel, before
// patches are acquired. Tiles that are there stay as they are.
DpStatus dp_terrain_touch(DpTerrain* terrain, DpCellRect cells);

// The memory of one patch of the terrain; create one per thread and reuse it.
typedef struct DpLease DpLease;
DpLease*               dp_lease_create(void);
void                   dp_lease_destroy(DpLease* lease);

// Copy cells into the lease and allocate tiles that are missing. The patch
// is valid until the lease acquires another. Patches that do not overlap may be out at once
// if their tiles were touched before (dp_terrain_touch) -- this is what sim does.
DpStatus dp_terrain_acquire(DpTerrain* terrain, DpLease* lease, DpCellRect cells,
                            DpSoilPatch** patch);

// Copy compression, heap and pressure_time of some cells, counted in the patch, back
// into the tiles and mark the tiles in which a value is new.
void dp_terrain_commit(DpTerrain* terrain, DpLease* lease, DpCellRect within);

// A trail somebody left: cells (nx, ny) from (i0, j0) on, all values finite and >= 0.
typedef struct DpTrail
{
    long         i0, j0;
    int          nx, ny;
    const float* compression;    // [m] (ny, nx)
    const float* heap;           // [m] (ny, nx)
    const float* pressure_time;  // [Pa s] (ny, nx)
    void (*as_left)(
        DpSoilPatch* patch);  // sets its springs: dp_soil_spring_trodden; NULL: all stays pressed
} DpTrail;

// Lay a trail down in place of what is there; cells without ground stay without. Tiles of which the
// trail says nothing but zeros are left as they are. Bad sizes or values: DP_BAD_ARGUMENT, nothing
// is laid.
DpStatus dp_terrain_lay(DpTerrain* terrain, const DpTrail* trail);

// ---- little by little --------------------------------------------------------------------------

// What was taken of a place [m^3]: of heaps, and of firm ground, of which no more goes than was pressed there.
typedef struct DpDug
{
    double  heap, firm;
    uint8_t kind;  // soil
} DpDug;

// Take a volume [m^3] from a square `width` wide [m], at least a cell, about (x, y); all of it, or false and nothing.
bool dp_terrain_dig(DpTerrain* terrain, double x, double y, double width, double volume,
                    DpDug* dug);
// Lay it down as loose soil; *cells are those it lies on, *laid how much it is [m^3]: 0 where there is no ground.
DpStatus dp_terrain_drop(DpTerrain* terrain, double x, double y, double width, double volume,
                         DpCellRect* cells, double* laid);
// How high a tile's surface is at its highest, over the datum [m], -INFINITY without ground. It is touched first;
// INFINITY where there is no memory for it.
double dp_terrain_highest(DpTerrain* terrain, long tx, long ty);
// Whether one of some cells stands higher over a neighbour than its soil may rest.
bool dp_terrain_steep(const DpTerrain* terrain, DpCellRect cells);

// ---- what grows on it ------------------------------------------------------------------------

// alpha_veg [-] and E_v [Pa] of cells (ny, nx), the first with its centre at (x0, y0); a pure
// function, called from several threads. TRAIL (7), TRAIL (8)
typedef void (*DpTerrainCover)(const void* context, double x0, double y0, double cell, int nx,
                               int ny, float* strength, float* roots);

// From now on the ground is planted: a tile asks for its cover when it is created, an untouched one
// whenever it is read. Once tiles are there: DP_BAD_ARGUMENT.
DpStatus dp_terrain_set_cover(DpTerrain* terrain, DpTerrainCover cover, const void* context);

// Cover has changed on some cells: tiles that are there ask for it again.
void dp_terrain_refresh_cover(DpTerrain* terrain, DpCellRect cells);

// ---- reading ---------------------------------------------------------------------------------

// Whether there are nx x ny cells from (i0, j0) on: at least one, and all at numbers whose places are exact.
bool dp_terrain_has(long i0, long j0, long nx, long ny);

// terrain_fields.h has the meaning and unit of each.
#define DP_FIELD_NUMBER(ID, name, number, unit, equation, meaning) DP_FIELD_##ID = number,
typedef enum DpField
{
    DP_FIELD_NONE = -1,  // so that a field is a number with a sign to every compiler
    DP_TERRAIN_FIELDS(DP_FIELD_NUMBER, DP_FIELD_NUMBER)
} DpField;
// Beyond those: how much of what is seen is of soil k, 0..1, and how thick soles have left it [m] >= 0.
#define DP_FIELD_SURFACE 1000
#define DP_FIELD_COAT 2000
#define DP_FIELD_OF_SOIL 255  // k from 0 to less than this
bool dp_terrain_knows(const DpTerrain* terrain, int field);

typedef struct DpFieldInfo
{
    int         field;  // a DpField, or one that only a simulation knows
    const char *name, *unit, *equation, *meaning;
} DpFieldInfo;

// All of them, ascending; *count how many.
const DpFieldInfo* dp_terrain_fields(int* count);

// Copy a rectangle of cells (nx, ny from cell i0, j0) into out (ny, nx). Untouched cells read 0
// (base height, modulus and kind are computed from the ground). Cells that there cannot be: DP_BAD_ARGUMENT.
DpStatus dp_terrain_read(const DpTerrain* terrain, int field, long i0, long j0, int nx, int ny,
                         float* out);

// Tiles changed since the last call: calls visit(context, tx, ty) in ascending (ty, tx) order and
// clears the marks.
typedef void (*DpTileVisit)(void* context, long tx, long ty);
void dp_terrain_changed(DpTerrain* terrain, DpTileVisit visit, void* context);

// A field of all of a tile, row 0 = lowest y: cell (i, j) at out[(j * DP_TILE + i) * stride].
void dp_terrain_tile(const DpTerrain* terrain, long tx, long ty, int field, float* out, int stride);

// Heights of the current surface over the datum, h0 - compression + heap [m], NaN = no ground, of a rectangle of
// cells whose tiles were touched; out (ny, nx).
void dp_terrain_surface(const DpTerrain* terrain, long i0, long j0, int nx, int ny, float* out);

// The same at a point, bilinear between cells; the base height where no tile was touched.
double dp_terrain_surface_at(const DpTerrain* terrain, double x, double y);

// Sum of heap and of compression over all tiles, times cell^2 [m^3], and the deepest compression [m].
void dp_terrain_totals(const DpTerrain* terrain, double* heaped, double* pressed, double* deepest);
size_t dp_terrain_tile_count(const DpTerrain* terrain);

// ---- kept from run to run ----------------------------------------------------------------------

// Write a chunk: which tiles there are, and what walkers and wear have made of them.
void dp_terrain_save(const DpTerrain* terrain, DpStateWriter* writer);

// Read it, for this ground with these soils: of another, or damaged: DP_BAD_FILE. The terrain stays as
// it is until it is restored.
typedef struct DpTerrainState DpTerrainState;
DpStatus dp_terrain_load(const DpTerrain* terrain, DpStateReader* reader, DpTerrainState** state);
// It goes on from there, to the bit; the state is gone afterwards. It cannot fail. What grows is asked
// for its cover, so restore plants first. The next dp_terrain_changed tells of all tiles that differ from
// bare ground; those that are gone are not reported.
void dp_terrain_restore(DpTerrain* terrain, DpTerrainState* state);
void dp_terrain_state_destroy(DpTerrainState* state);  // not taken; NULL is fine
// Take some tiles (count, 2) of it, x and y of each, rising by (y, x), and none that the terrain has; the state is gone
// afterwards. Tiles it does not hold, or that are there, or planted ground: DP_BAD_ARGUMENT, and all is as it was.
DpStatus dp_terrain_join(DpTerrain* terrain, DpTerrainState* state, const int32_t* tile,
                         size_t count);
// All tiles there are (dp_terrain_tile_count, 2), x and y of each, rising by (y, x).
void dp_terrain_list(const DpTerrain* terrain, int32_t* tile);

// ---- a mesh as other programs keep it ----------------------------------------------------------

typedef struct DpFaces
{
    int            point_count, face_count, corner_count;
    const float*   point;   // in the object's own space (point_count, 3)
    const int32_t* corner;  // point of every corner, face by face (corner_count)
    const int32_t* start;   // first corner of every face (face_count + 1); NULL: each has `sides`
    int            sides;   // 3 or 4
} DpFaces;

// Triangles of the world, and the points they need.
typedef struct DpCut
{
    int      bad;              // first point that is not finite, -1 = none; else there is no more
    float    low[3], high[3];  // box of all points, in the object's own space
    int      point_count, triangle_count;
    int32_t* of;        // number of the point in the mesh that was cut (point_count)
    double*  vertex;    // [m] (point_count, 3)
    int32_t* triangle;  // (triangle_count, 3)
} DpCut;

// Cut the faces that reach into a rectangle of the world into triangles: quads along the diagonal
// that lies inside, in the faces' order. Faces are 3 or 4 corners; others: DP_BAD_ARGUMENT.
// @param place  rows of the map from own space to the world (3, 4) [m]
// @param box    x0, y0, x1, y1 [m]: faces wholly beyond one side are left out; NULL = none is
DpStatus dp_mesh_cut(const DpFaces* faces, const double place[12], const double* box, int workers,
                     DpCut* cut);
void     dp_cut_free(DpCut* cut);

// Whether faces, of which only the corners, the edge from each corner to the next one of its face,
// and the two points of each edge are known, are quads alone.
bool dp_are_quads(int corners, const int32_t* corner, const int32_t* corner_edge, int edges,
                  const int32_t* edge, int workers);

// Whether all points (count, 3) [m] lie within `max_offset` [cells] of the centres of the cells they lie in.
bool dp_are_centres(int count, const double* vertex, double cell, const double origin[2],
                    double max_offset, int workers);
