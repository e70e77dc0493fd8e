// soil/soil_heap_paper.c - a rim of fixed width around the touched cells. TRAIL (12), SOFT22 (13).
//
// Departures
//   TRAIL (12) fills ring 1 only, a rim that gets thinner with the cell. Here the rim has a width
//   in
//     metres, and a cell's share falls linearly to zero over it. test_soil_accumulate.c,
//     paper_falls_off.
//   SOFT22 (14) lets the rim grow at a rate of its own; here what is displaced in a step is laid
//   down
//     in that step, so no soil is in the air.
#include "soil/soil_heaps.h"

// 1 at the sole, 0 at the rim's outer side
static double falloff(int ring, double cell, double width)
{
    if (ring == 1) return 1.0;
    return fmax(1.0 - (double)(ring - 1) * cell / width, 0.0);
}

DpStatus soil_heap_paper(DpSoilPatch* patch, const DpImprint* imprint, const HeapShares* shares,
                         double volume, double width)
{
    if (!(width > 0.0)) return DP_BAD_ARGUMENT;
    const double wide = fmin(ceil(width / patch->cell), 30000.0);
    const int    reach = 1 + (int)wide;
    const int    i0 = imprint->i0 > reach ? imprint->i0 - reach : 0;
    const int    j0 = imprint->j0 > reach ? imprint->j0 - reach : 0;
    const int    i1 = imprint->i1 + reach < patch->nx ? imprint->i1 + reach : patch->nx;
    const int    j1 = imprint->j1 + reach < patch->ny ? imprint->j1 + reach : patch->ny;
    const double coarse = ldexp(1.5, 52 - 30), area = patch->cell * patch->cell;

    double total = 0.0;
    for (int pass = 0; pass < 2; ++pass)  // the blended shares are normalised as a whole
        for (int j = j0; j < j1; ++j)
            for (int i = i0; i < i1; ++i) {
                const size_t p = soil_at(patch, i, j);
                const int    ring = imprint->ring[p];
                if (ring < 1 || ring > reach || !soil_is_ground(patch->rest[p])) continue;
                const double weight = soil_on_grid(
                    soil_heap_share(shares, i, j) * falloff(ring, patch->cell, width), coarse);
                if (pass == 0)
                    total += weight;
                else if (total > 0.0)
                    patch->heap[p] += (float)(weight / total * volume / area);  // TRAIL (12)
            }
    return total > 0.0 ? DP_OK : DP_NO_GROUND;
}
