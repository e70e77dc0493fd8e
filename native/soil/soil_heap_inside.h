// soil/soil_heap_inside.h - what the files of the resting heap share: soil_heap_rest.c finds its height,
// soil_heap_window.c reads the surface, soil_heap_envelope.c lays the cones.
#pragma once
#include "soil/soil_inside.h"

#define NOTHING (-(1 << 30))  // no cone reaches this cell
#define WALL (1 << 29)        // surface of cells that take no soil: under the sole, no ground
#define MAX_STEPS (1 << 28)   // heights stay below this, so that no sum can overflow

// The part of the patch that is worked on, with a frame of one wall cell around it.
typedef struct Window
{
    int      i0, j0, nx, ny;  // patch cells i0 <= i < i0 + nx, j0 <= j < j0 + ny
    int      row;             // nx + 2, and what makes rows start evenly
    int32_t* surface;         // present surface h, WALL where no soil can go [steps] (ny + 2, row)
    int32_t* fill;            // envelope of the cones                        [steps] (ny + 2, row)
    int32_t* turn;            // where a run of cells begins: its end; of walls: minus that
    int32_t* spare;           // one row
} Window;

// A border cell with a share.
typedef struct Apex
{
    int    i, j;    // of the patch
    double ground;  // firm ground [m]
    double root;    // sqrt(omega) [-]
    double away;    // from the sole's edge, beyond half a cell [cells]
    double spills;  // beta where what is pushed ahead flows off at the side of its face, else 0 [-]
    double climbs;  // from that side to here at the rest angle [m]
} Apex;

typedef struct Heap
{
    DpSoilPatch*     patch;
    const DpImprint* imprint;
    Window           window;
    Apex*            apex;
    int              apex_count;
    float            hollow;    // untouched cells pressed this deep take no soil [m]
    double           step;      // height of one step    [m]
    double           level;     // height of step 0      [m]
    int32_t          straight;  // what a cone falls per cell                [steps]
    int32_t          diagonal;  // .. per diagonal cell, sqrt(2) times that  [steps]
} Heap;

// What lies over the present surface.
typedef struct Laid
{
    int64_t volume;  // [steps * cells]
    int64_t cells;   // how many cells that is
} Laid;

static inline int32_t* row_of(const Window* window, int32_t* grid, int j)
{
    return grid + (size_t)(j + 1) * (size_t)window->row + 1;
}

// Read the surface of the patch's cells `box` into the window; false if its heights do
// not fit the steps.
bool dp_heap_open(Heap* heap, double height, double slope, DpCellRect box);

// A grid of one height in all cells [steps].
void dp_heap_flat(int32_t* grid, size_t cells, int32_t height);

// Lay cones of height T sqrt(omega), lower beside the sides of what is pushed ahead, and measure
// what lies over the present surface.
Laid dp_heap_fill(const Heap* heap, double height);
