// sim/sim_slide.c - what soles held slides until it rests, at once or in its time. MODEL 6.4
//
//   a sole lifts ---> its print slides ---> the limb stands elsewhere ---> the print slides on by itself
//
// On planted ground a print that still slides waits while its limb stands: plants follow limbs.
#include <math.h>

#include "base/alloc.h"
#include "sim/sim_inside.h"

#define FLOW_REACH 0.1    // what slides goes so far in a soil's flow_time [m]
#define FLOW_ENDS 0.02    // .. until it is so near to its rest angle, and then at once [rad]
#define SETTLE_MARGIN 8   // cells around trodden ground when loose soil comes to rest
#define SETTLE_GROWTH 32  // cells more on each side when it wants to go further

static int sweeps_of(const DpSim* sim, const DpSoil* soil, int sample)
{
    if (!(soil->flow_time > 0.0f) || sample < 0) return sim->options.max_sweeps;
    const double a_second = FLOW_REACH / ((double)soil->flow_time * sim->grid.cell);
    const double from = floor(dp_motion_time(sim->motion, sample) * a_second);
    const double to = floor(dp_motion_time(sim->motion, sample + 1) * a_second);
    return (int)fmin(to - from, (double)sim->options.max_sweeps);
}

static const DpSoil* middle_soil(const DpSoilPatch* patch)
{
    return &patch->soils[patch->kind[patch->ny / 2 * patch->row + patch->nx / 2]];
}

int dp_slide_sweeps(const DpSim* sim, const DpSoilPatch* patch, int sample)
{
    return sweeps_of(sim, middle_soil(patch), sample);
}

// cells of a patch that begins where `at` does, in the world
static DpCellRect in_world(DpCellRect cells, DpCellRect at)
{
    return (DpCellRect){at.i0 + cells.i0, at.i0 + cells.i1, at.j0 + cells.j0, at.j0 + cells.j1};
}

// Some sweeps over what slides; when little is left to go, all that are left. held: where soles stand, NULL: nowhere.
static DpStatus let_flow(const DpSim* sim, DpSoilPatch* patch, const DpImprint* held, int sweeps,
                         WorkerScratch* scratch, DpSettled* settled)
{
    const double tolerance = sim->options.tolerance;
    DpSettled    flown = {.at_rest = true};
    if (sweeps < sim->options.max_sweeps) {
        const DpStatus status = dp_soil_stabilize(patch, held, NULL, fmax(tolerance, FLOW_ENDS),
                                                  sweeps, scratch->soil_scratch, &flown);
        if (status != DP_OK || !flown.at_rest) {
            *settled = flown;
            return status;
        }
    }
    const DpStatus status = dp_soil_stabilize(patch, held, NULL, tolerance, sim->options.max_sweeps,
                                              scratch->soil_scratch, settled);
    settled->changed = dp_cells_join(settled->changed, flown.changed);
    settled->loosened += flown.loosened;
    return status;
}

// Let a print slide in the interval from `sample`, in ever larger patches until nothing wants to leave.
// @param cells     what slides: grows, or shrinks to what has moved
// @param flows     whether it slides on afterwards
// @param loosened  grows by what came loose [m^3]
static DpStatus settle(DpSim* sim, DpCellRect* cells, bool* flows, double* loosened, int sample,
                       WorkerScratch* scratch)
{
    DpCellRect at = dp_cells_grown(*cells, SETTLE_MARGIN);
    for (;;) {
        DpSoilPatch* patch = NULL;
        DpStatus     status = dp_limb_lease(sim, scratch, at, &patch);
        if (status != DP_OK) return status;
        const bool held = dp_hold_all(sim, at, &scratch->imprint, patch->row);
        DpSettled  settled;
        const int  sweeps = dp_slide_sweeps(sim, patch, sample);
        status = let_flow(sim, patch, held ? &scratch->imprint : NULL, sweeps, scratch, &settled);
        if (status != DP_OK) return status;
        dp_terrain_commit(sim->terrain, scratch->lease, settled.changed);
        *loosened += settled.loosened;
        *flows = sweeps < sim->options.max_sweeps && !settled.at_rest;
        if (middle_soil(patch)->flow_time > 0.0f && !dp_cells_empty(settled.changed)) {
            const DpCellRect slid = in_world(settled.changed, at);  // all else lies still
            *cells = *flows ? slid : dp_cells_join(*cells, slid);
        }
        if (!settled.at_edge) return DP_OK;
        at = dp_cells_grown(at, SETTLE_GROWTH);
        if (!*flows) continue;
        *cells = at;
        return DP_OK;
    }
}

// Whether what slides since an earlier step goes no cell in the interval from `sample`.
static bool waits(const DpSim* sim, int sample)
{
    return dp_terrain_soil_count(sim->terrain) == 1 &&
           sweeps_of(sim, &dp_terrain_soils(sim->terrain)[0], sample) == 0;
}

DpStatus dp_limb_settle(DpSim* sim, Limb* limb, int sample, WorkerScratch* scratch)
{
    if (dp_cells_empty(limb->trodden)) return DP_OK;
    if (limb->left && limb->flows && waits(sim, sample)) return DP_OK;
    return settle(sim, &limb->trodden, &limb->flows, &limb->loosened, sample, scratch);
}

// ---- prints that nobody stands on any more -------------------------------------------------------

DpStatus dp_slide_leave(DpSim* sim, Limb* limb)
{
    const DpCellRect around = dp_cells_grown(limb->trodden, SETTLE_MARGIN);
    if (sim->stage.plants || dp_cells_meet(around, limb->patch)) return DP_OK;
    if (!dp_make_room(&sim->slide, (size_t)sim->slides + 1, sizeof *sim->slide))
        return DP_NO_MEMORY;
    sim->slide[sim->slides++] = limb->trodden;
    limb->trodden = (DpCellRect){0, 0, 0, 0};
    limb->flows = false;
    return DP_OK;
}

// Whether a sole stands so near that it holds what slides.
static bool is_held(const DpSim* sim, DpCellRect cells)
{
    const DpCellRect around = dp_cells_grown(cells, SETTLE_MARGIN);
    bool             held = false;
    for (int l = 0; l < sim->cast.limbs; ++l) {
        const Limb* limb = &sim->limb[l];
        held = held || (limb->active && !limb->lifts && dp_cells_meet(around, limb->patch));
    }
    return held;
}

DpStatus dp_slide_step(DpSim* sim, int sample)
{
    if (sim->slides == 0 || (sample >= 0 && waits(sim, sample))) return DP_OK;
    int      left = 0;
    DpStatus status = DP_OK;
    for (int k = 0; k < sim->slides; ++k) {
        DpCellRect cells = sim->slide[k];
        bool       flows = true;
        if (status == DP_OK && (sample < 0 || !is_held(sim, cells)))
            status = settle(sim, &cells, &flows, &sim->report.loosened, sample, &sim->scratch[0]);
        if (flows) sim->slide[left++] = cells;
    }
    sim->slides = left;
    return status;
}
