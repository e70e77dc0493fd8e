// The ground before any walker: flat, heights, and what all kinds of ground share.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "terrain/terrain_inside.h"

#define EDGE_SLACK 1e-9  // of a step: a point on the last sample is not lost to rounding

static DpStatus check_heights(const DpGround* ground)
{
    if (ground->nx < 2 || ground->ny < 2 || !ground->heights || !(ground->spacing > 0.0) ||
        !isfinite(ground->spacing) || !isfinite(ground->x0) || !isfinite(ground->y0) ||
        !isfinite(ground->height))
        return DP_BAD_ARGUMENT;
    const size_t row = (size_t)ground->nx, count = row * (size_t)ground->ny;
    for (size_t n = 0; n < count; ++n)
        if (isinf(ground->heights[n])) return DP_BAD_ARGUMENT;
    for (size_t j = 0; j + 1 < (size_t)ground->ny; ++j)
        for (size_t i = 0; i + 1 < row; ++i) {
            const float* h = ground->heights + j * row + i;
            if (!isnan(h[0]) && !isnan(h[1]) && !isnan(h[row]) && !isnan(h[row + 1])) return DP_OK;
        }
    return DP_NO_GROUND;
}

static DpStatus copy_heights(Source* source, const DpGround* ground)
{
    const DpStatus status = check_heights(ground);
    if (status != DP_OK) return status;
    const size_t count = (size_t)ground->nx * (size_t)ground->ny;
    source->heights = dp_alloc(count, sizeof(float));
    if (!source->heights) return DP_NO_MEMORY;
    memcpy(source->heights, ground->heights, count * sizeof(float));
    source->height = source->somewhere = ground->height;
    for (size_t n = 0; n < count; ++n)
        if (!isnan(ground->heights[n])) {
            source->somewhere += (double)ground->heights[n];
            break;
        }
    source->nx = ground->nx, source->ny = ground->ny;
    source->x0 = ground->x0, source->y0 = ground->y0;
    source->spacing = ground->spacing;
    source->bounds[0] = ground->x0,
    source->bounds[2] = ground->x0 + (ground->nx - 1) * ground->spacing;
    source->bounds[1] = ground->y0,
    source->bounds[3] = ground->y0 + (ground->ny - 1) * ground->spacing;
    return DP_OK;
}

DpStatus dp_source_create(Source* source, const DpGround* ground, int workers)
{
    DpStatus status = DP_OK;
    size_t   weights = 0;
    memset(source, 0, sizeof *source);
    source->kind = ground->kind;
    switch (ground->kind) {
        case DP_GROUND_FLAT:
            if (!isfinite(ground->height)) return DP_BAD_ARGUMENT;
            source->height = source->somewhere = ground->height;
            source->bounds[0] = source->bounds[1] = -INFINITY;
            source->bounds[2] = source->bounds[3] = INFINITY;
            break;
        case DP_GROUND_HEIGHTS:
            status = copy_heights(source, ground);
            weights = (size_t)source->nx * (size_t)source->ny;
            break;
        case DP_GROUND_MESH:
            status = dp_mesh_create(&source->mesh, ground, workers, source->bounds);
            weights = (size_t)source->mesh.vertex_count;
            source->somewhere = source->mesh.somewhere;
            break;
        default:
            return DP_BAD_ARGUMENT;
    }
    if (status == DP_OK) status = dp_source_copy_weights(source, ground, weights);
    if (status != DP_OK) dp_source_destroy(source);
    return status;
}

void dp_source_destroy(Source* source)
{
    dp_free(source->heights);
    dp_free(source->kind_weight);
    dp_mesh_destroy(&source->mesh);
    memset(source, 0, sizeof *source);
}

// position along one axis in samples -> the sample before it and how far beyond it; false outside
static bool between(double at, int samples, int* before, double* beyond)
{
    if (!(at >= -EDGE_SLACK && at <= (double)(samples - 1) + EDGE_SLACK)) return false;
    const double held = dp_clamp(at, 0.0, (double)(samples - 1));
    const int    floored = (int)held;
    *before = floored < samples - 1 ? floored : samples - 2;
    *beyond = held - (double)*before;
    return true;
}

// in proportion; a point on a sample, up to rounding, is that sample, whatever lies beside it
static double mix(double low, double high, double share)
{
    return share <= EDGE_SLACK         ? low
           : share >= 1.0 - EDGE_SLACK ? high
                                       : low + (high - low) * share;
}

