// plants/plants.h - grass that bends under feet, wears, breaks, grows again and holds the soil. MODEL 7
//
//   add ---> step: solve ---> wear ---> cover, roots ---> soil
//            TRAIL (5)        TRAIL (6)  TRAIL (7)(8)     TRAIL (9)
//
// A plant is a grid of particles: sheets of stems side by side, rows from the root upward. The two
// lowest rows are held by the ground: row 0 is the root, one spacing deep, row 1 sits on the
// surface. Plants far from feet and at rest sleep, unbroken ones without memory: cost follows the
// walkers.
//
// Departures
//   Rows sit height / (rows - 2) apart, so that a plant stands as high over the ground as it says.
//   TRAIL (5): bending is the second difference along a stem against that of its rest shape; its
//   length is the chord of (phi - phi_0), and it knows to which side the stem leans.
//   Gravity pulls what is limp; unbroken stems are built as they hang.
//   TRAIL (6)(7): what is above a broken bend is limp, wears no more and holds nothing.
//   TRAIL (7): a stand denser than full cover counts 1; `paper` is as printed.
#pragma once
#include "base/number.h"
#include "base/status.h"
#include "base/stream.h"
#include "base/types.h"

typedef enum DpPlantForm
{
    DP_PLANT_SURFACE = 0,  // one sheet of stems, the paper's
    DP_PLANT_TUFT = 1      // two or three sheets that cross
} DpPlantForm;

// The numbers of a kind: X(name, unit, low, high, as Carex pensylvanica has it, meaning). A new number
// is a line here.
// clang-format off
#define DP_PLANT_NUMBERS(X) \
    X(height, "m", 0.0, 10.0, 0.10, "over the ground") \
    X(width, "m", 0.0, 10.0, 0.05, "of the first sheet") \
    X(depth, "m", 0.0, 10.0, 0.05, "of the sheets that cross it") \
    X(spacing, "m", 1e-4, 10.0, 0.015, "between particles, about") \
    X(radius, "m", 0.0, 1.0, 0.005, "of a particle") \
    X(curl, "rad", 0.0, 0.5 * DP_PI, 0.0, "phi_0, rest angle between edges of a stem") \
    X(sway, "Hz", 1e-3, 1e3, 3.0, "frequency at which a whole stem swings") \
    X(across, "Hz", 1e-3, 1e4, 20.0, "of edges between stems, as a frequency") \
    X(damping, "1/s", 0.0, 1e4, 6.0, "of speed") \
    X(strength, "-", 1e-9, 1e9, 0.1, "eps_b, reserve of a bend, TRAIL (6)") \
    X(degrade_angle, "rad", 0.0, DP_PI, 10.0 * DP_PI / 180.0, "phi_deg, from where it wears") \
    X(break_angle, "rad", 0.0, 1e3, 70.0 * DP_PI / 180.0, "phi_max, from where on it breaks") \
    X(degrade_rate, "1/s", 0.0, 1e9, 0.1, "mu_deg, at which bent stems wear, TRAIL (6)") \
    X(recover_rate, "1/s", 0.0, 1e9, 0.1, "mu_rec, at which strength comes back, TRAIL (6)") \
    X(spread, "-", 0.0, 4.0, 0.0, "s, reserves differ by exp(s z), z of deviation 1") \
    X(regrow_rate, "1/s", 0.0, 1e3, 1.02 / (365.25 * 86400.0), "r, of stems that broke, logistic") \
    X(seed_share, "-", 0.0, 1.0, 0.0, "w, of regrowth from seeds that need no neighbours") \
    X(root_radius, "m", 1e-3, 100.0, 0.15, "R, as far as its roots hold the soil, TRAIL (7)") \
    X(full_density, "1/m^2", 1e-6, 1e9, 40.0, "plants from which on the ground is fully covered") \
    X(modulus, "Pa", 0.0, 1e12, 10e6, "E_v0, of soil full of healthy roots, TRAIL (8)")
