// soil/soil_crust.c - a plate on soft ground: it carries, or breaks into pieces that lie tilted. Ours; MODEL 6.12
//
//   sole on whole pieces --(bending stress)--> carried | broken --(print)--> pieces tilt into it
//
// A piece is whole while no cell of it was ever pressed: nothing else has to be kept.
#include <math.h>

#include "soil/soil_columns.h"

#define STIFFER \
    1000.0  // elastic modulus of a crust, in its strength: brittle, it breaks at a strain of 1e-3
#define POISSON 0.3      // of a crust
#define AT_EDGE 2.0      // beside a free edge the stress is about twice that inside, Westergaard
#define TOUCH 0.01       // a sole carries on a plate with what is so close to its lowest [m]
#define PIECES 1024      // that one sole can break and tilt; more lie level
#define PIECE_WIDTH 7.0  // a piece is narrower than so many of its thicknesses
#define FLATTEST 0.15    // slopes at which pieces come to lie
#define STEEPEST 0.75
#define GRID ldexp(1.5, 20)  // for sums of depths: steps of 3e-10 m

double dp_soil_crust_margin(const DpSoil* soil)
{
    return dp_has_crust(soil) ? PIECE_WIDTH * (double)soil->crust_depth : 0.0;
}

double dp_soil_crust_stress(const DpSoil* soil, double load, double area, double stiffness,
                            bool edge)
{
    const double h = (double)soil->crust_depth, modulus = STIFFER * (double)soil->crust_strength;
    const double rigidity = modulus * h * h * h / (12.0 * (1.0 - POISSON * POISSON));
    const double length = sqrt(sqrt(rigidity / stiffness));  // radius of relative stiffness
    const double a = sqrt(area / DP_PI);
    const double b = a < 1.724 * h ? sqrt(1.6 * a * a + h * h) - 0.675 * h : a;
    const double spread = fmax(log(length / b) + 0.6159, 0.0);
    const double inside = 3.0 * (1.0 + POISSON) * load / (2.0 * DP_PI * h * h);
    return (edge ? AT_EDGE : 1.0) * inside * spread;  // MODEL 6.12
}

// ---- pieces --------------------------------------------------------------------------------------

// What is known of a piece on which a sole stands.
typedef struct Piece
{
    uint32_t name;              // 0 = no piece
    double under, x, y, depth;  // cells under the sole, sums of their places [cells] and depths [m]
    double out, out_x, out_y;   // the same beside it
    double near, far;           // along the way out [cells]
} Piece;

// where a piece is in the table, or the empty place for it; NULL: the table is full
static Piece* place_of(Piece* piece, uint32_t name)
{
    for (uint32_t k = 0; k < PIECES; ++k) {
        Piece* one = &piece[(name * 2654435761u + k) % PIECES];
        if (one->name == name || one->name == 0) return one;
    }
    return NULL;
}

// the name of a cell's piece, 0 where there is no crust now
static uint32_t name_at(const DpSoilPatch* patch, size_t p)
{
    const bool there =
        soil_is_ground(patch->base_height[p]) && dp_has_crust(&patch->soils[patch->kind[p]]);
    return there ? patch->plate[p] : 0;
}

// a piece that is in the table; NULL: it is not
static Piece* known(const DpSoilPatch* patch, Piece* piece, size_t p)
{
    const uint32_t name = name_at(patch, p);
    Piece*         one = name ? place_of(piece, name) : NULL;
    return one && one->name ? one : NULL;
}

// cells around the sole that its pieces can reach
static DpCellRect around(const DpSoilPatch* patch, const DpImprint* imprint)
{
    double margin = 0.0;
    for (int s = 0; s < patch->soil_count; ++s)
        margin = fmax(margin, dp_soil_crust_margin(&patch->soils[s]));
    const DpCellRect under = {imprint->i0, imprint->i1, imprint->j0, imprint->j1};
    return soil_grown(under, (long)ceil(margin / patch->cell), patch);
}

// height of the ground under a column's covered share over the sole's underside
static double overlap(const Columns* columns, int k)
{
    const double e = columns->pressed[k], share = columns->share[k];
    return columns->gap[k] - (e > 0.0 ? soil_min(e / share, columns->rigid[k]) : e);
}

// ---- carried or broken ---------------------------------------------------------------------------

// The pieces under the sole, in the table, and how deep each was pressed anywhere: 0 = whole.
static bool look_at_pieces(const DpSoilPatch* patch, const DpImprint* imprint, Piece* piece)
{
    const DpCellRect box = around(patch, imprint);
    bool             any = false;
    for (long j = imprint->j0; j < imprint->j1; ++j)
        for (long i = imprint->i0; i < imprint->i1; ++i) {
            const size_t   p = soil_at(patch, i, j);
            const uint32_t name = imprint->cover[p] > 0.0f ? name_at(patch, p) : 0;
            Piece*         one = name ? place_of(piece, name) : NULL;
            if (one) one->name = name, any = true;
        }
    for (long j = box.j0; any && j < box.j1; ++j)
        for (long i = box.i0; i < box.i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            Piece*       one = patch->compression[p] > 0.0f ? known(patch, piece, p) : NULL;
            if (one) one->depth = soil_max(one->depth, (double)patch->compression[p]);
        }
    return any;
}

static bool is_intact(const DpSoilPatch* patch, Piece* piece, size_t p)
{
    const Piece* one = p == NOWHERE ? NULL : known(patch, piece, p);
    return one && !(one->depth > 0.0);
}

// What of the sole stands on whole pieces.
typedef struct Footing
{
    double highest;           // of the ground over the sole [m]
    double share, stiffness;  // cells, and the sum of their E/L0 [Pa/m]
    size_t cell;              // one of them, for its soil; NOWHERE = none
    bool   edge;              // beside broken ones
} Footing;

