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

static DpStatus copy_heights(Rest* rest, const DpGround* ground)
{
    const DpStatus status = check_heights(ground);
    if (status != DP_OK) return status;
    const size_t count = (size_t)ground->nx * (size_t)ground->ny;
    rest->heights = dp_alloc(count, sizeof(float));
    if (!rest->heights) return DP_NO_MEMORY;
    memcpy(rest->heights, ground->heights, count * sizeof(float));
    rest->height = rest->somewhere = ground->height;
    for (size_t n = 0; n < count; ++n)
        if (!isnan(ground->heights[n])) {
            rest->somewhere += (double)ground->heights[n];
            break;
        }
    rest->level = true;
    for (size_t n = 1; n < count && rest->level; ++n)
        rest->level = ground->heights[n] == ground->heights[0];
    rest->nx = ground->nx, rest->ny = ground->ny;
    rest->x0 = ground->x0, rest->y0 = ground->y0;
    rest->spacing = ground->spacing;
    rest->bounds[0] = ground->x0, rest->bounds[2] = ground->x0 + (ground->nx - 1) * ground->spacing;
    rest->bounds[1] = ground->y0, rest->bounds[3] = ground->y0 + (ground->ny - 1) * ground->spacing;
    return DP_OK;
}

static DpStatus copy_weights(Rest* rest, const DpGround* ground, size_t weights)
{
    if (ground->kind_count == 0) return DP_OK;
    if (!ground->kind_weight || weights == 0) return DP_BAD_ARGUMENT;  // flat ground is not painted
    const size_t count = (size_t)ground->kind_count * weights;
    for (size_t n = 0; n < count; ++n)
        if (!(ground->kind_weight[n] >= 0.0f) || isinf(ground->kind_weight[n]))
            return DP_BAD_ARGUMENT;
    rest->kind_weight = dp_alloc(count, sizeof(float));
    if (!rest->kind_weight) return DP_NO_MEMORY;
    memcpy(rest->kind_weight, ground->kind_weight, count * sizeof(float));
    rest->kind_count = ground->kind_count;
    rest->weights = weights;
    return DP_OK;
}

DpStatus rest_create(Rest* rest, const DpGround* ground, int workers)
{
    DpStatus status = DP_OK;
    size_t   weights = 0;
    memset(rest, 0, sizeof *rest);
    rest->kind = ground->kind;
    switch (ground->kind) {
        case DP_GROUND_FLAT:
            if (!isfinite(ground->height)) return DP_BAD_ARGUMENT;
            rest->height = rest->somewhere = ground->height;
            rest->level = true;
            rest->bounds[0] = rest->bounds[1] = -INFINITY;
            rest->bounds[2] = rest->bounds[3] = INFINITY;
            break;
        case DP_GROUND_HEIGHTS:
            status = copy_heights(rest, ground);
            weights = (size_t)rest->nx * (size_t)rest->ny;
            break;
        case DP_GROUND_MESH:
            status = mesh_create(&rest->mesh, ground, workers, rest->bounds);
            weights = (size_t)rest->mesh.vertex_count;
            rest->level = rest->mesh.level;
            rest->somewhere = rest->mesh.somewhere;
            break;
        default:
            return DP_BAD_ARGUMENT;
    }
    if (status == DP_OK) status = copy_weights(rest, ground, weights);
    if (status != DP_OK) rest_destroy(rest);
    return status;
}

void rest_destroy(Rest* rest)
{
    dp_free(rest->heights);
    dp_free(rest->kind_weight);
    mesh_destroy(&rest->mesh);
    memset(rest, 0, sizeof *rest);
}

uint8_t heaviest_kind(const Rest* rest, int count, const size_t* of, const double* share)
{
    int    best = 0;
    double most = -1.0;
    for (int k = 0; k < rest->kind_count; ++k) {
        const float* weight = rest->kind_weight + (size_t)k * rest->weights;
        double       sum = 0.0;
        for (int n = 0; n < count; ++n) sum += share[n] * (double)weight[of[n]];
        if (sum > most) {
            most = sum;
            best = k;
        }
    }
    return (uint8_t)best;
}

