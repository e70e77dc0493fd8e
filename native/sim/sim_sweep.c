// sim/sim_sweep.c - the soles that plants meet, as far as the recording alone tells: where a part
// goes in a step, and its underside at the end. So they can be had before their step comes.
#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define MAX_SPEED 25.0  // a sole that is faster was put elsewhere [m/s]
#define SINKS 0.05      // a sole may stand so much lower than it was recorded, mostly [m]

// two sets, for this step and the next
static SweptSole* swept_of(DpSim* sim, int part, int sample)
{
    return &sim->stage.swept[(sample & 1) * sim->stage.parts + part];
}

// how far the middle of a box moves to become another [m]
static DpVec3 middle_moved(const DpBox* from, const DpBox* to)
{
    return dp_vec3(0.5 * (to->x0 + to->x1 - from->x0 - from->x1),
                   0.5 * (to->y0 + to->y1 - from->y0 - from->y1),
                   0.5 * (to->z0 + to->z1 - from->z0 - from->z1));
}

SweptSole* dp_sweep_path(DpSim* sim, int part, int sample)
{
    const DpMesh*    mesh = &sim->cast.sole[part];
    const int        walker = sim->cast.limb_walker[sim->cast.part_limb[part]];
    const SweptSole* last = swept_of(sim, part, sample + 1);
    SweptSole*       swept = swept_of(sim, part, sample);
    if (swept->sample == sample) return swept;
    swept->sample = sample;
    swept->cast = false;
    swept->displacement = dp_vec3(0, 0, 0);
    if (!dp_motion_there(sim->motion, walker, sample + 1)) {  // meets nothing
        swept->from = swept->to = (DpBox){0};
        swept->jumps = true, swept->low = INFINITY, swept->ground = NAN;
        return swept;
    }
    swept->pose = dp_limb_pose(sim, part, sample, 1.0);
    swept->to = dp_imprint_box(mesh, swept->pose);
    swept->jumps = !dp_motion_there(sim->motion, walker, sample);
    if (!swept->jumps) {
        swept->from = sample > 0 && last->sample == sample - 1
                          ? last->to
                          : dp_imprint_box(mesh, dp_limb_pose(sim, part, sample, 0.0));
        swept->displacement = middle_moved(&swept->from, &swept->to);
        swept->jumps = dp_length(swept->displacement) > MAX_SPEED * dp_sim_interval(sim, sample);
    }
    if (swept->jumps) swept->from = swept->to, swept->displacement = dp_vec3(0, 0, 0);
    const DpBox *from = &swept->from, *to = &swept->to;
    swept->low = fmin(from->z0, to->z0);
    const double xy[2] = {0.25 * (from->x0 + from->x1 + to->x0 + to->x1),
                          0.25 * (from->y0 + from->y1 + to->y0 + to->y1)};
    dp_terrain_base_height(sim->terrain, 1, xy, &swept->ground);
    swept->ground -= dp_terrain_datum(sim->terrain);
    return swept;
}

DpStatus dp_sweep_cast(DpSim* sim, SweptSole* swept, int part, DpImprintScratch* scratch)
{
    if (swept->cast) return DP_OK;
    const DpBox      to = swept->to;
    const DpCellRect at = dp_sim_cells(sim, to.x0, to.y0, to.x1, to.y1);
    const int        nx = (int)(at.i1 - at.i0), ny = (int)(at.j1 - at.j0);
    const size_t     cells = (size_t)nx * (size_t)ny;
    DpImprint*       own = &swept->imprint;
    if (!dp_make_room(&own->bottom, cells, sizeof *own->bottom) ||
        !dp_make_room(&own->cover, cells, sizeof *own->cover))
        return DP_NO_MEMORY;
    const DpSoilPatch patch = {.nx = nx,
                               .ny = ny,
                               .row = nx,
                               .cell = sim->grid.cell,
                               .x0 = dp_grid_x(&sim->grid, at.i0),
                               .y0 = dp_grid_y(&sim->grid, at.j0)};
    swept->at = at;
    const DpStatus status = dp_imprint_foot(&swept->imprint, &patch, &sim->cast.sole[part],
                                            &swept->pose, 1, 1, scratch);
    swept->cast = status == DP_OK;
    return status;
}

void dp_sweep_ahead(DpSim* sim, int part, int sample, DpImprintScratch* scratch)
{
    SweptSole* swept = dp_sweep_path(sim, part, sample);
    if (swept->low - SINKS < swept->ground + sim->stage.extent)
        (void)dp_sweep_cast(sim, swept, part, scratch);  // in its turn it says what is wrong
}
