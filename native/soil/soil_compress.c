// soil/soil_compress.c - how deep a sole goes. TRAIL (9) (10), SOFT22 (9)-(11).
//
//   force --(balance)--> sink of the sole --> target of each column --(rate)--> pressed now
//
// Departures
//   TRAIL (10): one stress for all touched cells is `uniform`. `sole` makes every column a spring
//   of
//     stiffness E/L0 under a rigid sole; a flat sole on even ground gives (10) exactly.
//     test_soil_compress.c, flat_sole_is_trail_10.
//   SOFT22 (11): as printed a column stops one step short of dL or overshoots it; here the last
//   step
//     is cut to what is left, so the print does not depend on the frame rate. test_soil_compress.c,
//     frame_rate_does_not_matter.
//   Below 0.95 L0 the ground is rigid: it presses back 100 times as hard and yields no further.
//   What of a sole stands over no ground carries its share, as if the ground went on: the rest of the
//     sole does not get it. test_soil_compress.c, over_an_edge.
//   `uniform` touches the ground as the contact met it, not its own print and rim: else the area, and
//     with it the depth, would depend on nu (SOFT22 Fig. 7). test_soil_compress.c, met_ground_counts.
//   A cell that the sole covers by the share a is pressed by a times its column, so that volume
//     and stress do not depend on the cell. test_soil_compress.c, cells_do_not_matter.
#include <string.h>

#include "base/wide.h"  // first: it says how loops may be widened
#include "base/vec.h"
#include "soil/soil_inside.h"

#define LANES 32             // columns worked on at once
#define CHUNKS 40            // .. that are kept ready: a sole of up to 1280 cells is read only once
#define RIGID_STIFFER 100.0  // how much harder the ground is below SOIL_RIGID
#define TOUCH_GAP 0.01       // `uniform`: cells this close to the lowest one touch [m]
#define NOWHERE SIZE_MAX
#define MAX_ROUNDS 100
#define FLOOR_CELLS 4.0   // least contact area: so many cells
#define FLOOR_SHARE 0.05  // .. or this share of the sole
#define PRESS_GRID \
    ldexp(1.5, 52 - 46)  // for sums of pressed depths: steps of 1.4e-14 m, up to 128 m

// Columns of ground under the sole, and of what would be ground; lanes that hold none have share and spring 0.
typedef struct Columns
{
    double gap[LANES];      // g = h0 - underside of the sole, before it sinks     [m]
    double pressed[LANES];  // e = compression - heap as the sole met them         [m]
    double rigid[LANES];    // 0.95 L0                                             [m]
    double share[LANES];    // a                                                   [-]
    double spring[LANES];   // a E/L0 cell^2                                       [N/m]
    size_t cell[LANES];     // where in the patch; NOWHERE = beyond the ground
    int    count;           // lanes in use
} Columns;

// The ground under a sole as it would go on where there is none: the mean of what there is, level with it.
typedef struct Beyond
{
    double base_height, met;  // at (i, j) [m]
    double i, j;              // [cells]
    double slope_i, slope_j;  // [m per cell]
    double stiffness, depth;  // E/L0 [Pa/m], L0 [m]
    bool   is_there;          // some of the sole has ground
} Beyond;

// The columns of a sole, as many at a time as there is room for.
typedef struct Sole
{
    const DpSoilPatch* patch;
    const DpImprint*   imprint;
    Beyond             beyond;
    int                i, j;      // where to read on
    int                filled;    // chunks that hold columns
    bool               complete;  // all of the sole is held: no need to read again
    bool               shown;     // .. and was handed out in this round
    Columns            chunk[CHUNKS];
} Sole;

// What the sole can be balanced on.
typedef struct Balance
{
    double load;                    // N                                        [N]
    double force_grid, slope_grid;  // for soil_on_grid
    double highest;                 // largest gap                              [m]
    double springs;                 // of all columns                           [N/m]
    double hanging;                 // their forces if the sole hung at its highest gap [N]
    double sole;                    // area of the sole                         [m^2]
} Balance;

// What the ground answers when the sole has sunk by s.
typedef struct Answer
{
    double force;  // [N]
    double slope;  // of force over s [N/m]
    double area;   // of the columns that carry [m^2]
} Answer;