// clang-format on

// One kind of plant. Start from dp_plant_kind_default() and change what you know.
typedef struct DpPlantKind
{
    int form;    // DpPlantForm
    int sheets;  // crossed sheets of a tuft, 2..3; a surface has one
    DP_PLANT_NUMBERS(DP_FLOAT_MEMBER)
} DpPlantKind;

// The table above, in the order of the members; *count of them.
const DpNumber* dp_plant_numbers(int* count);

DpPlantKind dp_plant_kind_default(void);  // Carex pensylvanica, TRAIL Table 1
// Can a plant be built of these numbers? Else DP_BAD_ARGUMENT, and why, if `reason` is there.
DpStatus dp_plant_kind_check(const DpPlantKind* kind, DpReason* reason);

// What a plant of this kind is made of.
typedef struct DpPlantShape
{
    int rows, stems, stems_a_sheet;
    int particles;  // stems * rows; particle = stem * rows + row
    int bends;      // stems * (rows - 2); bend = stem * (rows - 2) + k bends rows k, k + 1, k + 2
} DpPlantShape;
DpPlantShape dp_plant_shape(const DpPlantKind* kind);

// ---- a stand of plants -----------------------------------------------------------------------

typedef struct DpPlants DpPlants;
DpPlants*               dp_plants_create(uint64_t seed);
void                    dp_plants_destroy(DpPlants* plants);

// Can roots be planted? Else DP_BAD_ARGUMENT, and in `reason`, if it is there, which argument it is
// and why.
DpStatus dp_plants_check(const DpPlantKind* kind, const float* root, const float* heading,
                         int count, DpReason* reason);
// Plant `count` roots (count, 3) [m]; `heading` turns each about +Z [rad], NULL = from the seed.
// What differs from plant to plant hangs on the seed and the place of its root alone. *stand names
// them from now on, 0, 1, 2.. What dp_plants_check refuses is DP_BAD_ARGUMENT.
DpStatus dp_plants_add(DpPlants* plants, const DpPlantKind* kind, const float* root,
                       const float* heading, int count, int* stand);
// How the ground slopes under each plant of a stand, dz/dx and dz/dy (count, 2) [-].
DpStatus     dp_plants_slope(DpPlants* plants, int stand, const float* slope);
int          dp_plants_count(const DpPlants* plants, int stand);  // stand < 0: of all stands
DpPlantShape dp_plants_shape(const DpPlants* plants, int stand);  // of a stand that is there
// How far from its root a plant's leaves and its roots can be, of all stands [m].
double dp_plants_extent(const DpPlants* plants);
double dp_plants_root_radius(const DpPlants* plants);

// Heights of the ground's current surface at cell centres, NaN = no ground: where it may have
// changed since the last step. Or a function that tells them, called from several threads:
// elsewhere.
typedef struct DpPlantGround
{
    int                         nx, ny, row;
    double                      cell, x0, y0;  // side of a cell, centre of cell (0, 0)  [m]
    const float*                height;        // [m] (ny, nx)
    const struct DpPlantGround* next;  // ground elsewhere, or NULL; where two lie, the first counts

    double (*at)(const void* context, double x, double y);  // in place of nx..height [m]
    const void* context;

    bool rose;  // soil has come to rest, and may have risen over what lies there
} DpPlantGround;

// What pushes plants: the underside of a part, or a capsule when bottom is NULL. It stands there at
// the end of the step; during the step it comes there with `velocity`.
typedef struct DpPlantCollider
{
    int          nx, ny, row;
    double       cell, x0, y0;  // as for the ground                            [m]
    const float* bottom;        // lower envelope, +inf where there is none     [m] (ny, nx)
    double       thickness;     // of the part, upward from its bottom          [m] > 0

    DpVec3 from, to;  // axis of the capsule  [m]
    double radius;    // of the capsule       [m] > 0

    DpVec3 velocity;  // [m/s]
    double friction;  // [-] >= 0
} DpPlantCollider;

