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
static double place_of(const Asking* asking, int n, int axis)
{
    const DpPlanes* planes = asking->planes;
    const DpPoints* points = asking->points;
    double          at;
    if (points->world) {
        at = points->world[3 * (size_t)n + (size_t)axis];
    } else {
        const float*  p = points->local + 3 * (size_t)n;
        const double* row = points->place + 4 * axis;
        at = (double)p[0] * row[0] + (double)p[1] * row[1] + (double)p[2] * row[2] + row[3];
    }
    const double cells = (at - (axis ? planes->y0 : planes->x0)) / planes->cell - 0.5;
    const double near = nearbyint(cells);
    return fabs(cells - near) < planes->still ? near : cells;
}

// out += share of a cell
static void add_cell(const DpPlanes* planes, double i, double j, float share, float* out,
                     size_t stride)
{
    if (!(share > 0.0f) || i < 0.0 || j < 0.0 || i >= planes->nx || j >= planes->ny) return;
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
        const double x = place_of(asking, n, 0), y = place_of(asking, n, 1);
        float*       out = asking->out + n;
        if (!(x > -1.0 && y > -1.0 && x < planes->nx && y < planes->ny)) continue;
        const double i = floor(x), j = floor(y);
        const float  u = (float)(x - i), v = (float)(y - j);
        for (int dj = 0; dj < 2; ++dj)
            for (int di = 0; di < 2; ++di)
                add_cell(planes, i + di, j + dj, (di ? u : 1.0f - u) * (dj ? v : 1.0f - v), out,
                         (size_t)count);
    }
}

void dp_planes_at(const DpPlanes* planes, const DpPoints* points, int workers, float* out)
{
    Asking asking = {planes, points, out};
    dp_parallel_for((points->count + CHUNK - 1) / CHUNK, workers, ask, &asking);
}
