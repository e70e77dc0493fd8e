// soil/soil.h - loose ground that is pressed, pushed aside, and comes to rest.
//
//   compress ---volume---> accumulate ---heaps---> stabilize
//   TRAIL (9)(10)          TRAIL (11)-(13)         TRAIL (14)-(16)
//   SOFT22 (9)-(11)        SOFT22 (12)-(14)
//
// Nothing here owns or remembers: a patch goes in and comes back changed. Scratch memory is the
// caller's DpSoilScratch.
#pragma once
#include "base/grid.h"
#include "base/number.h"
#include "base/status.h"
#include "base/types.h"

// Soil between firm and soft, the defaults of base/soil_numbers.h.
DpSoil dp_soil_default(void);

// The table of base/soil_numbers.h, in the order of DpSoil; *count of them.
const DpNumber* dp_soil_numbers(int* count);

// DP_OK if every number of the soil is in its range; else which is not, if `reason` is there.
DpStatus dp_soil_check(const DpSoil* soil, DpReason* reason);

// Scratch memory of one thread; it grows and is kept.
typedef struct DpSoilScratch DpSoilScratch;
DpSoilScratch*               dp_soil_scratch_create(void);
void                         dp_soil_scratch_destroy(DpSoilScratch* scratch);

// ---- TRAIL (9) (10): pressed down -------------------------------------------------------------

typedef enum DpContactLaw
{
    DP_CONTACT_SOLE = 0,     // a rigid sole on springs, one sink for the limb (ours; MODEL 6.2)
    DP_CONTACT_UNIFORM = 1,  // one stress for all touched cells, as in the papers
    DP_CONTACT_CARVE = 2     // down to where the body is, whatever it weighs (MODEL 6.11)
} DpContactLaw;

// What one step of pressing did.
typedef struct DpPressed
{
    double firm;          // V_c, volume pressed out of firm ground                [m^3] >= 0
    double elastic;       // volume that had come back and is pressed again        [m^3] >= 0
    double loose;         // V_b, volume pressed out of loose heaps                [m^3] >= 0
    double displaced;     // 2 nu (V_c + V_b), to be laid down around, SOFT22 (12) [m^3] >= 0
    double area;          // A_contact, TRAIL (10), over no ground too             [m^2] >= 0
    double sink;          // s: how far the sole was lowered (> 0) from imprint->bottom [m]
    double deepest;       // largest compression of a touched cell                 [m]   >= 0
    double cut_firm;      // of a sole that slides: firm volume that was in its way [m^3] >= 0
    double cut_loose;     // .. and loose, to be laid down ahead with what was firm [m^3] >= 0
    double cut_x, cut_y;  // .. both, times the direction in which the sole goes there [m^3]
    int    rounds;        // sinks that were tried until the ground carried the load   [-]   >= 0
} DpPressed;

// What a soil presses back with is E/L0 times its depth, or by its snow_density or Bekker's numbers, MODEL 6.14.
// By the laws of a sole, not DP_CONTACT_CARVE: press the sole into the patch for dt seconds with the force's part along -normal.
// Sets imprint->ring to 0 on touched cells and to DP_RING_FAR elsewhere; changes compression, heap
// and pressure_time of touched cells only. Loose heap is used up before firm ground yields.
// What of the sole stands over no ground carries its share of the load all the same, and presses nothing.
// What stands in the way of a sole that slides (imprint->slide) is cut first: MODEL 6.18.
// With no load, or no ground under the sole: nothing touched, all zero, DP_OK.
DpStatus dp_soil_compress(DpSoilPatch* patch, DpImprint* imprint, const DpFootForce* foot,
                          DpContactLaw law, double dt, DpPressed* pressed);

// How far a body has come down in a step: each point of it, which is now at (x, y, z), by
// at + along_x (x - x_m) + along_y (y - y_m) + along_z z, (x_m, y_m) the middle of the patch; less than 0: it has risen.
typedef struct DpDescent
{
    double at;                         // [m]
    double along_x, along_y, along_z;  // [m per m]
} DpDescent;

// What one step of carving did.
typedef struct DpCarved
{
    DpPressed pressed;              // sink is 0; area is that of the body's contact
    double    cut_firm, cut_loose;  // volume it has met, to be laid down ahead [m^3] >= 0
    double    x, y;                 // middle of the contact [m]
} DpCarved;

// Push the surface down to a body wherever it stands above the underside. Of what a column loses it is pressed by no more
// than the body has come down there; what is left was cut, as by a plough. imprint: all that the body was in since the last
// step. Sets imprint->ring to 0 on touched cells and to DP_RING_FAR elsewhere; changes compression, heap and pressure_time
// of touched cells only. Pressure is what the columns would press back with, E/L0 times their depth.
DpStatus dp_soil_carve(DpSoilPatch* patch, DpImprint* imprint, const DpDescent* descent, double dt,
                       DpCarved* carved);