// A rectangle seen from above [m].
typedef struct DpPlantBox
{
    double x0, y0, x1, y1;
} DpPlantBox;

// What a step did.
#define DP_PLANT_BOXES 16
typedef struct DpPlantsReport
{
    int        awake;                // plants that were moved
    int        broke;                // bends that broke, and those above them
    int        changes;              // cover may have changed ..
    DpPlantBox box[DP_PLANT_BOXES];  // .. within these: walkers far apart have boxes of their own
} DpPlantsReport;

// Let plants live for dt seconds: wake those near a collider, solve (5), wear (6), let those at
// rest sleep. ground may be NULL: roots stay where they are and the ground under a plant is level.
// The result is the same for any number of workers. dt > 0; no more than 64 sub-steps are taken.
DpStatus dp_plants_step(DpPlants* plants, const DpPlantGround* ground,
                        const DpPlantCollider* colliders, int count, double dt, int workers,
                        DpPlantsReport* report);

// Roots follow the ground: every plant asleep within its grids is set on its surface, those awake in
// their step. Where `rose` says so, no particle stays below it.
DpStatus dp_plants_follow(DpPlants* plants, const DpPlantGround* ground);

// Time passes without walkers [s]: strength comes back linearly, broken stems logistically.
DpStatus dp_plants_advance_time(DpPlants* plants, double seconds);

// One plant's particles (particles, 3), speeds, bends' strength (bends; < 0 never, 0 = broken).
// What is NULL is left out. Writing wakes the plant.
DpStatus dp_plants_read(const DpPlants* plants, int stand, int plant, float* position,
                        float* velocity, double* strength);
DpStatus dp_plants_write(DpPlants* plants, int stand, int plant, const float* position,
                         const float* velocity, const double* strength);
// exp(s z) * eps_b, the most strength a bend of this plant has.
double dp_plants_reserve(const DpPlants* plants, int stand, int plant);
// Give every plant of a stand its z (count), |z| <= 8, in place of that from the seed and its place.
// Before anybody treads on them; else DP_BAD_ARGUMENT.
DpStatus dp_plants_vary(DpPlants* plants, int stand, const float* z);
// alpha_k, share of a plant's bends with nothing broken from the root up to them. TRAIL (7)
double dp_plants_alpha(const DpPlants* plants, int stand, int plant);

// ---- kept from one run to the next --------------------------------------------------------------

// Write what plants have become since they were planted, as one chunk of a stream.
void dp_plants_save(const DpPlants* plants, DpStateWriter* writer);

// What was read, until plants take it.
typedef struct DpPlantsState DpPlantsState;
// Read for plants that were planted alike, and that nobody trod on yet (else DP_BAD_ARGUMENT).
// Damaged bytes, and those of plants of another seed, kind or place: DP_BAD_FILE.
DpStatus dp_plants_load(const DpPlants* plants, DpStateReader* reader, DpPlantsState** state);
// They go on from there, to the bit; the state is gone afterwards. It cannot fail.
void dp_plants_restore(DpPlants* plants, DpPlantsState* state);
void dp_plants_state_destroy(DpPlantsState* state);  // not taken; NULL is fine

// ---- one by one ------------------------------------------------------------------------------

// Strength of one bend held at `angle` (phi, from its rest angle) for dt seconds. TRAIL (6)
double dp_plant_wear(const DpPlantKind* kind, double reserve, double strength, double angle,
                     double dt);
// Share of cover after so many seconds of regrowth, from `alpha` around:
// d alpha/dt = r (w + (1 - w) alpha) (1 - alpha).
double dp_plant_regrow(const DpPlantKind* kind, double alpha, double seconds);

typedef enum DpCoverLaw
{
    DP_COVER_FULL = 0,  // relative to full cover
    DP_COVER_PAPER = 1  // TRAIL (7) as printed
} DpCoverLaw;

