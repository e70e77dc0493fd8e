// sim/sim_speculate.c - the next step's soil, while plants still move.
//
//   soil k ---> plants k ---> soil k + 1 ---> ..      in turn
//   soil k ---> plants k                              at once: soil k + 1 on leases, then laid down
//          `--> soil k + 1 on leases
//
// What plants change of the soil is its cover, and only when stems break. So the limbs of the next
// step press on leases, as if nothing will break. If something did on the cells of any lease, what was
// worked out is dropped and the step is made in its turn: the result is the same to the bit.
#include "sim/sim_inside.h"

// Limbs whose patches meet have to press one after the other: not ahead. Nor what soil sticks to, since what it holds
// would have to be taken back.
static int pressing(DpSim* sim, Limb** limb)
{
    int count = 0;
    if (dp_terrain_coats(sim->terrain, NULL) > 0) return 0;
    for (int g = 0; g < sim->groups; ++g) {
        int in_group = 0;
        for (int k = sim->start[g]; k < sim->start[g + 1]; ++k) {
            Limb* one = &sim->limb[sim->order[k]];
            if (one->lifts) continue;
            if (++in_group > 1 || count == MAX_SPECULATED) return 0;
            limb[count++] = one;
        }
    }
    return count;
}

DpStatus dp_speculate_open(DpSim* sim, int sample, int* limbs)
{
    Speculation* speculation = &sim->speculation;
    *limbs = speculation->count = 0;
    const DpStatus planned = dp_step_plan(sim, sample);
    if (planned != DP_OK) return planned;
    speculation->planned = true;
    const int count = pressing(sim, speculation->limb);
    for (int n = 0; n < count; ++n) {
        const DpCellRect at = speculation->limb[n]->patch;
        const DpStatus   status =
            dp_terrain_acquire(sim->terrain, speculation->lease[n], at, &speculation->patch[n]);
        if (status != DP_OK) return status;
        speculation->was[n] = *speculation->limb[n];
        speculation->status[n] = DP_OK;
    }
    *limbs = speculation->count = count;
    return DP_OK;
}

void dp_speculate_press(DpSim* sim, int sample, int index, WorkerScratch* scratch)
{
    Speculation* speculation = &sim->speculation;
    speculation->status[index] =
        dp_limb_press(sim, speculation->limb[index], sample, speculation->patch[index], scratch);
}

// the limbs are as they were planned
static void drop(Speculation* speculation)
{
    for (int n = 0; n < speculation->count; ++n) *speculation->limb[n] = speculation->was[n];
    speculation->count = 0;
}

void dp_speculate_worn(DpSim* sim, double x0, double y0, double x1, double y1)
{
    Speculation*     speculation = &sim->speculation;
    const DpCellRect worn = dp_sim_cells(sim, x0, y0, x1, y1);
    bool             meets = false;
    for (int n = 0; n < speculation->count; ++n)
        meets = meets || dp_cells_meet(worn, speculation->limb[n]->patch);
    if (meets) drop(speculation);
}

bool dp_speculate_take(DpSim* sim)
{
    Speculation* speculation = &sim->speculation;
    speculation->planned = false;
    for (int n = 0; n < speculation->count; ++n)
        if (speculation->status[n] != DP_OK)
            drop(speculation);  // in its turn it says what is wrong
    const int count = speculation->count;
    for (int n = 0; n < count; ++n)
        dp_terrain_commit(sim->terrain, speculation->lease[n],
                          dp_cells(0, 0, speculation->patch[n]->nx, speculation->patch[n]->ny));
    speculation->count = 0;
    return count > 0;
}