// position along one axis in samples -> the sample before it and how far beyond it; false outside
static bool between(double at, int samples, int* before, double* beyond)
{
    if (!(at >= -EDGE_SLACK && at <= (double)(samples - 1) + EDGE_SLACK)) return false;
    const double held = dp_clamp(at, 0.0, (double)(samples - 1));
    const int    whole = (int)held;
    *before = whole < samples - 1 ? whole : samples - 2;
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
static double heights_at(const Rest* rest, double x, double y, uint8_t* kind)
{
    int    i, j;
    double u, v;
    if (!between((x - rest->x0) / rest->spacing, rest->nx, &i, &u) ||
        !between((y - rest->y0) / rest->spacing, rest->ny, &j, &v))
        return NAN;
    const size_t at = (size_t)j * (size_t)rest->nx + (size_t)i;
    const float* h = rest->heights + at;
    const float* above = h + rest->nx;
    const double here = mix((double)h[0], (double)h[1], u);
    const double next = mix((double)above[0], (double)above[1], u);
    const double height = mix(here, next, v);
    if (kind && rest->kind_count && !isnan(height)) {
        const size_t nearest = at + (u >= 0.5 ? 1 : 0) + (v >= 0.5 ? (size_t)rest->nx : 0);
        const double whole = 1.0;
        *kind = heaviest_kind(rest, 1, &nearest, &whole);
    }
    return height + rest->height;
}

double rest_at(const Rest* rest, double x, double y, uint8_t* kind)
{
    if (kind) *kind = 0;
    if (rest->kind == DP_GROUND_FLAT)
        return isfinite(x) && isfinite(y) ? rest->height : (double)NAN;
    if (rest->kind == DP_GROUND_HEIGHTS) return heights_at(rest, x, y, kind);
    return mesh_at(rest, x, y, kind);
}

void rest_tile(const Rest* rest, const TileGrid* grid, float* height, uint8_t* kind)
{
    if (rest->kind == DP_GROUND_MESH) {
        mesh_tile(rest, grid, height, kind);
        return;
    }
    for (int j = 0; j < DP_TILE; ++j) {
        const double y = cell_at(grid->origin_y, grid->cell, grid->j0 + j);
        for (int i = 0; i < DP_TILE; ++i) {
            const double x = cell_at(grid->origin_x, grid->cell, grid->i0 + i);
            height[j * DP_TILE + i] =
                (float)(rest_at(rest, x, y, &kind[j * DP_TILE + i]) - grid->base);
        }
    }
}

// ---- the doors that ask for heights -----------------------------------------------------------

void dp_terrain_bounds(const DpTerrain* terrain, double bounds[4])
{
    memcpy(bounds, terrain->rest.bounds, sizeof terrain->rest.bounds);
}

void dp_terrain_rest(const DpTerrain* terrain, int count, const double* xy, double* height)
{
    for (int n = 0; n < count; ++n)
        height[n] = rest_at(&terrain->rest, xy[2 * n], xy[2 * n + 1], NULL);
}

#define DISC 5  // lattice points across the disc; without its four corners, 21 points

DpVec3 dp_terrain_normal(const DpTerrain* terrain, double x, double y, double radius)
{
    const DpVec3 up = {0.0, 0.0, 1.0};
    if (terrain->rest.level) return up;
    const double step = radius / sqrt(5.0);  // the points (2, 1) lie on the rim
    double       at_u[DISC * DISC], at_v[DISC * DISC], at_z[DISC * DISC];
    double       mean_u = 0.0, mean_v = 0.0, mean_z = 0.0;
    int          count = 0;
    for (int b = -2; b <= 2; ++b)
        for (int a = -2; a <= 2; ++a) {
            if (a * a + b * b > 5) continue;
            const double z = rest_at(&terrain->rest, x + a * step, y + b * step, NULL);
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
    const double whole = uu * vv - uv * uv;
    if (!(whole > 1e-9) || !(step > 0.0)) return up;  // all in one line
    const double slope_x = (uz * vv - vz * uv) / (whole * step);
    const double slope_y = (vz * uu - uz * uv) / (whole * step);
    return dp_unit(dp_vec3(-slope_x, -slope_y, 1.0));
}
