// sim/sim_press.c - one limb's step in the paper's order: imprint, compress, accumulate, stabilize.
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define SLIDING_SWEEPS \
    16  // of one step: slides take time; all comes to rest when the foot has left

// the ground as the limb's stance met it, in the patch's rows
static const float* met_on(const DpSoilPatch* patch, const Limb* limb, WorkerScratch* scratch)
{
    if (!limb->met) return NULL;
    const size_t nx = (size_t)patch->nx;
    for (size_t j = 0; j < (size_t)patch->ny; ++j)
        memcpy(scratch->met + j * (size_t)patch->row, limb->met + j * nx, nx * sizeof(float));
    return scratch->met;
}

// The cell of the patch's ground that is nearest to a point (u, v) [cells]; (0, 0) where it has none.
static size_t nearest_ground(const DpSoilPatch* patch, double u, double v)
{
    size_t found = 0;
    double least = INFINITY;
    for (int j = 0; j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const size_t n = (size_t)j * (size_t)patch->row + (size_t)i;
            const double away = (i - u) * (i - u) + (j - v) * (j - v);
            if (!(away < least) || isnan(patch->base_height[n])) continue;
            found = n;
            least = away;
        }
    return found;
}

// The soil under a point of the patch, beside an edge that of the nearest ground; the first soil where
// the point lies outside.
static const DpSoil* soil_under(const DpSoilPatch* patch, DpVec3 point)
{
    const double u = (point.x - patch->x0) / patch->cell, v = (point.y - patch->y0) / patch->cell;
    const long   i = lround(u), j = lround(v);
    if (i < 0 || i >= patch->nx || j < 0 || j >= patch->ny) return &patch->soils[0];
    size_t at = (size_t)j * (size_t)patch->row + (size_t)i;
    if (patch->soil_count > 1 && isnan(patch->base_height[at])) at = nearest_ground(patch, u, v);
    return &patch->soils[patch->kind[at]];
}

// The sole slips as far as the soil has to shear to carry the push along the ground, in the time it
// takes to yield, and never back: what pushes the other way shears it anew. A foot that only begins
// to carry its body shears little of what it will press.
// @param body  the weight of the whole body [N]
static void slip(Limb* limb, const DpSoil* soil, const DpFootForce* foot, double body, double dt)
{
    const double weight = -dp_dot(foot->force, foot->normal);
    const DpVec3 push = dp_add(foot->force, dp_scale(foot->normal, weight));
    const double along = dp_length(push);
    const double wanted = dp_soil_slip(soil, along, weight);
    if (!(wanted > 0.0)) return;
    const DpVec3 direction = dp_scale(push, 1.0 / along);
    const double held = fmax(dp_dot(limb->sheared, direction), 0.0);
    if (!(wanted > held)) return;
    const double bears = fmin(weight / body, 1.0);
    const double more = (wanted - held) * -expm1(-bears * dt / (double)soil->settle_time);
    const DpVec3 slipped = dp_add(limb->slip, dp_scale(direction, more));
    limb->sheared = dp_scale(direction, held + more);
    if (dp_length(slipped) <= DP_MAX_SLIP) limb->slip = slipped;
}

// One of so many sub-steps of an interval.
typedef struct SubStep
{
    int sample, number, count;
} SubStep;