// how far below h0 the ground stood when the sole met it
static double met_at(const DpSoilPatch* patch, const DpImprint* imprint, size_t p)
{
    if (imprint->met) return -(double)imprint->met[p];
    return (double)patch->compression[p] - (double)patch->heap[p];
}

static void put_column(Columns* columns, const Sole* sole, size_t p)
{
    const DpSoilPatch* patch = sole->patch;
    const Beyond*      beyond = &sole->beyond;
    const int          k = columns->count++;
    const bool         ground = soil_is_ground(patch->base_height[p]);
    double             depth = beyond->depth, met = beyond->met, stiffness = beyond->stiffness;
    double base_height = beyond->base_height + beyond->slope_i * ((double)sole->i - beyond->i) +
                         beyond->slope_j * ((double)sole->j - beyond->j);
    if (ground) {
        depth = (double)patch->soils[patch->kind[p]].layer_depth;
        stiffness = (double)patch->modulus[p] / depth;
        met = met_at(patch, sole->imprint, p);
        base_height = (double)patch->base_height[p];
    }
    columns->gap[k] = base_height - (double)sole->imprint->bottom[p];
    columns->pressed[k] = met;
    columns->rigid[k] = SOIL_RIGID * depth;
    columns->share[k] = (double)sole->imprint->cover[p];
    columns->spring[k] = columns->share[k] * (stiffness * (patch->cell * patch->cell));
    columns->cell[k] = ground ? p : NOWHERE;
}

static void fill_up(Columns* columns)
{
    for (int k = columns->count; k < LANES; ++k) {
        columns->gap[k] = columns->pressed[k] = 0.0;
        columns->share[k] = columns->spring[k] = 0.0;
        columns->rigid[k] = 1.0;
    }
}

static void from_the_start(Sole* sole)
{
    sole->shown = false;
    if (sole->complete) return;
    sole->i = sole->imprint->i0;
    sole->j = sole->imprint->j0;
}

// the next chunk with room for a column; NULL when all are full
static Columns* with_room(Sole* sole)
{
    if (sole->filled > 0 && sole->chunk[sole->filled - 1].count < LANES)
        return &sole->chunk[sole->filled - 1];
    if (sole->filled == CHUNKS) return NULL;
    sole->chunk[sole->filled].count = 0;
    return &sole->chunk[sole->filled++];
}

// read columns from where the last reading stopped; true when the sole's end is reached
static bool read_columns(Sole* sole)
{
    const DpImprint* imprint = sole->imprint;
    for (; sole->j < imprint->j1; ++sole->j, sole->i = imprint->i0)
        for (; sole->i < imprint->i1; ++sole->i) {
            const size_t p = soil_at(sole->patch, sole->i, sole->j);
            if (!(imprint->cover[p] > 0.0f)) continue;
            Columns* columns = with_room(sole);
            if (!columns) return false;
            put_column(columns, sole, p);
        }
    return true;
}

static void look_beyond(Sole* sole, DpVec3 normal)
{
    const DpSoilPatch* patch = sole->patch;
    const DpImprint*   imprint = sole->imprint;
    Beyond             sum = {0};
    double             share = 0.0;
    bool               needed = false;
    for (int j = imprint->j0; j < imprint->j1; ++j)
        for (int i = imprint->i0; i < imprint->i1; ++i) {
            const size_t p = soil_at(patch, i, j);
            const double a = (double)imprint->cover[p];
            if (!(a > 0.0)) continue;
            if (!soil_is_ground(patch->base_height[p])) {
                needed = true;
                continue;
            }
            const double depth = (double)patch->soils[patch->kind[p]].layer_depth;
            share += a;
            sum.base_height += a * (double)patch->base_height[p];
            sum.met += a * met_at(patch, imprint, p);
            sum.i += a * i, sum.j += a * j;
            sum.stiffness += a * ((double)patch->modulus[p] / depth);
            sum.depth += a * depth;
        }
    sole->beyond = (Beyond){.is_there = share > 0.0};
    if (!needed || !sole->beyond.is_there) return;
    const double level = normal.z > 0.0 ? patch->cell / normal.z : 0.0;
    sole->beyond = (Beyond){.base_height = sum.base_height / share,
                            .met = sum.met / share,
                            .i = sum.i / share,
                            .j = sum.j / share,
                            .slope_i = -normal.x * level,
                            .slope_j = -normal.y * level,
                            .stiffness = sum.stiffness / share,
                            .depth = sum.depth / share,
                            .is_there = true};
}

