// sim/sim_pressure.c - the pressure under the soles now; its sum over time is pressure_time, TRAIL (17).
#include <string.h>

#include "base/alloc.h"
#include "sim/sim_inside.h"

DpStatus dp_pressing_open(Pressing* pressing, const Limb* limb, DpSoilPatch* patch)
{
    const size_t cells = (size_t)patch->row * (size_t)patch->ny;
    if (!dp_make_room(&pressing->value, cells, sizeof *pressing->value)) return DP_NO_MEMORY;
    memset(pressing->value, 0, cells * sizeof *pressing->value);
    pressing->i0 = limb->patch.i0, pressing->j0 = limb->patch.j0;
    pressing->row = patch->row;
    patch->pressure = pressing->value;
    return DP_OK;
}

void dp_pressing_clear(DpSim* sim)
{
    for (int l = 0; sim->pressing && l < sim->cast.limbs; ++l)
        sim->pressing[l].at = (DpCellRect){0, 0, 0, 0};
}

void dp_sim_pressure(const DpSim* sim, long i0, long j0, int nx, int ny, float* out)
{
    memset(out, 0, (size_t)nx * (size_t)ny * sizeof *out);
    for (int l = 0; sim->pressing && l < sim->cast.limbs; ++l) {
        const Pressing* from = &sim->pressing[l];
        if (from->waits) continue;
        for (long j = from->at.j0; j < from->at.j1; ++j) {
            if (j < j0 || j >= j0 + ny) continue;
            const float* value = from->value + (size_t)(j - from->j0) * (size_t)from->row;
            for (long i = from->at.i0; i < from->at.i1; ++i)
                if (i >= i0 && i < i0 + nx) out[(j - j0) * nx + (i - i0)] += value[i - from->i0];
        }
    }
}

void dp_sim_soles(const DpSim* sim, DpTileVisit visit, void* context)
{
    for (int l = 0; sim->pressing && l < sim->cast.limbs; ++l) {
        const DpCellRect at = sim->pressing[l].at;
        if (dp_cells_empty(at) || sim->pressing[l].waits) continue;
        const long tx1 = dp_tile_of(at.i1 - 1), ty1 = dp_tile_of(at.j1 - 1);
        for (long ty = dp_tile_of(at.j0); ty <= ty1; ++ty)
            for (long tx = dp_tile_of(at.i0); tx <= tx1; ++tx) visit(context, tx, ty);
    }
}