// Cells to be filled.
typedef struct DpPlantWindow
{
    int    nx, ny, row;
    double cell, x0, y0;
} DpPlantWindow;

// alpha_veg, TRAIL (7), and E_v, TRAIL (8) [Pa], of every cell; NULL is left out.
DpStatus dp_plants_cover(const DpPlants* plants, const DpPlantWindow* window, DpCoverLaw law,
                         float* strength, float* modulus);

// Poisson-disc placement in x0..x1, y0..y1: at most `max_count` roots (x, y) in `root` (max_count, 2),
// *count of them. What `root` holds before, *count roots of the ground around, stays and keeps its
// distance. weight (wy, wx), 0..1, thins the density over the same rectangle; NULL = 1.
DpStatus dp_plants_place(double x0, double y0, double x1, double y1, double density,
                         const float* weight, int wx, int wy, uint64_t seed, float* root,
                         int max_count, int* count);

// ---- for grass between the plants ---------------------------------------------------------------

// Of all kinds that stand, the tallest [m]; 0 = nothing grows.
double dp_plants_height(const DpPlants* plants);

// One stem for each cell of a window, the mean of what grows there; 0 where nothing does.
typedef struct DpPlantStature
{
    float* height;  // [m]; NULL = all but `broken` are left out
    float* rate;    // at which it swings up [1/s]
    float* heal;    // at which it rises when its strength has to return first [1/s], <= rate
    float* limp;    // share of height lost from which that is so
    float* broken;  // share of bends that is broken
} DpPlantStature;
void dp_plants_stature(const DpPlants* plants, const DpPlantWindow* window,
                       const DpPlantStature* out);

// Can all pieces of the ground be read? NULL can.
bool dp_plant_ground_ok(const DpPlantGround* ground);
// Surface at a point; NaN off the ground.
double dp_plant_ground_at(const DpPlantGround* ground, double x, double y);

// ---- stems as they are shown ------------------------------------------------------------------

// How the unbroken stems of a place lie, as grass keeps it; those that are broken lie by themselves.
typedef struct DpStemLean
{
    double down;     // share of height that is lost; 0 = it stands
    double lean[2];  // direction
    bool   pressed;  // a sole lies on it
} DpStemLean;
typedef DpStemLean (*DpStemLeanAt)(const void* context, double x, double y);

// A stem swings up when its foot has left, and wears by that; what was trodden is shown down for as
// long as the lean at its foot says, as it was laid. Plants and what tells the lean are borrowed.
typedef struct DpPlantDisplay DpPlantDisplay;
DpStatus dp_plant_display_create(DpPlantDisplay** display, const DpPlants* plants,
                                 DpStemLeanAt lean_at, const void* context);
void     dp_plant_display_destroy(DpPlantDisplay* display);  // before its plants

// After each step of plants and grass: how soles laid the stems is remembered.
DpStatus dp_plant_display_step(DpPlantDisplay* display);

// One plant's particles (particles, 3) [m], none that was bent below `ground`; NULL = the plane the
// plant stands on. Where the lean is 0 those of dp_plants_read, to the bit.
DpStatus dp_plant_display_read(const DpPlantDisplay* display, const DpPlantGround* ground,
                               int stand, int plant, float* position);

// What soles laid, kept as one chunk of a stream; and read for the same plants: damaged bytes, and
// those of stands of another shape, are DP_BAD_FILE.
void dp_plant_display_save(const DpPlantDisplay* display, DpStateWriter* writer);
typedef struct DpPlantDisplayState DpPlantDisplayState;
DpStatus dp_plant_display_load(const DpPlantDisplay* display, DpStateReader* reader,
                               DpPlantDisplayState** state);
// Stems are shown as they were from then on; the state is gone afterwards. It cannot fail.
void dp_plant_display_restore(DpPlantDisplay* display, DpPlantDisplayState* state);
void dp_plant_display_state_destroy(DpPlantDisplayState* state);  // not taken; NULL is fine
