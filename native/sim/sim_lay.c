// sim/sim_lay.c - what a limb has displaced is laid around it.
#include "sim/sim_inside.h"

#define BORDER_RINGS 1

DpStatus dp_limb_lay(const DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                     const DpFootForce* foot, double volume, double threshold)
{
    const DpHeapOptions heap = {sim->options.heap_law, sim->options.rim_width, threshold,
                                limb->law == DP_CONTACT_CARVE};
    volume += limb->unlaid;
    if (volume <= 0.0) return DP_OK;
    dp_imprint_rings(&scratch->imprint, patch, BORDER_RINGS);
    const DpStatus status = dp_soil_accumulate(patch, &scratch->imprint, foot, volume, &heap,
                                               &limb->heap_height, scratch->soil_scratch);
    const bool     laid = status == DP_OK;
    limb->unlaid = laid ? 0.0 : volume;  // no border cell in reach: it waits for one
    if (laid) limb->laid += volume;
    return status == DP_NO_GROUND ? DP_OK : status;
}