// have the next columns at hand; false when all have been handed out since from_the_start()
static bool next_columns(Sole* sole)
{
    if (sole->complete) {
        const bool more = !sole->shown && sole->filled > 0;
        sole->shown = true;
        return more;
    }
    const bool first = sole->i == sole->imprint->i0 && sole->j == sole->imprint->j0;
    sole->filled = 0;
    const bool end = read_columns(sole);
    sole->complete = sole->shown = first && end;
    if (sole->filled > 0) fill_up(&sole->chunk[sole->filled - 1]);
    return sole->filled > 0;
}

// Length by which a column's spring is pressed when its target lies t below h0: t itself, more when it
// meets the rigid ground.
static inline double spring_length(double t, double rigid)
{
    const double hard = t > rigid ? rigid + RIGID_STIFFER * (t - rigid) : t;
    return hard > 0.0 ? hard : 0.0;
}

// add what `columns` answer to the sums; every lane has its own, the grids make the order free
DP_CLONES
static void push_back(const Columns* columns, const Balance* balance, double s, double* force,
                      double* slope, double* share)
{
    const double load = balance->load, force_grid = balance->force_grid;
    const double slope_grid = balance->slope_grid, share_grid = ldexp(1.5, 52 - 30);
    for (int k = 0; k < LANES; ++k) {
        const double x = spring_length(columns->gap[k] + s, columns->rigid[k]);
        const double push = columns->spring[k] * x;
        const double stiff = (x > columns->rigid[k] ? RIGID_STIFFER : 1.0) * columns->spring[k];
        force[k] += soil_on_grid(push < load ? push : load, force_grid);  // more only by rounding
        slope[k] += soil_on_grid(x > 0.0 ? stiff : 0.0, slope_grid);
        share[k] += soil_on_grid(x > 0.0 ? columns->share[k] : 0.0, share_grid);
    }
}

static Answer answer(Sole* sole, const Balance* balance, double s)
{
    double force[LANES] = {0}, slope[LANES] = {0}, share[LANES] = {0};
    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c)
            push_back(&sole->chunk[c], balance, s, force, slope, share);
    Answer sum = {0};
    for (int k = 0; k < LANES; ++k) {
        sum.force += force[k];
        sum.slope += slope[k];
        sum.area += share[k];
    }
    sum.area *= sole->patch->cell * sole->patch->cell;
    return sum;
}

// largest spring and gap of `columns`
DP_CLONES
static void find_max(const Columns* columns, double* restrict stiffest, double* restrict highest)
{
    for (int k = 0; k < LANES; ++k) {
        const double gap = k < columns->count ? columns->gap[k] : -INFINITY;
        stiffest[k] = soil_max(stiffest[k], columns->spring[k]);
        highest[k] = soil_max(highest[k], gap);
    }
}

// add up shares, springs, and the springs' forces if the sole hung at its highest gap
DP_CLONES
static void add_up(const Columns* columns, double highest, double slope_grid,
                   double* restrict share, double* restrict springs, double* restrict hanging)
{
    const double share_grid = ldexp(1.5, 52 - 30);
    for (int k = 0; k < LANES; ++k) {
        const double gap = highest - columns->gap[k];
        share[k] += soil_on_grid(columns->share[k], share_grid);
        springs[k] += soil_on_grid(columns->spring[k], slope_grid);
        hanging[k] += soil_on_grid(columns->spring[k] * soil_min(gap, 1.0), slope_grid);
    }
}

// how far a column's target may lie below h0 before it alone carries the load
static inline double lone_target(double load, double spring, double rigid)
{
    const double x = load / spring;
    return x > rigid ? rigid + (x - rigid) / RIGID_STIFFER : x;
}

// the least sink at which some column carries the load alone
static double lone_sink(const Columns* columns, double load)
{
    double lowest = INFINITY;
    for (int k = 0; k < columns->count; ++k) {
        const double target = lone_target(load, columns->spring[k], columns->rigid[k]);
        lowest = soil_min(lowest, target - columns->gap[k]);
    }
    return lowest;
}

