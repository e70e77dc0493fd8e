// soil/soil_rebound.c - what comes back when a sole lifts. Ours; MODEL 6.9
//
// A patch keeps in `spring` how a cell was pressed: -(c at its deepest) while a sole stands on it, afterwards what
// has come back of that. What is pressed again up to there displaces nothing anew. What falls from a wall takes of what
// came back with it, and was pressed by nobody.
#include "soil/soil_inside.h"

// how deep a cell was when it was pressed deepest [m]; c: how deep it is
static double deepest_of(const DpSoilPatch* patch, size_t p, double c)
{
    const double spring = (double)patch->spring[p];
    return spring < 0.0 ? -spring : c + spring;
}

double dp_soil_spring_press(DpSoilPatch* patch, size_t p, double before)
{
    const double now = (double)patch->compression[p], deepest = deepest_of(patch, p, before);
    patch->spring[p] = -(float)soil_max(now, deepest);
    return soil_max(soil_min(now, deepest) - before, 0.0);  // MODEL 6.9
}

double dp_soil_spring_share(const DpSoilPatch* patch, size_t p)
{
    const double share = (double)patch->soils[patch->kind[p]].rebound;
    const double uneven = patch->uneven ? (double)patch->uneven[p] : 0.0;
    return soil_min(soil_max(share * (1.0 + SPRING_ROUGH * uneven), 0.0), MAX_SPRING);
}

void dp_soil_spring_fell(DpSoilPatch* patch, size_t p, double fell)
{
    const double spring = (double)patch->spring[p];
    if (spring > 0.0) patch->spring[p] = (float)soil_max(spring - fell, 0.0);
}

void dp_soil_spring_trodden(DpSoilPatch* patch)
{
    for (int j = 0; patch->spring && j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const size_t p = soil_at(patch, i, j);
            const double share = dp_soil_spring_share(patch, p);
            patch->spring[p] = (float)((double)patch->compression[p] * share / (1.0 - share));
        }
}

double dp_soil_rebound(DpSoilPatch* patch, const DpImprint* imprint)
{
    double back = 0.0;
    for (int j = 0; patch->spring && j < patch->ny; ++j)
        for (int i = 0; i < patch->nx; ++i) {
            const size_t p = soil_at(patch, i, j);
            if (!(patch->spring[p] < 0.0f) || (imprint && imprint->ring[p] == 0)) continue;
            const float  c = patch->compression[p];
            const double deepest = -(double)patch->spring[p];
            const double rises = dp_soil_spring_share(patch, p) * deepest;  // MODEL 6.9
            const double stays = soil_max(deepest - rises, (double)c - rises);
            patch->compression[p] = (float)soil_min((double)c, stays);
            patch->spring[p] = (float)soil_max(deepest - (double)patch->compression[p], 0.0);
            back += (double)c - (double)patch->compression[p];
        }
    return back * patch->cell * patch->cell;
}
