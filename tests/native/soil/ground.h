// tests/native/soil/ground.h - a small piece of ground and a sole made of boxes, for the soil's
// tests and its benchmark. The sole is sampled 8 x 8 times a cell, so edges may lie anywhere.
#pragma once
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "soil/soil.h"

typedef struct Ground
{
    DpSoilPatch patch;
    DpImprint   imprint;
    DpSoil      soil[4];
    float *     base_height, *compression, *heap, *pressure_time, *modulus, *rest_slope;
    uint8_t*    kind;
} Ground;

static inline void ground_material(Ground* ground)
{
    for (int k = 0; k < ground->patch.nx * ground->patch.ny; ++k) {
        ground->modulus[k] = ground->soil[ground->kind[k]].young_modulus;
        ground->rest_slope[k] = (float)tan((double)ground->soil[ground->kind[k]].rest_angle);
    }
}

// level ground of nx x ny cells, its middle at (0, 0), rows as long as they need to be
static inline Ground ground_make(int nx, int ny, double cell, DpSoil soil)
{
    Ground       ground = {0};
    const size_t cells = (size_t)nx * (size_t)ny;
    ground.base_height = dp_alloc(cells, sizeof(float));
    ground.compression = dp_alloc(cells, sizeof(float));
    ground.heap = dp_alloc(cells, sizeof(float));
    ground.pressure_time = dp_alloc(cells, sizeof(float));
    ground.modulus = dp_alloc(cells, sizeof(float));
    ground.rest_slope = dp_alloc(cells, sizeof(float));
    ground.kind = dp_alloc(cells, 1);
    ground.imprint.bottom = dp_alloc(cells, sizeof(float));
    ground.imprint.cover = dp_alloc(cells, sizeof(float));
    ground.imprint.ring = dp_alloc(cells, sizeof(int32_t));
    for (int k = 0; k < 4; ++k) ground.soil[k] = soil;
    ground.patch = (DpSoilPatch){.nx = nx,
                                 .ny = ny,
                                 .row = nx,
                                 .cell = cell,
                                 .x0 = -0.5 * (nx - 1) * cell,
                                 .y0 = -0.5 * (ny - 1) * cell,
                                 .base_height = ground.base_height,
                                 .compression = ground.compression,
                                 .heap = ground.heap,
                                 .pressure_time = ground.pressure_time,
                                 .modulus = ground.modulus,
                                 .rest_slope = ground.rest_slope,
                                 .kind = ground.kind,
                                 .soil_count = 4};
    ground_material(&ground);
    return ground;
}

static inline void ground_free(Ground* ground)
{
    dp_free(ground->base_height), dp_free(ground->compression), dp_free(ground->heap);
    dp_free(ground->pressure_time), dp_free(ground->modulus), dp_free(ground->rest_slope);
    dp_free(ground->kind), dp_free(ground->imprint.bottom), dp_free(ground->imprint.cover);
    dp_free(ground->imprint.ring);
}

// A sole: a box of length along `heading`, flat underside at height z, tilted by pitch (slope along
// the heading: > 0 lifts the front), its middle at (x, y).
typedef struct BoxSole
{
    double x, y, z, length, width, heading, pitch;
} BoxSole;

static inline void ground_sole(Ground* ground, BoxSole sole)
{
    DpSoilPatch* patch = &ground->patch;
    DpImprint*   imprint = &ground->imprint;
    patch->soils = ground->soil;
    const double along_x = cos(sole.heading), along_y = sin(sole.heading);
    imprint->i0 = patch->nx, imprint->i1 = 0, imprint->j0 = patch->ny, imprint->j1 = 0;
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            int    hits = 0;
            double height = 0.0;
            for (int b = 0; b < 8; ++b)
                for (int a = 0; a < 8; ++a) {
                    const double x = patch->x0 + (i + (a - 3.5) / 8.0) * patch->cell - sole.x;
                    const double y = patch->y0 + (j + (b - 3.5) / 8.0) * patch->cell - sole.y;
                    const double along = x * along_x + y * along_y;
                    const double across = y * along_x - x * along_y;
                    if (fabs(along) > 0.5 * sole.length || fabs(across) > 0.5 * sole.width)
                        continue;
                    ++hits;
                    height += sole.z + sole.pitch * along;
                }
            const int at = j * patch->row + i;
            imprint->cover[at] = (float)(hits / 64.0);
            imprint->bottom[at] = hits ? (float)(height / hits) : INFINITY;
            if (!hits) continue;
            imprint->i0 = i < imprint->i0 ? i : imprint->i0;
            imprint->i1 = i >= imprint->i1 ? i + 1 : imprint->i1;
            imprint->j0 = j < imprint->j0 ? j : imprint->j0;
            imprint->j1 = j >= imprint->j1 ? j + 1 : imprint->j1;
        }
}

// ring k is k steps of 8-neighbourhood from ring 0, by looking at every cell again and again
static inline void ground_rings(Ground* ground, int rings)
{
    const DpSoilPatch* patch = &ground->patch;
    int32_t*           ring = ground->imprint.ring;
    for (int r = 1; r <= rings; ++r)
        for (int j = 0; j < patch->ny; ++j)
            for (int i = 0; i < patch->nx; ++i) {
                if (ring[j * patch->row + i] != DP_RING_FAR) continue;
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a) {
                        const int x = i + a, y = j + b;
                        if (x < 0 || x >= patch->nx || y < 0 || y >= patch->ny) continue;
                        if (ring[y * patch->row + x] == r - 1) ring[j * patch->row + i] = r;
                    }
            }
}

static inline DpFootForce ground_load(double newton)
{
    const DpFootForce foot = {{0.0, 0.0, -newton}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    return foot;
}

static inline double ground_sum(const Ground* ground, const float* grid)
{
    double sum = 0.0;
    for (int k = 0; k < ground->patch.nx * ground->patch.ny; ++k) sum += (double)grid[k];
    return sum * ground->patch.cell * ground->patch.cell;
}

static inline double ground_max(const Ground* ground, const float* grid)
{
    double most = 0.0;
    for (int k = 0; k < ground->patch.nx * ground->patch.ny; ++k)
        most = fmax(most, (double)grid[k]);
    return most;
}