// bilinear; a square with a hole at one of its corners is a hole, but for its other samples
static double heights_at(const Source* source, double x, double y, uint8_t* kind)
{
    int    i, j;
    double u, v;
    if (!between((x - source->x0) / source->spacing, source->nx, &i, &u) ||
        !between((y - source->y0) / source->spacing, source->ny, &j, &v))
        return NAN;
    const size_t at = (size_t)j * (size_t)source->nx + (size_t)i;
    const float* h = source->heights + at;
    const float* above = h + source->nx;
    const double here = mix((double)h[0], (double)h[1], u);
    const double next = mix((double)above[0], (double)above[1], u);
    const double height = mix(here, next, v);
    if (kind && source->kind_count && !isnan(height)) {
        const size_t nearest = at + (u >= 0.5 ? 1 : 0) + (v >= 0.5 ? (size_t)source->nx : 0);
        const double full = 1.0;
        *kind = dp_source_kind(source, 1, &nearest, &full);
    }
    return height + source->height;
}

double dp_source_at(const Source* source, double x, double y, uint8_t* kind)
{
    if (kind) *kind = 0;
    if (source->kind == DP_GROUND_FLAT)
        return isfinite(x) && isfinite(y) ? source->height : (double)NAN;
    if (source->kind == DP_GROUND_HEIGHTS) return heights_at(source, x, y, kind);
    return dp_mesh_at(source, x, y, kind);
}

void dp_source_tile(const Source* source, const TileGrid* grid, float* height, uint8_t* kind)
{
    if (source->kind == DP_GROUND_MESH) {
        dp_mesh_tile(source, grid, height, kind);
        return;
    }
    for (int j = 0; j < DP_TILE; ++j) {
        const double y = dp_grid_y(&grid->world, grid->j0 + j);
        for (int i = 0; i < DP_TILE; ++i) {
            const double x = dp_grid_x(&grid->world, grid->i0 + i);
            height[j * DP_TILE + i] =
                (float)(dp_source_at(source, x, y, &kind[j * DP_TILE + i]) - grid->datum);
        }
    }
}

// ---- the doors that ask for heights -----------------------------------------------------------

void dp_terrain_bounds(const DpTerrain* terrain, double bounds[4])
{
    memcpy(bounds, terrain->source.bounds, sizeof terrain->source.bounds);
}

void dp_terrain_base_height(const DpTerrain* terrain, int count, const double* xy, double* height)
{
    for (int n = 0; n < count; ++n)
        height[n] = dp_source_at(&terrain->source, xy[2 * n], xy[2 * n + 1], NULL);
}

#define DISC 5  // lattice points across the disc; without its four corners, 21 points

DpVec3 dp_terrain_normal(const DpTerrain* terrain, double x, double y, double radius)
{
    const DpVec3 up = {0.0, 0.0, 1.0};
    const double step = radius / sqrt(5.0);  // the points (2, 1) lie on the rim
    double       at_u[DISC * DISC], at_v[DISC * DISC], at_z[DISC * DISC];
    double       mean_u = 0.0, mean_v = 0.0, mean_z = 0.0;
    int          count = 0;
    for (int b = -2; b <= 2; ++b)
        for (int a = -2; a <= 2; ++a) {
            if (a * a + b * b > 5) continue;
            const double z = dp_source_at(&terrain->source, x + a * step, y + b * step, NULL);
            if (isnan(z)) continue;
            at_u[count] = a, at_v[count] = b, at_z[count] = z;
            mean_u += a, mean_v += b, mean_z += z - at_z[0];
            ++count;
        }
    if (count < 3) return up;
    mean_u /= count, mean_v /= count, mean_z = at_z[0] + mean_z / count;

    double uu = 0.0, uv = 0.0, vv = 0.0, uz = 0.0, vz = 0.0;
    for (int n = 0; n < count; ++n) {
        const double u = at_u[n] - mean_u, v = at_v[n] - mean_v, z = at_z[n] - mean_z;
        uu += u * u, uv += u * v, vv += v * v, uz += u * z, vz += v * z;
    }
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-9) || !(step > 0.0)) return up;  // all in one line
    const double slope_x = (uz * vv - vz * uv) / (determinant * step);
    const double slope_y = (vz * uu - uz * uv) / (determinant * step);
    return dp_unit(dp_vec3(0.0 - slope_x, 0.0 - slope_y, 1.0));  // 0, not -0, where it is level
}
