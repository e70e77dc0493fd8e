// tests/native/soil/heap.h - uneven ground with a sole, and a window on it, for the tests of the resting heap.
#pragma once
#include "check.h"
#include "ground.h"
#include "soil/soil_heap_inside.h"

#define NX 37
#define NY 29
#define CELL 0.01
#define SLOPE 0.6
#define HEIGHT 0.05

static int32_t surface[64 * 64], fill[64 * 64], turn[64 * 64], spare[64];
static Apex    apex[3];

static inline Heap heap_on(Ground* ground, int i0, int j0, int nx, int ny)
{
    Heap heap = {
        .patch = &ground->patch, .imprint = &ground->imprint, .apex = apex, .hollow = INFINITY};
    heap.window.row = 64;
    heap.window.surface = surface, heap.window.fill = fill;
    heap.window.turn = turn, heap.window.spare = spare;
    CHECK(dp_heap_open(&heap, HEIGHT, SLOPE, dp_cells(i0, j0, nx, ny)));
    return heap;
}

// ground that goes up and down, with holes, and a sole
static inline Ground uneven_ground(unsigned seed)
{
    Ground ground = ground_make(NX, NY, CELL, dp_soil_default());
    for (int k = 0; k < NX * NY; ++k) {
        ground.base_height[k] = 3.0f + 0.01f * (float)check_random(&seed);
        ground.compression[k] = 0.02f * (float)check_random(&seed);
        ground.heap[k] = check_random(&seed) < 0.5 ? 0.0f : 0.01f * (float)check_random(&seed);
        if (check_random(&seed) < 0.04) ground.base_height[k] = NAN;
        const int i = k % NX, j = k / NX;
        ground.imprint.ring[k] = i >= 14 && i < 22 && j >= 9 && j < 21 ? 0 : DP_RING_FAR;
    }
    return ground;
}
