// sim/sim_step.c - all limbs, interval by interval. TRAIL 4.2: where the rooms meet.
//
// Limbs whose patches meet form a group and are worked on in the recording's order by one thread;
// groups do not touch each other, so they may run at once and the result stays the same. On planted
// ground the next step's soil is worked out while the plants still move: sim_ahead.c.
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define HEAP_MARGIN 0.10  // [m] of ground around a sole that a step may change, at least
#define SPILL_GROWTH \
    1.5               // .. so many times more, after a step whose loose soil wanted to go farther
#define HEAP_SPARE 4  // cells beyond the foot of the heap
#define FEW_GROUPS 4  // with fewer, starting threads costs more than it gives ..
#define MANY_CELLS 8000  // .. unless their patches are as large as this

// how far soles may slip on any of the soils [m]
static double slips(const DpSim* sim)
{
    for (int s = 0; s < dp_terrain_soil_count(sim->terrain); ++s)
        if (dp_terrain_soils(sim->terrain)[s].shear_modulus > 0.0f) return DP_MAX_SLIP;
    return 0.0;
}

// What a limb does in the interval from `sample` to the next, and on which cells.
static void plan_limb(DpSim* sim, Limb* limb, int sample)
{
    const bool now = dp_limb_touches(sim, limb, sample);
    const bool then = dp_limb_touches(sim, limb, sample + 1);
    const bool presses = now || then;
    limb->lifts = limb->stands && !presses;
    limb->active = presses || limb->lifts;
    const bool spilled = limb->spills;
    limb->spills = limb->off_ground = false;
    limb->firm = limb->loose = limb->laid = limb->deepest = 0.0;
    if (presses && !limb->stands) {
        limb->heap_height = 0.0;
        limb->slip = limb->sheared = dp_vec3(0.0, 0.0, 0.0);
        limb->margin = HEAP_MARGIN;
        limb->trodden = limb->met_at = (Cells){0, 0, 0, 0};
        ++sim->report.contacts;
    }
    limb->stands = presses;
    if (presses) {
        double slope = INFINITY;  // the flattest heap reaches farthest
        for (int s = 0; s < dp_terrain_soil_count(sim->terrain); ++s)
            slope = fmin(slope, tan((double)dp_terrain_soils(sim->terrain)[s].rest_angle));
        const bool   paper = sim->options.heap_law == DP_HEAP_PAPER;
        const double rim = paper ? sim->options.rim_width : 0.0;
        const double reach = fmax(1.25 * limb->heap_height / slope, rim) + HEAP_SPARE * sim->cell;
        if (spilled && paper) limb->margin *= SPILL_GROWTH;  // laid at rest it waits for lift-off
        limb->patch = dp_limb_cells(sim, limb, sample, fmax(limb->margin, reach) + slips(sim));
    } else {
        limb->patch = limb->trodden;
    }
}

static int root(const int* group, int l)
{
    while (group[l] != l) l = group[l];
    return l;
}

// Limbs that meet get one group: start[k] .. start[k + 1] are the places of group k in `order`.
static int make_groups(DpSim* sim)
{
    const int limbs = sim->gait.limbs;
    for (int l = 0; l < limbs; ++l) sim->group[l] = l;
    for (int a = 0; a < limbs; ++a) {
        if (!sim->limb[a].active) continue;
        for (int b = a + 1; b < limbs; ++b) {
            if (!sim->limb[b].active || !dp_cells_meet(sim->limb[a].patch, sim->limb[b].patch))
                continue;
            const int ra = root(sim->group, a), rb = root(sim->group, b);
            sim->group[ra > rb ? ra : rb] = ra > rb ? rb : ra;
        }
    }
    int groups = 0, placed = 0;
    for (int l = 0; l < limbs; ++l) {
        if (!sim->limb[l].active || sim->group[l] != l) continue;
        sim->start[groups++] = placed;
        for (int m = l; m < limbs; ++m)
            if (sim->limb[m].active && root(sim->group, m) == l) sim->order[placed++] = m;
    }
    sim->start[groups] = placed;
    return groups;
}

typedef struct Step
{
    DpSim* sim;
    int    sample;
} Step;

static void work_group(void* context, int group, int worker)
{
    const Step* step = context;
    DpSim*      sim = step->sim;
    Bench*      bench = &sim->bench[worker];
    for (int k = sim->start[group]; k < sim->start[group + 1]; ++k) {
        Limb*        limb = &sim->limb[sim->order[k]];
        const Cells  at = limb->patch;
        DpSoilPatch* patch = NULL;
        if (limb->lifts || bench->status != DP_OK) continue;
        bench->status =
            dp_terrain_acquire(sim->terrain, bench->loan, at.i0, at.i1, at.j0, at.j1, &patch);
        if (bench->status == DP_OK)
            bench->status = dp_limb_press(sim, limb, step->sample, patch, bench);
        if (bench->status == DP_OK)
            dp_terrain_commit(sim->terrain, bench->loan, 0, patch->nx, 0, patch->ny);
    }
}

