// plants/plant_part.c - a sole in the grass: what it presses flat, and what it parts beside it.
#include "base/wide.h"

#include "base/alloc.h"
#include "plants/plant_lean_inside.h"

#define PARTED 0.5       // of its height: so far from a sole's edge grass leans away
#define PARTED_MOST 0.4  // [m]
#define SLOW 0.1         // a foot this slow has no direction of its own [m/s]
#define FAR 8000         // cells
#define SLIGHT 0.002     // leaning less than this is standing
#define MOST_CELLS 4e6   // around one sole

static size_t at_print(const LeanPrint* print, int i, int j)
{
    return (size_t)(j + 1) * (size_t)(print->nx + 2) + (size_t)(i + 1);
}

static int length2(Offset o)
{
    return o.i * o.i + o.j * o.j;
}

// how a cell's offset would be by way of a neighbour at (di, dj)
static inline Offset by_way_of(Offset there, bool alike, int di, int dj)
{
    return (Offset){(int16_t)(di + (alike ? there.i : 0)), (int16_t)(dj + (alike ? there.j : 0))};
}

// a row's cells look at the row before it
DP_CLONES
static void look_back(Offset* restrict own, const Offset* restrict back,
                      const uint8_t* restrict sole, const uint8_t* restrict sole_back, int nx,
                      int dj)
{
    for (int i = 0; i < nx; ++i) {
        Offset best = own[i];
        for (int d = -1; d <= 1; ++d) {
            const Offset way = by_way_of(back[i + d], sole_back[i + d] == sole[i], d, dj);
            const bool   nearer = length2(way) < length2(best);
            best.i = nearer ? way.i : best.i, best.j = nearer ? way.j : best.j;
        }
        own[i] = best;
    }
}

// then each of them at the one beside it, `step` away, one after the other
static void look_along(Offset* own, const uint8_t* sole, int nx, int step)
{
    const int first = step < 0 ? 0 : nx - 1;
    Offset    beside = own[first + step];
    uint8_t   kind = sole[first + step];
    for (int n = 0, i = first; n < nx; ++n, i -= step) {
        const Offset way = by_way_of(beside, kind == sole[i], step, 0);
        kind = sole[i];
        beside = own[i];
        if (length2(way) < length2(beside)) own[i] = beside = way;
    }
}

