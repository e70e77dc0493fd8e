// plants/plant_lean.c - how grass lies, cell by cell: pressed flat under soles, parted at their
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
#include "plants/plant_lean_inside.h"

#define AT_REST 0.002f  // nearer to where it stays than this, grass is there
#define DUE 0.01        // slow stems rise once this share of what is left is due

DpStatus dp_lean_create(DpLean** lean, const DpPlants* plants, double cell, double origin_x,
                        double origin_y)
{
    if (!lean || !plants || !(cell > 0.0 && cell < 1e6) || !(fabs(origin_x) < 1e9) ||
        !(fabs(origin_y) < 1e9))
        return DP_BAD_ARGUMENT;
    DpLean* made = dp_alloc(1, sizeof *made);
    if (!made) return DP_NO_MEMORY;
    made->plants = plants, made->cell = cell;
    made->origin[0] = origin_x, made->origin[1] = origin_y;
    *lean = made;
    return DP_OK;
}

void dp_lean_destroy(DpLean* lean)
{
    if (!lean) return;
    for (int t = 0; t < lean->tiles; ++t) dp_free(lean->tile[t]);
    for (int k = 0; k < lean->print_room; ++k) dp_lean_drop_print(&lean->print[k]);
    dp_free(lean->tile), dp_free(lean->print), dp_free(lean);
}

// ---- tiles -----------------------------------------------------------------------------------

// where a tile is in the list, or where it belongs
static int place_of(const DpLean* lean, long tx, long ty)
{
    int low = 0, high = lean->tiles;
    while (low < high) {
        const int       mid = (low + high) / 2;
        const LeanTile* at = lean->tile[mid];
        if (at->ty < ty || (at->ty == ty && at->tx < tx))
            low = mid + 1;
        else
            high = mid;
    }
    return low;
}

static LeanTile* find(const DpLean* lean, long tx, long ty)
{
    const int  at = place_of(lean, tx, ty);
    const bool there = at < lean->tiles && lean->tile[at]->tx == tx && lean->tile[at]->ty == ty;
    return there ? lean->tile[at] : NULL;
}

// what grows on cells i0 <= i < i1, j0 <= j < j1 of a tile; its stems' size only the first time
static void grow(const DpLean* lean, LeanTile* tile, int i0, int i1, int j0, int j1, bool first)
{
    const DpPlantWindow window = {i1 - i0,
                                  j1 - j0,
                                  DP_TILE,
                                  lean->cell,
                                  lean_centre(lean, 0, tile->tx * DP_TILE + i0),
                                  lean_centre(lean, 1, tile->ty * DP_TILE + j0)};
    const int           at = j0 * DP_TILE + i0;
    const PlantStature  stature = {first ? tile->height + at : NULL, tile->rate + at,
                                  tile->heal + at, tile->limp + at, tile->stays + at};
    dp_plant_stature(lean->plants, &window, &stature);
    for (size_t p = 0; first && p < CELLS; ++p) tile->healing = fmaxf(tile->healing, tile->heal[p]);
}

LeanTile* dp_lean_touch(DpLean* lean, long tx, long ty)
{
    LeanTile* tile = find(lean, tx, ty);
    if (tile) return tile;
    if (lean->tiles == lean->room) {
        const int  room = lean->room ? 2 * lean->room : 16;
        LeanTile** more = dp_realloc(lean->tile, (size_t)room, sizeof *more);
        if (!more) return NULL;
        lean->tile = more, lean->room = room;
    }
    tile = dp_alloc(1, sizeof *tile);
    if (!tile) return NULL;
    tile->tx = tx, tile->ty = ty;
    grow(lean, tile, 0, DP_TILE, 0, DP_TILE, true);
    const int at = place_of(lean, tx, ty);
    memmove(lean->tile + at + 1, lean->tile + at, (size_t)(lean->tiles - at) * sizeof *lean->tile);
    lean->tile[at] = tile;
    ++lean->tiles;
    return tile;
}

static void widen(LeanBox* box, int i, int j)
{
    const bool none = box->i0 >= box->i1;
    box->i0 = none || i < box->i0 ? i : box->i0, box->i1 = none || i >= box->i1 ? i + 1 : box->i1;
    box->j0 = none || j < box->j0 ? j : box->j0, box->j1 = none || j >= box->j1 ? j + 1 : box->j1;
}

void dp_lean_may_move(LeanTile* tile, int i, int j)
{
    widen(&tile->moves, i, j);
    widen(&tile->brisk, i, j);
}

// ---- standing up -----------------------------------------------------------------------------

