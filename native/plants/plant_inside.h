// plants/plant_inside.h - what the files of this room share.
//
// Plants of a stand live in blocks of DP_LANES neighbours; every number of a block is an array over
// its lanes, so that loops over lanes become wide registers. A block without `state` is unbroken and
// in its rest shape.
#pragma once
#include "base/vec.h"
#include "plants/plants.h"

#define DP_LANES 8
#define DP_PLANT_HELD 2         // rows held by the ground
#define DP_SUBSTEP (1.0 / 480)  // longest sub-step [s]
#define DP_MAX_SUBSTEPS 64
#define DP_PLANT_MAX_ROWS 64
#define DP_MAX_STRETCH 1.05f  // no stem is longer
#define DP_NO_FLOOR -1e30f    // not seen yet: the plane a plant stands on
#define DP_MAX_SPEED 6.0f     // of a particle [m/s]

// two particles that keep their distance
typedef struct PlantEdge
{
    int   a, b;
    float rest;              // [m]
    float share_a, share_b;  // how much of the correction each end takes, sum 1
    float rate;              // stiffness over mass [1/s^2]; 0 = rigid
} PlantEdge;

// state of a block; grids are (particles, lanes) and (bends, lanes)
typedef struct PlantState
{
    float*  at[3];     // positions from the block's origin [m]
    float*  speed[3];  // [m/s]
    float*  limp;      // 1 above a broken bend, else 0 (particles, lanes)
    float*  floor;     // height of the ground under a particle, as it was last seen [m], ..
    float*  seen[2];   // .. and where that was [m]
    double* strength;  // eps_b; 0 = broken
} PlantState;

typedef struct PlantBlock
{
    PlantState* state;  // NULL: unbroken and at rest
    int         count;  // lanes in use; the others repeat lane 0
    bool        awake, touched, wearing, changed;
    bool   moved;  // the ground has been asked for: it may stand elsewhere than when it was planted
    bool   touched_lane[DP_LANES];
    bool   ground_known[DP_LANES];  // a grid tells of the ground around it: it may have changed
    int    broke;                   // bends, in the last step
    double quiet;                   // time without motion [s]
    double asleep_since;            // [s]
    double origin[3];               // of the state's positions, so that floats are small [m]
    float  root[3][DP_LANES];
    float  foot[3][DP_LANES];   // root - origin
    float  turn[2][DP_LANES];   // cos, sin of the heading
    float  slope[2][DP_LANES];  // of the ground
    float  ceiling[DP_LANES];   // no ground around is higher; -inf: not known [m]
    float  alpha[DP_LANES];     // unbroken share
    double reserve[DP_LANES];
    int    plant[DP_LANES];  // number at which it was added
} PlantBlock;

typedef struct PlantStand
{
    DpPlantKind  kind;
    DpPlantShape shape;
    float        gap;        // between rows [m]
    float        extent;     // farthest particle from the root [m]
    float        aside;      // the same at rest, along x or y [m]
    float        near;       // neighbours of a row are at least so far apart, seen from above [m]
    float        bend_rate;  // [1/s^2]
    float*       rest;       // in the plant's frame (particles, 3)
    float*       rest_bend;  // second differences of it (bends, 3)
    double*      limit;      // cosines at which bends wear and break (bends, 2)
    PlantEdge*   edge;
    int          edges;
    PlantBlock*  block;
    int          blocks, count;
    uint8_t*     up;     // is the block awake? (blocks)
    float*       box;    // roots of each block, x0 y0 x1 y1 (blocks, 4) [m]
    int*         where;  // block * DP_LANES + lane of each plant, as added
    // roots by cells of side `bin`, for kernels that look around
    double bin, bx0, by0;
    int    bnx, bny;
    int *  bin_start, *bin_item;  // where[]-numbers
} PlantStand;

struct DpPlants
{
    uint64_t    seed;
    double      now;       // [s]
    uint64_t    advances;  // times that dp_plants_advance_time was called
    PlantStand* stand;
    int         stands;
    // scratch of a step
    struct PlantTask* task;
    float*            scratch;
    float*            side;
};

// ---- plant_kind.c

// speed over distance of a stem on its way back to its rest shape: it swings, or creeps if
// overdamped [1/s]
double dp_plant_return_rate(const DpPlantKind* kind);
// at which its swings die away, or it creeps [1/s]
double dp_plant_rise_rate(const DpPlantKind* kind);

// ---- plant_random.c

// a number 0..1 from three names; the same on every machine
double dp_plant_hash(uint64_t seed, uint64_t a, uint64_t b);
// what a plant is called by its root, whoever planted it with whatever others
uint64_t dp_plant_name(float x, float y);
// a number of mean 0 and deviation 1 that lies far out more often than a normal one: its density is
// as exp(-sqrt(|z|)). |z| <= 8
double dp_plant_vigour(uint64_t seed, uint64_t a, uint64_t b);

// ---- plant_shape.c

