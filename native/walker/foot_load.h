// walker/foot_load.h - what carries one walker over a clip, for the files of TRAIL (3).
#pragma once
#include "walker/walker_inside.h"

// one walker: its limbs and their contact points in a row, and what they do over the clip
typedef struct DpLoad
{
    const DpGait*        gait;
    const DpLoadOptions* options;
    const double*        ground;
    double               rate;
    int                  walker, limbs, points;
    int*                 limb;          // index of each limb                  (limbs)
    int*                 point;         // index of each point, limb by limb   (points)
    int*                 first;         // first point of each limb            (limbs + 1)
    double*              capacity;      // how much of a load suits each point (points)
    DpVec3*              place;         // the points in the world, z on the ground (points, T)
    uint8_t*             limb_on;       //                                     (limbs, T)
    uint8_t*             point_on;      //                                     (points, T)
    double*              limb_weight;   // W_i of limbs                        (limbs, T)
    double*              point_weight;  // and of points within their limb     (points, T)
    double*              accel;         // a_com                               (3, T)
    double*              velocity;      // v_com over the ground               (2, T)
    DpVec3*              landing;       // v0 latched for the impulse          (limbs)
    int*                 landed;        // its sample; -1 = never              (limbs)
    double*              tau;           // of the soil it landed on        [s] (limbs)
} DpLoad;

bool dp_load_open(DpLoad* load);  // gait, options, ground and rate are set; false: no memory
void dp_load_close(DpLoad* load);

// Go on to a walker: its limbs and points, which of them carry, and their ramps.
void dp_load_gather(DpLoad* load, int walker, const uint8_t* touching);