// offsets to the nearest cell of the other kind, in two passes
static void find_edges(const LeanPrint* print)
{
    const Offset    far = {FAR, FAR};
    const int       nx = print->nx, ny = print->ny;
    const ptrdiff_t row = nx + 2;
    for (size_t k = 0; k < (size_t)row * (size_t)(ny + 2); ++k) print->offset[k] = far;
    for (int pass = 0; pass < 2; ++pass) {
        const int step = pass ? 1 : -1;
        for (int jj = 0; jj < ny; ++jj) {
            const size_t   at = at_print(print, 0, pass ? ny - 1 - jj : jj);
            Offset*        own = print->offset + at;
            const uint8_t* sole = print->under + at;
            look_back(own, own + step * row, sole, sole + step * row, nx, step);
            look_along(own, sole, nx, step);
            look_along(own, sole, nx, -step);
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
    tile->brisk = true;
    lean_may_move(tile, i, j);
}

// how far a cell lies inside the sole's edge, < 0 outside [cells]
static double depth_at(const LeanPrint* print, size_t p)
{
    const double length = sqrt((double)length2(print->offset[p]));
    return print->under[p] ? length : -length;
}

// the stem of one cell under or beside a sole
static void meet(DpLean* lean, const LeanPrint* print, const DpPlantGround* ground, LeanTile* tile,
                 int pi, int pj)
{
    const long   i = print->i0 + pi, j = print->j0 + pj;
    const int    ti = (int)(i - tile->tx * DP_TILE), tj = (int)(j - tile->ty * DP_TILE);
    const size_t t = (size_t)tj * DP_TILE + (size_t)ti, p = at_print(print, pi, pj);
    const double high = (double)tile->height[t];
    const Offset edge = print->offset[p];
    const bool   under = isfinite(print->bottom[p]);
    if (!(high > 0.0) || edge.i >= FAR) return;
    const double length = sqrt((double)length2(edge)), parted = fmin(PARTED * high, PARTED_MOST);
    const double near = dp_clamp(1.0 - (length - 0.5) * lean->cell / parted, 0.0, 1.0);
    if (!under && !(near > 0.0)) return;
    const size_t by = under ? p : at_print(print, pi + edge.i, pj + edge.j);
    const double gap = (double)print->bottom[by] -
                       plant_ground_at(ground, lean_centre(lean, 0, i), lean_centre(lean, 1, j));
    const double pressed = dp_clamp(1.0 - gap / high, 0.0, 1.0);
    if (!(pressed > 0.0)) return;  // the sole is above it; without ground, too
    if (!under) {
        const double size = pressed * near * near;
        if (size > SLIGHT)
            press(lean, tile, ti, tj, 1.0 - sqrt(1.0 - size * size), size, -edge.i, -edge.j);
        return;
    }
    if (pressed < (double)tile->crushed[t]) return;  // it may rise to the sole
    const double own =
        sqrt(print->motion[0] * print->motion[0] + print->motion[1] * print->motion[1]);
    const double out = near + (1.0 - near) * (1.0 - own);
    const size_t row = (size_t)(print->nx + 2);
    double       ox = depth_at(print, p - 1) - depth_at(print, p + 1);
    double       oy = depth_at(print, p - row) - depth_at(print, p + row);
    const double steep = sqrt(ox * ox + oy * oy);
    ox = steep > 0.1 ? ox / steep : 0.0, oy = steep > 0.1 ? oy / steep : 0.0;
    double x = out * ox + (1.0 - near) * print->motion[0];
    double y = out * oy + (1.0 - near) * print->motion[1];
    if (!(x * x + y * y > 1e-6)) x = edge.i, y = edge.j;  // halfway between two sides: either
    press(lean, tile, ti, tj, pressed, sqrt(pressed * (2.0 - pressed)), x, y);
    tile->under[t] = lean->step;
}

static bool make_room(LeanPrint* print)
{
    const size_t cells = (size_t)(print->nx + 2) * (size_t)(print->ny + 2);
    if (cells <= print->room) return true;
    lean_drop_print(print);
    print->room = cells + cells / 4;
    print->offset = dp_alloc(print->room, sizeof(Offset));
    print->bottom = dp_alloc(print->room, sizeof(float));
    print->under = dp_alloc(print->room, 1);
    if (print->offset && print->bottom && print->under) return true;
    lean_drop_print(print);
    return false;
}

void lean_drop_print(LeanPrint* print)
{
    dp_free(print->offset), dp_free(print->bottom), dp_free(print->under);
    print->offset = NULL, print->bottom = NULL, print->under = NULL, print->room = 0;
}

// The sole on the lean's own cells; false if it is nowhere less than `tallest` over the ground.
static bool lay_out(const DpLean* lean, const LeanPrint* print, const DpPlantGround* ground,
                    double tallest)
{
    const DpPlantCollider* c = print->sole;
    bool                   low = false;
    for (int j = -1; j <= print->ny; ++j) {
        const double y = lean_centre(lean, 1, print->j0 + j), v = (y - c->y0) / c->cell + 0.5;
        const bool   crosses = v >= 0.0 && v < c->ny;
        const float* from = crosses ? c->bottom + (size_t)v * (size_t)c->row : NULL;
        float*       to = print->bottom + at_print(print, 0, j);
        uint8_t*     sole = print->under + at_print(print, 0, j);
        for (int i = -1; i <= print->nx; ++i) to[i] = INFINITY, sole[i] = 0;
        for (int i = -1; i <= print->nx && crosses; ++i) {
            const double x = lean_centre(lean, 0, print->i0 + i), u = (x - c->x0) / c->cell + 0.5;
            if (!(u >= 0.0 && u < c->nx)) continue;
            to[i] = from[(size_t)u];
            sole[i] = isfinite(to[i]) ? 1 : 0;
            if (sole[i] && !low) low = (double)to[i] - plant_ground_at(ground, x, y) < tallest;
        }
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

DpStatus lean_look_at(const DpLean* lean, LeanPrint* print, const DpPlantGround* ground,
                      const DpPlantCollider* c)
{
    const double tallest = plants_tallest(lean->plants);
    const double margin = fmin(PARTED * tallest, PARTED_MOST) + 2.0 * lean->cell;
    print->sole = c;
    print->nx = print->ny = 0;
    print->i0 = lean_cell(lean, 0, c->x0 - 0.5 * c->cell - margin);
    print->j0 = lean_cell(lean, 1, c->y0 - 0.5 * c->cell - margin);
    const long i1 = lean_cell(lean, 0, c->x0 + (c->nx - 0.5) * c->cell + margin) + 1;
    const long j1 = lean_cell(lean, 1, c->y0 + (c->ny - 0.5) * c->cell + margin) + 1;
    if ((double)(i1 - print->i0) * (double)(j1 - print->j0) > MOST_CELLS) return DP_OK;
    print->nx = (int)(i1 - print->i0), print->ny = (int)(j1 - print->j0);
    const double speed = sqrt(c->velocity.x * c->velocity.x + c->velocity.y * c->velocity.y);
    print->motion[0] = c->velocity.x / (speed + SLOW),
    print->motion[1] = c->velocity.y / (speed + SLOW);
    const bool room = make_room(print);
    if (room && lay_out(lean, print, ground, tallest))
        find_edges(print);
    else
        print->nx = print->ny = 0;
    return room ? DP_OK : DP_NO_MEMORY;
}

DpStatus lean_press_print(DpLean* lean, const LeanPrint* print, const DpPlantGround* ground)
{
    const int nx = print->nx, ny = print->ny;
    if (nx < 1 || ny < 1) return DP_OK;
    for (long ty = lean_tile(print->j0); ty <= lean_tile(print->j0 + ny - 1); ++ty)
        for (long tx = lean_tile(print->i0); tx <= lean_tile(print->i0 + nx - 1); ++tx) {
            LeanTile* tile = lean_touch(lean, tx, ty);
            if (!tile) return DP_NO_MEMORY;
            const long from_i = tx * DP_TILE - print->i0, from_j = ty * DP_TILE - print->j0;
            for (int j = from_j > 0 ? (int)from_j : 0; j < ny && j < from_j + DP_TILE; ++j)
                for (int i = from_i > 0 ? (int)from_i : 0; i < nx && i < from_i + DP_TILE; ++i)
                    meet(lean, print, ground, tile, i, j);
        }
    return DP_OK;
}
