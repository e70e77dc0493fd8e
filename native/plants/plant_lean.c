// plants/plant_lean.c - how grass lies, cell by cell: pressed flat under soles, parted at their edge,
// standing up again as far as its stems are whole.
//
// Plants are sparse and soles have edges. Besides the plants, every planted cell that was touched
// keeps one stem, a mean of the kinds that grow there. A sole presses it to the height it leaves:
//   crushed = 1 - gap / height,  |lean| = sqrt(1 - (1 - crushed)^2), a straight stem's
// towards where the foot goes; nearer to the sole's edge than half its height, out of its way. Beside
// the sole it leans away as far as that. Let go, it rises to the share of stems that is broken: one
// bent at its foot beyond phi_deg as its strength returns, by exp(-t mu_rec / eps_b), then, or if
// nothing wears it, as it swings, by exp(-t rate); lean and crushed keep their ratio.
#include <string.h>

#include "base/alloc.h"
#include "plants/plant_inside.h"

#define CELLS (DP_TILE * DP_TILE)
#define PARTED 0.5       // of its height: so far from a sole's edge grass leans away
#define PARTED_MOST 0.4  // [m]
#define SLOW 0.1         // a foot this slow has no direction of its own [m/s]
#define FAR 8000         // cells
#define AT_REST 0.002f   // nearer to where it stays than this, grass is there
#define MOST_CELLS 4e6   // around one sole
#define DUE 0.01         // slow stems rise once this share of what is left is due

typedef struct LeanTile
{
    long    tx, ty;
    bool    changed;
    int     i0, i1, j0, j1;  // cells that may move: i0 <= i < i1, j0 <= j < j1; empty if i0 >= i1
    float   lean[2][CELLS], crushed[CELLS];
    float   most[CELLS];    // crushed when it was let go
    float   height[CELLS];  // of the stem, 0 = nothing grows [m]
    float   rate[CELLS];    // at which it swings up [1/s]
    float   heal[CELLS];    // at which it rises while its crushed is above `limp` [1/s]
    float   limp[CELLS];
    float   healing;       // the most of heal [1/s]
    double  waited;        // since slow stems rose [s]
    float   stays[CELLS];  // share of stems that is broken
    int32_t held[CELLS];   // the step in which something held it last
} LeanTile;

// an offset in cells to the nearest cell of the other kind, sole or no sole
typedef struct Offset
{
    int16_t i, j;
} Offset;

struct DpLean
{
    const DpPlants* plants;
    double          cell, origin[2];
    int32_t         step;
    LeanTile**      tile;  // ascending (ty, tx)
    int             tiles, room;
    // scratch around one sole: a print's cells with a border of one
    Offset*  offset;
    float*   bottom;  // +inf where there is no sole
    uint8_t* sole;
    size_t   room_of_print;
};

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
    dp_free(lean->tile), dp_free(lean->offset), dp_free(lean->bottom);
    dp_free(lean->sole), dp_free(lean);
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

static double centre(const DpLean* lean, int axis, long cell)
{
    return lean->origin[axis] + ((double)cell + 0.5) * lean->cell;
}

static long cell_of(const DpLean* lean, int axis, double at)
{
    return (long)floor((at - lean->origin[axis]) / lean->cell);
}

static long tile_of(long cell)
{
    return cell >= 0 ? cell / DP_TILE : -((-cell - 1) / DP_TILE) - 1;
}

// what grows on cells i0 <= i < i1, j0 <= j < j1 of a tile; its stems' size only the first time
static void grow(const DpLean* lean, LeanTile* tile, int i0, int i1, int j0, int j1, bool first)
{
    const DpPlantWindow window = {i1 - i0,
                                  j1 - j0,
                                  DP_TILE,
                                  lean->cell,
                                  centre(lean, 0, tile->tx * DP_TILE + i0),
                                  centre(lean, 1, tile->ty * DP_TILE + j0)};
    const int           at = j0 * DP_TILE + i0;
    const PlantStature  stature = {first ? tile->height + at : NULL, tile->rate + at,
                                  tile->heal + at, tile->limp + at, tile->stays + at};
    plant_stature(lean->plants, &window, &stature);
    for (size_t p = 0; first && p < CELLS; ++p) tile->healing = fmaxf(tile->healing, tile->heal[p]);
}

