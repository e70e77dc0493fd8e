// carry/carry_inside.h - the store of a limb; not a door.
#pragma once
#include "carry/carry.h"

// A piece of a part's surface: a cube of the part's frame.
typedef struct Block
{
    int32_t part, x, y, z;
} Block;

// A cell that the sole touches.
typedef struct Touch
{
    long   i, j;   // in the world
    int    block;  // of the sole that lies over it
    float  share;  // of the cell that the sole covers
    double peak;   // pressure so far [Pa]
    double since;  // .. before the step at hand
} Touch;

struct DpCarry
{
    int     coats;
    double  side;     // of a block [m]
    Block*  block;    // (blocks)
    double* amount;   // of each soil on each block [m^3] (blocks, coats)
    double* brought;  // .. when the block came to the ground (blocks, coats)
    double* had;      // .. before cells of a step take and leave (blocks, coats)
    double* asked;    // .. what those ask for together (blocks, coats)
    int*    held;     // cells it touches (blocks)
    double  grid;     // of amounts, so that their sums do not depend on their order
    double* taken;    // of each soil, in all [m^3] (coats)
    int     blocks;
    int*    slot;  // hash of blocks, -1 = empty: a power of two of slots, at most half of them full
    int     slots;
    Touch*  touch;  // ascending (j, i) (touches)
    Touch*  next;   // those of the step at hand
    Touch*  gone;   // those that let go in it
    int     touches;
};

// carry_store.c: the number of a block, which is created if it is not there; -1 without memory
int dp_carry_block(DpCarry* carry, Block key);
