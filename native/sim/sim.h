// sim/sim.h - one step, in the paper's order; the only place where rooms meet.
//
//   contact, force ---> imprint ---> compress ---> accumulate ---> stabilize ---> tiles changed
//                                       ^                              |
//                                     cover <--- wear <--- solve <--- plants follow the surface
//
// A simulation holds a terrain and follows a motion. Each limb that touches presses
// its sole; a limb that has let go lets its rim come to rest. Limbs whose patches do not overlap are
// worked on at once; the result is the same for any number of workers.
#pragma once
#include "carry/carry.h"
#include "grass/grass.h"
#include "base/stream.h"
#include "motion/motion.h"
#include "plants/plants.h"
#include "sim/sim_film.h"
#include "soil/soil.h"
#include "spray/spray.h"
#include "terrain/terrain.h"
#include "walker/walker.h"

typedef struct DpSim DpSim;

typedef struct DpSimOptions
{
    DpContactLaw law;         // how a sole presses            MODEL 6.2
    DpHeapLaw    heap_law;    // how displaced soil is laid    MODEL 6.3
    double       rim_width;   // `paper` heaps [m] > 0
    double       tolerance;   // slopes rest within gamma_r + this [rad] > 0
    int          max_sweeps;  // sweeps of one settling, baking: large [-] > 0
    double normal_radius;     // the base ground is smoothed over this for N and placement [m] > 0
    int    workers;           // threads, >= 1
} DpSimOptions;

DpSimOptions dp_sim_options_default(void);

// What has happened since the start.
typedef struct DpSimReport
{
    int    contacts;      // stances begun by any part's limb          [-]
    int    off_ground;    // limb-steps with load where no ground was  [-]
    double deepest;       // deepest compression                       [m]
    double pressed;       // V_c, pressed out of firm ground           [m^3]
    double pressed_heap;  // V_b, pressed out of loose heaps           [m^3]
    double displaced;     // 2 nu (V_c + V_b), what the ledger laid down [m^3]
    double heaped;        // sum of heap * cell^2                      [m^3]
    double loosened;      // firm ground that fell from walls          [m^3]
    double rebounded;     // firm ground that came back                [m^3]
    long   broke;         // bends of stems that broke, and those above them [-]
    int    awake;         // plants that moved in the last step        [-]
    double thrown;        // of spray: what ever came off              [m^3]
    double stuck;         // .. what sticks to who walks or has walked [m^3]
    double airborne;      // .. what flies                             [m^3]
    double beside;        // .. what fell by the ground and is gone    [m^3]
} DpSimReport;

// The simulation borrows terrain (must outlive it) and copies all else.
DpStatus dp_sim_create(DpSim** sim, DpTerrain* terrain, const DpSimOptions* options);
void     dp_sim_destroy(DpSim* sim);

// Plants on this ground; borrowed like the terrain, on which nobody has walked yet. Once a motion is
// followed: DP_BAD_ARGUMENT.
DpStatus dp_sim_plant(DpSim* sim, DpPlants* plants);

// Plant roots at xy (count, 2) [m] as one more stand, at any time; those without ground are left
// out. *grown of them came up; none: *stand is -1.
DpStatus dp_sim_grow(DpSim* sim, const DpPlantKind* kind, const float* xy, int count, int* stand,
                     int* grown);

// How the grass lies on the terrain's cells; NULL on bare ground. It belongs to the simulation.
DpGrass* dp_sim_grass(const DpSim* sim);

// What the soles press with at the end of the last step: sigma [Pa] of cells (nx, ny) from (i0, j0)
// on into out (ny, nx), 0 where nobody presses; and the tiles in which somebody does.
void dp_sim_pressure(const DpSim* sim, long i0, long j0, int nx, int ny, float* out);
void dp_sim_soles(const DpSim* sim, DpTileVisit visit, void* context);

// From now on remember how stems are laid, for dp_sim_shown; costs time and memory where feet go.
DpStatus dp_sim_lay(DpSim* sim);
// One plant's particles (particles, 3) [m] as they are to be shown: trodden stems down for as long
// as the grass lies, see plants.h. Before dp_sim_lay: as they are.
DpStatus dp_sim_shown(const DpSim* sim, int stand, int plant, float* position);
// The same as they are now.
DpStatus dp_sim_stands(const DpSim* sim, int stand, int plant, float* position);

// Time passes without walkers [s]: plants regain strength and grow again.
DpStatus dp_sim_pass_time(DpSim* sim, double seconds);

// How many walkers the motion that is followed has; 0 while none is.
int dp_sim_walkers(const DpSim* sim);

