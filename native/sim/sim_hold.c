// sim/sim_hold.c - soil under a sole that stands: nobody lays there, and nothing slides there. MODEL 6.4
//
// A limb presses among those of its group, one after the other: who came before it stands where it has
// pressed in this step, who comes after it still stands where it pressed in the last.
#include "sim/sim_inside.h"

// cells of an imprint that begins where `cells` does, on which a limb stands, but those the imprint touches itself
static bool hold(const Pressing* pressing, DpCellRect cells, DpImprint* imprint, int row)
{
    const DpCellRect under = dp_cells_common(pressing->at, cells);
    bool             any = false;
    for (long j = under.j0; !dp_cells_empty(under) && j < under.j1; ++j)
        for (long i = under.i0; i < under.i1; ++i) {
            const long   at = (j - pressing->j0) * pressing->row + (i - pressing->i0);
            const size_t p = (size_t)(j - cells.j0) * (size_t)row + (size_t)(i - cells.i0);
            if (!(pressing->value[at] > 0.0f) || imprint->ring[p] == 0) continue;
            imprint->ring[p] = DP_RING_HELD;
            any = true;
        }
    return any;
}

bool dp_hold_group(const DpSim* sim, const Limb* limb, DpImprint* imprint, int row)
{
    bool any = false;
    for (int k = sim->start[limb->group]; k < sim->start[limb->group + 1]; ++k) {
        const int l = sim->order[k];
        if (&sim->limb[l] != limb && hold(&sim->pressing[l], limb->patch, imprint, row)) any = true;
    }
    return any;
}

bool dp_hold_all(const DpSim* sim, DpCellRect cells, DpImprint* imprint, int row)
{
    bool any = false;
    for (int l = 0; l < sim->cast.limbs; ++l)
        if (hold(&sim->pressing[l], cells, imprint, row)) any = true;
    return any;
}
