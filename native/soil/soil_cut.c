// soil/soil_cut.c - what is taken off a column by a body or a sole that goes there, and what becomes of it. MODEL 6.11, 6.18
#include "soil/soil_law.h"

#define CUT_GRID ldexp(1.5, 52 - 46)  // for sums of heights: steps of 1.4e-14 m, up to 128 m

Cut dp_cut_cell(DpSoilPatch* patch, size_t p, double loose, double firm, double cut)
{
    const float c = patch->compression[p], b = patch->heap[p];
    patch->heap[p] = (float)((double)b - loose);
    patch->compression[p] = (float)((double)c + firm);

    // the ledger counts what the float grids really hold
    const double out_of_heap = (double)b - (double)patch->heap[p];
    const double out_of_firm = (double)patch->compression[p] - (double)c;
    const double elastic = patch->spring ? dp_soil_spring_press(patch, p, (double)c) : 0.0;
    if (patch->spring && cut > 0.5) patch->spring[p] = 0.0f;  // what was cut off does not spring
    const double lasting = out_of_firm - elastic;
    const double nu = dp_law_poisson(patch, p, (double)c, (double)patch->compression[p]);
    const double loose_cut = soil_on_grid(cut * out_of_heap, CUT_GRID);
    const double firm_cut = soil_on_grid(cut * lasting, CUT_GRID);
    const double loose_pressed = soil_on_grid(out_of_heap - loose_cut, CUT_GRID);
    const double firm_pressed = soil_on_grid(lasting - firm_cut, CUT_GRID);
    return (Cut){.firm = firm_cut,
                 .loose = loose_cut,
                 .firm_pressed = firm_pressed,
                 .loose_pressed = loose_pressed,
                 .elastic = soil_on_grid(elastic, CUT_GRID),
                 .displaced = soil_on_grid(2.0 * nu * firm_pressed, CUT_GRID) +
                              loose_pressed};  // SOFT22 (12)
}
