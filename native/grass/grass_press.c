// grass/grass_press.c - a sole in the grass: what it presses flat, and what it parts beside it.
#include "base/wide.h"

#include <stdlib.h>

#include "base/alloc.h"
#include "grass/grass_inside.h"

#define PARTED 0.5      // of its height: so far from a sole's edge grass leans away
#define MAX_PARTED 0.4  // [m]
#define SLOW 0.1        // a foot this slow has no direction of its own [m/s]
#define FAR 8000        // cells
#define SLIGHT 0.002    // leaning less than this is standing
#define MAX_CELLS 4e6   // around one sole

static size_t at_print(const GrassPrint* print, int i, int j)
{
    return (size_t)(j + 1) * (size_t)(print->nx + 2) + (size_t)(i + 1);
}

static int length2(const GrassPrint* print, size_t p)
{
    return print->across[p] * print->across[p] + print->up[p] * print->up[p];
}

// Rows of offsets to the nearest cell of the other kind, and of whether there is a sole.
typedef struct EdgeRow
{
    int32_t *      across, *up;
    const uint8_t* sole;
} EdgeRow;

static EdgeRow row_at(const GrassPrint* print, int j)
{
    const size_t at = at_print(print, 0, j);
    return (EdgeRow){print->across + at, print->up + at, print->under + at};
}

// a row's own nearest cells of the other kind, to the left and to the right
static void look_along(EdgeRow own, int nx)
{
    for (int step = -1; step <= 1; step += 2) {
        int far = FAR;  // from the cell before to its nearest
        for (int n = 0, i = step < 0 ? 0 : nx - 1; n < nx; ++n, i -= step) {
            far = own.sole[i + step] != own.sole[i] ? 1 : far < FAR ? far + 1 : FAR;
            if (far < abs(own.across[i])) own.across[i] = step * far, own.up[i] = 0;
        }
    }
}

// a row's cells look at those of the row `dj` beyond: by way of one of their own kind to its
// nearest, or at one of the other kind itself
DP_CLONES
static void look_back(int32_t* restrict across, int32_t* restrict up, const uint8_t* restrict sole,
                      const int32_t* restrict their_across, const int32_t* restrict their_up,
                      const uint8_t* restrict their_sole, int nx, int dj)
{
    for (int i = 0; i < nx; ++i) {
        int32_t best_i = across[i], best_j = up[i], best = best_i * best_i + best_j * best_j;
        for (int d = -1; d <= 1; ++d) {
            const int32_t alike = their_sole[i + d] == sole[i] ? 1 : 0;
            const int32_t to_i = d + alike * their_across[i + d];
            const int32_t to_j = dj + alike * their_up[i + d];
            const int32_t far = to_i * to_i + to_j * to_j;
            best_i = far < best ? to_i : best_i;
            best_j = far < best ? to_j : best_j;
            best = far < best ? far : best;
        }
        across[i] = best_i, up[i] = best_j;
    }
}

// Offsets to the nearest cell of the other kind: within a row first, then down and up again.
static void find_edges(const GrassPrint* print)
{
    const int    nx = print->nx, ny = print->ny;
    const size_t size = (size_t)(nx + 2) * (size_t)(ny + 2);
    for (size_t k = 0; k < size; ++k) print->across[k] = print->up[k] = FAR;
    for (int j = 0; j < ny; ++j) look_along(row_at(print, j), nx);
    for (int pass = 0; pass < 2; ++pass)
        for (int jj = 0; jj < ny; ++jj) {
            const int     j = pass ? ny - 1 - jj : jj, dj = pass ? 1 : -1;
            const EdgeRow own = row_at(print, j), back = row_at(print, j + dj);
            look_back(own.across, own.up, own.sole, back.across, back.up, back.sole, nx, dj);
        }
}

// one stem is pressed: no less than `crushed`, leaning by `size` towards (x, y)
static void press(DpGrass* grass, GrassTile* tile, int i, int j, double crushed, double size,
                  double x, double y)
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
    tile->deepest[p] = fmaxf(tile->deepest[p], tile->crushed[p]);
    tile->held[p] = grass->step;
    dp_grass_may_move(tile, i, j);
}

// how far a cell lies inside the sole's edge, < 0 outside [cells]
static double depth_at(const GrassPrint* print, size_t p)
{
    const double length = sqrt((double)length2(print, p));
    return print->under[p] ? length : -length;
}

// Height of the ground at a cell's centre: grids mostly have the grass's own cells.
static double ground_at(const DpGrass* grass, const DpPlantGround* ground, long i, long j)
{
    const double x = dp_grid_x(&grass->grid, i), y = dp_grid_y(&grass->grid, j);
    if (ground && !ground->at) {
        const double u = (x - ground->x0) / ground->cell, v = (y - ground->y0) / ground->cell;
        const double ci = floor(u + 0.5), cj = floor(v + 0.5);
        const bool   centred = fabs(u - ci) < 1e-6 && fabs(v - cj) < 1e-6;
        if (centred && ci >= 0.0 && cj >= 0.0 && ci < ground->nx && cj < ground->ny) {
            const float height = ground->height[(size_t)cj * (size_t)ground->row + (size_t)ci];
            if (isfinite(height)) return (double)height;
        }
    }
    return dp_plant_ground_at(ground, x, y);
}