// look at all columns: scales of the sums, and a first guess; false if there are none
static bool weigh(Balance* balance, Sole* sole, double load)
{
    double stiffest[LANES] = {0}, highest[LANES];
    for (int k = 0; k < LANES; ++k) highest[k] = -INFINITY;
    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c) find_max(&sole->chunk[c], stiffest, highest);
    for (int k = 1; k < LANES; ++k) {
        stiffest[0] = soil_max(stiffest[0], stiffest[k]);
        highest[0] = soil_max(highest[0], highest[k]);
    }
    if (!(stiffest[0] > 0.0 && isfinite(stiffest[0]) && isfinite(highest[0]))) return false;
    const double slope_grid = soil_grid(RIGID_STIFFER * stiffest[0]);
    double       share[LANES] = {0}, springs[LANES] = {0}, hanging[LANES] = {0};
    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c)
            add_up(&sole->chunk[c], highest[0], slope_grid, share, springs, hanging);
    for (int k = 1; k < LANES; ++k) {
        share[0] += share[k];
        springs[0] += springs[k];
        hanging[0] += hanging[k];
    }
    balance->slope_grid = slope_grid;
    balance->highest = highest[0];
    balance->springs = springs[0];
    balance->hanging = hanging[0];
    balance->sole = share[0] * sole->patch->cell * sole->patch->cell;
    balance->load = load;
    return true;
}

// The sink s at which the columns carry the load, by Newton. Their force is convex in s, so from above
// every step stays above. Above the sink at which one column alone carries it s cannot lie, and up to
// there no column pushes back by more than the load, as the grid of their sum wants it.
static double sink_of(Sole* sole, Balance* balance, Answer* found)
{
    const double load = balance->load;
    double       max_sink = INFINITY;
    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c)
            max_sink = soil_min(max_sink, lone_sink(&sole->chunk[c], load));
    balance->force_grid = soil_grid(load);
    // if all columns carried
    double s = soil_min((load + balance->hanging) / balance->springs - balance->highest, max_sink);
    for (int round = 0; round < MAX_ROUNDS; ++round) {
        *found = answer(sole, balance, s);
        const double missing = load - found->force;
        if (fabs(missing) <= 2e-9 * load || !(found->slope > 0.0)) break;
        const double next = soil_min(s + missing / found->slope, max_sink);
        if (fabs(next - s) < 1e-15 * fabs(s)) break;
        s = next;
    }
    return s;
}

// the target of one cell and the stress on it
typedef struct Target
{
    double depth;   // t, below h0 under the sole [m]
    double stress;  // sigma [Pa]
    double share;   // a [-]
} Target;

// lower one cell towards its target for dt seconds, SOFT22 (11)
static void press_cell(DpSoilPatch* patch, size_t p, Target target, double dt, DpPressed* pressed)
{
    const DpSoil* soil = &patch->soils[patch->kind[p]];
    const float   c = patch->compression[p], b = patch->heap[p];
    const double  goal = target.share * target.depth;                           // TRAIL (10)
    const double  rate = goal * soil_min(dt / (double)soil->settle_time, 1.0);  // SOFT22 (11)
    const double  press =
        soil_max(soil_min(rate, goal - ((double)c - (double)b)), 0.0);  // not past it
    const double loose = soil_min(press, (double)b);
    patch->heap[p] = (float)((double)b - loose);
    patch->compression[p] = (float)((double)c + (press - loose));
    if (patch->pressure_time)
        patch->pressure_time[p] += (float)(target.stress * target.share * dt);  // TRAIL (17)
    if (patch->pressure) patch->pressure[p] = (float)(target.stress * target.share);

    // the ledger counts what the float grids really hold
    const double out_of_heap = (double)b - (double)patch->heap[p];
    const double out_of_firm = (double)patch->compression[p] - (double)c;
    const double moved = out_of_heap + out_of_firm;
    pressed->loose += soil_on_grid(out_of_heap, PRESS_GRID);
    pressed->firm += soil_on_grid(out_of_firm, PRESS_GRID);
    pressed->displaced += soil_on_grid(2.0 * (double)soil->poisson_ratio * moved,  // SOFT22 (12)
                                       PRESS_GRID);
    pressed->deepest = soil_max(pressed->deepest, (double)patch->compression[p]);
}

// least contact area, so that a first touch is not a needle
static double min_area(const Sole* sole, const Balance* balance)
{
    const double area = sole->patch->cell * sole->patch->cell;
    return soil_min(soil_max(FLOOR_CELLS * area, FLOOR_SHARE * balance->sole), balance->sole);
}