// Follow a motion (motion/motion.h), which is the simulation's from now on. A limb that is held, as
// DP_HELD in `touching` says, stays in its print and presses no deeper. Pressed prints stay: motions
// may follow each other on the same ground. On failure both are as they were.
DpStatus dp_sim_follow(DpSim* sim, DpMotion* motion);
// The same with a recording, evenly sampled, with what its parts touch and press (walker/walker.h).
DpStatus dp_sim_load(DpSim* sim, const DpGait* gait, const uint8_t* touching, const double* force,
                     const double* pressure_point);
// The next sample of the live motion that is followed: see dp_motion_push.
DpStatus dp_sim_push(DpSim* sim, double time, const uint8_t* present, const DpLoadedPoses* poses);

// Turn one walker's feet to the base ground of a terrain, and carry it there: see dp_foot_place.
DpStatus dp_sim_place(const DpTerrain* terrain, const DpGait* gait, int walker,
                      const DpPlaceOptions* options, const double* clearance, double* pose,
                      double* com);

// Cells the motion that is followed can change, as a rectangle {i0, i1, j0, j1}, with room for heaps;
// empty (i0 >= i1) when nothing touches.
void dp_sim_bounds(const DpSim* sim, long bounds[4]);
// The same by tiles: sets tile (ny, nx), from tile (tile_x, tile_y) on, to 1 where it can change something.
void dp_sim_reach(const DpSim* sim, long tile_x, long tile_y, int nx, int ny, uint8_t* tile);

// Step over samples up to but not including `sample` (0..T). Steps already taken are not repeated.
// One that fails leaves its step half done: what can be done then is to load anew or to destroy.
DpStatus dp_sim_run(DpSim* sim, int sample);

// From now on soil sticks to soles and flies off them, spray/spray.h; before the first step. Numbers out of their
// range, or a second time: DP_BAD_ARGUMENT.
DpStatus dp_sim_spray(DpSim* sim, const DpSprayNumbers* numbers);
bool     dp_sim_sprays(const DpSim* sim);
// What flies: how many grains, and one of them, in the world's frame.
int     dp_sim_grains(const DpSim* sim);
DpGrain dp_sim_grain(const DpSim* sim, int index);

// Let everything that is still loose, or flies, come to rest.
DpStatus dp_sim_settle(DpSim* sim);

DpSimReport dp_sim_report(const DpSim* sim);

// What became of one of the soils that stick (dp_terrain_coats): taken up since the start, on soles now, and left on the
// ground [m^3]; taken = carried + left.
typedef struct DpSimCarried
{
    double taken, carried, left;
} DpSimCarried;
DpSimCarried dp_sim_carried(const DpSim* sim, int coat);

// Fields of ground in layers, on cells: out (ny, nx). DP_FIELD_LAYER + k is how thick the layer of that place still is [m],
// DP_FIELD_SURFACE + k how much of what is seen is of the soil of that name, MODEL 6.17.
DpStatus dp_sim_layers(const DpSim* sim, int field, const DpCellRect* at, float* out);
bool     dp_sim_is_of_layers(const DpSim* sim, int field);  // whether the ground has it, in layers

// ---- stop and go on ------------------------------------------------------------------------------

// Write what the simulation has become after the steps taken: with the chunks of terrain, plants and
// grass. Files are whole or not at all if the bytes are written so.
DpStatus dp_sim_save_state(const DpSim* sim, DpStateWriter* writer);
// Take it back, in a simulation of the same ground, options and plants that follows the same motion,
// not live, from its first sample on: it goes on from there to the bit, and the next pictures of it are
// whole. Taken steps, or a live motion: DP_BAD_ARGUMENT. Damaged bytes, or those of another: DP_BAD_FILE.
// On failure all is as it was.
DpStatus dp_sim_load_state(DpSim* sim, const void* bytes, size_t size);

// What is taken of a state by dp_sim_join_state.
typedef struct DpStatePart
{
    const int32_t* tile;  // x and y of each, rising by (y, x) (tiles, 2)
    size_t         tiles;
    const uint8_t* walkers;  // whose limbs are taken (walkers)
} DpStatePart;

// Take some tiles and limbs of a state, in a simulation as dp_sim_load_state wants it, but that tiles may be there, from
// states of the same ground that was pressed in parts which do not meet. What its report tells is not taken. On planted
// ground, where prints slide that no limb stands on, or of tiles that are not in it or are there already:
// DP_BAD_ARGUMENT. On failure all is as it was.
DpStatus dp_sim_join_state(DpSim* sim, const void* bytes, size_t size, const DpStatePart* part);
// Before the first step: go on from this sample, as if nothing had happened until then. Not of a live motion, or beyond
// its samples: DP_BAD_ARGUMENT.
DpStatus dp_sim_begin_at(DpSim* sim, int sample);
