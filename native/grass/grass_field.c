// grass/grass_field.c - how grass lies, cell by cell: pressed flat under soles, parted at their
// edge, standing up again as far as its stems are whole.
//
// Plants are sparse and soles have edges. Besides the plants, every planted cell that was touched
// keeps one stem, a mean of the kinds that grow there. A sole presses it to the height it leaves:
//   crushed = 1 - gap / height,  |lean| = sqrt(1 - (1 - crushed)^2), a straight stem's
// towards where the foot goes; nearer to the sole's edge than half its height, out of its way.
// Beside the sole it leans away as far as that. Let go, it rises to the share of stems that is
// broken: one bent at its foot beyond phi_deg as its strength returns, by exp(-t mu_rec / eps_b),
// then, or if nothing wears it, as it swings, by exp(-t rate); lean and crushed keep their ratio.
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "grass/grass_inside.h"

#define AT_REST 0.002f  // nearer to where it stays than this, grass is there
#define DUE 0.01        // slow stems rise once this share of what is left is due

DpStatus dp_grass_create(DpGrass** grass, const DpPlants* plants, DpGrid grid)
{
    if (!grass || !plants || !(grid.cell > 0.0 && grid.cell < 1e6) || !(fabs(grid.x0) < 1e9) ||
        !(fabs(grid.y0) < 1e9))
        return DP_BAD_ARGUMENT;
    DpGrass* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    created->plants = plants, created->grid = grid;
    *grass = created;
    return DP_OK;
}

void dp_grass_destroy(DpGrass* grass)
{
    if (!grass) return;
    for (int t = 0; t < grass->tiles; ++t) dp_grass_tile_destroy(grass->tile[t]);
    for (int k = 0; k < grass->print_room; ++k) dp_grass_print_drop(&grass->print[k]);
    dp_free(grass->tile), dp_free(grass->print), dp_free(grass);
}

// ---- standing up -----------------------------------------------------------------------------

// one stem rises by a share `keep` of what is left; is it still on its way?
static bool rise(GrassTile* tile, size_t p, float keep)
{
    const float was = tile->crushed[p], goal = tile->stays[p] * tile->deepest[p];
    if (!(was > goal)) return false;
    float now = goal + (was - goal) * keep;
    if (now < goal + AT_REST) now = goal;
    tile->crushed[p] = now;
    for (int d = 0; d < 2; ++d) tile->lean[d][p] *= now / was;
    if (!(now > 0.0f)) tile->lean[0][p] = tile->lean[1][p] = tile->deepest[p] = 0.0f;
    tile->changed = true;
    return now > goal;
}

static void rise_tile(const DpGrass* grass, GrassTile* tile, double dt)
{
    const bool       due = (tile->waited + dt) * (double)tile->healing > DUE;
    const DpCellRect at = due ? tile->moves : tile->brisk, none = {0, 0, 0, 0};
    tile->waited += dt;
    if (!dp_cells_empty(at)) dp_memory_ease(DP_EASE_PAGE);
    tile->brisk = none;
    if (due) tile->moves = none;
    float rate = 0.0f, keep = 1.0f, heal = 0.0f, kept = 1.0f;  // neighbours mostly are alike
    for (int j = (int)at.j0; j < at.j1; ++j)
        for (int i = (int)at.i0; i < at.i1; ++i) {
            const size_t p = (size_t)j * DP_TILE + (size_t)i;
            if (!(tile->crushed[p] > 0.0f)) continue;
            if (tile->held[p] == grass->step) {
                dp_grass_may_move(tile, i, j);
                continue;
            }
            if (tile->crushed[p] > tile->limp[p]) {
                if (!due) continue;
                if (tile->heal[p] < heal || tile->heal[p] > heal) {
                    heal = tile->heal[p];
                    kept = (float)exp(-(double)heal * tile->waited);
                }
                if (!rise(tile, p, kept)) continue;
                tile->moves = dp_cells_with(tile->moves, i, j);
                if (!(tile->crushed[p] > tile->limp[p]))
                    tile->brisk = dp_cells_with(tile->brisk, i, j);
                continue;
            }
            if (tile->rate[p] < rate || tile->rate[p] > rate) {
                rate = tile->rate[p];
                keep = (float)exp(-(double)rate * dt);
            }
            if (rise(tile, p, keep)) dp_grass_may_move(tile, i, j);
        }
    if (due) tile->waited = 0.0;
}

