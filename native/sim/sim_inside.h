// sim/sim_inside.h - what a simulation keeps between steps; for the files of this room only.
#pragma once
#include "base/grid.h"
#include "imprint/imprint.h"
#include "sim/sim.h"

// How far the ground around a sole has sheared along with it, to first order around a place, MODEL 6.18.
typedef struct Shear
{
    DpVec3 place;
    double field[6];  // along x and y there [m], and how much more a metre along x, and along y
} Shear;

// One limb and the stance it is in.
typedef struct Limb
{
    int          walker;
    int          part_count;
    int*         part;         // its parts, in the order of the recording (part_count)
    double       length;       // of its soles, one after the other                        [m]
    int          samples;      // a side that every cell under them gets, see dp_imprint_samples
    DpContactLaw law;          // how it presses
    bool         stands;       // in a stance
    bool         ploughs;      // has cut what was in its way in this stance
    bool         flows;        // has let go, and soil around still slides
    double       heap_height;  // T of the rest heap, from step to step of a stance          [m]
    double       margin;       // of ground around its soles that a step may change        [m]
    double       unlaid;       // displaced volume that found no border cell yet             [m^3]
    double       owed;         // what its soles slid over in this stance and have not cut [m^3]
    double       sink;         // how far its soles stand below where they were recorded     [m]
    DpVec3       slip;         // how far its soles have slipped along the ground in this stance [m]
    DpVec3       sheared;  // of that, what the soil carries the push with as it is now       [m]
    Shear        shear;    // of what its soles slide into, that does not flow yet
    double       lowered;  // the same as plants saw it at the end of the last step      [m]
    DpCellRect   trodden;  // cells its patches covered during this stance
    float*       met;      // `uniform`: heap - compression on `met_at` as this stance met them [m]
    DpCellRect   met_at;
    DpCarry*     carry;  // what sticks to it; NULL: no soil does

    // this step's work and what came of it
    DpCellRect patch;   // cells this step's patch covers
    bool       active;  // presses or settles in this step
    int        group;   // .. among the limbs of this one
    bool       begins;  // its stance begins
    int        boxed;   // the sample at which `from` is where it carves from, and `to` where to
    DpBox      from, to;
    bool       lifts;   // has let go: its rim comes to rest
    bool       left;    // .. before this step, and soil only slides on
    bool       spills;  // loose soil wants to leave the patch: settle again in a larger one
    double     firm, loose, laid, deepest;  // this step's volumes [m^3] and depth [m]
    double     loosened, rebounded;         // .. of walls and springs, and when it settles [m^3]
    bool       off_ground;                  // pressed where there is no ground
} Limb;

// Columns of a limb's patch, for finding limbs that meet.
typedef struct LimbSpan
{
    long i0, i1;
    int  limb;
} LimbSpan;

// What a limb's soles press with at the end of a step.
typedef struct Pressing
{
    DpCellRect at;      // cells under its soles; empty: it does not press
    bool       waits;   // no time passes for it: it stands there, and presses nothing
    long       i0, j0;  // world cell of value[0]
    int        row;
    float*     value;  // sigma [Pa]
} Pressing;

// What one thread needs for itself.
typedef struct WorkerScratch
{
    DpLease*          lease;
    DpImprintScratch* imprint_scratch;
    DpSoilScratch*    soil_scratch;
    DpImprint         imprint;
    float*            met;   // as large as the imprint's grids
    DpMesh*           sole;  // of the limb at hand (as many as any limb has parts)
    DpPose*           pose;
    DpStatus          status;
} WorkerScratch;

// A part between two samples, and its underside at the end.
typedef struct SweptSole
{
    int        sample;        // from this sample to the next; -1 = none
    DpPose     pose;          // at the end
    DpBox      from, to;      // [m]
    DpVec3     displacement;  // of its middle [m]
    bool       jumps;         // was put elsewhere: nothing lies between
    double     low;           // its lowest [m]
    double     ground;        // base height below it, NaN where there is none [m]
    bool       cast;          // the underside is known
    DpCellRect at;            // of its grids
    DpImprint  imprint;       // its own grids
} SweptSole;

