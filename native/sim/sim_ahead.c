// sim/sim_ahead.c - the next step's soil, while plants still move.
//
//   soil k ---> plants k ---> soil k + 1 ---> ..      in turn
//   soil k ---> plants k                              at once: soil k + 1 on loans, then laid down
//          `--> soil k + 1 on loans
//
// What plants change of the soil is its cover, and only when stems break. So the limbs of the next
// step press on loans, as if nothing will break. If something did on the cells of any loan, what was
// worked out is dropped and the step is made in its turn: the result is the same to the bit.
#include "sim/sim_inside.h"

// Limbs whose patches meet have to press one after the other: not ahead.
static int pressing(DpSim* sim, Limb** limb)
{
    int count = 0;
    for (int g = 0; g < sim->groups; ++g) {
        int in_group = 0;
        for (int k = sim->start[g]; k < sim->start[g + 1]; ++k) {
            Limb* one = &sim->limb[sim->order[k]];
            if (one->lifts) continue;
            if (++in_group > 1 || count == AHEAD_MOST) return 0;
            limb[count++] = one;
        }
    }
    return count;
}

DpStatus dp_ahead_open(DpSim* sim, int sample, int* limbs)
{
    Ahead* ahead = &sim->ahead;
    *limbs = ahead->count = 0;
    const DpStatus planned = dp_step_plan(sim, sample);
    if (planned != DP_OK) return planned;
    ahead->planned = true;
    const int count = pressing(sim, ahead->limb);
    for (int n = 0; n < count; ++n) {
        const Cells    at = ahead->limb[n]->patch;
        const DpStatus status = dp_terrain_acquire(sim->terrain, ahead->loan[n], at.i0, at.i1,
                                                   at.j0, at.j1, &ahead->patch[n]);
        if (status != DP_OK) return status;
        ahead->was[n] = *ahead->limb[n];
        ahead->status[n] = DP_OK;
    }
    *limbs = ahead->count = count;
    return DP_OK;
}

void dp_ahead_press(DpSim* sim, int sample, int index, Bench* bench)
{
    Ahead* ahead = &sim->ahead;
    ahead->status[index] =
        dp_limb_press(sim, ahead->limb[index], sample, ahead->patch[index], bench);
}

// the limbs are as they were planned
static void drop(Ahead* ahead)
{
    for (int n = 0; n < ahead->count; ++n) *ahead->limb[n] = ahead->was[n];
    ahead->count = 0;
}

void dp_ahead_worn(DpSim* sim, double x0, double y0, double x1, double y1)
{
    Ahead*      ahead = &sim->ahead;
    const Cells worn = dp_sim_cells(sim, x0, y0, x1, y1);
    bool        meets = false;
    for (int n = 0; n < ahead->count; ++n)
        meets = meets || dp_cells_meet(worn, ahead->limb[n]->patch);
    if (meets) drop(ahead);
}

bool dp_ahead_take(DpSim* sim)
{
    Ahead* ahead = &sim->ahead;
    ahead->planned = false;
    for (int n = 0; n < ahead->count; ++n)
        if (ahead->status[n] != DP_OK) drop(ahead);  // in its turn it says what is wrong
    const int count = ahead->count;
    for (int n = 0; n < count; ++n)
        dp_terrain_commit(sim->terrain, ahead->loan[n], 0, ahead->patch[n]->nx, 0,
                          ahead->patch[n]->ny);
    ahead->count = 0;
    return count > 0;
}