// Limbs that let go, or whose soil wants to leave its patch, come to rest one after the other:
// their patches grow as far as they need.
static DpStatus settle_limbs(DpSim* sim)
{
    for (int l = 0; l < sim->gait.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (!limb->active || !(limb->lifts || limb->spills)) continue;
        if (limb->spills && !limb->lifts) continue;  // its sole holds part of it: at lift-off
        const DpStatus status = dp_limb_settle(sim, limb, &sim->bench[0]);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}

static void count(DpSim* sim)
{
    for (int l = 0; l < sim->gait.limbs; ++l) {
        const Limb* limb = &sim->limb[l];
        if (!limb->active) continue;
        sim->report.pressed += limb->firm;
        sim->report.pressed_heap += limb->loose;
        sim->report.displaced += limb->laid;
        sim->report.deepest = fmax(sim->report.deepest, limb->deepest);
        sim->report.off_ground += limb->off_ground;
    }
}

// Remember the ground under a patch as this stance met it: what the stance has covered all along is
// known, the rest is met now.
static DpStatus meet(DpSim* sim, Limb* limb)
{
    const Cells  at = limb->patch, was = limb->met_at;
    const int    nx = (int)(at.i1 - at.i0), ny = (int)(at.j1 - at.j0);
    float* const met = dp_alloc((size_t)nx * (size_t)ny, sizeof *met);
    if (!met) return DP_NO_MEMORY;
    const DpStatus status =
        dp_terrain_read(sim->terrain, DP_FIELD_HEIGHT_CHANGE, at.i0, at.j0, nx, ny, met);
    const long i0 = at.i0 > was.i0 ? at.i0 : was.i0, i1 = at.i1 < was.i1 ? at.i1 : was.i1;
    for (long j = at.j0; limb->met && j < at.j1; ++j)
        for (long i = i0; i < i1 && j >= was.j0 && j < was.j1; ++i)
            met[(j - at.j0) * nx + (i - at.i0)] =
                limb->met[(j - was.j0) * (was.i1 - was.i0) + (i - was.i0)];
    dp_free(limb->met);
    limb->met = met;
    limb->met_at = at;
    return status;
}

// what every limb does in a step, and room for it on the terrain
DpStatus dp_step_plan(DpSim* sim, int sample)
{
    sim->groups = 0;
    dp_pressing_clear(sim);
    bool any = false;
    for (int l = 0; l < sim->gait.limbs; ++l) {
        plan_limb(sim, &sim->limb[l], sample);
        any = any || sim->limb[l].active;
    }
    if (any) sim->groups = make_groups(sim);
    for (int l = 0; any && l < sim->gait.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (!limb->active || dp_cells_empty(limb->patch)) continue;
        DpStatus status = dp_terrain_touch(sim->terrain, limb->patch.i0, limb->patch.i1,
                                           limb->patch.j0, limb->patch.j1);
        if (status == DP_OK && sim->options.law == DP_CONTACT_UNIFORM && !limb->lifts)
            status = meet(sim, limb);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}

static DpStatus press_limbs(DpSim* sim, int sample)
{
    long cells = 0;
    for (int l = 0; l < sim->gait.limbs; ++l) {
        const Cells* at = &sim->limb[l].patch;
        if (sim->limb[l].active && !sim->limb[l].lifts)
            cells += (at->i1 - at->i0) * (at->j1 - at->j0);
    }
    const int  groups = sim->groups;
    const bool worth = groups >= FEW_GROUPS || (groups > 1 && cells >= MANY_CELLS);
    Step       step = {sim, sample};
    for (int b = 0; b < sim->bench_count; ++b) sim->bench[b].status = DP_OK;
    dp_parallel_for(groups, worth ? sim->bench_count : 1, work_group, &step);
    for (int b = 0; b < sim->bench_count; ++b)
        if (sim->bench[b].status != DP_OK) return sim->bench[b].status;
    return DP_OK;
}

static DpStatus step_soil(DpSim* sim, int sample)
{
    DpStatus   status = DP_OK;
    const bool planned = sim->ahead.planned;
    const bool done = dp_ahead_take(sim);
    if (!planned) status = dp_step_plan(sim, sample);
    if (status != DP_OK || sim->groups == 0) return status;
    if (!done) status = press_limbs(sim, sample);
    if (status != DP_OK) return status;
    status = settle_limbs(sim);
    count(sim);
    return status;
}

DpStatus dp_sim_run(DpSim* sim, int sample)
{
    if (!sim->limb) return DP_BAD_ARGUMENT;
    if (sample > sim->gait.times - 1) sample = sim->gait.times - 1;
    while (sim->next < sample) {
        DpStatus status = step_soil(sim, sim->next);
        if (status == DP_OK && sim->meadow.plants)
            status = dp_meadow_step(sim, sim->next, sim->next + 1 < sample);
        if (status != DP_OK) return status;
        ++sim->next;
    }
    return DP_OK;
}

DpStatus dp_sim_settle(DpSim* sim)
{
    dp_pressing_clear(sim);
    for (int l = 0; sim->limb && l < sim->gait.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (!limb->stands) continue;
        limb->stands = false;
        DpStatus status = dp_limb_settle(sim, limb, &sim->bench[0]);
        if (status == DP_OK) status = dp_meadow_settled(sim, limb);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}

void dp_sim_reach(const DpSim* sim, long reach[4])
{
    Cells        cells = {0, 0, 0, 0};
    const double rim = sim->options.heap_law == DP_HEAP_PAPER ? sim->options.rim_width : 0.0;
    const double margin = 3 * fmax(HEAP_MARGIN, rim) + slips(sim) + dp_meadow_margin(sim);
    for (int l = 0; sim->limb && l < sim->gait.limbs; ++l)
        for (int k = 0; k + 1 < sim->gait.times; ++k)
            if (dp_limb_touches(sim, &sim->limb[l], k) ||
                dp_limb_touches(sim, &sim->limb[l], k + 1))
                cells = dp_cells_join(cells, dp_limb_cells(sim, &sim->limb[l], k, margin));
    reach[0] = cells.i0, reach[1] = cells.i1, reach[2] = cells.j0, reach[3] = cells.j1;
}

DpSimReport dp_sim_report(const DpSim* sim)
{
    DpSimReport report = sim->report;
    double      pressed;
    dp_terrain_totals(sim->terrain, &report.heaped, &pressed, &report.deepest);
    return report;
}
