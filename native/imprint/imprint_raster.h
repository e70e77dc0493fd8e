// imprint/imprint_raster.h - triangles on a grid of samples, lowest height kept. Inside the room.
#pragma once
#include "base/inline.h"
#include "base/types.h"

// A window on the grid of samples about a patch. Sample (p, q) of the whole grid sits at
// (2 p - past_u, 2 q - past_v) in units of half the distance of two samples, from the patch's
// middle: whole numbers, so that a mirrored sole meets mirrored samples to the last bit.
typedef struct DpSamples
{
    int    p0, p1, q0, q1;  // window: p0 <= p < p1, q0 <= q < q1
    int    past_u, past_v;  // samples along the whole grid, less one
    int    row;             // floats from one row to the next, a multiple of 8, 8 or more to spare
    float* low;             // lowest height of the sole above its lowest point, +inf where none [m]
} DpSamples;

// First sample at or after position x, last sample at or before it; at most one beyond the grid.
int dp_samples_first(double x, int past);
int dp_samples_last(double x, int past);

// Rectangle of samples that a triangle can cover, both ends included.
typedef struct DpSampleRect
{
    int32_t triangle, p0, p1, q0, q1;
} DpSampleRect;

// Lower the samples under `count` triangles over corners (u, v, z). z >= 0 above the lowest point.
// `due` is scratch for `count` of them.
void dp_samples_lower(const DpSamples* samples, const double* corner, const int32_t* triangle,
                      int count, DpSampleRect* due);
