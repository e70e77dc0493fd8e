// soil/soil_law_press.c - a rigid sole on ground that is no spring: how deep it goes. MODEL 6.2, MODEL 6.14
//
//   load --(Illinois)--> sink of the sole --> target of each column --(rate)--> pressed now
#include "soil/soil_law.h"

#define FIRST_STEP 1e-3  // sinks are looked for so far apart, then four times that .. [m]
#define FARTHEST 1e4     // [m]
#define MAX_ROUNDS 100
#define CLOSE 2e-9        // of the load is near enough ..
#define ALIKE 1e-10       // .. and so are sinks that differ by so little of the greatest depth
#define FLOOR_CELLS 4.0   // least contact area, as on springs
#define FLOOR_SHARE 0.05  // .. or this share of the sole
#define UNLOADS 0.05  // of its depth: so far pressed ground comes back before it carries nothing

typedef struct Balance
{
    double load;    // [N]
    double width;   // of the contact [m]
    int    beyond;  // kind of what would lie where there is no ground, -1 = none
    int    rounds;  // sinks tried so far
} Balance;

typedef struct Answer
{
    double force, area;  // [N], [m^2]
} Answer;

// The share of what ground carries as it is pressed for the first time that it carries at a depth t: 1 as deep as it was
// pressed or deeper; the sole lets go of it a little above, where a wheel has left its rut. Bekker and Wong.
static double reloaded(const Columns* columns, int k, double t)
{
    const double e = columns->pressed[k];
    if (!(e > 0.0)) return 1.0;
    const double deep = soil_min(e / columns->share[k], columns->rigid[k]);
    return soil_max(soil_min((t - deep) / (UNLOADS * deep) + 1.0, 1.0), 0.0);
}

// what column k presses back with, sunk by s [Pa]
static double stress_of(const Sole* sole, const Balance* balance, const Columns* columns, int k,
                        double s)
{
    const size_t p = columns->cell[k];
    const int    kind = p == NOWHERE ? balance->beyond : sole->patch->kind[p];
    const double firm = p == NOWHERE ? 1.0 : dp_law_firmness(sole->patch, p);
    const double t = columns->gap[k] + s;
    const double again = dp_law_unloads(sole->patch, kind) ? reloaded(columns, k, t) : 1.0;
    return again * firm * dp_law_kind_pressure(sole->patch, kind, balance->width, t);
}

static Answer answer(Sole* sole, Balance* balance, double s)
{
    ++balance->rounds;
    const double cell2 = sole->patch->cell * sole->patch->cell;
    const double force_grid = soil_grid(balance->load), share_grid = ldexp(1.5, 52 - 30);
    Answer       sum = {0.0, 0.0};
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                const Columns* columns = &sole->chunk[c];
                if (!(columns->gap[k] + s > 0.0)) continue;
                const double share = columns->share[k];
                const double push = stress_of(sole, balance, columns, k, s) * share * cell2;
                sum.force += soil_on_grid(soil_min(push, balance->load), force_grid);
                sum.area += soil_on_grid(push > 0.0 ? share : 0.0, share_grid);
            }
    sum.area *= cell2;
    return sum;
}

// The sink at which the columns carry the load. Their force never falls with the sink, but may rise as steeply or as
// slowly as it likes: what is known of both sides counts, by half of a side that stays, Dowell and Jarratt 1971; their
// middle a quarter of the time, and while the upper side carries more than twice the load.
static double sink_of(Sole* sole, Balance* balance, double highest, Answer* found)
{
    double low = -highest, high = low, below = -balance->load, above = 0.0;
    for (double step = FIRST_STEP; step < FARTHEST; step *= 4.0) {
        high = low + step;
        *found = answer(sole, balance, high);
        above = found->force - balance->load;
        if (above >= 0.0) break;
        low = high, below = above;
    }
    double s = high, last = 0.0;
    for (int round = 1; round < MAX_ROUNDS; ++round) {
        if (fabs(found->force - balance->load) <= CLOSE * balance->load) break;
        if (high - low <= ALIKE * (high + highest)) break;
        const bool   far = above > balance->load || round % 4 == 0;
        const double share = far ? 0.5 : below / (below - above);
        s = low + (high - low) * share;
        if (!(s > low && s < high)) s = 0.5 * (low + high);
        if (!(s > low && s < high)) break;
        *found = answer(sole, balance, s);
        const double over = found->force - balance->load;
        if (over < 0.0)
            low = s, below = over, above *= last < 0.0 ? 0.5 : 1.0;
        else
            high = s, above = over, below *= last > 0.0 ? 0.5 : 1.0;
        last = over;
    }
    return s;
}

// the highest gap, the sole's area, and what lies under it
static double look(Sole* sole, Balance* balance, double* area)
{
    const DpSoilPatch* patch = sole->patch;
    const double       share_grid = ldexp(1.5, 52 - 30);
    double             highest = -INFINITY, share = 0.0;
    for (dp_columns_rewind(sole); dp_columns_next(sole);)
        for (int c = 0; c < sole->filled; ++c)
            for (int k = 0; k < sole->chunk[c].count; ++k) {
                const size_t p = sole->chunk[c].cell[k];
                highest = soil_max(highest, sole->chunk[c].gap[k]);
                share += soil_on_grid(sole->chunk[c].share[k], share_grid);
                if (p != NOWHERE && balance->beyond < 0) balance->beyond = patch->kind[p];
            }
    *area = share * patch->cell * patch->cell;
    return highest;
}

void dp_law_press(DpSoilPatch* patch, DpImprint* imprint, Sole* sole, double load, double dt,
                  DpPressed* pressed)
{
    Balance      balance = {.load = load, .width = dp_law_width(patch, imprint), .beyond = -1};
    double       area = 0.0;
    const double highest = look(sole, &balance, &area);
    if (balance.beyond < 0 || !isfinite(highest)) return;
    const double floor_area = soil_max(FLOOR_CELLS * patch->cell * patch->cell, FLOOR_SHARE * area);
    const double least = soil_min(floor_area, area);
    Answer       found;
    double       s = sink_of(sole, &balance, highest, &found);
    if (found.area > 0.0 && found.area < least) {
        balance.load *= found.area / least;
        s = sink_of(sole, &balance, highest, &found);
    }
    pressed->sink = s;
    pressed->area = found.area;
    pressed->rounds = balance.rounds;
    for (Turn turn = dp_plough_begin(patch, imprint); turn <= PRESSES; ++turn) {
        for (dp_columns_rewind(sole); dp_columns_next(sole);)
            for (int c = 0; c < sole->filled; ++c) {
                const Columns* columns = &sole->chunk[c];
                Targets        targets = {.count = 0};
                for (int k = 0; k < columns->count; ++k) {
                    const double depth = columns->gap[k] + s;
                    if (!(depth > 0.0) || columns->cell[k] == NOWHERE) continue;
                    const double stress = stress_of(sole, &balance, columns, k, s);
                    add_target(
                        &targets, columns->cell[k],
                        (Target){soil_min(depth, columns->rigid[k]), stress, columns->share[k]});
                }
                dp_plough_press(patch, imprint, &targets, turn, dt, pressed);
            }
        if (turn == TELLS) dp_plough(patch, imprint, pressed);
    }
}
