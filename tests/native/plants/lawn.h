// tests/native/plants/lawn.h - small stands of plants and the things that walk on them.
#pragma once
#include "base/vec.h"
#include "check.h"
#include "plants/plants.h"

#define SOLE_SIDE 41

static inline DpPlants* lawn(const DpPlantKind* kind, int nx, int ny, double apart, uint64_t seed)
{
    float*    root = dp_alloc((size_t)(nx * ny), 3 * sizeof(float));
    int       stand = -1;
    DpPlants* plants = dp_plants_create(seed);
    for (int k = 0; k < nx * ny; ++k) {
        root[3 * k] = (float)(apart * (k % nx));
        root[3 * k + 1] = (float)(apart * (k / nx));
    }
    CHECK(dp_plants_add(plants, kind, root, NULL, nx * ny, &stand) == DP_OK);
    CHECK(stand == 0);
    dp_free(root);
    return plants;
}

// a rectangular sole, its underside at z, tilted by `tilt` along x, in a window of SOLE_SIDE cells
static inline DpPlantCollider sole(float* bottom, double cell, double x, double y, double z,
                                   double long_, double wide, double tilt)
{
    const int half = SOLE_SIDE / 2;
    for (int j = 0; j < SOLE_SIDE; ++j)
        for (int i = 0; i < SOLE_SIDE; ++i) {
            const double dx = (i - half) * cell, dy = (j - half) * cell;
            const bool   in = fabs(dx) <= 0.5 * long_ && fabs(dy) <= 0.5 * wide;
            bottom[j * SOLE_SIDE + i] = in ? (float)(z + tilt * dx) : INFINITY;
        }
    return (DpPlantCollider){.nx = SOLE_SIDE,
                             .ny = SOLE_SIDE,
                             .row = SOLE_SIDE,
                             .cell = cell,
                             .x0 = x - half * cell,
                             .y0 = y - half * cell,
                             .bottom = bottom,
                             .thickness = 0.12,
                             .friction = 0.5};
}

static inline void step(DpPlants* plants, const DpPlantCollider* c, int count, double dt)
{
    DpPlantsReport told;
    CHECK(dp_plants_step(plants, NULL, c, count, dt, 1, &told) == DP_OK);
}

// the longest stem edge against its rest length, the longest of the others, the farthest that a particle is from its
// rest place, and the shortest stem edge, over all plants
typedef struct Strain
{
    double stem, across, away, lowest;
    bool   finite;
    double shortest;
} Strain;

static inline Strain strain_of(const DpPlants* plants, const DpPlantKind* kind, int plants_count)
{
    const DpPlantShape shape = dp_plant_shape(kind);
    const double       gap = (double)kind->height / (shape.rows - 2);
    const double       wide =
        shape.stems_a_sheet > 1 ? (double)kind->width / (shape.stems_a_sheet - 1) : 0.0;
    float* at = dp_alloc((size_t)shape.particles, 3 * sizeof(float));
    Strain s = {0.0, 0.0, 0.0, 1e9, true, 1e9};
    for (int k = 0; k < plants_count; ++k) {
        CHECK(dp_plants_read(plants, 0, k, at, NULL, NULL) == DP_OK);
        for (int c = 0; c < 3 * shape.particles; ++c) s.finite = s.finite && isfinite(at[c]);
        for (int p = 0; p < shape.particles; ++p) {
            const float* a = at + 3 * p;
            const int    r = p % shape.rows;
            if (r >= 1) s.lowest = fmin(s.lowest, (double)a[2]);
            if (r >= 1 && r + 1 < shape.rows) {
                const double l = dp_length(
                    dp_vec3((double)(a[3] - a[0]), (double)(a[4] - a[1]), (double)(a[5] - a[2])));
                s.stem = fmax(s.stem, gap > 0.0 ? l / gap : l);
                s.shortest = fmin(s.shortest, gap > 0.0 ? l / gap : l);
            }
            if (r >= 2 && p / shape.rows % shape.stems_a_sheet + 1 < shape.stems_a_sheet) {
                const float* b = a + 3 * shape.rows;
                const double l = dp_length(
                    dp_vec3((double)(b[0] - a[0]), (double)(b[1] - a[1]), (double)(b[2] - a[2])));
                s.across = fmax(s.across, wide > 0.0 ? l / wide : l);
            }
            // straight kinds stand over their feet
            const float* foot = at + 3 * (p - r + 1);
            const double up = gap * (r - 1);
            s.away =
                fmax(s.away, dp_length(dp_vec3((double)(a[0] - foot[0]), (double)(a[1] - foot[1]),
                                               (double)(a[2] - foot[2]) - up)));
        }
    }
    dp_free(at);
    return s;
}
