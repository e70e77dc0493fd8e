// soil/soil_plough.c - a sole that slides while it presses cuts what is in its way. Ours; MODEL 6.18
//
//   targets of a law --(how deep the sole is by now)--> its underside --(less what was there before)--> cut, laid ahead
//
// What of the sole is over a place now is met from the side there as far as it is lower than what was over it before, which
// has gone on by the slide: all of it at the front, nothing in the middle of a flat sole, and nothing where it only comes down.
#include <string.h>

#include "soil/soil_law.h"

#define NOISE 1e-5  // of a cell's side: less than this is not cut, but pressed

Turn dp_plough_begin(const DpSoilPatch* patch, DpImprint* imprint)
{
    if (!imprint->slide) return PRESSES;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        memset(imprint->goal + soil_at(patch, imprint->i0, j), 0,
               (size_t)(imprint->i1 - imprint->i0) * sizeof *imprint->goal);
    return TELLS;
}

void dp_plough_press(DpSoilPatch* patch, DpImprint* imprint, const Targets* targets, Turn turn,
                     double dt, DpPressed* pressed)
{
    for (int k = 0; k < targets->count; ++k) imprint->ring[targets->cell[k]] = 0;
    if (turn == PRESSES) {
        dp_press_cells(patch, targets, dt, pressed);
        return;
    }
    for (int k = 0; k < targets->count; ++k)
        imprint->goal[targets->cell[k]] = (float)(targets->share[k] * targets->depth[k]);
}

// the share of its depth to which the sole has come so far, 0..1
static double reached(const DpSoilPatch* patch, const DpImprint* imprint)
{
    const double grid = ldexp(1.5, 52 - 46);
    double       now = 0.0, goal = 0.0;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            const double wanted = (double)imprint->goal[p];
            if (!(wanted > 0.0)) continue;
            const double depth = (double)patch->compression[p] - (double)patch->heap[p];
            goal += soil_on_grid(wanted, grid);
            now += soil_on_grid(soil_min(soil_max(depth, 0.0), wanted), grid);
        }
    return goal > 0.0 ? now / goal : 0.0;
}

// What of the sole was over a place before it slid.
typedef struct Before
{
    double goal, cover;
} Before;

// the whole number below, of cells
static inline long below(double u)
{
    const long cut = (long)u;
    return cut - (u < (double)cut);
}

// .. which is now at (u, v) [cells]: the mean of the four cells around, nothing beyond the sole
static Before before(const DpSoilPatch* patch, const DpImprint* imprint, double u, double v)
{
    const double grid = ldexp(1.5, 52 - 30);
    const long   i0 = below(u), j0 = below(v);
    const double right = soil_on_grid(u - (double)i0, grid),
                 up = soil_on_grid(v - (double)j0, grid);
    Before sum = {0.0, 0.0};
    for (long j = j0; j < j0 + 2; ++j) {
        if (j < imprint->j0 || j >= imprint->j1) continue;
        Before row = {0.0, 0.0};
        for (long i = i0; i < i0 + 2; ++i) {
            if (i < imprint->i0 || i >= imprint->i1) continue;
            const size_t p = soil_at(patch, i, j);
            const double share = i > i0 ? right : 1.0 - right;
            if (imprint->ring[p] != 0) continue;
            row.goal += share * fabs((double)imprint->goal[p]);
            row.cover += share * (double)imprint->cover[p];
        }
        sum.goal += (j > j0 ? up : 1.0 - up) * row.goal;
        sum.cover += (j > j0 ? up : 1.0 - up) * row.cover;
    }
    return sum;
}

// of the part of a cell that was bare, the share that the sole has come over
static double uncovered(double was, double is)
{
    return is > was ? (is - was) / (1.0 - was) : 0.0;
}

// how what is over a cell has gone along the ground [m]
static void slid(const DpSoilPatch* patch, const DpImprint* imprint, int i, int j, double gone[2])
{
    const DpSlide* slide = imprint->slide;
    const double   x = ((double)i - 0.5 * (double)(patch->nx - 1)) * patch->cell;
    const double   y = ((double)j - 0.5 * (double)(patch->ny - 1)) * patch->cell;
    const double   z = (double)imprint->bottom[soil_at(patch, i, j)];
    for (int k = 0; k < 2; ++k)
        gone[k] = slide->at[k] + slide->by_x[k] * x + slide->by_y[k] * y + slide->by_z[k] * z;
}

