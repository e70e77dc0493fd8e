// sim/sim_release.c - ground from which soles have gone comes back, after all limbs have pressed. MODEL 6.9
#include "sim/sim_inside.h"

// cells of `patch`, which begins at (i0, j0), on which a limb stands: ring 0
static void stand(const DpSim* sim, int l, int sample, DpCellRect cells, DpImprint* imprint,
                  int row)
{
    const Pressing*  pressing = &sim->pressing[l];
    const Limb*      limb = &sim->limb[l];
    const bool       held = sample >= 0 && limb->stands && dp_limb_held(sim, limb, sample);
    const DpCellRect under = dp_cells_common(held ? limb->patch : pressing->at, cells);
    for (long j = under.j0; !dp_cells_empty(under) && j < under.j1; ++j)
        for (long i = under.i0; i < under.i1; ++i) {
            const long   at = (j - pressing->j0) * pressing->row + (i - pressing->i0);
            const size_t p = (size_t)(j - cells.j0) * (size_t)row + (size_t)(i - cells.i0);
            if (held || pressing->value[at] > 0.0f) imprint->ring[p] = 0;
        }
}

DpStatus dp_release_limb(DpSim* sim, Limb* limb, DpCellRect cells, int sample)
{
    if (!dp_terrain_springs(sim->terrain) || dp_cells_empty(cells)) return DP_OK;
    WorkerScratch* scratch = &sim->scratch[0];
    DpSoilPatch*   patch = NULL;
    const DpStatus status = dp_limb_lease(sim, scratch, cells, &patch);
    if (status != DP_OK) return status;
    for (int l = 0; l < sim->cast.limbs; ++l)
        stand(sim, l, sample, cells, &scratch->imprint, patch->row);
    const double back = dp_soil_rebound(patch, &scratch->imprint);
    limb->rebounded += back;
    dp_terrain_commit(sim->terrain, scratch->lease, dp_cells(0, 0, patch->nx, patch->ny));
    return DP_OK;
}

DpStatus dp_release_step(DpSim* sim, int sample)
{
    for (int l = 0; dp_terrain_springs(sim->terrain) && l < sim->cast.limbs; ++l) {
        Limb* limb = &sim->limb[l];
        if (!limb->active || limb->left) continue;  // what it left came back when it lifted
        const DpStatus status =
            dp_release_limb(sim, limb, limb->lifts ? limb->trodden : limb->patch, sample);
        if (status != DP_OK) return status;
    }
    return DP_OK;
}