// a tile, made if nobody touched it yet; NULL without memory
static LeanTile* touch(DpLean* lean, long tx, long ty)
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

static void may_move(LeanTile* tile, int i, int j)
{
    const bool none = tile->i0 >= tile->i1;
    tile->i0 = none || i < tile->i0 ? i : tile->i0,
    tile->i1 = none || i >= tile->i1 ? i + 1 : tile->i1;
    tile->j0 = none || j < tile->j0 ? j : tile->j0,
    tile->j1 = none || j >= tile->j1 ? j + 1 : tile->j1;
}

// ---- pressing --------------------------------------------------------------------------------

// A window of the lean's cells around a sole.
typedef struct Print
{
    const DpPlantCollider* sole;
    long                   i0, j0;  // world cell of its cell (0, 0)
    int                    nx, ny;
    double                 motion[2];  // where the foot goes, shorter when slow
} Print;

static size_t at_print(const Print* print, int i, int j)
{
    return (size_t)(j + 1) * (size_t)(print->nx + 2) + (size_t)(i + 1);
}

static int length2(Offset o)
{
    return o.i * o.i + o.j * o.j;
}

// look at a neighbour: is the other kind nearer by its way?
static inline void look(DpLean* lean, size_t own, ptrdiff_t step, int di, int dj)
{
    const size_t there = own + (size_t)step;
    Offset       way = {(int16_t)di, (int16_t)dj};
    if (lean->sole[there] == lean->sole[own]) {
        way.i = (int16_t)(way.i + lean->offset[there].i);
        way.j = (int16_t)(way.j + lean->offset[there].j);
    }
    if (length2(way) < length2(lean->offset[own])) lean->offset[own] = way;
}

// offsets to the nearest cell of the other kind, in two passes
static void find_edges(DpLean* lean, const Print* print)
{
    const Offset    far = {FAR, FAR};
    const int       nx = print->nx, ny = print->ny;
    const ptrdiff_t row = nx + 2;
    for (size_t k = 0; k < (size_t)row * (size_t)(ny + 2); ++k) lean->offset[k] = far;
    for (int pass = 0; pass < 2; ++pass) {
        const int step = pass ? 1 : -1;
        for (int jj = 0; jj < ny; ++jj) {
            const int j = pass ? ny - 1 - jj : jj;
            for (int ii = 0; ii < nx; ++ii) {
                const size_t own = at_print(print, pass ? nx - 1 - ii : ii, j);
                for (int d = -1; d <= 1; ++d) look(lean, own, step * row + d, d, step);
                look(lean, own, step, step, 0);
            }
            for (int ii = 0; ii < nx; ++ii)
                look(lean, at_print(print, pass ? ii : nx - 1 - ii, j), -step, -step, 0);
        }
    }
}

// one stem is pressed: no less than `crushed`, leaning by `size` towards (x, y)
static void press(DpLean* lean, LeanTile* tile, int i, int j, double crushed, double size, double x,
                  double y)
{
    const size_t p = (size_t)j * DP_TILE + (size_t)i;
    const double lx = (double)tile->lean[0][p], ly = (double)tile->lean[1][p];
    const double more = size - sqrt(lx * lx + ly * ly), far = sqrt(x * x + y * y);
    if (more > 0.0 && far > 0.0) {
        tile->lean[0][p] = (float)(lx + more * x / far);
        tile->lean[1][p] = (float)(ly + more * y / far);
        tile->changed = true;
    }
    if (crushed > (double)tile->crushed[p]) {
        tile->crushed[p] = (float)crushed;
        tile->changed = true;
    }
    tile->most[p] = fmaxf(tile->most[p], tile->crushed[p]);
    tile->held[p] = lean->step;
    may_move(tile, i, j);
}

