// soil/soil_compress.c - how deep a sole goes. TRAIL (9) (10), SOFT22 (9)-(11), MODEL 6.2
//
//   force --(balance)--> sink of the sole --> target of each column --(rate)--> pressed now
//
// Departures
//   TRAIL (10): one stress for all touched cells is `uniform`. `sole` makes every column a spring of
//     stiffness E/L0 under a rigid sole; a flat sole on even ground gives (10) exactly.
//     test_soil_compress.c, flat_sole_is_trail_10.
//   SOFT22 (11): as printed a column stops one step short of dL or overshoots it; here the last step is cut
//     to what is left, so the print does not depend on the frame rate. test_soil_compress.c,
//     frame_rate_does_not_matter.
//   Below 0.95 L0 the ground is rigid: it presses back 100 times as hard and yields no further.
//   What of a sole stands over no ground carries its share, as if the ground went on: the rest of the sole
//     does not get it. test_soil_compress_edge.c, over_an_edge. Ground that lies lower, beside a step, is no
//     such edge: what stands on the step bears all of the load, as it would. over_a_step.
//   `uniform` touches the ground as the contact met it, not its own print and rim: else the area, and with
//     it the depth, would depend on nu (SOFT22 Fig. 7). test_soil_compress_edge.c, met_ground_counts.
//   A cell that the sole covers by the share a is pressed by a times its column, so that volume and stress
//     do not depend on the cell. test_soil_compress.c, cells_do_not_matter.
#include "base/wide.h"  // first: it says how loops may be widened

#include <string.h>

#include "base/vec.h"
#include "soil/soil_law.h"

#define RIGID_STIFFER 100.0  // how much harder the ground is below SOIL_RIGID
#define TOUCH_GAP 0.01       // `uniform`: cells this close to the lowest one touch [m]
#define MAX_ROUNDS 100
#define FLOOR_CELLS 4.0   // least contact area: so many cells
#define FLOOR_SHARE 0.05  // .. or this share of the sole

// What the sole can be balanced on.
typedef struct Balance
{
    double load;                    // N                                        [N]
    double force_grid, slope_grid;  // for soil_on_grid
    int    rounds;                  // sinks tried so far
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
    _Alignas(64) double force[LANES] = {0}, slope[LANES] = {0}, share[LANES] = {0};
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
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

// the least sink at which some column of each lane carries the load alone; lanes that hold none never do
DP_CLONES
static void lone_sinks(const Columns* columns, double load, double* restrict lowest)
{
    for (int k = 0; k < LANES; ++k) {
        const double target = lone_target(load, columns->spring[k], columns->rigid[k]);
        lowest[k] = soil_min(lowest[k], target - columns->gap[k]);
    }
}

// look at all columns: scales of the sums, and a first guess; false if there are none
static bool weigh(Balance* balance, Sole* sole, double load)
{
    double stiffest[LANES] = {0}, highest[LANES];
    for (int k = 0; k < LANES; ++k) highest[k] = -INFINITY;
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c) find_max(&sole->chunk[c], stiffest, highest);
    for (int k = 1; k < LANES; ++k) {
        stiffest[0] = soil_max(stiffest[0], stiffest[k]);
        highest[0] = soil_max(highest[0], highest[k]);
    }
    if (!(stiffest[0] > 0.0 && isfinite(stiffest[0]) && isfinite(highest[0]))) return false;
    const double slope_grid = soil_grid(RIGID_STIFFER * stiffest[0]);
    double       share[LANES] = {0}, springs[LANES] = {0}, hanging[LANES] = {0};
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
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
// every step stays above and goes down: one that does not has come to what the grid of the sum rounds, more
// of the load the more columns there are. Above the sink at which one column alone carries it s cannot lie,
// and up to there no column pushes back by more than the load, as the grid wants it.
static double sink_of(Sole* sole, Balance* balance, Answer* found)
{
    const double load = balance->load;
    double       max_sink = INFINITY, lowest[LANES];
    for (int k = 0; k < LANES; ++k) lowest[k] = INFINITY;
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c) lone_sinks(&sole->chunk[c], load, lowest);
    for (int k = 0; k < LANES; ++k) max_sink = soil_min(max_sink, lowest[k]);
    balance->force_grid = soil_grid(load);
    // if all columns carried
    double s = soil_min((load + balance->hanging) / balance->springs - balance->highest, max_sink);
    for (int round = 0; round < MAX_ROUNDS; ++round) {
        *found = answer(sole, balance, s);
        ++balance->rounds;
        const double missing = load - found->force;
        if (fabs(missing) <= 2e-9 * load || !(found->slope > 0.0)) break;
        const double next = soil_min(s + missing / found->slope, max_sink);
        if (round > 0 && !(next < s)) break;
        s = next;
    }
    return s;
}