// one stem rises by a share `keep` of what is left; is it still on its way?
static bool rise(LeanTile* tile, size_t p, float keep)
{
    const float was = tile->crushed[p], goal = tile->stays[p] * tile->most[p];
    if (!(was > goal)) return false;
    float now = goal + (was - goal) * keep;
    if (now < goal + AT_REST) now = goal;
    tile->crushed[p] = now;
    for (int d = 0; d < 2; ++d) tile->lean[d][p] *= now / was;
    if (!(now > 0.0f)) tile->lean[0][p] = tile->lean[1][p] = tile->most[p] = 0.0f;
    tile->changed = true;
    return now > goal;
}

static void rise_tile(const DpLean* lean, LeanTile* tile, double dt)
{
    const bool    due = (tile->waited + dt) * (double)tile->healing > DUE;
    const LeanBox at = due ? tile->moves : tile->brisk, none = {0, 0, 0, 0};
    tile->waited += dt;
    tile->brisk = none;
    if (due) tile->moves = none;
    float rate = 0.0f, keep = 1.0f, heal = 0.0f, kept = 1.0f;  // neighbours mostly are alike
    for (int j = at.j0; j < at.j1; ++j)
        for (int i = at.i0; i < at.i1; ++i) {
            const size_t p = (size_t)j * DP_TILE + (size_t)i;
            if (!(tile->crushed[p] > 0.0f)) continue;
            if (tile->held[p] == lean->step) {
                dp_lean_may_move(tile, i, j);
                continue;
            }
            if (tile->crushed[p] > tile->limp[p]) {
                if (!due) continue;
                if (tile->heal[p] < heal || tile->heal[p] > heal) {
                    heal = tile->heal[p];
                    kept = (float)exp(-(double)heal * tile->waited);
                }
                if (!rise(tile, p, kept)) continue;
                widen(&tile->moves, i, j);
                if (!(tile->crushed[p] > tile->limp[p])) widen(&tile->brisk, i, j);
                continue;
            }
            if (tile->rate[p] < rate || tile->rate[p] > rate) {
                rate = tile->rate[p];
                keep = (float)exp(-(double)rate * dt);
            }
            if (rise(tile, p, keep)) dp_lean_may_move(tile, i, j);
        }
    if (due) tile->waited = 0.0;
}

DpStatus dp_lean_ready(DpLean* lean, const DpPlantCollider* colliders, int count)
{
    if (!lean || count < 0 || (count > 0 && !colliders)) return DP_BAD_ARGUMENT;
    for (int k = 0; k < count; ++k) {
        if (!colliders[k].bottom) continue;
        const LeanPrint at = dp_lean_window(lean, &colliders[k]);
        if (at.nx < 1) continue;
        for (long ty = lean_tile(at.j0); ty <= lean_tile(at.j0 + at.ny - 1); ++ty)
            for (long tx = lean_tile(at.i0); tx <= lean_tile(at.i0 + at.nx - 1); ++tx)
                if (!dp_lean_touch(lean, tx, ty)) return DP_NO_MEMORY;
    }
    return DP_OK;
}

static DpStatus look(DpLean* lean, const DpPlantGround* ground, const DpPlantCollider* colliders,
                     int count)
{
    if (count > lean->print_room) {
        LeanPrint* more = dp_realloc(lean->print, (size_t)count, sizeof *more);
        if (!more) return DP_NO_MEMORY;
        lean->print = more, lean->print_room = count;
    }
    lean->prints = 0;
    for (int k = 0; k < count; ++k) {
        if (!colliders[k].bottom) continue;
        const DpStatus status =
            dp_lean_look_at(lean, &lean->print[lean->prints], ground, &colliders[k]);
        if (status != DP_OK) return status;
        ++lean->prints;
    }
    return DP_OK;
}

DpStatus dp_lean_step(DpLean* lean, const DpPlantGround* ground, const DpPlantCollider* colliders,
                      int count, double dt)
{
    if (!lean || count < 0 || (count > 0 && !colliders) || !(dt > 0.0) ||
        !dp_plant_ground_ok(ground))
        return DP_BAD_ARGUMENT;
    ++lean->step;
    DpStatus status = look(lean, ground, colliders, count);
    for (int k = 0; k < lean->prints && status == DP_OK; ++k)
        status = dp_lean_press_print(lean, &lean->print[k], ground);
    if (status != DP_OK) return status;
    for (int t = 0; t < lean->tiles; ++t)
        if (lean->tile[t]->moves.i0 < lean->tile[t]->moves.i1) rise_tile(lean, lean->tile[t], dt);
    return DP_OK;
}