// the stem of one cell under or beside a sole
static void meet(DpLean* lean, const Print* print, const DpPlantGround* ground, LeanTile* tile,
                 int pi, int pj)
{
    const long   i = print->i0 + pi, j = print->j0 + pj;
    const int    ti = (int)(i - tile->tx * DP_TILE), tj = (int)(j - tile->ty * DP_TILE);
    const size_t t = (size_t)tj * DP_TILE + (size_t)ti, p = at_print(print, pi, pj);
    const double high = (double)tile->height[t];
    const Offset edge = lean->offset[p];
    const bool   under = isfinite(lean->bottom[p]);
    if (!(high > 0.0) || edge.i >= FAR) return;
    const double length = sqrt((double)length2(edge)), parted = fmin(PARTED * high, PARTED_MOST);
    const double near = dp_clamp(1.0 - (length - 0.5) * lean->cell / parted, 0.0, 1.0);
    if (!under && !(near > 0.0)) return;
    const size_t by = under ? p : at_print(print, pi + edge.i, pj + edge.j);
    const double gap =
        (double)lean->bottom[by] - plant_ground_at(ground, centre(lean, 0, i), centre(lean, 1, j));
    const double pressed = dp_clamp(1.0 - gap / high, 0.0, 1.0);
    if (!(pressed > 0.0)) return;            // the sole is above it; without ground, too
    const double side = under ? 1.0 : -1.0;  // out of the sole
    const double ox = side * edge.i / length, oy = side * edge.j / length;
    if (!under) {
        const double size = pressed * near * near;
        if (size > (double)AT_REST)
            press(lean, tile, ti, tj, 1.0 - sqrt(1.0 - size * size), size, ox, oy);
        return;
    }
    if (pressed < (double)tile->crushed[t]) return;  // it may rise to the sole
    const double own =
        sqrt(print->motion[0] * print->motion[0] + print->motion[1] * print->motion[1]);
    const double out = near + (1.0 - near) * (1.0 - own);
    press(lean, tile, ti, tj, pressed, sqrt(pressed * (2.0 - pressed)),
          out * ox + (1.0 - near) * print->motion[0], out * oy + (1.0 - near) * print->motion[1]);
}

static bool make_room(DpLean* lean, size_t cells)
{
    if (cells <= lean->room_of_print) return true;
    dp_free(lean->offset), dp_free(lean->bottom), dp_free(lean->sole);
    lean->room_of_print = cells + cells / 4;
    lean->offset = dp_alloc(lean->room_of_print, sizeof(Offset));
    lean->bottom = dp_alloc(lean->room_of_print, sizeof(float));
    lean->sole = dp_alloc(lean->room_of_print, 1);
    if (lean->offset && lean->bottom && lean->sole) return true;
    lean->room_of_print = 0;
    return false;
}

// The sole on the lean's own cells; false if it is nowhere less than `tallest` over the ground.
static bool lay_out(DpLean* lean, const Print* print, const DpPlantGround* ground, double tallest)
{
    const DpPlantCollider* c = print->sole;
    bool                   low = false;
    for (int j = -1; j <= print->ny; ++j)
        for (int i = -1; i <= print->nx; ++i) {
            const double x = centre(lean, 0, print->i0 + i), y = centre(lean, 1, print->j0 + j);
            const double u = (x - c->x0) / c->cell + 0.5, v = (y - c->y0) / c->cell + 0.5;
            const bool   inside = u >= 0.0 && v >= 0.0 && u < c->nx && v < c->ny;
            const float  bottom =
                inside ? c->bottom[(size_t)v * (size_t)c->row + (size_t)u] : INFINITY;
            const size_t at = at_print(print, i, j);
            lean->bottom[at] = bottom;
            lean->sole[at] = isfinite(bottom);
            if (isfinite(bottom) && !low)
                low = (double)bottom - plant_ground_at(ground, x, y) < tallest;
        }
    return low;
}

static double plants_tallest(const DpPlants* plants)
{
    double most = 0.0;
    for (int s = 0; s < plants->stands; ++s)
        most = fmax(most, (double)plants->stand[s].kind.height);
    return most;
}

