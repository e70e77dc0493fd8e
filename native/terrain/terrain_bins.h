// terrain/terrain_bins.h - which bins of a mesh lie under a rectangle; terrain_bins.c fills them.
#pragma once
#include "terrain/terrain_inside.h"

// column or row of the finest bins
static inline int bin_of(double at, double from, double per_bin, int bins)
{
    const double steps = (at - from) * per_bin;
    return steps <= 0.0 ? 0 : steps >= (double)(bins - 1) ? bins - 1 : (int)steps;
}

// rectangle of bins, both ends included
typedef struct Bins
{
    int x0, x1, y0, y1;
} Bins;

static inline Bins bins_of(const MeshGround* mesh, double x_min, double x_max, double y_min,
                           double y_max)
{
    const Bins bins = {bin_of(x_min, mesh->x0, mesh->per_bin, mesh->nx),
                       bin_of(x_max, mesh->x0, mesh->per_bin, mesh->nx),
                       bin_of(y_min, mesh->y0, mesh->per_bin, mesh->ny),
                       bin_of(y_max, mesh->y0, mesh->per_bin, mesh->ny)};
    return bins;
}