// Plants on the ground, and what a step tells them. Everything here is 0 on bare ground.
typedef struct PlantStage
{
    DpPlants*       plants;
    DpGrass*        grass;
    DpPlantDisplay* display;              // NULL: nobody asked for stems as they are shown
    double          extent, root_radius;  // of the largest plant, above and below ground [m]

    int              parts, limbs;  // of the recording
    SweptSole*       swept;         // of this step and the next (2, parts)
    DpPlantCollider* sole;          // of parts near the ground (parts)

    DpPlantGround* ground;  // around limbs near the ground (limbs)
    float**        height;
    int            soles, grounds;  // of this step
} PlantStage;

// The same plants before anybody walks by.
static inline PlantStage dp_stage_empty(const PlantStage* stage)
{
    return (PlantStage){.plants = stage->plants,
                        .grass = stage->grass,
                        .display = stage->display,
                        .extent = stage->extent,
                        .root_radius = stage->root_radius};
}

#define MAX_SPECULATED 4  // limbs; where more press, they keep all cores busy by themselves

// The next step's soil, worked out on leases while plants move. It counts unless they broke
// something the leases hold: then the limbs are as they were planned, and press in their turn.
typedef struct Speculation
{
    bool         planned;  // limbs and groups are those of the next step
    int          count;    // limbs at work, 0 = none
    Limb*        limb[MAX_SPECULATED];
    Limb         was[MAX_SPECULATED];
    DpSoilPatch* patch[MAX_SPECULATED];
    DpStatus     status[MAX_SPECULATED];
    DpLease*     lease[MAX_SPECULATED];
} Speculation;

// What sticks and what flies. All is 0 without spray.
typedef struct SprayStage
{
    DpSprayNumbers numbers;
    DpCloud*       cloud;  // NULL: nothing sticks
    DpCoat**       coat;   // of parts that have pressed (parts)
    int            parts;  // of the recording
    long           thrown, beside,
        carried_off;  // grains: come off, fallen by the ground, on walkers of before
} SprayStage;

// What limbs that are not followed any more took up, and carried away, of each soil that sticks [m^3].
typedef struct Gone
{
    double taken[DP_MAX_COATS], carried[DP_MAX_COATS];
} Gone;

struct DpSim
{
    DpTerrain*   terrain;
    DpSimOptions options;
    DpGrid       grid;  // of the terrain

    DpMotion* motion;  // what is followed; NULL: nobody walks yet
    DpGait    cast;    // its walkers, limbs, parts and soles
    double    datum;   // of the terrain, from which heights count                       [m]
    int*      part_of_limb;
    int       limb_parts;   // as many as any limb has, in all poses of a step
    DpMesh*   worker_sole;  // room of every worker for the soles and poses of one limb
    DpPose*   worker_pose;

    Limb*     limb;
    Pressing* pressing;  // of every limb
    Gone      gone;
    int       next;  // first interval not yet stepped: from sample `next` to `next + 1`

    WorkerScratch* scratch;  // one per worker (options.workers)
    int            worker_count;
    int*           group;  // limbs in groups that touch each other: group k holds order[start[k]..]
    int*           number;  // of the group of each root
    int*           order;
    int*           start;
    int            groups;
    LimbSpan*      span;

    DpCellRect* slide;  // prints that still slide though their limbs stand elsewhere (slides)
    int         slides;

    Speculation speculation;
    PlantStage  stage;
    SprayStage  spray;
    DpSimReport report;
};

// how long an interval lasts [s]
static inline double dp_sim_interval(const DpSim* sim, int sample)
{
    return dp_motion_time(sim->motion, sample + 1) - dp_motion_time(sim->motion, sample);
}

// sim_follow.c: nothing is followed any more
void dp_sim_forget(DpSim* sim);

// How a part has moved: what is at p now was at  from + turn (p - to).
typedef struct Moved
{
    DpQuat turn;
    DpVec3 from, to;
} Moved;