// a stem beside a sole leans away from its edge, the less the farther it stands
static void part(DpGrass* grass, const GrassPrint* print, const DpPlantGround* ground,
                 GrassTile* tile, int pi, int pj, int ti, int tj)
{
    const size_t t = (size_t)tj * DP_TILE + (size_t)ti;
    const double high = (double)tile->height[t], parted = fmin(PARTED * high, MAX_PARTED);
    const size_t p = at_print(print, pi, pj);
    const double span = parted / grass->grid.cell + 0.5;
    if (!((double)length2(print, p) < span * span)) return;
    const double length = sqrt((double)length2(print, p));
    const double near = dp_clamp(1.0 - (length - 0.5) * grass->grid.cell / parted, 0.0, 1.0);
    const double bottom =
        (double)print->bottom[at_print(print, pi + print->across[p], pj + print->up[p])];
    const double gap = bottom - ground_at(grass, ground, print->i0 + pi, print->j0 + pj);
    const double size = dp_clamp(1.0 - gap / high, 0.0, 1.0) * near * near;
    if (size > SLIGHT)
        press(grass, tile, ti, tj, 1.0 - sqrt(1.0 - size * size), size, -print->across[p],
              -print->up[p]);
}

// A stem under a sole is pressed to the height it leaves, towards where the foot goes; near the
// sole's edge, or under one that does not move, out of its way.
static void flatten(DpGrass* grass, const GrassPrint* print, const DpPlantGround* ground,
                    GrassTile* tile, int pi, int pj, int ti, int tj)
{
    const size_t t = (size_t)tj * DP_TILE + (size_t)ti, p = at_print(print, pi, pj);
    const double high = (double)tile->height[t];
    const double gap =
        (double)print->bottom[p] - ground_at(grass, ground, print->i0 + pi, print->j0 + pj);
    const double pressed = dp_clamp(1.0 - gap / high, 0.0, 1.0);
    if (!(pressed > 0.0)) return;                    // the sole is above it; without ground, too
    if (pressed < (double)tile->crushed[t]) return;  // it may rise to the sole
    const double lx = (double)tile->lean[0][t], ly = (double)tile->lean[1][t];
    const double size = sqrt(pressed * (2.0 - pressed));
    tile->under[t] = grass->step;
    if (size * size <= lx * lx + ly * ly) {  // it leans so far already, whereto is the same
        press(grass, tile, ti, tj, pressed, size, 0.0, 0.0);
        return;
    }
    const double length = sqrt((double)length2(print, p)), parted = fmin(PARTED * high, MAX_PARTED);
    const double near = dp_clamp(1.0 - (length - 0.5) * grass->grid.cell / parted, 0.0, 1.0);
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
    if (!(x * x + y * y > 1e-6))
        x = print->across[p], y = print->up[p];  // halfway between two sides: either
    press(grass, tile, ti, tj, pressed, size, x, y);
}

// the stem of one cell
static void meet(DpGrass* grass, const GrassPrint* print, const DpPlantGround* ground,
                 GrassTile* tile, int pi, int pj)
{
    const int ti = (int)(print->i0 + pi - tile->tx * DP_TILE);
    const int tj = (int)(print->j0 + pj - tile->ty * DP_TILE);
    if (!(tile->height[(size_t)tj * DP_TILE + (size_t)ti] > 0.0f)) return;
    if (print->under[at_print(print, pi, pj)])
        flatten(grass, print, ground, tile, pi, pj, ti, tj);
    else
        part(grass, print, ground, tile, pi, pj, ti, tj);
}

static bool fit_print(GrassPrint* print)
{
    const size_t cells = (size_t)(print->nx + 2) * (size_t)(print->ny + 2);
    return dp_make_room(&print->across, cells, sizeof *print->across) &&
           dp_make_room(&print->up, cells, sizeof *print->up) &&
           dp_make_room(&print->bottom, cells, sizeof *print->bottom) &&
           dp_make_room(&print->under, cells, sizeof *print->under);
}

void dp_grass_print_drop(GrassPrint* print)
{
    dp_free(print->across), dp_free(print->up), dp_free(print->bottom), dp_free(print->under);
    print->across = print->up = NULL, print->bottom = NULL, print->under = NULL;
}

