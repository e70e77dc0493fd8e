// sim/sim_step.c - all limbs, interval by interval. TRAIL 4.2: where the rooms meet.
//
// Limbs whose patches meet form a group and are worked on in the recording's order by one thread;
// groups do not touch each other, so they may run at once and the result stays the same. On planted
// ground the next step's soil is worked out while the plants still move: sim_speculate.c.
#include <math.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "sim/sim_inside.h"

#define FEW_GROUPS 4     // with fewer, starting threads costs more than it gives ..
#define MANY_CELLS 8000  // .. unless their patches are as large as this

typedef struct Step
{
    DpSim* sim;
    int    sample;
} Step;

static void work_group(void* context, int group, int worker)
{
    const Step*    step = context;
    DpSim*         sim = step->sim;
    WorkerScratch* scratch = &sim->scratch[worker];
    for (int k = sim->start[group]; k < sim->start[group + 1]; ++k) {
        Limb*            limb = &sim->limb[sim->order[k]];
        const DpCellRect at = limb->patch;
        DpSoilPatch*     patch = NULL;
        if (limb->lifts || scratch->status != DP_OK) continue;
        scratch->status = dp_terrain_acquire(sim->terrain, scratch->lease, at, &patch);
        if (scratch->status == DP_OK)
            scratch->status = dp_limb_press(sim, limb, step->sample, patch, scratch);
        if (scratch->status == DP_OK)
            dp_terrain_commit(sim->terrain, scratch->lease, dp_cells(0, 0, patch->nx, patch->ny));
    }
}

// Limbs that let go, or whose soil wants to leave its patch, come to rest one after the other:
// their patches grow as far as they need.
static DpStatus settle_limbs(DpSim* sim, int sample)
{
    for (int l = 0; l < sim->cast.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (limb->active && !limb->lifts && limb->law == DP_CONTACT_CARVE) {
            const DpStatus status = dp_carve_behind(sim, limb);
            if (status != DP_OK) return status;
        }
        if (!limb->active || !(limb->lifts || limb->spills)) continue;
        if (limb->spills && !limb->lifts) continue;  // its sole holds part of it: at lift-off
        const DpStatus status = dp_limb_settle(sim, limb, sample, &sim->scratch[0]);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}

static void count(DpSim* sim)
{
    for (int l = 0; l < sim->cast.limbs; ++l) {
        const Limb* limb = &sim->limb[l];
        if (!limb->active) continue;
        sim->report.pressed += limb->firm;
        sim->report.pressed_heap += limb->loose;
        sim->report.displaced += limb->laid;
        sim->report.rebounded += limb->rebounded;
        sim->report.loosened += limb->loosened;
        sim->report.deepest = fmax(sim->report.deepest, limb->deepest);
        sim->report.off_ground += limb->off_ground;
    }
}

static DpStatus press_limbs(DpSim* sim, int sample)
{
    long cells = 0;
    for (int l = 0; l < sim->cast.limbs; ++l) {
        const DpCellRect* at = &sim->limb[l].patch;
        if (sim->limb[l].active && !sim->limb[l].lifts)
            cells += (at->i1 - at->i0) * (at->j1 - at->j0);
    }
    const int  groups = sim->groups;
    const bool worth = groups >= FEW_GROUPS || (groups > 1 && cells >= MANY_CELLS);
    Step       step = {sim, sample};
    for (int b = 0; b < sim->worker_count; ++b) sim->scratch[b].status = DP_OK;
    dp_parallel_for(groups, worth ? sim->worker_count : 1, work_group, &step);
    for (int b = 0; b < sim->worker_count; ++b)
        if (sim->scratch[b].status != DP_OK) return sim->scratch[b].status;
    return DP_OK;
}

static DpStatus step_soil(DpSim* sim, int sample)
{
    DpStatus   status = DP_OK;
    const bool planned = sim->speculation.planned;
    const bool done = dp_speculate_take(sim);
    if (!planned) status = dp_step_plan(sim, sample);
    if (status == DP_OK && sim->groups == 0) status = dp_slide_step(sim, sample);
    if (status != DP_OK || sim->groups == 0) return status;
    if (!done) status = press_limbs(sim, sample);
    if (status != DP_OK) return status;
    status = dp_carry_lifts(sim);
    if (status == DP_OK) status = dp_release_step(sim, sample);
    if (status == DP_OK) status = settle_limbs(sim, sample);
    if (status == DP_OK) status = dp_slide_step(sim, sample);
    count(sim);
    return status;
}

DpStatus dp_sim_run(DpSim* sim, int sample)
{
    if (!sim->motion) return DP_BAD_ARGUMENT;
    if (sample > dp_motion_samples(sim->motion) - 1) sample = dp_motion_samples(sim->motion) - 1;
    while (sim->next < sample) {
        DpStatus status = step_soil(sim, sim->next);
        if (status == DP_OK) status = dp_spray_step(sim, sim->next);
        if (status == DP_OK && sim->stage.plants)
            status = dp_stage_step(sim, sim->next, sim->next + 1 < sample);
        if (status != DP_OK) return status;
        dp_motion_forget(sim->motion, ++sim->next);
        dp_memory_ease(DP_EASE_NOW);
    }
    return DP_OK;
}

DpStatus dp_sim_settle(DpSim* sim)
{
    dp_pressing_clear(sim);
    const DpStatus landed = dp_spray_land(sim);
    if (landed != DP_OK) return landed;
    const DpStatus slid = dp_slide_step(sim, -1);
    if (slid != DP_OK) return slid;
    for (int l = 0; sim->limb && l < sim->cast.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (!limb->stands && !limb->flows) continue;
        limb->stands = limb->flows = false;
        limb->loosened = limb->rebounded = 0.0;
        DpStatus status = dp_limb_lifts(sim, limb);
        if (status == DP_OK) status = dp_release_limb(sim, limb, limb->trodden, -1);
        if (status == DP_OK) status = dp_limb_settle(sim, limb, -1, &sim->scratch[0]);
        sim->report.loosened += limb->loosened;
        sim->report.rebounded += limb->rebounded;
        if (status == DP_OK) status = dp_stage_settled(sim, limb);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}

DpSimReport dp_sim_report(const DpSim* sim)
{
    DpSimReport report = sim->report;
    double      pressed;
    dp_terrain_totals(sim->terrain, &report.heaped, &pressed, &report.deepest);
    dp_spray_report(&sim->spray, &report);
    return report;
}
