// maps/maps_at.c - what planes of cells say at the points of a mesh.
#include <math.h>

#include "base/parallel.h"
#include "maps/maps.h"

#define CHUNK 32768  // points looked at by one worker at a time

typedef struct Asking
{
    const DpPlanes* planes;
    const DpPoints* points;
    float*          out;
} Asking;

// where a point lies among the centres of cells, along x or y [cells]
static inline double place_of(const DpPlanes* planes, const DpPoints* points, int n, int axis)
{
    double at;
    if (points->world) {
        at = points->world[3 * (size_t)n + (size_t)axis];
    } else {
        const float*  p = points->local + 3 * (size_t)n;
        const double* row = points->place + 4 * axis;
        at = (double)p[0] * row[0] + (double)p[1] * row[1] + (double)p[2] * row[2] + row[3];
    }
    return (at - (axis ? planes->y0 : planes->x0)) / planes->cell - 0.5;
}

// the cell before a place above -1.5, and how far beyond its centre it is
static inline int split(const DpPlanes* planes, double place, float* beyond)
{
    const int    near = (int)(place + 2.5) - 2;
    const double off = place - (double)near;
    const bool   on = fabs(off) < planes->still;
    const int    before = !on && off < 0.0 ? near - 1 : near;
    *beyond = on ? 0.0f : (float)(place - (double)before);
    return before;
}

// out += share of a cell
static inline void add_cell(const DpPlanes* planes, int i, int j, float share, float* out,
                            size_t stride)
{
    if (!(share > 0.0f) || i < 0 || j < 0 || i >= planes->nx || j >= planes->ny) return;
    const size_t at = (size_t)j * (size_t)planes->nx + (size_t)i;
    for (int p = 0; p < planes->count; ++p) out[(size_t)p * stride] += share * planes->plane[p][at];
}

static void ask(void* context, int chunk, int worker)
{
    const Asking*   asking = context;
    const DpPlanes* planes = asking->planes;
    const int       count = asking->points->count;
    const int       end = count - chunk * CHUNK < CHUNK ? count : (chunk + 1) * CHUNK;
    (void)worker;
    for (int n = chunk * CHUNK; n < end; ++n) {
        const double x = place_of(planes, asking->points, n, 0);
        const double y = place_of(planes, asking->points, n, 1);
        if (!(x > -1.5 && y > -1.5 && x < planes->nx && y < planes->ny)) continue;
        float     u, v;
        const int i = split(planes, x, &u), j = split(planes, y, &v);
        for (int dj = 0; dj < 2; ++dj)
            for (int di = 0; di < 2; ++di)
                add_cell(planes, i + di, j + dj, (di ? u : 1.0f - u) * (dj ? v : 1.0f - v),
                         asking->out + n, (size_t)count);
    }
}

void dp_planes_at(const DpPlanes* planes, const DpPoints* points, int workers, float* out)
{
    Asking asking = {planes, points, out};
    dp_parallel_for((points->count + CHUNK - 1) / CHUNK, workers, ask, &asking);
}
