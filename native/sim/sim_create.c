// sim/sim_create.c - a simulation, and the recording it holds a copy of.
#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

#include <string.h>

DpSimOptions dp_sim_options_default(void)
{
    const DpSimOptions options = {
        .law = DP_CONTACT_SOLE,
        .heap_law = DP_HEAP_REST,
        .rim_width = 0.04,
        .tolerance = 0.1 * 3.14159265358979323846 / 180.0,
        .max_sweeps = 100000,
        .normal_radius = 0.25,
        .workers = 1,
    };
    return options;
}

static bool options_hold(const DpSimOptions* o)
{
    return (o->law == DP_CONTACT_SOLE || o->law == DP_CONTACT_UNIFORM) &&
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
    double origin[2];
    dp_terrain_origin(terrain, origin);
    sim->terrain = terrain;
    sim->options = *options;
    sim->cell = dp_terrain_cell(terrain);
    sim->origin_x = origin[0];
    sim->origin_y = origin[1];
    sim->samples = dp_imprint_samples(sim->cell);
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

static void drop_recording(DpSim* sim)
{
    dp_stage_drop(sim);
    sim->speculation.planned = false, sim->speculation.count = 0;
    for (int l = 0; sim->limb && l < sim->gait.limbs; ++l) dp_free(sim->limb[l].met);
    void* const blocks[] = {sim->time,  sim->pose,         sim->mass,           sim->sole,
                            sim->force, sim->limb,         sim->sole_vertex,    sim->sole_triangle,
                            sim->group, sim->order,        sim->pressure_point, sim->touching,
                            sim->start, sim->part_of_limb, sim->number,         sim->span};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
    for (int l = 0; sim->pressing && l < sim->gait.limbs; ++l) dp_free(sim->pressing[l].value);
    dp_free(sim->pressing);
    sim->pressing = NULL;
    sim->time = sim->pose = sim->mass = sim->force = sim->pressure_point = NULL;
    sim->sole = NULL, sim->limb = NULL, sim->sole_vertex = NULL, sim->sole_triangle = NULL;
    sim->span = NULL, sim->group = sim->order = sim->number = sim->start = sim->part_of_limb = NULL,
    sim->touching = NULL;
    sim->gait = (DpGait){0};
    for (int b = 0; b < sim->worker_count; ++b) {
        dp_free(sim->scratch[b].sole);
        dp_free(sim->scratch[b].pose);
        sim->scratch[b].sole = NULL, sim->scratch[b].pose = NULL;
    }
}

void dp_sim_destroy(DpSim* sim)
{
    if (!sim) return;
    if (sim->scratch) drop_recording(sim);
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
        dp_free(scratch->met);
    }
    for (int n = 0; n < MAX_SPECULATED; ++n) dp_lease_destroy(sim->speculation.lease[n]);
    dp_free(sim->scratch);
    dp_free(sim);
}

// A copy of `count` items; NULL counts as no memory, so never ask for none.
static void* copy(const void* items, size_t count, size_t size)
{
    void* block = dp_alloc(count, size);
    if (block) memcpy(block, items, count * size);
    return block;
}

#define FARTHEST 1e9     // of anything from the origin [m]
#define TURN_SLACK 1e-2  // a unit quaternion's length may be so far off

static bool poses_hold(const DpGait* g)
{
    for (size_t k = 0; k < (size_t)g->parts * (size_t)g->times; ++k) {
        const double* p = g->pose + 7 * k;
        const double  length = sqrt(p[3] * p[3] + p[4] * p[4] + p[5] * p[5] + p[6] * p[6]);
        if (!(fabs(p[0]) <= FARTHEST && fabs(p[1]) <= FARTHEST && fabs(p[2]) <= FARTHEST &&
              fabs(length - 1.0) <= TURN_SLACK))
            return false;
    }
    return true;
}

// Indices in range, times rising, masses and soles that can be worked with.
static bool gait_holds(const DpGait* g)
{
    if (g->times < 2 || g->walkers < 1 || g->limbs < 1 || g->parts < 1) return false;
    for (int t = 1; t < g->times; ++t)
        if (!(g->time[t] > g->time[t - 1])) return false;
    if (!isfinite(g->time[0]) || !isfinite(g->time[g->times - 1])) return false;
    for (int w = 0; w < g->walkers; ++w)
        if (!(g->mass[w] > 0.0 && isfinite(g->mass[w]))) return false;
    for (int l = 0; l < g->limbs; ++l)
        if (g->limb_walker[l] < 0 || g->limb_walker[l] >= g->walkers) return false;
    for (int p = 0; p < g->parts; ++p) {
        const DpMesh* sole = &g->sole[p];
        if (g->part_limb[p] < 0 || g->part_limb[p] >= g->limbs) return false;
        if (sole->vertex_count < 3 || sole->triangle_count < 1) return false;
        for (int k = 0; k < 3 * sole->triangle_count; ++k)
            if (sole->triangle[k] < 0 || sole->triangle[k] >= sole->vertex_count) return false;
        for (int k = 0; k < 3 * sole->vertex_count; ++k)
            if (!(fabs((double)sole->vertex[k]) <= FARTHEST)) return false;
    }
    return poses_hold(g);
}

