// motion/motion_inside.h - what a motion holds; for the files of this room only.
#pragma once
#include "motion/motion.h"

// Poses and loads of some parts over some samples: part p, sample k at (p * count + k).
typedef struct Block
{
    int      first, count;    // samples
    double*  pose;            // (parts, count, 7)
    double*  force;           // (parts, count, 3)
    double*  pressure_point;  // (parts, count, 3)
    uint8_t* touching;        // (parts, count)
} Block;

struct DpMotion
{
    DpGait   cast;   // copies of all its arrays, below
    double*  mass;   // (walkers)
    uint8_t* law;    // (walkers)
    int32_t* owner;  // limb_walker (limbs), part_limb (parts)
    DpMesh*  sole;   // (parts)
    float*   vertex;
    int32_t* triangle;
    int*     walker_of;   // walker of each part (parts)
    int*     own_number;  // of each part among those of its walker (parts)
    int*     own_parts;   // how many each walker has (walkers)

    int     samples;
    double* time;  // recorded, tracks: (samples); live: (room)

    // recorded and tracks
    Block* block;  // those of walker w, rising: start[w] .. start[w + 1]
    int*   start;  // (walkers + 1)

    // live: sample k lies at k % room
    bool     live;
    int      room, oldest;  // samples kept: oldest .. samples - 1
    Block    window;        // (parts, room, ..)
    uint8_t* present;       // (room, walkers)
    double   first_touch;
};

// motion_cast.c: an empty motion of these walkers; numbers that are no poses or loads
DpStatus dp_motion_open(DpMotion** motion, const DpGait* cast);
void     dp_motion_drop(DpMotion* motion);
bool     dp_motion_times_hold(const double* time, int count);
bool     dp_motion_poses_hold(const DpLoadedPoses* poses, size_t count);  // count = parts * samples
DpStatus dp_block_open(Block* block, int parts, int first, int count);
void     dp_block_drop(Block* block);
// Copy `count` samples of one part, from `from` to `to` (numbers of part and sample in their blocks).
void dp_block_take(Block* block, size_t to, const DpLoadedPoses* poses, size_t from, size_t count);
// What lies at a place of a block.
DpPartState dp_block_state(const Block* block, size_t at);