// least contact area, so that a first touch is not a needle
static double min_area(const Sole* sole, const Balance* balance)
{
    const double area = sole->patch->cell * sole->patch->cell;
    return soil_min(soil_max(FLOOR_CELLS * area, FLOOR_SHARE * balance->sole), balance->sole);
}

// the targets of columns sunk by s, and the stress on them: 0 where they carry nothing
DP_CLONES
static void sink_springs(const Columns* columns, double s, double area, double* restrict depth,
                         double* restrict stress)
{
    for (int k = 0; k < LANES; ++k) {
        const double t = columns->gap[k] + s, rigid = columns->rigid[k];
        const double share = columns->share[k];
        depth[k] = soil_min(t, rigid);
        stress[k] = columns->spring[k] * spring_length(t, rigid) / (share * area + 1e-300);
    }
}

// press the columns that carry, sunk by s
static void press_springs(DpSoilPatch* patch, DpImprint* imprint, const Columns* columns, double s,
                          Turn turn, double dt, DpPressed* pressed)
{
    double  depth[LANES], stress[LANES];
    Targets targets = {.count = 0};
    sink_springs(columns, s, patch->cell * patch->cell, depth, stress);
    for (int k = 0; k < columns->count; ++k)
        if (depth[k] > 0.0 && columns->cell[k] != NOWHERE)
            add_target(&targets, columns->cell[k],
                       (Target){depth[k], stress[k], columns->share[k]});
    dp_plough_press(patch, imprint, &targets, turn, dt, pressed);
}

// `sole`: balance, then press what carries
static void press_sole(DpSoilPatch* patch, DpImprint* imprint, Sole* sole, Balance* balance,
                       double dt, DpPressed* pressed)
{
    const double smallest = min_area(sole, balance);
    Answer       found;
    double       s = sink_of(sole, balance, &found);
    if (found.area > 0.0 && found.area < smallest) {
        balance->load *= found.area / smallest;
        s = sink_of(sole, balance, &found);
    }
    pressed->sink = s;
    pressed->area = found.area;
    pressed->rounds = balance->rounds;
    for (Turn turn = dp_plough_begin(patch, imprint); turn <= PRESSES; ++turn) {
        for (dp_columns_rewind(sole); dp_columns_next(sole);)
            for (int c = 0; c < sole->filled; ++c)
                press_springs(patch, imprint, &sole->chunk[c], s, turn, dt, pressed);
        if (turn == TELLS) dp_plough(patch, imprint, pressed);
    }
}

// height of the ground under the covered share of a cell over the sole's underside
static double overlap(const Columns* columns, int k)
{
    const double e = columns->pressed[k], share = columns->share[k];
    return columns->gap[k] - (e > 0.0 ? soil_min(e / share, columns->rigid[k]) : e);
}

// how deep a stress presses a cell [m]
static double uniform_depth(const DpSoilPatch* patch, size_t p, double stress, double rigid,
                            double width)
{
    const DpSoil* soil = &patch->soils[patch->kind[p]];
    if (dp_law_own(soil) || patch->layers)
        return dp_law_kind_depth(patch, patch->kind[p], width, stress / dp_law_firmness(patch, p));
    return stress * (rigid / SOIL_RIGID) / (double)patch->modulus[p];
}

