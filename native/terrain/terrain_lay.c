// terrain/terrain_lay.c - ground that was trodden before: a trail is laid down as somebody left it.
#include <math.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

// whether every value is a finite number >= 0
static bool is_trail(size_t count, const float* value)
{
    for (size_t k = 0; k < count; ++k)
        if (!(value[k] >= 0.0f) || isinf(value[k])) return false;
    return true;
}

static bool is_trodden(const DpTrail* trail, const TilePart* part)
{
    for (int j = 0; j < part->ny; ++j)
        for (int i = 0; i < part->nx; ++i) {
            const size_t at = (size_t)(part->j + j) * (size_t)trail->nx + (size_t)(part->i + i);
            if (trail->compression[at] > 0.0f || trail->heap[at] > 0.0f ||
                trail->pressure_time[at] > 0.0f)
                return true;
        }
    return false;
}

static DpStatus lay_tile(DpTerrain* terrain, DpLease* lease, const DpTrail* trail,
                         const TilePart* part)
{
    const long     i0 = trail->i0 + part->i, j0 = trail->j0 + part->j;
    DpSoilPatch*   patch = NULL;
    const DpStatus status =
        dp_terrain_acquire(terrain, lease, dp_cells(i0, j0, part->nx, part->ny), &patch);
    if (status != DP_OK) return status;
    for (int j = 0; j < part->ny; ++j)
        for (int i = 0; i < part->nx; ++i) {
            const size_t from = (size_t)(part->j + j) * (size_t)trail->nx + (size_t)(part->i + i);
            const size_t to = (size_t)j * (size_t)patch->row + (size_t)i;
            patch->compression[to] = trail->compression[from];
            patch->heap[to] = trail->heap[from];
            patch->pressure_time[to] = trail->pressure_time[from];
        }
    if (trail->as_left) trail->as_left(patch);
    dp_terrain_commit(terrain, lease, dp_cells(0, 0, part->nx, part->ny));
    return DP_OK;
}

DpStatus dp_terrain_lay(DpTerrain* terrain, const DpTrail* trail)
{
    if (!dp_terrain_has(trail->i0, trail->j0, trail->nx, trail->ny)) return DP_BAD_ARGUMENT;
    const DpCellRect cells = dp_cells(trail->i0, trail->j0, trail->nx, trail->ny);
    const size_t     count = (size_t)trail->nx * (size_t)trail->ny;
    if (!is_trail(count, trail->compression) || !is_trail(count, trail->heap) ||
        !is_trail(count, trail->pressure_time))
        return DP_BAD_ARGUMENT;
    DpLease* lease = dp_lease_create();
    if (!lease) return DP_NO_MEMORY;
    DpStatus status = DP_OK;
    for (long ty = dp_tile_of(cells.j0); status == DP_OK && ty <= dp_tile_of(cells.j1 - 1); ++ty)
        for (long tx = dp_tile_of(cells.i0); status == DP_OK && tx <= dp_tile_of(cells.i1 - 1);
             ++tx) {
            const TilePart part = dp_tile_part(tx, ty, cells);
            if (is_trodden(trail, &part)) status = lay_tile(terrain, lease, trail, &part);
        }
    dp_lease_destroy(lease);
    return status;
}