// what grows within a box on one tile, anew
static void grow_box(const DpLean* lean, LeanTile* tile, const double box[4], bool first)
{
    const double side = DP_TILE * lean->cell;
    int          from[2], to[2];
    for (int d = 0; d < 2; ++d) {
        const double at = lean->origin[d] + side * (double)(d ? tile->ty : tile->tx);
        from[d] = (int)dp_clamp(floor((box[d] - at) / lean->cell) - 1.0, 0.0, DP_TILE);
        to[d] = (int)dp_clamp(ceil((box[2 + d] - at) / lean->cell) + 1.0, 0.0, DP_TILE);
    }
    if (from[0] >= to[0] || from[1] >= to[1]) return;
    grow(lean, tile, from[0], to[0], from[1], to[1], first);
    tile->changed = true;
    dp_lean_may_move(tile, from[0], from[1]), dp_lean_may_move(tile, to[0] - 1, to[1] - 1);
}

void dp_lean_grown(DpLean* lean, double x0, double y0, double x1, double y1)
{
    const double box[4] = {x0, y0, x1, y1};
    for (int t = 0; t < lean->tiles; ++t) grow_box(lean, lean->tile[t], box, true);
}

DpStatus dp_lean_worn(DpLean* lean, double x0, double y0, double x1, double y1)
{
    if (!lean || !(x0 <= x1 && y0 <= y1 && x1 - x0 < 1e6 && y1 - y0 < 1e6)) return DP_BAD_ARGUMENT;
    const double box[4] = {x0, y0, x1, y1};
    const long   tx1 = lean_tile(lean_cell(lean, 0, x1)), ty1 = lean_tile(lean_cell(lean, 1, y1));
    for (long ty = lean_tile(lean_cell(lean, 1, y0)); ty <= ty1; ++ty)
        for (long tx = lean_tile(lean_cell(lean, 0, x0)); tx <= tx1; ++tx) {
            LeanTile* tile = dp_lean_touch(lean, tx, ty);
            if (!tile) return DP_NO_MEMORY;
            grow_box(lean, tile, box, false);
        }
    return DP_OK;
}

// ---- reading ---------------------------------------------------------------------------------

void dp_lean_read(const DpLean* lean, long i0, long j0, int nx, int ny, float* lean_x,
                  float* lean_y, float* crushed)
{
    float* const out[3] = {lean_x, lean_y, crushed};
    for (int d = 0; d < 3; ++d)
        if (out[d]) memset(out[d], 0, (size_t)nx * (size_t)ny * sizeof(float));
    for (int t = 0; t < lean->tiles; ++t) {
        const LeanTile*    tile = lean->tile[t];
        const float* const from[3] = {tile->lean[0], tile->lean[1], tile->crushed};
        const long         ti = tile->tx * DP_TILE, tj = tile->ty * DP_TILE;
        const long a = ti > i0 ? ti : i0, b = ti + DP_TILE < i0 + nx ? ti + DP_TILE : i0 + nx;
        for (long j = tj > j0 ? tj : j0; j < tj + DP_TILE && j < j0 + ny && a < b; ++j)
            for (int d = 0; d < 3; ++d)
                if (out[d])
                    memcpy(out[d] + (j - j0) * nx + (a - i0),
                           from[d] + (j - tj) * DP_TILE + (a - ti),
                           (size_t)(b - a) * sizeof(float));
    }
}

// Of `most`, the share `stays` is that of broken stems, the rest that of whole ones.
LeanStem dp_lean_stem_at(const DpLean* lean, double x, double y)
{
    const long      i = lean_cell(lean, 0, x), j = lean_cell(lean, 1, y);
    const LeanTile* tile = find(lean, lean_tile(i), lean_tile(j));
    LeanStem        stem = {0};
    if (!tile) return stem;
    const size_t p = (size_t)(j - tile->ty * DP_TILE) * DP_TILE + (size_t)(i - tile->tx * DP_TILE);
    const double whole = 1.0 - (double)tile->stays[p];
    const double risen = (double)tile->crushed[p] - (double)tile->stays[p] * (double)tile->most[p];
    stem.down = whole > 0.0 ? dp_clamp(risen / whole, 0.0, 1.0) : 0.0;
    stem.lean[0] = (double)tile->lean[0][p], stem.lean[1] = (double)tile->lean[1][p];
    stem.pressed = tile->under[p] == lean->step && lean->step > 0;
    return stem;
}

void dp_lean_changed(DpLean* lean, void (*visit)(void* context, long tx, long ty), void* context)
{
    for (int t = 0; t < lean->tiles; ++t) {
        if (!lean->tile[t]->changed) continue;
        lean->tile[t]->changed = false;
        visit(context, lean->tile[t]->tx, lean->tile[t]->ty);
    }
}