// sim_limb.c: where a limb is and what it does at fraction `w` between samples k and k + 1
bool        dp_limb_there(const DpSim* sim, const Limb* limb, int sample);
bool        dp_limb_touches(const DpSim* sim, const Limb* limb, int sample);
bool        dp_limb_held(const DpSim* sim, const Limb* limb, int sample);
DpPose      dp_limb_pose(const DpSim* sim, int part, int sample, double w);
Moved       dp_limb_moved(const DpSim* sim, int part, int sample, double w0, double w1);
DpFootForce dp_limb_force(const DpSim* sim, const Limb* limb, int sample, double w);
DpCellRect  dp_box_cells(const DpSim* sim, const DpBox* box, double margin);
DpCellRect  dp_limb_cells(const DpSim* sim, const Limb* limb, int sample, double margin);
int         dp_limb_substeps(const DpSim* sim, const Limb* limb, int sample);

// Some `count` vertices of each part: how low they are at a sample, and how far over the ground those not above `high`
// go until the next                                                                                          [m]
typedef struct DpProbe
{
    double lowest, farthest;
} DpProbe;
DpProbe dp_limb_probe(const DpSim* sim, const Limb* limb, int sample, int count, double high);

// sim_cells.c: cells whose centres may lie in a box [m]; the ground asks again for its cover within
// one; the surface where no limb is near, as plants ask for it (context: the terrain)
DpCellRect dp_sim_cells(const DpSim* sim, double x0, double y0, double x1, double y1);
void       dp_sim_cover_anew(DpSim* sim, double x0, double y0, double x1, double y1);
double     dp_sim_surface(const void* terrain, double x, double y);

// sim_sweep.c: a part's path from `sample` to the next; its underside; both before its step comes, if
// plants can meet it.
SweptSole* dp_sweep_path(DpSim* sim, int part, int sample);
DpStatus   dp_sweep_cast(DpSim* sim, SweptSole* swept, int part, DpImprintScratch* scratch);
void       dp_sweep_ahead(DpSim* sim, int part, int sample, DpImprintScratch* scratch);

#define DP_STAGE_MARGIN 0.5  // plants are moved no farther beside a sole than this [m]

// sim_planting.c: room for a recording's soles; how far beside a sole plants are changed [m]; what
// remembers how stems are laid
DpStatus dp_stage_fit(DpSim* sim, int parts, int limbs);
void     dp_stage_drop(DpSim* sim);
double   dp_stage_margin(const DpSim* sim);
DpStatus dp_sim_display(const PlantStage* stage, DpPlantDisplay** display);

// sim_plants.c: what plants do in a step, after the soil
DpStatus dp_stage_settled(DpSim* sim, Limb* limb);
DpStatus dp_stage_step(DpSim* sim, int sample, bool more);  // more: another step comes at once

// sim_spray.c: what sticks and flies in a step, after its soil; all that flies comes down; what of it a report tells
DpStatus dp_spray_step(DpSim* sim, int sample);
DpStatus dp_spray_land(DpSim* sim);
void     dp_spray_report(const SprayStage* spray, DpSimReport* report);

// .. coats go, or go with the walkers of before
void dp_spray_drop(SprayStage* spray);
void dp_spray_leave(SprayStage* spray, const SprayStage* before);

// .. a chunk of the state; without spray none is written or read
void     dp_spray_save(const DpSim* sim, DpStateWriter* writer);
DpStatus dp_spray_load(const DpSim* sim, DpStateReader* reader, SprayStage* state);

// sim_plan.c: what every limb does in a step, and room for it on the terrain
DpStatus dp_step_plan(DpSim* sim, int sample);

// sim_speculate.c: plan the step from `sample` on, and lend its patches; how many limbs can press ahead
DpStatus dp_speculate_open(DpSim* sim, int sample, int* limbs);
void dp_speculate_press(DpSim* sim, int sample, int index, WorkerScratch* scratch);  // one of them
// Cover has changed within x0..x1, y0..y1 [m]: what was lent there does not count.
void dp_speculate_worn(DpSim* sim, double x0, double y0, double x1, double y1);
bool dp_speculate_take(DpSim* sim);  // lay it down; false: the step has still to be done

// sim_pressure.c: room for what a limb presses with on a patch, all zero; nobody stands anywhere
DpStatus dp_pressing_open(Pressing* pressing, const Limb* limb, DpSoilPatch* patch);
void     dp_pressing_clear(DpSim* sim);