static DpStatus press_sole(DpLean* lean, const DpPlantGround* ground, const DpPlantCollider* c)
{
    const double tallest = plants_tallest(lean->plants);
    const double margin = fmin(PARTED * tallest, PARTED_MOST) + 2.0 * lean->cell;
    Print        print = {.sole = c};
    print.i0 = cell_of(lean, 0, c->x0 - 0.5 * c->cell - margin);
    print.j0 = cell_of(lean, 1, c->y0 - 0.5 * c->cell - margin);
    const long i1 = cell_of(lean, 0, c->x0 + (c->nx - 0.5) * c->cell + margin) + 1;
    const long j1 = cell_of(lean, 1, c->y0 + (c->ny - 0.5) * c->cell + margin) + 1;
    if ((double)(i1 - print.i0) * (double)(j1 - print.j0) > MOST_CELLS) return DP_OK;
    print.nx = (int)(i1 - print.i0), print.ny = (int)(j1 - print.j0);
    const double speed = sqrt(c->velocity.x * c->velocity.x + c->velocity.y * c->velocity.y);
    print.motion[0] = c->velocity.x / (speed + SLOW),
    print.motion[1] = c->velocity.y / (speed + SLOW);
    if (!make_room(lean, (size_t)(print.nx + 2) * (size_t)(print.ny + 2))) return DP_NO_MEMORY;
    if (!lay_out(lean, &print, ground, tallest)) return DP_OK;
    find_edges(lean, &print);
    for (long ty = tile_of(print.j0); ty <= tile_of(j1 - 1); ++ty)
        for (long tx = tile_of(print.i0); tx <= tile_of(i1 - 1); ++tx) {
            LeanTile* tile = touch(lean, tx, ty);
            if (!tile) return DP_NO_MEMORY;
            const long from_i = tx * DP_TILE - print.i0, from_j = ty * DP_TILE - print.j0;
            for (int j = from_j > 0 ? (int)from_j : 0; j < print.ny && j < from_j + DP_TILE; ++j)
                for (int i = from_i > 0 ? (int)from_i : 0; i < print.nx && i < from_i + DP_TILE;
                     ++i)
                    meet(lean, &print, ground, tile, i, j);
        }
    return DP_OK;
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
    const int i0 = tile->i0, i1 = tile->i1, j0 = tile->j0, j1 = tile->j1;
    float     rate = 0.0f, keep = 1.0f, heal = 0.0f, kept = 1.0f;  // neighbours mostly are alike
    tile->i0 = tile->i1 = tile->j0 = tile->j1 = 0;
    tile->waited += dt;
    const bool due = tile->waited * (double)tile->healing > DUE;
    for (int j = j0; j < j1; ++j)
        for (int i = i0; i < i1; ++i) {
            const size_t p = (size_t)j * DP_TILE + (size_t)i;
            if (!(tile->crushed[p] > 0.0f)) continue;
            if (tile->held[p] == lean->step) {
                may_move(tile, i, j);
                continue;
            }
            if (tile->crushed[p] > tile->limp[p]) {
                if (tile->heal[p] < heal || tile->heal[p] > heal) {
                    heal = tile->heal[p];
                    kept = (float)exp(-(double)heal * tile->waited);
                }
                if (!due || rise(tile, p, kept)) may_move(tile, i, j);
                continue;
            }
            if (tile->rate[p] < rate || tile->rate[p] > rate) {
                rate = tile->rate[p];
                keep = (float)exp(-(double)rate * dt);
            }
            if (rise(tile, p, keep)) may_move(tile, i, j);
        }
    if (due) tile->waited = 0.0;
}

DpStatus dp_lean_step(DpLean* lean, const DpPlantGround* ground, const DpPlantCollider* colliders,
                      int count, double dt)
{
    if (!lean || count < 0 || (count > 0 && !colliders) || !(dt > 0.0) || !plant_ground_ok(ground))
        return DP_BAD_ARGUMENT;
    ++lean->step;
    for (int k = 0; k < count; ++k) {
        if (!colliders[k].bottom) continue;
        const DpStatus status = press_sole(lean, ground, &colliders[k]);
        if (status != DP_OK) return status;
    }
    for (int t = 0; t < lean->tiles; ++t)
        if (lean->tile[t]->i0 < lean->tile[t]->i1) rise_tile(lean, lean->tile[t], dt);
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
    may_move(tile, from[0], from[1]), may_move(tile, to[0] - 1, to[1] - 1);
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
    const long   tx1 = tile_of(cell_of(lean, 0, x1)), ty1 = tile_of(cell_of(lean, 1, y1));
    for (long ty = tile_of(cell_of(lean, 1, y0)); ty <= ty1; ++ty)
        for (long tx = tile_of(cell_of(lean, 0, x0)); tx <= tx1; ++tx) {
            LeanTile* tile = touch(lean, tx, ty);
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

void dp_lean_changed(DpLean* lean, void (*visit)(void* context, long tx, long ty), void* context)
{
    for (int t = 0; t < lean->tiles; ++t) {
        if (!lean->tile[t]->changed) continue;
        lean->tile[t]->changed = false;
        visit(context, lean->tile[t]->tx, lean->tile[t]->ty);
    }
}
