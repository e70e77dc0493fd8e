// base/types.h - the nouns that travel between rooms.
//
//   DpGait -> DpFootContact -> DpFootForce -> DpSoilPatch -> (tiles changed) -> maps
//
// The frame, said once: SI units, radians, right-handed, +Z up, gravity (0, 0, -9.81) m/s^2.
// Recordings are double, grids are float, sums are double. Grids are row-major with +x along a row
// and +y from row to row; cell (i, j) sits at j * row + i. Forces are those of the foot on the
// ground. Compression counts downward and is positive.
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/number.h"
#include "base/soil_numbers.h"

#define DP_GRAVITY 9.81  // g [m/s^2]
#define DP_PI 3.14159265358979323846
#define DP_TILE 64  // cells along one side of a terrain tile and of a playback tile

typedef struct DpVec3
{
    double x, y, z;
} DpVec3;

typedef struct DpQuat
{
    double w, x, y, z;
} DpQuat;

// Where a part is: a point of its frame goes to  at + turn * point.
typedef struct DpPose
{
    DpVec3 at;    // [m]
    DpQuat turn;  // unit quaternion
} DpPose;

// A triangle mesh in its own frame. Owned by whoever created it.
typedef struct DpMesh
{
    int            vertex_count;
    int            triangle_count;
    const float*   vertex;    // [m] (vertex_count, 3)
    const int32_t* triangle;  // indices into vertex (triangle_count, 3)
} DpMesh;

// What a contact point is, since toes stay down longer than heels. TRAIL (4).
typedef enum DpPointRole
{
    DP_POINT_HEEL = 0,
    DP_POINT_BALL = 1,
    DP_POINT_TIP = 2
} DpPointRole;

// What the walkers did. W walkers own L limbs, L limbs own P parts, P parts own K contact points.
// A part is a rigid piece that touches the ground: heel, toe, hoof, paw, wheel, box.
typedef struct DpGait
{
    int times, walkers, limbs, parts, points;  // T, W, L, P, K

    const double*  time;         // strictly increasing                         [s]    (T)
    const double*  com;          // centre of mass of each walker               [m]    (W, T, 3)
    const double*  mass;         // > 0                                         [kg]   (W)
    const double*  pose;         // at (x, y, z), unit quaternion (w, x, y, z)  [m, -] (P, T, 7)
    const int32_t* limb_walker;  // walker of each limb                         [-]    (L)
    const int32_t* part_limb;    // limb of each part                           [-]    (P)
    const DpMesh*  sole;         // what presses the ground, in the part's frame       (P)
    const double*  point;        // contact points, in the part's frame         [m]    (K, 3)
    const int32_t* point_part;   // part of each contact point                  [-]    (K)
    const int32_t* point_role;   // DpPointRole of each contact point           [-]    (K)
    const uint8_t*
        contact_law;  // DpContactLaw of each walker, DP_LAW_ANY: as others do; NULL: all (W)
} DpGait;

#define DP_LAW_COUNT 3  // laws of soil/soil.h
#define DP_LAW_ANY 255  // presses by the law that the simulation goes by

// One kind of ground. Start from dp_soil_default() and change what you know.
// base/soil_numbers.h has the meaning, unit and range of each number.
typedef struct DpSoil
{
    DP_SOIL_NUMBERS(DP_FLOAT_MEMBER)
} DpSoil;

// One of several that ground is made of.
typedef struct DpLayer
{
    DpSoil soil;
    double thickness;  // [m] > 0
    int    name;       // of its soil among all that the ground is made of, 0 ..
    int    place;  // which of the ground's layers it is, 0 = the topmost; some places may lack it
} DpLayer;

static inline bool dp_has_crust(const DpSoil* soil)
{
    return soil->crust_depth > 0.0f && soil->crust_strength > 0.0f;
}

