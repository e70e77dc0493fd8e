// sim/sim_shadow.c - the soles that plants meet, as far as the recording alone tells: where a part
// goes in a step, and its underside at the end. So they can be had before their step comes.
#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#define FASTEST 25.0  // a sole that is faster was put elsewhere [m/s]
#define SINKS 0.05    // a sole may stand so much lower than it was recorded, mostly [m]

// two sets, for this step and the next
static Shadow* shadow_of(DpSim* sim, int part, int sample)
{
    return &sim->meadow.shadow[(sample & 1) * sim->meadow.parts + part];
}

Shadow* dp_shadow_way(DpSim* sim, int part, int sample)
{
    const DpMesh* mesh = &sim->sole[part];
    const Shadow* last = shadow_of(sim, part, sample + 1);
    Shadow*       shadow = shadow_of(sim, part, sample);
    const double  dt = sim->time[sample + 1] - sim->time[sample];
    if (shadow->sample == sample) return shadow;
    shadow->sample = sample;
    shadow->cast = false;
    shadow->pose = dp_limb_pose(sim, part, sample, 1.0);
    shadow->to = dp_imprint_box(mesh, shadow->pose);
    shadow->from = sample > 0 && last->sample == sample - 1
                       ? last->to
                       : dp_imprint_box(mesh, dp_limb_pose(sim, part, sample, 0.0));
    const DpBox *from = &shadow->from, *to = &shadow->to;
    shadow->way = dp_vec3(0.5 * (to->x0 + to->x1 - from->x0 - from->x1),
                          0.5 * (to->y0 + to->y1 - from->y0 - from->y1),
                          0.5 * (to->z0 + to->z1 - from->z0 - from->z1));
    shadow->jumps = dp_length(shadow->way) > FASTEST * dt;
    if (shadow->jumps) shadow->from = shadow->to, shadow->way = dp_vec3(0, 0, 0);
    shadow->low = fmin(from->z0, to->z0);
    const double xy[2] = {0.25 * (from->x0 + from->x1 + to->x0 + to->x1),
                          0.25 * (from->y0 + from->y1 + to->y0 + to->y1)};
    dp_terrain_base_height(sim->terrain, 1, xy, &shadow->ground);
    shadow->ground -= dp_terrain_datum(sim->terrain);
    return shadow;
}

static bool make_room(Shadow* shadow, size_t cells)
{
    DpImprint* imprint = &shadow->imprint;
    if (cells <= shadow->room) return true;
    dp_free(imprint->bottom), dp_free(imprint->cover);
    shadow->room = cells + cells / 4;
    imprint->bottom = dp_alloc(shadow->room, sizeof(float));
    imprint->cover = dp_alloc(shadow->room, sizeof(float));
    if (imprint->bottom && imprint->cover) return true;
    shadow->room = 0;
    return false;
}

DpStatus dp_shadow_cast(DpSim* sim, Shadow* shadow, int part, DpImprintScratch* scratch)
{
    if (shadow->cast) return DP_OK;
    const DpBox  to = shadow->to;
    const Cells  at = dp_sim_cells(sim, to.x0, to.y0, to.x1, to.y1);
    const int    nx = (int)(at.i1 - at.i0), ny = (int)(at.j1 - at.j0);
    const size_t cells = (size_t)nx * (size_t)ny;
    if (!make_room(shadow, cells)) return DP_NO_MEMORY;
    const DpSoilPatch patch = {.nx = nx,
                               .ny = ny,
                               .row = nx,
                               .cell = sim->cell,
                               .x0 = sim->origin_x + ((double)at.i0 + 0.5) * sim->cell,
                               .y0 = sim->origin_y + ((double)at.j0 + 0.5) * sim->cell};
    shadow->at = at;
    const DpStatus status =
        dp_imprint_foot(&shadow->imprint, &patch, &sim->sole[part], &shadow->pose, 1, 1, scratch);
    shadow->cast = status == DP_OK;
    return status;
}

void dp_shadow_ahead(DpSim* sim, int part, int sample, DpImprintScratch* scratch)
{
    Shadow* shadow = dp_shadow_way(sim, part, sample);
    if (shadow->low - SINKS < shadow->ground + sim->meadow.extent)
        (void)dp_shadow_cast(sim, shadow, part, scratch);  // in its turn it says what is wrong
}
