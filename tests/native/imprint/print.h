// tests/native/imprint/print.h - a patch to press soles into, and a box to press.
#pragma once
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "check.h"
#include "imprint/imprint.h"

#define MAX_CELLS (160 * 160)

// a patch with an imprint on it, filled with rubbish so that what is not written shows
typedef struct Ground
{
    DpSoilPatch patch;
    DpImprint   imprint;
    float       bottom[MAX_CELLS], cover[MAX_CELLS];
    int32_t     ring[MAX_CELLS];
} Ground;

static inline void lay(Ground* ground, int nx, int ny, double cell, double x0, double y0)
{
    memset(ground, 0, sizeof *ground);
    ground->patch.nx = nx;
    ground->patch.ny = ny;
    ground->patch.row = nx + 3;
    ground->patch.cell = cell;
    ground->patch.x0 = x0;
    ground->patch.y0 = y0;
    for (int n = 0; n < MAX_CELLS; ++n) ground->bottom[n] = ground->cover[n] = -7.0f;
    for (int n = 0; n < MAX_CELLS; ++n) ground->ring[n] = -7;
    ground->imprint.bottom = ground->bottom;
    ground->imprint.cover = ground->cover;
    ground->imprint.ring = ground->ring;
}

// a patch whose middle is the world's origin
static inline void lay_centred(Ground* ground, int nx, int ny, double cell)
{
    lay(ground, nx, ny, cell, -0.5 * (nx - 1) * cell, -0.5 * (ny - 1) * cell);
}

static inline DpStatus press(Ground* ground, const DpMesh* soles, const DpPose* poses, int count,
                             int samples)
{
    DpImprintScratch* scratch = dp_imprint_scratch_create();
    const DpStatus    status =
        dp_imprint_foot(&ground->imprint, &ground->patch, soles, poses, count, samples, scratch);
    dp_imprint_scratch_destroy(scratch);
    return status;
}

static const DpPose stand = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};

static inline DpPose turned(double angle, DpVec3 axis, DpVec3 at)
{
    const DpVec3 unit = dp_unit(axis);
    const double s = sin(0.5 * angle);
    const DpPose pose = {at, {cos(0.5 * angle), s * unit.x, s * unit.y, s * unit.z}};
    return pose;
}

// a closed box, 12 triangles
static const float   box_vertex[] = {-0.1f,  -0.05f, 0.0f,  0.1f,  -0.05f, 0.0f,   0.1f,  0.05f,
                                     0.0f,   -0.1f,  0.05f, 0.0f,  -0.1f,  -0.05f, 0.03f, 0.1f,
                                     -0.05f, 0.03f,  0.1f,  0.05f, 0.03f,  -0.1f,  0.05f, 0.03f};
static const int32_t box_triangle[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                       1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
static const DpMesh  box = {8, 12, box_vertex, box_triangle};

// a heap of triangles that share nothing
static inline DpMesh random_mesh(unsigned* seed, float* vertex, int32_t* triangle, int triangles,
                                 double size)
{
    for (int n = 0; n < 3 * triangles; ++n) {
        vertex[3 * n] = (float)((check_random(seed) - 0.5) * size);
        vertex[3 * n + 1] = (float)((check_random(seed) - 0.5) * size);
        vertex[3 * n + 2] = (float)(check_random(seed) * 0.1);
        triangle[n] = n;
    }
    const DpMesh mesh = {3 * triangles, triangles, vertex, triangle};
    return mesh;
}