static Footing stand_on(const DpSoilPatch* patch, Sole* sole, Piece* piece)
{
    Footing found = {.highest = -INFINITY, .cell = NOWHERE};
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k)
                found.highest = soil_max(found.highest, overlap(&sole->chunk[c], k));
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                const Columns* columns = &sole->chunk[c];
                const size_t   p = columns->cell[k];
                const bool     intact = is_intact(patch, piece, p);
                found.edge = found.edge || !intact;
                if (!intact || overlap(columns, k) < found.highest - TOUCH) continue;
                found.share += soil_on_grid(columns->share[k], ldexp(1.5, 52 - 30));
                found.stiffness += columns->spring[k];
                if (found.cell == NOWHERE) found.cell = p;
            }
    found.stiffness /= patch->cell * patch->cell;
    return found;
}

bool dp_crust_carries(DpSoilPatch* patch, DpImprint* imprint, Sole* sole, double load, double dt,
                      DpPressed* pressed)
{
    Piece piece[PIECES] = {{0}};
    if (!look_at_pieces(patch, imprint, piece)) return false;
    const Footing found = stand_on(patch, sole, piece);
    if (found.cell == NOWHERE) return false;
    const DpSoil* soil = &patch->soils[patch->kind[found.cell]];
    const double  area = found.share * patch->cell * patch->cell, sigma = load / area;
    const double  stress =
        dp_soil_crust_stress(soil, load, area, found.stiffness / found.share, found.edge);
    if (stress >= (double)soil->crust_strength) return false;
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                const Columns* columns = &sole->chunk[c];
                const size_t   p = columns->cell[k];
                const double   share = columns->share[k];
                if (!is_intact(patch, piece, p) || overlap(columns, k) < found.highest - TOUCH)
                    continue;
                imprint->ring[p] = 0;
                if (patch->pressure_time)
                    patch->pressure_time[p] += (float)(sigma * share * dt);  // TRAIL (17)
                if (patch->pressure) patch->pressure[p] = (float)(sigma * share);
            }
    pressed->sink = -found.highest;
    pressed->area = area;
    return true;
}

// ---- what is broken tilts ------------------------------------------------------------------------

// how far along its way out from under the sole a cell of a piece lies [cells]
static double along(const Piece* one, long i, long j)
{
    const double from_x = one->x / one->under, from_y = one->y / one->under;
    const double x = one->out_x / one->out - from_x, y = one->out_y / one->out - from_y;
    return (((double)i - from_x) * x + ((double)j - from_y) * y) / soil_max(hypot(x, y), 1e-9);
}

// the piece of a cell beside the sole, if the sole has pressed into it
static Piece* beside(const DpSoilPatch* patch, const DpImprint* imprint, Piece* piece, size_t p)
{
    return imprint->ring[p] == 0 || imprint->cover[p] > 0.0f ? NULL : known(patch, piece, p);
}

// cells of pieces that the sole has pressed, and those beside it, are added up
static void add_up(const DpSoilPatch* patch, const DpImprint* imprint, DpCellRect box, Piece* piece)
{
    for (long j = imprint->j0; j < imprint->j1; ++j)
        for (long i = imprint->i0; i < imprint->i1; ++i) {
            const size_t   p = soil_at(patch, i, j);
            const uint32_t name = imprint->ring[p] == 0 ? name_at(patch, p) : 0;
            Piece*         one = name ? place_of(piece, name) : NULL;
            if (!one) continue;
            one->name = name;
            one->under += 1.0, one->x += (double)i, one->y += (double)j;
            one->depth += soil_on_grid((double)patch->compression[p], GRID);
        }
    for (long j = box.j0; j < box.j1; ++j)
        for (long i = box.i0; i < box.i1; ++i) {
            Piece* one = beside(patch, imprint, piece, soil_at(patch, i, j));
            if (!one) continue;
            one->out += 1.0, one->out_x += (double)i, one->out_y += (double)j;
            one->near = INFINITY, one->far = -INFINITY;
        }
}

// How deep a piece lies at a cell: it hangs at its far edge, and leans into the print as steeply as chance has it.
static double lies(const Piece* one, double t, double cell)
{
    const double chance = (double)(one->name >> 8) / (double)(1 << 24);
    const double span = (one->far - one->near + 1.0) * cell;
    const double slope = FLATTEST + (STEEPEST - FLATTEST) * chance;
    const double inner = soil_min(one->depth / one->under, slope * span);
    return inner * soil_min((one->far + 0.5 - t) * cell / span, 1.0);  // MODEL 6.12
}

void dp_crust_tilt(DpSoilPatch* patch, const DpImprint* imprint, DpPressed* pressed)
{
    Piece            piece[PIECES] = {{0}};
    const DpCellRect box = around(patch, imprint);
    const double     deepest = pressed->deepest;
    add_up(patch, imprint, box, piece);
    for (long j = box.j0; j < box.j1; ++j)
        for (long i = box.i0; i < box.i1; ++i) {
            Piece* one = beside(patch, imprint, piece, soil_at(patch, i, j));
            if (!one) continue;
            const double t = along(one, i, j);
            one->near = soil_min(one->near, t), one->far = soil_max(one->far, t);
        }
    for (long j = box.j0; j < box.j1; ++j)
        for (long i = box.i0; i < box.i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            const Piece* one = beside(patch, imprint, piece, p);
            if (!one) continue;
            const double depth = lies(one, along(one, i, j), patch->cell);
            const double at_once = (double)patch->soils[patch->kind[p]].settle_time;
            if (depth > 0.0) dp_press_cell(patch, p, (Target){depth, 0.0, 1.0}, at_once, pressed);
        }
    pressed->deepest = deepest;
}