DpStatus dp_grass_ready(DpGrass* grass, const DpPlantCollider* colliders, int count)
{
    if (!grass || count < 0 || (count > 0 && !colliders)) return DP_BAD_ARGUMENT;
    for (int k = 0; k < count; ++k) {
        if (!colliders[k].bottom) continue;
        const GrassPrint at = dp_grass_window(grass, &colliders[k]);
        if (at.nx < 1) continue;
        for (long ty = dp_tile_of(at.j0); ty <= dp_tile_of(at.j0 + at.ny - 1); ++ty)
            for (long tx = dp_tile_of(at.i0); tx <= dp_tile_of(at.i0 + at.nx - 1); ++tx)
                if (!dp_grass_touch(grass, tx, ty)) return DP_NO_MEMORY;
    }
    return DP_OK;
}

static DpStatus look(DpGrass* grass, const DpPlantGround* ground, const DpPlantCollider* colliders,
                     int count)
{
    if (count > grass->print_room) {
        GrassPrint* more = dp_realloc(grass->print, (size_t)count, sizeof *more);
        if (!more) return DP_NO_MEMORY;
        grass->print = more, grass->print_room = count;
    }
    grass->prints = 0;
    for (int k = 0; k < count; ++k) {
        if (!colliders[k].bottom) continue;
        const DpStatus status =
            dp_grass_look_at(grass, &grass->print[grass->prints], ground, &colliders[k]);
        if (status != DP_OK) return status;
        ++grass->prints;
    }
    return DP_OK;
}

DpStatus dp_grass_step(DpGrass* grass, const DpPlantGround* ground,
                       const DpPlantCollider* colliders, int count, double dt)
{
    if (!grass || count < 0 || (count > 0 && !colliders) || !(dt > 0.0) ||
        !dp_plant_ground_ok(ground))
        return DP_BAD_ARGUMENT;
    ++grass->step;
    DpStatus status = look(grass, ground, colliders, count);
    for (int k = 0; k < grass->prints && status == DP_OK; ++k)
        status = dp_grass_press(grass, &grass->print[k], ground);
    if (status != DP_OK) return status;
    for (int t = 0; t < grass->tiles; ++t)
        if (grass->tile[t]->moves.i0 < grass->tile[t]->moves.i1)
            rise_tile(grass, grass->tile[t], dt);
    return DP_OK;
}

// what grows within a box on one tile, anew
static void grow_box(const DpGrass* grass, GrassTile* tile, const double box[4], bool first)
{
    const double side = DP_TILE * grass->grid.cell;
    int          from[2], to[2];
    for (int d = 0; d < 2; ++d) {
        const double at =
            (d ? grass->grid.y0 : grass->grid.x0) + side * (double)(d ? tile->ty : tile->tx);
        from[d] = (int)dp_clamp(floor((box[d] - at) / grass->grid.cell) - 1.0, 0.0, DP_TILE);
        to[d] = (int)dp_clamp(ceil((box[2 + d] - at) / grass->grid.cell) + 1.0, 0.0, DP_TILE);
    }
    if (from[0] >= to[0] || from[1] >= to[1]) return;
    dp_grass_grow(grass, tile, from[0], to[0], from[1], to[1], first);
    tile->changed = true;
    dp_grass_may_move(tile, from[0], from[1]), dp_grass_may_move(tile, to[0] - 1, to[1] - 1);
}

void dp_grass_grown(DpGrass* grass, double x0, double y0, double x1, double y1)
{
    const double box[4] = {x0, y0, x1, y1};
    for (int t = 0; t < grass->tiles; ++t) grow_box(grass, grass->tile[t], box, true);
}

