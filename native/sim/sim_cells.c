// sim/sim_cells.c - world boxes as cells, and what is asked of the ground's cells for the plants.
#include "base/vec.h"
#include "sim/sim_inside.h"

DpCellRect dp_sim_cells(const DpSim* sim, double x0, double y0, double x1, double y1)
{
    const double     far = 1e9;
    const DpCellRect cells = {
        (long)dp_clamp(floor((x0 - sim->grid.x0) / sim->grid.cell - 0.5), -far, far),
        (long)dp_clamp(ceil((x1 - sim->grid.x0) / sim->grid.cell + 0.5), -far, far),
        (long)dp_clamp(floor((y0 - sim->grid.y0) / sim->grid.cell - 0.5), -far, far),
        (long)dp_clamp(ceil((y1 - sim->grid.y0) / sim->grid.cell + 0.5), -far, far)};
    return cells;
}

// the ground asks again for its cover within a box [m]
void dp_sim_cover_anew(DpSim* sim, double x0, double y0, double x1, double y1)
{
    const DpCellRect at = dp_sim_cells(sim, x0, y0, x1, y1);
    dp_terrain_refresh_cover(sim->terrain, at);
}

// where no limb is near, plants still stand and lie on the ground
double dp_sim_surface(const void* terrain, double x, double y)
{
    return dp_terrain_surface_at(terrain, x, y);
}
