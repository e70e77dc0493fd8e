// sim/sim_create.c - a simulation, before anybody walks.
#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

DpSimOptions dp_sim_options_default(void)
{
    const DpSimOptions options = {
        .law = DP_CONTACT_SOLE,
        .heap_law = DP_HEAP_REST,
        .rim_width = 0.04,
        .tolerance = 0.1 * DP_PI / 180.0,
        .max_sweeps = 100000,
        .normal_radius = 0.25,
        .workers = 1,
    };
    return options;
}

static bool options_hold(const DpSimOptions* o)
{
    return (o->law == DP_CONTACT_SOLE || o->law == DP_CONTACT_UNIFORM ||
            o->law == DP_CONTACT_CARVE) &&
           (o->heap_law == DP_HEAP_REST || o->heap_law == DP_HEAP_PAPER) &&
           isfinite(o->rim_width) && o->rim_width > 0.0 && o->tolerance > 0.0 &&
           o->tolerance < 1.0 && o->max_sweeps > 0 && isfinite(o->normal_radius) &&
           o->normal_radius > 0.0 && o->workers >= 1 && o->workers <= 64;
}

DpStatus dp_sim_create(DpSim** sim_out, DpTerrain* terrain, const DpSimOptions* options)
{
    if (!sim_out || !terrain || !options || !options_hold(options)) return DP_BAD_ARGUMENT;
    DpSim* sim = dp_alloc(1, sizeof *sim);
    if (!sim) return DP_NO_MEMORY;
    sim->terrain = terrain;
    sim->options = *options;
    sim->grid = dp_terrain_grid(terrain);
    sim->worker_count = options->workers;
    sim->scratch = dp_alloc((size_t)sim->worker_count, sizeof *sim->scratch);
    bool complete = sim->scratch != NULL;
    for (int b = 0; complete && b < sim->worker_count; ++b) {
        WorkerScratch* scratch = &sim->scratch[b];
        scratch->lease = dp_lease_create();
        scratch->imprint_scratch = dp_imprint_scratch_create();
        scratch->soil_scratch = dp_soil_scratch_create();
        complete = scratch->lease && scratch->imprint_scratch && scratch->soil_scratch;
    }
    for (int n = 0; complete && n < MAX_SPECULATED; ++n) {
        sim->speculation.lease[n] = dp_lease_create();
        complete = sim->speculation.lease[n] != NULL;
    }
    if (!complete) {
        dp_sim_destroy(sim);
        return DP_NO_MEMORY;
    }
    *sim_out = sim;
    return DP_OK;
}

void dp_sim_destroy(DpSim* sim)
{
    if (!sim) return;
    dp_sim_forget(sim);
    dp_cloud_destroy(sim->spray.cloud);
    dp_plant_display_destroy(sim->stage.display);
    dp_grass_destroy(sim->stage.grass);
    for (int b = 0; sim->scratch && b < sim->worker_count; ++b) {
        WorkerScratch* scratch = &sim->scratch[b];
        dp_lease_destroy(scratch->lease);
        dp_imprint_scratch_destroy(scratch->imprint_scratch);
        dp_soil_scratch_destroy(scratch->soil_scratch);
        dp_free(scratch->imprint.bottom);
        dp_free(scratch->imprint.cover);
        dp_free(scratch->imprint.ring);
        dp_free(scratch->imprint.goal);
        dp_free(scratch->met);
    }
    for (int n = 0; n < MAX_SPECULATED; ++n) dp_lease_destroy(sim->speculation.lease[n]);
    dp_free(sim->scratch);
    dp_free(sim->slide);
    dp_free(sim);
}