DpStatus dp_grass_worn(DpGrass* grass, double x0, double y0, double x1, double y1)
{
    if (!grass || !(x0 <= x1 && y0 <= y1 && x1 - x0 < 1e6 && y1 - y0 < 1e6)) return DP_BAD_ARGUMENT;
    const double box[4] = {x0, y0, x1, y1};
    const long   tx1 = dp_tile_of(dp_grid_i(&grass->grid, x1)),
               ty1 = dp_tile_of(dp_grid_j(&grass->grid, y1));
    for (long ty = dp_tile_of(dp_grid_j(&grass->grid, y0)); ty <= ty1; ++ty)
        for (long tx = dp_tile_of(dp_grid_i(&grass->grid, x0)); tx <= tx1; ++tx) {
            GrassTile* tile = dp_grass_touch(grass, tx, ty);
            if (!tile) return DP_NO_MEMORY;
            grow_box(grass, tile, box, false);
        }
    return DP_OK;
}

// ---- reading ---------------------------------------------------------------------------------

void dp_grass_read(const DpGrass* grass, long i0, long j0, int nx, int ny, float* lean_x,
                   float* lean_y, float* crushed)
{
    float* const out[3] = {lean_x, lean_y, crushed};
    for (int d = 0; d < 3; ++d)
        if (out[d]) memset(out[d], 0, (size_t)nx * (size_t)ny * sizeof(float));
    for (int t = 0; t < grass->tiles; ++t) {
        const GrassTile*   tile = grass->tile[t];
        const float* const from[3] = {tile->lean[0], tile->lean[1], tile->crushed};
        const long         ti = tile->tx * DP_TILE, tj = tile->ty * DP_TILE;
        const long a = ti > i0 ? ti : i0, b = ti + DP_TILE < i0 + nx ? ti + DP_TILE : i0 + nx;
        if (a < b && tj < j0 + ny && tj + DP_TILE > j0) dp_memory_ease(DP_EASE_PAGE);
        for (long j = tj > j0 ? tj : j0; j < tj + DP_TILE && j < j0 + ny && a < b; ++j)
            for (int d = 0; d < 3; ++d)
                if (out[d])
                    memcpy(out[d] + (j - j0) * nx + (a - i0),
                           from[d] + (j - tj) * DP_TILE + (a - ti),
                           (size_t)(b - a) * sizeof(float));
    }
}

// Of `deepest`, the share `stays` is that of broken stems, what is left that of others.
DpStemLean dp_grass_stem_at(const DpGrass* grass, double x, double y)
{
    const long       i = dp_grid_i(&grass->grid, x), j = dp_grid_j(&grass->grid, y);
    const GrassTile* tile = dp_grass_find(grass, dp_tile_of(i), dp_tile_of(j));
    DpStemLean       stem = {0};
    if (!tile) return stem;
    const size_t p = (size_t)(j - tile->ty * DP_TILE) * DP_TILE + (size_t)(i - tile->tx * DP_TILE);
    const double unbroken = 1.0 - (double)tile->stays[p];
    const double risen =
        (double)tile->crushed[p] - (double)tile->stays[p] * (double)tile->deepest[p];
    stem.down = unbroken > 0.0 ? dp_clamp(risen / unbroken, 0.0, 1.0) : 0.0;
    stem.lean[0] = (double)tile->lean[0][p], stem.lean[1] = (double)tile->lean[1][p];
    stem.pressed = tile->under[p] == grass->step && grass->step > 0;
    return stem;
}

void dp_grass_changed(DpGrass* grass, void (*visit)(void* context, long tx, long ty), void* context)
{
    for (int t = 0; t < grass->tiles; ++t) {
        if (!grass->tile[t]->changed) continue;
        grass->tile[t]->changed = false;
        visit(context, grass->tile[t]->tx, grass->tile[t]->ty);
    }
}