// Whether what is over a cell now may be lower than what was: none of the cells ahead is as deep, or it went farther.
static bool may_front(const DpSoilPatch* patch, const DpImprint* imprint, int i, int j,
                      const double gone[2])
{
    if (!(fabs(gone[0]) < patch->cell && fabs(gone[1]) < patch->cell)) return true;
    const int a = (gone[0] > 0.0) - (gone[0] < 0.0), b = (gone[1] > 0.0) - (gone[1] < 0.0);
    if (i + a < imprint->i0 || i + a >= imprint->i1 || j + b < imprint->j0 || j + b >= imprint->j1)
        return a || b;
    const float own = imprint->goal[soil_at(patch, i, j)];
    return fabsf(imprint->goal[soil_at(patch, i + a, j)]) < own ||
           fabsf(imprint->goal[soil_at(patch, i, j + b)]) < own ||
           fabsf(imprint->goal[soil_at(patch, i + a, j + b)]) < own;
}

// What a cell's column has to do with a slide.
typedef struct Met
{
    bool   is_met;     // something of it is met from the side
    double far;        // what is over it has gone so far [m] ..
    double x, y;       // .. that way, a unit vector
    double from_side;  // by so much its underside is lower than what was there before [m]
    double in_way;     // .. and by so much the firm column stands above it [m]
    double swept;      // share of what is loose on it that is in the way
} Met;

static Met meet(const DpSoilPatch* patch, const DpImprint* imprint, int i, int j, double share)
{
    Met          met = {.is_met = false};
    const size_t p = soil_at(patch, i, j);
    double       gone[2];
    slid(patch, imprint, i, j, gone);
    if (!may_front(patch, imprint, i, j, gone)) return met;
    const double far = sqrt(gone[0] * gone[0] + gone[1] * gone[1]);
    const double goal = (double)imprint->goal[p], cover = (double)imprint->cover[p];
    const Before was = before(patch, imprint, i + gone[0] / patch->cell, j + gone[1] / patch->cell);
    met.is_met = goal > was.goal;
    met.far = far, met.x = gone[0] / far, met.y = gone[1] / far;
    const double flows = 1.0 - imprint->slide->held;
    met.from_side = flows * share * soil_max(goal - was.goal, 0.0);
    met.in_way = soil_max(share * goal - (double)patch->compression[p], 0.0);
    met.swept = flows * uncovered(was.cover, cover);
    return met;
}

// What a step cuts of what is in its way: as much as it slides over, and has slid over, for a cell is covered by leaps and
// seen with those around.
static double cut_share(const DpSoilPatch* patch, const DpImprint* imprint, double share)
{
    const double grid = ldexp(1.5, 52 - 46), area = patch->cell * patch->cell;
    double       from_side = 0.0, in_way = 0.0, most = 0.0;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (!(imprint->goal[p] > 0.0f)) continue;
            const Met met = meet(patch, imprint, i, j, share);
            if (!met.is_met) {
                imprint->goal[p] = -imprint->goal[p];  // not to be looked at again
                continue;
            }
            from_side += soil_on_grid(met.from_side, grid);
            in_way += soil_on_grid(met.in_way, grid);
            most += soil_on_grid(met.from_side * soil_max(patch->cell / met.far, 1.0), grid);
        }
    DpSlide*     slide = imprint->slide;
    const double owed = soil_min(slide->owed + from_side * area, most * area);  // of one cell's way
    const double cut = soil_min(in_way * area, owed);
    slide->owed = owed - cut;
    return in_way > 0.0 ? cut / (in_way * area) : 0.0;
}

void dp_plough(DpSoilPatch* patch, const DpImprint* imprint, DpPressed* pressed)
{
    const double share = reached(patch, imprint), grid = ldexp(1.5, 52 - 46);
    const double part = cut_share(patch, imprint, share);
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            const double cover = (double)imprint->cover[p], goal = share * (double)imprint->goal[p];
            if (!(goal > 0.0)) continue;
            if (goal <= (double)patch->compression[p] && patch->heap[p] <= 0.0f) continue;
            const Met    met = meet(patch, imprint, i, j, share);
            const double was = cover * (1.0 - met.in_way / goal);
            const double swept = soil_max(met.swept, part * uncovered(was, cover));
            const double loose = swept * (double)patch->heap[p], firm = part * met.in_way;
            if (!(loose + firm > NOISE * patch->cell)) continue;
            const Cut    cut = dp_cut_cell(patch, p, loose, firm, 1.0);
            const double all = cut.firm + cut.loose;
            pressed->cut_firm += cut.firm, pressed->cut_loose += cut.loose;
            pressed->elastic += cut.elastic;
            pressed->cut_x += soil_on_grid(all * met.x, grid);
            pressed->cut_y += soil_on_grid(all * met.y, grid);
        }
}