// The sole on the grass's own cells; false if it is nowhere less than `tallest` over the ground.
static bool lay_out(const DpGrass* grass, const GrassPrint* print, const DpPlantGround* ground,
                    double tallest)
{
    const DpPlantCollider* c = print->sole;
    const double           per_cell = grass->grid.cell / c->cell;  // mostly 1
    const double           u0 = (dp_grid_x(&grass->grid, print->i0) - c->x0) / c->cell + 0.5;
    const double           v0 = (dp_grid_y(&grass->grid, print->j0) - c->y0) / c->cell + 0.5;
    const size_t           cells = (size_t)(print->nx + 2) * (size_t)(print->ny + 2);
    bool                   low = false;
    for (size_t k = 0; k < cells; ++k) print->bottom[k] = INFINITY, print->under[k] = 0;
    const int first = (int)fmax(ceil(-u0 / per_cell), -1.0);
    for (int j = -1; j <= print->ny; ++j) {
        const double v = v0 + j * per_cell;
        if (!(v >= 0.0 && v < c->ny)) continue;
        const float* from = c->bottom + (size_t)v * (size_t)c->row;
        float*       to = print->bottom + at_print(print, 0, j);
        uint8_t*     sole = print->under + at_print(print, 0, j);
        for (int i = first; i <= print->nx; ++i) {
            const double u = u0 + i * per_cell;
            if (!(u >= 0.0)) continue;
            if (u >= c->nx) break;
            to[i] = from[(size_t)u];
            sole[i] = isfinite(to[i]) ? 1 : 0;
            if (sole[i] && !low)
                low = (double)to[i] - ground_at(grass, ground, print->i0 + i, print->j0 + j) <
                      tallest;
        }
    }
    return low;
}

static double margin_of(const DpGrass* grass)
{
    return fmin(PARTED * dp_plants_height(grass->plants), MAX_PARTED) + 2.0 * grass->grid.cell;
}

GrassPrint dp_grass_window(const DpGrass* grass, const DpPlantCollider* c)
{
    const double margin = margin_of(grass);
    GrassPrint   print = {.sole = c};
    print.i0 = dp_grid_i(&grass->grid, c->x0 - 0.5 * c->cell - margin);
    print.j0 = dp_grid_j(&grass->grid, c->y0 - 0.5 * c->cell - margin);
    const long i1 = dp_grid_i(&grass->grid, c->x0 + (c->nx - 0.5) * c->cell + margin) + 1;
    const long j1 = dp_grid_j(&grass->grid, c->y0 + (c->ny - 0.5) * c->cell + margin) + 1;
    if ((double)(i1 - print.i0) * (double)(j1 - print.j0) > MAX_CELLS) return print;
    print.nx = (int)(i1 - print.i0), print.ny = (int)(j1 - print.j0);
    return print;
}

DpStatus dp_grass_look_at(const DpGrass* grass, GrassPrint* print, const DpPlantGround* ground,
                          const DpPlantCollider* c)
{
    const GrassPrint window = dp_grass_window(grass, c);
    print->sole = c;
    print->i0 = window.i0, print->j0 = window.j0, print->nx = window.nx, print->ny = window.ny;
    if (print->nx < 1) return DP_OK;
    const double speed = sqrt(c->velocity.x * c->velocity.x + c->velocity.y * c->velocity.y);
    print->motion[0] = c->velocity.x / (speed + SLOW),
    print->motion[1] = c->velocity.y / (speed + SLOW);
    const bool room = fit_print(print);
    if (room && lay_out(grass, print, ground, dp_plants_height(grass->plants)))
        find_edges(print);
    else
        print->nx = print->ny = 0;
    return room ? DP_OK : DP_NO_MEMORY;
}

DpStatus dp_grass_press(DpGrass* grass, const GrassPrint* print, const DpPlantGround* ground)
{
    const int nx = print->nx, ny = print->ny;
    if (nx < 1 || ny < 1) return DP_OK;
    const double far =
        (margin_of(grass) - 1.5 * grass->grid.cell) / grass->grid.cell;  // nothing is parted there
    for (long ty = dp_tile_of(print->j0); ty <= dp_tile_of(print->j0 + ny - 1); ++ty)
        for (long tx = dp_tile_of(print->i0); tx <= dp_tile_of(print->i0 + nx - 1); ++tx) {
            GrassTile* tile = dp_grass_touch(grass, tx, ty);
            if (!tile) return DP_NO_MEMORY;
            const long from_i = tx * DP_TILE - print->i0, from_j = ty * DP_TILE - print->j0;
            for (int j = from_j > 0 ? (int)from_j : 0; j < ny && j < from_j + DP_TILE; ++j)
                for (int i = from_i > 0 ? (int)from_i : 0; i < nx && i < from_i + DP_TILE; ++i) {
                    const size_t p = at_print(print, i, j);
                    if (print->under[p] || (double)length2(print, p) < far * far)
                        meet(grass, print, ground, tile, i, j);
                }
        }
    return DP_OK;
}