// press the columns that touch, which all bear the same stress
static void press_evenly(DpSoilPatch* patch, DpImprint* imprint, const Columns* columns,
                         double stress, double width, Turn turn, double dt, DpPressed* pressed)
{
    Targets targets = {.count = 0};
    for (int k = 0; k < columns->count; ++k) {
        const size_t p = columns->cell[k];
        if (p == NOWHERE || imprint->ring[p] != 0) continue;
        const double rigid = columns->rigid[k];
        const double depth = uniform_depth(patch, p, stress, rigid, width);  // SOFT22 (10)
        add_target(&targets, p, (Target){soil_min(depth, rigid), stress, columns->share[k]});
    }
    dp_plough_press(patch, imprint, &targets, turn, dt, pressed);
}

// `uniform`: the sole is lowered until it touches; cells near its lowest one share the load evenly
static void press_uniform(DpSoilPatch* patch, DpImprint* imprint, Sole* sole,
                          const Balance* balance, double dt, DpPressed* pressed)
{
    const double width = dp_law_on(patch) ? dp_law_width(patch, imprint) : patch->cell;
    const double share_grid = ldexp(1.5, 52 - 30);
    double       highest = -INFINITY, area = 0.0, stress = 0.0;
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k)
                highest = soil_max(highest, overlap(&sole->chunk[c], k));

    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                if (overlap(&sole->chunk[c], k) < highest - TOUCH_GAP) continue;
                area += soil_on_grid(sole->chunk[c].share[k], share_grid);
                const size_t p = sole->chunk[c].cell[k];
                if (p != NOWHERE) imprint->ring[p] = 0;
            }
    area *= patch->cell * patch->cell;
    stress = balance->load / soil_max(area, min_area(sole, balance));  // SOFT22 (9)

    for (Turn turn = dp_plough_begin(patch, imprint); turn <= PRESSES; ++turn) {
        for (dp_columns_rewind(sole); dp_columns_next(sole);)
            for (int c = 0; c < sole->filled; ++c)
                press_evenly(patch, imprint, &sole->chunk[c], stress, width, turn, dt, pressed);
        if (turn == TELLS) dp_plough(patch, imprint, pressed);
    }
    pressed->sink = -highest;
    pressed->area = area;
}

DP_CLONES
static void all_far(int32_t* ring, int count)
{
    for (int i = 0; i < count; ++i) ring[i] = DP_RING_FAR;
}

DpStatus dp_soil_compress(DpSoilPatch* patch, DpImprint* imprint, const DpFootForce* foot,
                          DpContactLaw law, double dt, DpPressed* pressed)
{
    if (!soil_patch_ok(patch) || !imprint || !foot || !pressed || !(dt > 0.0) || !isfinite(dt) ||
        law == DP_CONTACT_CARVE)
        return DP_BAD_ARGUMENT;
    const double load = -dp_dot(foot->force, foot->normal);
    if (!isfinite(load)) return DP_BAD_ARGUMENT;

    memset(pressed, 0, sizeof *pressed);
    for (int j = 0; j < patch->ny; ++j) all_far(imprint->ring + soil_at(patch, 0, j), patch->nx);
    Sole sole;
    dp_columns_begin(&sole, patch, imprint, foot->normal);
    Balance balance = {0};
    if (load <= 0.0 || !sole.beyond.is_there || !weigh(&balance, &sole, load)) return DP_OK;

    if (patch->plate && dp_crust_carries(patch, imprint, &sole, load, dt, pressed)) return DP_OK;
    if (law == DP_CONTACT_UNIFORM)
        press_uniform(patch, imprint, &sole, &balance, dt, pressed);
    else if (dp_law_on(patch))
        dp_law_press(patch, imprint, &sole, load, dt, pressed);
    else
        press_sole(patch, imprint, &sole, &balance, dt, pressed);
    if (patch->plate) dp_crust_tilt(patch, imprint, pressed);
    const double area = patch->cell * patch->cell;
    pressed->firm *= area;
    pressed->elastic *= area;
    pressed->loose *= area;
    pressed->displaced *= area;
    pressed->cut_firm *= area, pressed->cut_loose *= area;
    pressed->cut_x *= area, pressed->cut_y *= area;
    return DP_OK;
}
