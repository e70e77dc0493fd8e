// soil/soil_press.c - a cell is lowered towards its target, loose soil first. TRAIL (10) (17), SOFT22 (11) (12), MODEL 6.2
#include "soil/soil_law.h"

#define PRESS_GRID \
    ldexp(1.5, 52 - 46)  // for sums of pressed depths: steps of 1.4e-14 m, up to 128 m

// the share of its target to which a soil yields in dt seconds
static double yields(const DpSoil* soil, double dt)
{
    return soil_min(dt / (double)soil->settle_time, 1.0);  // SOFT22 (11)
}

static inline void press_cell(DpSoilPatch* patch, size_t p, Target target, double share, double dt,
                              DpPressed* pressed)
{
    const DpSoil* soil = &patch->soils[patch->kind[p]];
    const float   c = patch->compression[p], b = patch->heap[p];
    const double  goal = target.share * target.depth;  // TRAIL (10)
    const double  rate = goal * share;
    const double  press =
        soil_max(soil_min(rate, goal - ((double)c - (double)b)), 0.0);  // not past it
    const double loose = soil_min(press, (double)b);
    patch->heap[p] = (float)((double)b - loose);
    patch->compression[p] = (float)((double)c + (press - loose));
    if (patch->pressure_time)
        patch->pressure_time[p] += (float)(target.stress * target.share * dt);  // TRAIL (17)
    if (patch->pressure) patch->pressure[p] = (float)(target.stress * target.share);

    // the ledger counts what the float grids really hold
    const double out_of_heap = (double)b - (double)patch->heap[p];
    const double out_of_firm = (double)patch->compression[p] - (double)c;
    const double elastic = patch->spring ? dp_soil_spring_press(patch, p, (double)c) : 0.0;
    const double lasting = out_of_firm - elastic;
    const double moved = out_of_heap + lasting;
    pressed->loose += soil_on_grid(out_of_heap, PRESS_GRID);
    pressed->firm += soil_on_grid(lasting, PRESS_GRID);
    if (elastic > 0.0) pressed->elastic += soil_on_grid(elastic, PRESS_GRID);
    const double nu = patch->layers
                          ? dp_law_poisson(patch, p, (double)c, (double)patch->compression[p])
                          : (double)soil->poisson_ratio;
    pressed->displaced += soil_on_grid(2.0 * nu * moved, PRESS_GRID);  // SOFT22 (12)
    pressed->deepest = soil_max(pressed->deepest, (double)patch->compression[p]);
}

void dp_press_cell(DpSoilPatch* patch, size_t p, Target target, double dt, DpPressed* pressed)
{
    press_cell(patch, p, target, yields(&patch->soils[patch->kind[p]], dt), dt, pressed);
}

void dp_press_cells(DpSoilPatch* patch, const Targets* targets, double dt, DpPressed* pressed)
{
    DpPressed     sum = *pressed;  // of its own, so that no cell waits for memory
    const DpSoil* soil = NULL;
    double        share = 0.0;
    for (int k = 0; k < targets->count; ++k) {
        const size_t  p = targets->cell[k];
        const DpSoil* under = &patch->soils[patch->kind[p]];
        if (under != soil) soil = under, share = yields(soil, dt);
        press_cell(patch, p, (Target){targets->depth[k], targets->stress[k], targets->share[k]},
                   share, dt, &sum);
    }
    *pressed = sum;
}
