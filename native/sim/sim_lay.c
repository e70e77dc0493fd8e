// sim/sim_lay.c - room for a limb's imprint, and what it has displaced laid around it.
#include "base/alloc.h"
#include "sim/sim_inside.h"

#define BORDER_RINGS 1

DpStatus dp_limb_fit(WorkerScratch* scratch, const DpSoilPatch* patch)
{
    const size_t cells = (size_t)patch->row * (size_t)patch->ny;
    DpImprint*   imprint = &scratch->imprint;
    const bool   fits = dp_make_room(&imprint->bottom, cells, sizeof *imprint->bottom) &&
                      dp_make_room(&imprint->cover, cells, sizeof *imprint->cover) &&
                      dp_make_room(&imprint->ring, cells, sizeof *imprint->ring) &&
                      dp_make_room(&imprint->goal, cells, sizeof *imprint->goal) &&
                      dp_make_room(&scratch->met, cells, sizeof *scratch->met);
    return fits ? DP_OK : DP_NO_MEMORY;
}

void dp_limb_bare(WorkerScratch* scratch, const DpSoilPatch* patch)
{
    const size_t cells = (size_t)patch->row * (size_t)patch->ny;
    for (size_t k = 0; k < cells; ++k) scratch->imprint.ring[k] = DP_RING_FAR;
}

DpStatus dp_limb_lease(DpSim* sim, WorkerScratch* scratch, DpCellRect at, DpSoilPatch** patch)
{
    DpStatus status = dp_terrain_acquire(sim->terrain, scratch->lease, at, patch);
    if (status == DP_OK) status = dp_limb_fit(scratch, *patch);
    if (status != DP_OK) return status;
    dp_limb_bare(scratch, *patch);
    return DP_OK;
}

DpStatus dp_limb_lay(const DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                     const DpFootForce* foot, double volume, double threshold, DpVec3 cut)
{
    const DpHeapOptions heap = {sim->options.heap_law, sim->options.rim_width, threshold, cut};
    volume += limb->unlaid;
    if (volume <= 0.0) return DP_OK;
    dp_imprint_rings(&scratch->imprint, patch, BORDER_RINGS);
    (void)dp_hold_group(sim, limb, &scratch->imprint, patch->row);
    const DpStatus status = dp_soil_accumulate(patch, &scratch->imprint, foot, volume, &heap,
                                               &limb->heap_height, scratch->soil_scratch);
    const bool     laid = status == DP_OK;
    limb->unlaid = laid ? 0.0 : volume;  // no border cell in reach: it waits for one
    if (laid) limb->laid += volume;
    return status == DP_NO_GROUND ? DP_OK : status;
}