// A dense window of ground, acquired from the terrain by a lease and committed when kernels have changed it.
// All grids are (ny, nx) with `row` cells from one row to the next.
typedef struct DpSoilPatch
{
    int    nx, ny, row;
    double cell;    // side of a cell                                    [m]
    double x0, y0;  // world position of the centre of cell (0, 0)       [m]

    const float*
           base_height;    // h0, ground before any walker, over the terrain's base; NaN = none [m]
    float* compression;    // h_c, pressed below h0              [m]  >= 0
    float* heap;           // h_a, loose soil piled on top       [m]  >= 0
    float* pressure_time;  // sigma_acc, TRAIL (17)              [Pa s] >= 0
    const float*   modulus;     // E = E_g + E_v, TRAIL (9)           [Pa] > 0
    const float*   rest_slope;  // tan(gamma_r)                       [-]  > 0
    const uint8_t* kind;        // index into the table of soils      [-]

    const DpSoil* soils;  // the table of soils
    int           soil_count;

    float* pressure;  // sigma under the sole at hand, where it presses; NULL = not asked for [Pa]

    const float* wall_slope;  // tan(gamma_w), +inf = walls stand; NULL = all do [-] > 0
    const float* uneven;      // rho n, MODEL 6.7; NULL = 0                       [-]
    float*       spring;      // how it was pressed, soil_rebound.c; NULL = nothing comes back [m]

    const uint32_t*
        plate;  // piece of a crust in which a cell lies, 0 = none; NULL = no crust, MODEL 6.12

    // Ground of several layers: those of kind k are layers[layer_start[k]] .. [layer_start[k + 1] - 1], from the top down,
    // and soils[k] is the topmost, with the thickness of all of them as its L0; NULL = each kind is one soil
    const DpLayer* layers;
    const int*     layer_start;

    float*
        coat;  // what soles have left on top, of soils that stick (coats, coat_stride); NULL = none [m]
    size_t     coat_stride;
    const int* coat_soil;     // which soil each is of (coats)
    const int* coat_of_soil;  // coat of each soil, -1 = it does not stick (soil_count)
} DpSoilPatch;

// How far what is over the ground at (x, y, z) has gone along it since the step before, to first order:
// at + by_x (x - x_m) + by_y (y - y_m) + by_z z, (x_m, y_m) the middle of the patch.
typedef struct DpSlide
{
    double at[2];                      // along x and y [m]
    double by_x[2], by_y[2], by_z[2];  // [m per m]
    double owed;  // what it has slid over and not cut yet, since columns are covered by leaps [m^3]
    double
        held;  // share of what it meets that only shears along with it and does not flow yet  0..1
} DpSlide;

// A limb's sole over a patch: its lower envelope, one column per cell, and the rings around it.
// Grids have the patch's shape and row. imprint/imprint.h fills it, soil/soil.h reads it.
typedef struct DpImprint
{
    float*   bottom;  // height of the sole's underside, +inf where there is none     [m]
    float*   cover;   // share of the cell the sole covers                            [-] 0..1
    int32_t* ring;    // 0 = touched, 1 = border, 2.. outward, DP_RING_FAR beyond     [-]
                      // DP_RING_HELD: another sole stands there

    const float* met;  // heap - compression as this contact met them; NULL = as they are [m]

    DpSlide* slide;  // how the sole slides, MODEL 6.18; NULL: it does not
    float*   goal;   // room, where it slides: how deep a column is pressed, by its cover [m]

    int i0, i1, j0, j1;  // columns with cover > 0: i0 <= i < i1, j0 <= j < j1; empty if i0 >= i1
} DpImprint;

#define DP_RING_FAR 32767
#define DP_RING_HELD (-1)

// The force one limb puts on the ground at one time.
typedef struct DpFootForce
{
    DpVec3 force;   // of the foot on the ground: z < 0 presses  [N]
    DpVec3 point;   // centre of pressure                        [m]
    DpVec3 normal;  // of the smoothed base ground, unit         [-]
} DpFootForce;