static DpStatus copy_soles(DpSim* sim, const DpGait* gait)
{
    size_t vertices = 0, triangles = 0;
    for (int p = 0; p < gait->parts; ++p) {
        vertices += (size_t)gait->sole[p].vertex_count;
        triangles += (size_t)gait->sole[p].triangle_count;
    }
    sim->sole = copy(gait->sole, (size_t)gait->parts, sizeof *sim->sole);
    sim->sole_vertex = dp_alloc(3 * vertices, sizeof *sim->sole_vertex);
    sim->sole_triangle = dp_alloc(3 * triangles, sizeof *sim->sole_triangle);
    if (!sim->sole || !sim->sole_vertex || !sim->sole_triangle) return DP_NO_MEMORY;
    float*   vertex = sim->sole_vertex;
    int32_t* triangle = sim->sole_triangle;
    for (int p = 0; p < gait->parts; ++p) {
        DpMesh* sole = &sim->sole[p];
        memcpy(vertex, sole->vertex, 3 * (size_t)sole->vertex_count * sizeof *vertex);
        memcpy(triangle, sole->triangle, 3 * (size_t)sole->triangle_count * sizeof *triangle);
        sole->vertex = vertex;
        sole->triangle = triangle;
        vertex += 3 * sole->vertex_count;
        triangle += 3 * sole->triangle_count;
    }
    return DP_OK;
}

// Which parts belong to which limb, in the recording's order.
static DpStatus make_limbs(DpSim* sim, const DpGait* gait)
{
    const size_t limbs = (size_t)gait->limbs, parts = (size_t)gait->parts;
    sim->limb = dp_alloc(limbs, sizeof *sim->limb);
    sim->pressing = dp_alloc(limbs, sizeof *sim->pressing);
    sim->part_of_limb = dp_alloc(parts, sizeof *sim->part_of_limb);
    sim->group = dp_alloc(limbs, sizeof *sim->group);
    sim->order = dp_alloc(limbs, sizeof *sim->order);
    sim->number = dp_alloc(limbs, sizeof *sim->number);
    sim->span = dp_alloc(limbs, sizeof *sim->span);
    sim->start = dp_alloc(limbs + 1, sizeof *sim->start);
    bool complete = sim->limb && sim->pressing && sim->part_of_limb && sim->group && sim->order &&
                    sim->start && sim->number && sim->span;
    for (int b = 0; b < sim->worker_count; ++b) {
        sim->scratch[b].sole = dp_alloc(parts, sizeof(DpMesh));
        sim->scratch[b].pose = dp_alloc(parts, sizeof(DpPose));
        complete = complete && sim->scratch[b].sole && sim->scratch[b].pose;
    }
    if (!complete) return DP_NO_MEMORY;
    int* next = sim->part_of_limb;
    for (int l = 0; l < gait->limbs; ++l) {
        Limb* limb = &sim->limb[l];
        limb->walker = gait->limb_walker[l];
        limb->part = next;
        for (int p = 0; p < gait->parts; ++p)
            if (gait->part_limb[p] == l) limb->part[limb->part_count++] = p;
        next += limb->part_count;
    }
    return DP_OK;
}

// heights count from the terrain's base, which is where the walker first treads
static void lower(DpSim* sim, size_t samples)
{
    size_t first = 0;
    while (first < samples && !sim->touching[first]) ++first;
    if (first < samples && !sim->stage.plants)
        dp_terrain_move_datum(sim->terrain, sim->pose[7 * first + 2]);
    const double base = dp_terrain_datum(sim->terrain);
    for (size_t k = 0; k < samples; ++k) {
        sim->pose[7 * k + 2] -= base;
        sim->pressure_point[3 * k + 2] -= base;
    }
}

DpStatus dp_sim_load(DpSim* sim, const DpGait* gait, const uint8_t* touching, const double* force,
                     const double* pressure_point)
{
    if (!gait_holds(gait)) return DP_BAD_ARGUMENT;
    const size_t samples = (size_t)gait->parts * (size_t)gait->times;
    for (size_t k = 0; k < 3 * samples; ++k)
        if (!isfinite(force[k])) return DP_BAD_ARGUMENT;

    drop_recording(sim);
    DpStatus status = copy_soles(sim, gait);
    if (status == DP_OK) status = make_limbs(sim, gait);
    if (status == DP_OK) status = dp_stage_fit(sim, gait->parts, gait->limbs);
    sim->time = copy(gait->time, (size_t)gait->times, sizeof *sim->time);
    sim->pose = copy(gait->pose, 7 * samples, sizeof *sim->pose);
    sim->mass = copy(gait->mass, (size_t)gait->walkers, sizeof *sim->mass);
    sim->touching = copy(touching, samples, sizeof *sim->touching);
    sim->force = copy(force, 3 * samples, sizeof *sim->force);
    sim->pressure_point = copy(pressure_point, 3 * samples, sizeof *sim->pressure_point);
    if (status != DP_OK || !sim->time || !sim->pose || !sim->mass || !sim->touching ||
        !sim->force || !sim->pressure_point) {
        drop_recording(sim);
        return DP_NO_MEMORY;
    }
    sim->gait = (DpGait){.times = gait->times,
                         .walkers = gait->walkers,
                         .limbs = gait->limbs,
                         .parts = gait->parts,
                         .time = sim->time,
                         .mass = sim->mass,
                         .pose = sim->pose,
                         .sole = sim->sole};
    lower(sim, samples);
    sim->next = 0;
    return DP_OK;
}
