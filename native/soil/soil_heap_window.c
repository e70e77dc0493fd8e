// soil/soil_heap_window.c - the surface a heap is laid on, in whole numbers of a small step.
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_heap_inside.h"

#define LANES 8  // lowest and highest of so many columns at once

// lowest firm ground and highest surface of one row; ground that is not there is NaN and not less
DP_CLONES
static void range_of_row(const float* restrict base_height, const float* restrict compression,
                         const float* restrict heap, int count, double* restrict low,
                         double* restrict high)
{
    for (int i = 0; i < count; i += LANES) {
        const int lanes = count - i < LANES ? count - i : LANES;
        for (int k = 0; k < lanes; ++k) {
            const double firm = (double)base_height[i + k] - (double)compression[i + k];
            const double top = firm + (double)heap[i + k];
            low[k] = firm < low[k] ? firm : low[k];
            high[k] = top > high[k] ? top : high[k];
        }
    }
}

// the surface in steps above `low`; WALL where takes_soil() says no
DP_CLONES
static void surface_of_row(int32_t* restrict surface, const float* restrict base_height,
                           const float* restrict compression, const float* restrict heap,
                           const int32_t* restrict ring, int count, float hollow, double low,
                           double steps)
{
    for (int i = 0; i < count; ++i) {
        const int takes =
            (base_height[i] == base_height[i]) & (ring[i] > 0) & (compression[i] < hollow);
        const double at = (double)base_height[i] - (double)compression[i] - low;
        const double top = (at + (double)heap[i]) * steps + 0.5;
        surface[i] = takes ? (int32_t)(takes ? top : 0.0) : WALL;
    }
}

static void find_turns(int32_t* turn, const int32_t* surface, int count)
{
    for (int from = 0, to = 0; from < count; from = to) {
        const bool wall = surface[from] == WALL;
        while (to < count && (surface[to] == WALL) == wall) ++to;
        turn[from] = wall ? -to : to;
    }
}

DP_CLONES
static void flat(int32_t* grid, size_t cells, int32_t height)
{
    for (size_t k = 0; k < cells; ++k) grid[k] = height;
}

void dp_heap_flat(int32_t* grid, size_t cells, int32_t height)
{
    flat(grid, cells, height);
}

bool dp_heap_open(Heap* heap, double height, double slope, DpCellRect box)
{
    DpSoilPatch* patch = heap->patch;
    Window*      window = &heap->window;
    window->i0 = (int)box.i0, window->j0 = (int)box.j0;
    window->nx = (int)(box.i1 - box.i0), window->ny = (int)(box.j1 - box.j0);
    double low = INFINITY, high = -INFINITY, lows[LANES], highs[LANES];
    for (int k = 0; k < LANES; ++k) lows[k] = INFINITY, highs[k] = -INFINITY;
    for (long j = box.j0; j < box.j1; ++j) {
        const size_t p = soil_at(patch, box.i0, j);
        range_of_row(patch->base_height + p, patch->compression + p, patch->heap + p, window->nx,
                     lows, highs);
    }
    for (int k = 0; k < LANES; ++k) {
        low = soil_min(low, lows[k]);
        high = soil_max(high, highs[k]);
    }
    const double fall = slope * patch->cell * (double)(window->nx + window->ny);
    const double range = high - low + height + fall;
    int          exponent = 0;
    (void)frexp(range, &exponent);
    if (!isfinite(range) || exponent > 40) return false;
    heap->step = ldexp(1.0, exponent - 28);  // range / step <= MAX_STEPS
    heap->level = low;
    heap->straight = (int32_t)floor(slope * patch->cell / heap->step + 0.5);
    heap->diagonal = (int32_t)floor(slope * patch->cell * sqrt(2.0) / heap->step + 0.5);

    const size_t cells = (size_t)window->row * (size_t)(window->ny + 2);
    dp_heap_flat(window->surface, cells, WALL);
    const double steps = 1.0 / heap->step;  // a power of two: exact
    for (int j = 0; j < window->ny; ++j) {
        const size_t p = soil_at(patch, window->i0, window->j0 + j);
        int32_t*     surface = row_of(window, window->surface, j);
        surface_of_row(surface, patch->base_height + p, patch->compression + p, patch->heap + p,
                       heap->imprint->ring + p, window->nx, heap->hollow, low, steps);
        find_turns(row_of(window, window->turn, j), surface, window->nx);
    }
    return true;
}