// rest shape, edges and limits of a stand, from its kind
void dp_plant_shape_stand(PlantStand* stand);
// rest position of a particle from the block's origin, at its present root
DpVec3 dp_plant_rest_at(const PlantStand* stand, const PlantBlock* block, int particle, int lane);

// ---- plant_sleep.c

// room for a block's state; NULL without memory
PlantState* dp_plant_state_create(const PlantStand* stand);
// give a block its state, in the rest shape; false without memory
bool dp_plant_wake(DpPlants* plants, PlantStand* stand, PlantBlock* block);
void dp_plant_put_to_sleep(const DpPlants* plants, const PlantStand* stand, PlantBlock* block);
// strength that came back while asleep
void dp_plant_catch_up(const PlantStand* stand, PlantBlock* block, double seconds);
// strength of a bend that regained `gain` while nothing bent it
double dp_plant_recovered(const PlantStand* stand, const PlantBlock* block, int bend, int lane,
                          double gain);

// ---- plant_broadphase.c

// A collider prepared: how far it is to its side.
typedef struct PlantPush
{
    const DpPlantCollider* collider;
    const float*           out;  // distance to the side [m] (ny + 2, nx + 2), NULL for capsules
    double                 x0, y0, z0, x1, y1, z1;  // swept box
} PlantPush;

bool dp_plant_collider_ok(const DpPlantCollider* collider);
// the box that push->collider goes through in dt; false if it is nowhere
bool dp_plant_sweep(PlantPush* push, double dt);
// how far from its root a plant can be met [m]
double dp_plant_span(const PlantStand* stand);
// can any of the colliders, which may be far apart, meet a block whose roots lie within the box?
bool dp_plant_meets_any(const float box[4], const PlantPush* push, int count, double span);
// mark the plants that a collider can meet, as they are and as far as they move in a step of dt
void dp_plant_touch(const PlantStand* stand, PlantBlock* block, const PlantPush* push, int count,
                    double dt);

// ---- plant_solve.c, TRAIL (5)

// stiffness of edges over a sub-step of h
void dp_plant_soften(const PlantStand* stand, float* soft, double h);
// stiffness of bends over a sub-step of h, from strength (bends, lanes)
void dp_plant_prepare(const PlantStand* stand, const PlantBlock* block, float* give, double h);
// edges between stems: length at rest on the ground's slope, and 1 if they hold (edges, 2, lanes)
void dp_plant_lengths(const PlantStand* stand, const PlantBlock* block, float* length);
// one sub-step. TRAIL (5)
void dp_plant_substep(const PlantStand* stand, PlantBlock* block, const float* give,
                      const float* length, float* before, const float* soft, double h);
// no stem longer than DP_MAX_STRETCH
void dp_plant_shorten(const PlantStand* stand, PlantBlock* block, const float* length);
// speeds from where particles were; returns the largest squared speed
float dp_plant_speeds(const PlantStand* stand, PlantBlock* block, const float* before, double h);

// ---- plant_push.c

// push a block's plants out of the colliders, `left` seconds before the end of the step
void dp_plant_push_block(const PlantStand* stand, PlantBlock* block, const PlantPush* push,
                         int count, const DpPlantGround* ground, const float* before, double left,
                         double h);
// roots of a block on the ground, under soles
void dp_plant_hold_block(const PlantStand* stand, PlantBlock* block, const PlantPush* push,
                         int count, const DpPlantGround* ground);

// ---- plant_ground.c

// a root on the ground, the ground's slope there and its ceiling; false where no grid tells of it
bool dp_plant_ground_lane(const PlantStand* stand, PlantBlock* block, const DpPlantGround* ground,
                          int lane);
// a ceiling that is not known yet
void dp_plant_ask_ceiling(const PlantStand* stand, PlantBlock* block, const DpPlantGround* ground,
                          int lane);
// no particle below the ground
void dp_plant_ground_block(const PlantStand* stand, PlantBlock* block, const DpPlantGround* ground);
// surface at a point, or off the ground the plane a plant stands on
double dp_plant_floor_at(const PlantBlock* block, const DpPlantGround* ground, int lane, double x,
                         double y);

// ---- plant_collide.c

// fill the distances to the side of a sole (ny + 2, nx + 2)
#define PLANT_SIDE_CELLS(sole) ((size_t)((sole)->nx + 2) * (size_t)((sole)->ny + 2))
void dp_plant_side_field(const DpPlantCollider* collider, float* out);

// ---- plant_wear.c, TRAIL (6), and plant_cover.c

// TRAIL (6) for all bends
void dp_plant_wear_block(const PlantStand* stand, PlantBlock* block, double dt);
// alpha of every plant and what hangs limp, from the bends' strength
void dp_plant_count_broken(const PlantStand* stand, PlantBlock* block);
// alpha_veg around a point, as far as plants grow again from
float dp_plant_cover_around(const DpPlants* plants, float x, float y);
