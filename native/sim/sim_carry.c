// sim/sim_carry.c - limbs take up soil that sticks, and leave it along the way. MODEL 6.16
#include "sim/sim_inside.h"

DpStatus dp_carry_fit(DpSim* sim)
{
    const int coats = dp_terrain_coats(sim->terrain, NULL);
    DpStatus  status = DP_OK;
    for (int l = 0; l < sim->cast.limbs && coats > 0 && status == DP_OK; ++l)
        status = dp_carry_create(&sim->limb[l].carry, coats, sim->grid.cell);
    return status;
}

void dp_carry_gone(const DpSim* sim, Gone* gone)
{
    for (int k = 0; k < dp_terrain_coats(sim->terrain, NULL); ++k)
        for (int l = 0; sim->limb && l < sim->cast.limbs; ++l) {
            const DpCarry* carry = sim->limb[l].carry;
            gone->carried[k] += carry ? dp_carry_volume(carry, k) : 0.0;
            gone->taken[k] += carry ? dp_carry_taken(carry, k) : 0.0;
        }
}

// Firm ground that sticks is loose from now on.
static void count(Limb* limb, const DpCarried* carried)
{
    limb->loosened += carried->firm;
}

DpStatus dp_limb_carry(DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                       int poses)
{
    if (!limb->carry) return DP_OK;
    const Pressing*  pressing = &sim->pressing[limb - sim->limb];
    const DpCarrying by = {scratch->pose, poses, limb->part_count, pressing->i0, pressing->j0};
    DpCarried        carried = {0};
    const DpStatus   status = dp_carry_step(limb->carry, patch, &scratch->imprint, &by, &carried);
    count(limb, &carried);
    return status;
}

DpStatus dp_limb_lifts(DpSim* sim, Limb* limb)
{
    const DpCellRect at = limb->carry ? dp_carry_cells(limb->carry) : (DpCellRect){0, 0, 0, 0};
    if (dp_cells_empty(at)) return DP_OK;
    WorkerScratch* scratch = &sim->scratch[0];
    DpSoilPatch*   patch = NULL;
    DpCarried      carried = {0};
    DpStatus       status = dp_terrain_acquire(sim->terrain, scratch->lease, at, &patch);
    if (status == DP_OK) status = dp_carry_lift(limb->carry, patch, at.i0, at.j0, &carried);
    if (status != DP_OK) return status;
    dp_terrain_commit(sim->terrain, scratch->lease, dp_cells(0, 0, patch->nx, patch->ny));
    count(limb, &carried);
    return DP_OK;
}

DpStatus dp_carry_lifts(DpSim* sim)
{
    DpStatus status = DP_OK;
    for (int l = 0; l < sim->cast.limbs && status == DP_OK; ++l)
        if (sim->limb[l].active && sim->limb[l].lifts) status = dp_limb_lifts(sim, &sim->limb[l]);
    return status;
}

DpSimCarried dp_sim_carried(const DpSim* sim, int coat)
{
    DpSimCarried carried = {sim->gone.taken[coat], sim->gone.carried[coat],
                            dp_terrain_coat_volume(sim->terrain, coat)};
    for (int l = 0; sim->limb && l < sim->cast.limbs; ++l) {
        const DpCarry* carry = sim->limb[l].carry;
        carried.carried += carry ? dp_carry_volume(carry, coat) : 0.0;
        carried.taken += carry ? dp_carry_taken(carry, coat) : 0.0;
    }
    return carried;
}