// sim_lay.c: room for the imprint of a patch in the scratch's grids; what its sole has displaced, and what still waits, is
// laid around it, threshold of TRAIL (13) [N]
DpStatus dp_limb_fit(WorkerScratch* scratch, const DpSoilPatch* patch);

// .. no sole on it; of a patch that is acquired here, with no sole on it
void     dp_limb_bare(WorkerScratch* scratch, const DpSoilPatch* patch);
DpStatus dp_limb_lease(DpSim* sim, WorkerScratch* scratch, DpCellRect at, DpSoilPatch** patch);
DpStatus dp_limb_lay(const DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                     const DpFootForce* foot, double volume, double threshold, DpVec3 cut);

// sim_plough.c: whether a limb's sole slides while it presses between fractions w0 and w1 of an interval, in which it has
// slipped, too; and how. What it has cut is counted.
bool dp_limb_slides(const DpSim* sim, const Limb* limb, const DpSoilPatch* patch, int sample,
                    double w0, double w1, DpVec3 slipped, DpSlide* slide);
void dp_plough_count(Limb* limb, const DpPressed* pressed);

// .. how much of that slide the soil at `place` shears along with, which goes to slide->held; whether some of it flows
bool dp_limb_shears(Limb* limb, const DpSoilPatch* patch, const DpSoil* soil, DpVec3 place,
                    DpSlide* slide);
void dp_shear_save(DpStateWriter* writer, const Shear* shear);  // as a part of a limb's state
void dp_shear_load(DpStateReader* reader, Shear* shear);

#define DP_CARVE_STEPS 128  // poses of a body between two samples, at most

// sim_carve.c: how far a body that carves goes into the surface at most in an interval, 0 where it stays over it [m];
// one's step on its patch
double     dp_carve_depth(const DpSim* sim, Limb* limb, int sample);
DpCellRect dp_carve_cells(const DpSim* sim, const Limb* limb,
                          double margin);  // as dp_limb_cells, of the same interval
DpStatus   dp_limb_carve(DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                         int sample);

DpStatus dp_carve_behind(DpSim* sim,
                         Limb*  limb);  // after a long path what lies behind comes to rest

// sim_release.c: what no sole stands on any more comes back, on the cells of limbs that are active, or of one
DpStatus dp_release_step(DpSim* sim, int sample);
DpStatus dp_release_limb(DpSim* sim, Limb* limb, DpCellRect cells, int sample);

// sim_carry.c: stores for the limbs where soil sticks; what a limb that has pressed takes up and leaves, `poses` as in its
// scratch; what those take that lift
DpStatus dp_carry_fit(DpSim* sim);
void     dp_carry_gone(const DpSim* sim, Gone* gone);  // limbs go, with what sticks to them
DpStatus dp_limb_carry(DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                       int poses);
DpStatus dp_carry_lifts(DpSim* sim);
DpStatus dp_limb_lifts(DpSim* sim, Limb* limb);

// sim_hold.c: the ring of an imprint on a limb's patch, or on `cells`, becomes DP_RING_HELD where another limb of its group,
// or any limb, stands; whether one does
bool dp_hold_group(const DpSim* sim, const Limb* limb, DpImprint* imprint, int row);
bool dp_hold_all(const DpSim* sim, DpCellRect cells, DpImprint* imprint, int row);

// sim_press.c: one limb's step on its patch
DpStatus dp_limb_press(DpSim* sim, Limb* limb, int sample, DpSoilPatch* patch,
                       WorkerScratch* scratch);

// sim_slide.c: how many sweeps soil slides in the interval from `sample`, for what slides goes one cell in each; all at
// the end (sample < 0), or if it does not take time. What a limb's sole held slides. A limb begins a stance while its
// last print still slides: where it stands elsewhere, that goes on by itself, in every step.
int      dp_slide_sweeps(const DpSim* sim, const DpSoilPatch* patch, int sample);
DpStatus dp_limb_settle(DpSim* sim, Limb* limb, int sample, WorkerScratch* scratch);
DpStatus dp_slide_leave(DpSim* sim, Limb* limb);
DpStatus dp_slide_step(DpSim* sim, int sample);
