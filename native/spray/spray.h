// spray/spray.h - what sticks to soles and wheels, falls off them and flies. SUMNER99, MODEL 6.15
//
//   ground ---sticks, when a sole leaves it---> coat of a part ---falls off---> cloud ---lands---> ground
//
// A coat is places on the surface of a part, spread evenly, of which each can hold one grain. All grains are of one
// size, so that nothing is lost on the way: what is on coats and in the cloud are whole numbers of grains.
#pragma once
#include "base/status.h"
#include "base/stream.h"
#include "base/types.h"

// (name, unit, lowest, highest, default, meaning); both ends are possible
#define DP_SPRAY_NUMBERS(X)                                                                  \
    X(adhesion, "m", 0.0, 0.05, 0.002, "how thick soil sticks to what has pressed it")       \
    X(hold_time, "s", 1e-4, 100.0, 0.05, "h, in which most of it falls off, at full speed")  \
    X(slow_speed, "m/s", 0.0, 1000.0, 1.5, "slower than this nothing falls off")             \
    X(fast_speed, "m/s", 0.01, 1000.0, 5.0, "from this speed on all falls off, in its time") \
    X(particle_size, "m", 0.0005, 0.1, 0.004, "width of a grain or clump that flies")        \
    X(particle_density, "kg/m3", 10.0, 20000.0, 1600.0,                                      \
      "its mass for its volume, against the air")                                            \
    X(scatter, "-", 0.0, 1.0, 0.3, "up to this share of its speed is lost when it comes off")

typedef struct DpSprayNumbers
{
    DP_SPRAY_NUMBERS(DP_DOUBLE_MEMBER)
} DpSprayNumbers;

const DpNumber* dp_spray_numbers(int* count);
DpStatus        dp_spray_check(const DpSprayNumbers* numbers, DpReason* reason);
double          dp_spray_volume(const DpSprayNumbers* numbers);  // of a grain [m^3]

// ---- what flies --------------------------------------------------------------------------------

typedef struct DpCloud DpCloud;

typedef struct DpGrain
{
    DpVec3   at;        // over the datum of the terrain [m]
    DpVec3   velocity;  // [m/s]
    uint32_t name;      // in the order in which they came off
    uint8_t  kind;      // of soil
} DpGrain;

DpCloud* dp_cloud_create(const DpSprayNumbers* numbers);  // NULL: no memory
void     dp_cloud_destroy(DpCloud* cloud);
int      dp_cloud_count(const DpCloud* cloud);
DpGrain  dp_cloud_grain(const DpCloud* cloud, int index);

// A grain begins to fly; `late` after the begin of the step in which it flies next [s]. Its name is chosen here.
DpStatus dp_cloud_add(DpCloud* cloud, const DpGrain* grain, double late);

// Heights of the ground that grains meet over its datum [m], NaN where there is none; asked from several threads.
typedef double (*DpSpraySurface)(const void* ground, double x, double y);

typedef struct DpSprayGround
{
    DpSpraySurface surface;
    const void*    ground;

    // How high the surface is anywhere in square (i, j) of many, (i side + x0, j side + y0) its lowest corner; INFINITY:
    // not known. Asked from one thread, before grains fly: over it none is looked at. NULL: all are.
    double (*highest)(void* context, long i, long j);
    void*  context;
    double side, x0, y0;  // [m]
} DpSprayGround;

// What has come down in a step.
typedef struct DpLanding
{
    double  x, y;  // [m]
    uint8_t kind;
    bool    beside;  // fell by the ground, DP_SPRAY_FALL below where it came off: it is gone
} DpLanding;

#define DP_SPRAY_FALL 1.0  // [m]

// All grains fly for `dt` [s], by gravity and the air's drag, and those that meet the ground stop there: *landing lists
// them in the cloud's order, *landings how many, until the next call. The same for any number of workers.
DpStatus dp_cloud_fly(DpCloud* cloud, const DpSprayGround* ground, double dt, int workers,
                      const DpLanding** landing, int* landings);

void     dp_cloud_save(const DpCloud* cloud, DpStateWriter* writer);  // within an open chunk
DpStatus dp_cloud_load(DpCloud** cloud, const DpSprayNumbers* numbers, DpStateReader* reader);

// ---- what sticks -------------------------------------------------------------------------------

typedef struct DpCoat DpCoat;

// Places for grains all over a part's surface; more than DP_COAT_MOST: DP_BAD_ARGUMENT.
#define DP_COAT_MOST (1 << 20)
DpStatus dp_coat_create(DpCoat** coat, const DpMesh* part, const DpSprayNumbers* numbers,
                        uint32_t seed);
void     dp_coat_destroy(DpCoat* coat);
double   dp_coat_wanted(const DpMesh*         part,
                        const DpSprayNumbers* numbers);  // places, before there are any
int      dp_coat_held(const DpCoat* coat);               // grains on it

// What a part does from one pose to the next.
typedef struct DpCoatStep
{
    DpPose from, to;  // over the datum
    double dt;        // [s] > 0
    double sink;      // how far it stands lower than its pose says at the end [m]
    bool   presses;   // may touch the ground at the end
    bool   jumps;     // was put elsewhere: nothing falls off

    const DpSprayGround* ground;
    // Take a grain from the ground at a place; *kind its soil. False: there is none to take.
    bool (*dig)(void* digger, double x, double y, uint8_t* kind);
    void* digger;
} DpCoatStep;

// Where the part leaves the ground grains stick to it; what sticks falls off, into the cloud.
DpStatus dp_coat_step(DpCoat* coat, const DpCoatStep* step, DpCloud* cloud);

void dp_coat_save(const DpCoat* coat, DpStateWriter* writer);  // within an open chunk; NULL is fine
DpStatus dp_coat_load(DpCoat** coat, const DpMesh* part, const DpSprayNumbers* numbers,
                      uint32_t seed, DpStateReader* reader);  // *coat NULL: there was none