// `sole`: balance, then press what carries
static void press_sole(DpSoilPatch* patch, DpImprint* imprint, Sole* sole, Balance* balance,
                       double dt, DpPressed* pressed)
{
    const double area = patch->cell * patch->cell, smallest = min_area(sole, balance);
    Answer       found;
    double       s = sink_of(sole, balance, &found);
    if (found.area > 0.0 && found.area < smallest) {
        balance->load *= found.area / smallest;
        s = sink_of(sole, balance, &found);
    }
    pressed->sink = s;
    pressed->area = found.area;
    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c) {
            const Columns* columns = &sole->chunk[c];
            for (int k = 0; k < columns->count; ++k) {
                const double t = columns->gap[k] + s, rigid = columns->rigid[k];
                const double x = spring_length(t, rigid);
                if (x <= 0.0) continue;
                const size_t p = columns->cell[k];
                if (p == NOWHERE) continue;
                const double stress = columns->spring[k] * x / (columns->share[k] * area);
                imprint->ring[p] = 0;
                press_cell(patch, p, (Target){soil_min(t, rigid), stress, columns->share[k]}, dt,
                           pressed);
            }
        }
}

// height of the ground under the covered share of a cell over the sole's underside
static double overlap(const Columns* columns, int k)
{
    const double e = columns->pressed[k], share = columns->share[k];
    return columns->gap[k] - (e > 0.0 ? soil_min(e / share, columns->rigid[k]) : e);
}

// `uniform`: the sole is lowered until it touches; cells near its lowest one share the load evenly
static void press_uniform(DpSoilPatch* patch, DpImprint* imprint, Sole* sole,
                          const Balance* balance, double dt, DpPressed* pressed)
{
    const double share_grid = ldexp(1.5, 52 - 30);
    double       highest = -INFINITY, area = 0.0, stress = 0.0;
    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k)
                highest = soil_max(highest, overlap(&sole->chunk[c], k));

    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                if (overlap(&sole->chunk[c], k) < highest - TOUCH_GAP) continue;
                area += soil_on_grid(sole->chunk[c].share[k], share_grid);
                const size_t p = sole->chunk[c].cell[k];
                if (p != NOWHERE) imprint->ring[p] = 0;
            }
    area *= patch->cell * patch->cell;
    stress = balance->load / soil_max(area, min_area(sole, balance));  // SOFT22 (9)

    for (from_the_start(sole); next_columns(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                const Columns* columns = &sole->chunk[c];
                const size_t   p = columns->cell[k];
                if (p == NOWHERE || imprint->ring[p] != 0) continue;
                const double rigid = columns->rigid[k];
                const double depth = stress * (rigid / SOIL_RIGID) / (double)patch->modulus[p];
                press_cell(patch, p, (Target){soil_min(depth, rigid), stress, columns->share[k]},
                           dt,
                           pressed);  // SOFT22 (10)
            }
    pressed->sink = -highest;
    pressed->area = area;
}

DpStatus dp_soil_compress(DpSoilPatch* patch, DpImprint* imprint, const DpFootForce* foot,
                          DpContactLaw law, double dt, DpPressed* pressed)
{
    if (!soil_patch_ok(patch) || !imprint || !foot || !pressed || !(dt > 0.0) || !isfinite(dt))
        return DP_BAD_ARGUMENT;
    const double load = -dp_dot(foot->force, foot->normal);
    if (!isfinite(load)) return DP_BAD_ARGUMENT;

    memset(pressed, 0, sizeof *pressed);
    for (int j = 0; j < patch->ny; ++j) {
        int32_t* ring = imprint->ring + soil_at(patch, 0, j);
        for (int i = 0; i < patch->nx; ++i) ring[i] = DP_RING_FAR;
    }
    Sole sole;
    sole.patch = patch;
    sole.imprint = imprint;
    sole.complete = false;
    look_beyond(&sole, foot->normal);
    Balance balance = {0};
    if (load <= 0.0 || !sole.beyond.is_there || !weigh(&balance, &sole, load)) return DP_OK;

    if (law == DP_CONTACT_UNIFORM)
        press_uniform(patch, imprint, &sole, &balance, dt, pressed);
    else
        press_sole(patch, imprint, &sole, &balance, dt, pressed);
    const double area = patch->cell * patch->cell;
    pressed->firm *= area;
    pressed->loose *= area;
    pressed->displaced *= area;
    return DP_OK;
}
