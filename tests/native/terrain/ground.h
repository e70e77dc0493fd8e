// tests/native/terrain/ground.h - small grounds that the terrain's tests share.
#pragma once
#include "check.h"
#include "terrain/terrain.h"

static const DpSoil ground_soils[3] = {{.layer_depth = 0.3f,
                                        .young_modulus = 2e6f,
                                        .poisson_ratio = 0.05f,
                                        .settle_time = 0.2f,
                                        .rest_angle = 0.5585f,
                                        .wall_angle = 1.5707964f,
                                        .grain_size = 0.012f},
                                       {.layer_depth = 0.3f,
                                        .young_modulus = 4e5f,
                                        .poisson_ratio = 0.05f,
                                        .settle_time = 0.2f,
                                        .rest_angle = 0.6632f,
                                        .wall_angle = 1.5707964f,
                                        .grain_size = 0.012f},
                                       {.layer_depth = 0.3f,
                                        .young_modulus = 6e5f,
                                        .poisson_ratio = 0.35f,
                                        .settle_time = 0.2f,
                                        .rest_angle = 0.2618f,
                                        .wall_angle = 1.5707964f,
                                        .grain_size = 0.012f}};

static inline DpTerrainOptions ground_options(double cell, double origin_x, double origin_y)
{
    const DpTerrainOptions options = {{cell, origin_x, origin_y}, ground_soils, 3, 2, 0, NULL};
    return options;
}

static inline DpGround ground_flat(double height)
{
    DpGround ground = {0};
    ground.kind = DP_GROUND_FLAT;
    ground.height = height;
    return ground;
}

static inline DpGround ground_mesh(int vertices, const double* vertex, int triangles,
                                   const int32_t* triangle)
{
    DpGround ground = {0};
    ground.kind = DP_GROUND_MESH;
    ground.vertex_count = vertices;
    ground.triangle_count = triangles;
    ground.vertex = vertex;
    ground.triangle = triangle;
    return ground;
}

static inline DpGround ground_heights(int nx, int ny, double x0, double y0, double spacing,
                                      const float* heights)
{
    DpGround ground = {0};
    ground.kind = DP_GROUND_HEIGHTS;
    ground.nx = nx, ground.ny = ny;
    ground.x0 = x0, ground.y0 = y0;
    ground.spacing = spacing;
    ground.heights = heights;
    return ground;
}

// the terrain on a ground, or NULL with the status told
static inline DpTerrain* ground_terrain(const DpGround* ground, double cell, double origin_x,
                                        double origin_y)
{
    DpTerrain*             terrain = NULL;
    const DpTerrainOptions options = ground_options(cell, origin_x, origin_y);
    const DpStatus         status = dp_terrain_create(&terrain, &options, ground);
    if (status != DP_OK) printf("  no terrain: %s\n", dp_status_text(status));
    return terrain;
}

// a ground that a test has spoiled is refused; then it is as good as before
#define CHECK_REFUSED(terrain, options, spoiled, good, want)                    \
    do {                                                                        \
        CHECK(dp_terrain_create(&(terrain), &(options), &(spoiled)) == (want)); \
        CHECK((terrain) == NULL);                                               \
        (spoiled) = (good);                                                     \
    } while (0)