// One sub-step: the sole as it stands in its middle presses for dt.
static DpStatus press(DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                      SubStep step, double dt)
{
    const int    sample = step.sample;
    const double w = (step.number + 0.5) / step.count;
    const DpVec3 before = limb->slip;
    DpFootForce  foot = dp_limb_force(sim, limb, sample, w);
    if (foot.force.z >= 0.0) return DP_OK;
    foot.normal =
        dp_terrain_normal(sim->terrain, foot.point.x, foot.point.y, sim->options.normal_radius);

    slip(limb, soil_under(patch, foot.point), &foot, sim->cast.mass[limb->walker] * DP_GRAVITY, dt);
    foot.point = dp_add(foot.point, limb->slip);
    for (int p = 0; p < limb->part_count; ++p) {
        scratch->sole[p] = sim->cast.sole[limb->part[p]];
        scratch->pose[p] = dp_limb_pose(sim, limb->part[p], sample, w);
        scratch->pose[p].at = dp_add(scratch->pose[p].at, limb->slip);
    }
    DpStatus status = dp_imprint_foot(&scratch->imprint, patch, scratch->sole, scratch->pose,
                                      limb->part_count, limb->samples, scratch->imprint_scratch);
    if (status != DP_OK) return status;

    DpSlide       slide;
    const DpSoil* soil = soil_under(patch, foot.point);
    const bool    slides =
        dp_limb_slides(sim, limb, patch, sample, (double)step.number / step.count,
                       (step.number + 1.0) / step.count, dp_sub(limb->slip, before), &slide) &&
        dp_limb_shears(limb, patch, soil, foot.point, &slide);
    DpPressed pressed;
    scratch->imprint.slide = slides ? &slide : NULL;
    status = dp_soil_compress(patch, &scratch->imprint, &foot, limb->law, dt, &pressed);
    scratch->imprint.slide = NULL;
    if (slides) limb->owed = slide.owed;
    if (status != DP_OK) return status;
    if (pressed.area <= 0.0) {
        limb->off_ground =
            scratch->imprint.i0 < scratch->imprint.i1;  // not if no cell saw the sole
        return DP_OK;
    }
    limb->sink = pressed.sink;
    dp_plough_count(limb, &pressed);
    limb->firm += pressed.firm;
    limb->rebounded -= pressed.elastic;
    limb->loose += pressed.loose;
    limb->deepest = fmax(limb->deepest, pressed.deepest);
    status = dp_limb_carry(sim, limb, patch, scratch, limb->part_count);
    if (status != DP_OK) return status;

    const double half_weight = 0.5 * sim->cast.mass[limb->walker] * DP_GRAVITY;  // TRAIL (13)
    const double volume = pressed.displaced + pressed.cut_firm + pressed.cut_loose;
    const DpVec3 cut = volume > 0.0 ? dp_vec3(pressed.cut_x / volume, pressed.cut_y / volume, 0.0)
                                    : dp_vec3(0.0, 0.0, 0.0);
    return dp_limb_lay(sim, limb, patch, scratch, &foot, volume,
                       soil->push_threshold > 0.0f ? (double)soil->push_threshold : half_weight,
                       cut);
}

// The steps of a sole in an interval; the last leaves its imprint.
static DpStatus press_in_turn(DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                              int sample)
{
    const int    substeps = dp_limb_substeps(sim, limb, sample);
    const double dt = (dp_sim_interval(sim, sample)) / substeps;
    DpStatus     status = DP_OK;
    scratch->imprint.met = met_on(patch, limb, scratch);
    for (int u = 0; u < substeps && status == DP_OK; ++u) {
        status = dp_pressing_open(&sim->pressing[limb - sim->limb], limb, patch);
        if (status == DP_OK)
            status = press(sim, limb, patch, scratch, (SubStep){sample, u, substeps}, dt);
    }
    return status;
}

DpStatus dp_limb_press(DpSim* sim, Limb* limb, int sample, DpSoilPatch* patch,
                       WorkerScratch* scratch)
{
    Pressing* pressing = &sim->pressing[limb - sim->limb];
    pressing->waits = dp_limb_held(sim, limb, sample);
    if (pressing->waits) return DP_OK;
    DpStatus status = dp_limb_fit(scratch, patch);
    if (status != DP_OK) return status;

    scratch->imprint.i0 = scratch->imprint.i1 = 0;
    status = limb->law == DP_CONTACT_CARVE ? dp_limb_carve(sim, limb, patch, scratch, sample)
                                           : press_in_turn(sim, limb, patch, scratch, sample);
    if (status != DP_OK) return status;

    DpSettled  settled = {.at_rest = true};
    const bool stands_here = scratch->imprint.i0 < scratch->imprint.i1;
    pressing->at = (DpCellRect){0, 0, 0, 0};
    if (stands_here)
        pressing->at =
            (DpCellRect){pressing->i0 + scratch->imprint.i0, pressing->i0 + scratch->imprint.i1,
                         pressing->j0 + scratch->imprint.j0, pressing->j0 + scratch->imprint.j1};
    else
        dp_limb_bare(scratch, patch);
    const bool holds = dp_hold_group(sim, limb, &scratch->imprint, patch->row) || stands_here;
    const bool paper_heap = sim->options.heap_law == DP_HEAP_PAPER;
    const int  sweeps = paper_heap || sim->options.max_sweeps < SLIDING_SWEEPS
                            ? sim->options.max_sweeps
                            : SLIDING_SWEEPS;
    const int  flow = dp_slide_sweeps(sim, patch, sample);
    if (flow > 0)
        status =
            dp_soil_stabilize(patch, holds ? &scratch->imprint : NULL, NULL, sim->options.tolerance,
                              flow < sweeps ? flow : sweeps, scratch->soil_scratch, &settled);
    if (status != DP_OK) return status;
    limb->spills = settled.at_edge;
    limb->loosened += settled.loosened;
    limb->trodden = dp_cells_join(limb->trodden, limb->patch);
    return DP_OK;
}