// Where no sole stands any more, a share of the depth comes back; imprint as the step left it, NULL: nobody stands.
// Changes compression and spring. @return the volume that has come back [m^3] >= 0
double dp_soil_rebound(DpSoilPatch* patch, const DpImprint* imprint);

// A patch that was trodden before, and nobody knows by whom: what is pressed is what a sole left whose ground has come
// back. Changes spring only.
void dp_soil_spring_trodden(DpSoilPatch* patch);

// How far from a sole a piece of a crust that it breaks can reach; 0 without a crust [m]
double dp_soil_crust_margin(const DpSoil* soil);

// The bending stress of a soil's crust under a load, or at its edge if it stands on one, Westergaard 1926; MODEL 6.12
// @param load  [N] on an area [m^2] > 0; stiffness  E/L0 of what lies below [Pa/m] > 0
double dp_soil_crust_stress(const DpSoil* soil, double load, double area, double stiffness,
                            bool edge);

// ---- layers -------------------------------------------------------------------------------------

// How much of a depth [m] one of several layers has yielded, 0 = the topmost [m]; MODEL 6.17.
double dp_soil_layer_pressed(const DpLayer* layers, int count, int layer, double depth);

// ---- slip ---------------------------------------------------------------------------------------

#define DP_MAX_SLIP 0.05  // a sole slips no farther in a stance [m]

// How far soil shears under a sole before it carries a force along the ground: the j at which
// F = N tan(gamma_r) (1 - exp(-j / K)), Janosi and Hanamoto 1961.
// @param along   F, along the ground             [N] >= 0
// @param weight  N, square to the ground         [N] >= 0
// @return j  0 on soil that does not slip or without a load; no more than DP_MAX_SLIP  [m]
double dp_soil_slip(const DpSoil* soil, double along, double weight);

// ---- TRAIL (11)-(13): pushed aside ------------------------------------------------------------

// How one-sided the heap is, TRAIL (13): 0 = even all round, 1 = only along the push.
// @param push       tangential part of the foot's force  [N]
// @param threshold  F_threshold                           [N] > 0
double dp_soil_anisotropy(DpVec3 push, double threshold);

typedef enum DpHeapLaw
{
    DP_HEAP_REST = 0,  // laid at once in its resting shape (ours; MODEL 6.3)
    DP_HEAP_PAPER = 1  // laid on a rim of fixed width, to be relaxed, TRAIL (12)
} DpHeapLaw;

typedef struct DpHeapOptions
{
    DpHeapLaw law;
    double    rim_width;  // `paper`: how wide the rim is, at least one cell [m] > 0
    double    threshold;  // F_threshold, TRAIL (13)                      [N] > 0
    DpVec3
        cut;  // of what is laid, the share that was cut, not displaced, times the way it is pushed:
              // u_k of TRAIL (11) is away from the touched cells then                  [-] <= 1
} DpHeapOptions;

// Lay `volume` [m^3] >= 0 around the touched cells. Rings are numbered on entry (dp_imprint_rings,
// 1 is enough). Adds to patch->heap only, never on touched or held cells; the heaps' sum grows by
// volume / cell^2 up to rounding. `height` is T of the resting law, kept by the caller from step to
// step of one stance as the first guess; 0 at touch-down.
// Without a border cell: DP_NO_GROUND, patch untouched.
DpStatus dp_soil_accumulate(DpSoilPatch* patch, const DpImprint* imprint, const DpFootForce* foot,
                            double volume, const DpHeapOptions* options, double* height,
                            DpSoilScratch* scratch);

// ---- TRAIL (14)-(16): comes to rest -----------------------------------------------------------

typedef struct DpSettled
{
    int        sweeps;    // sweeps done                                            [-]
    bool       at_rest;   // no loose slope exceeds the rest angle by more than the tolerance
    bool       at_edge;   // loose soil wants to leave the patch: acquire a larger one
    DpCellRect changed;   // cells of the patch
    double     loosened;  // firm ground that fell from walls and is loose now, MODEL 6.8 [m^3] >= 0
} DpSettled;

// Let loose soil slide until no slope of it exceeds gamma_r + tolerance [rad], and firm walls until none that
// was cut exceeds gamma_w + tolerance, or for `max_sweeps`.
// Nothing slides onto or off the cells with ring == 0 or DP_RING_HELD of `imprint` (a sole stands there);
// imprint may be NULL. Volume is conserved and the order of cells does not matter.
// Only cells of the patch `within` are looked at first; NULL = all of it.
DpStatus dp_soil_stabilize(DpSoilPatch* patch, const DpImprint* imprint, const DpCellRect* within,
                           double tolerance, int max_sweeps, DpSoilScratch* scratch,
                           DpSettled* settled);
