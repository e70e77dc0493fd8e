// sim/sim_follow.c - the motion that a simulation follows, and the limbs that come with it.
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "sim/sim_inside.h"

void dp_sim_forget(DpSim* sim)
{
    dp_stage_drop(sim);
    dp_spray_drop(&sim->spray);
    sim->speculation.planned = false, sim->speculation.count = 0;
    for (int l = 0; sim->limb && l < sim->cast.limbs; ++l) {
        dp_free(sim->limb[l].met);
        dp_carry_destroy(sim->limb[l].carry);
    }
    for (int l = 0; sim->pressing && l < sim->cast.limbs; ++l) dp_free(sim->pressing[l].value);
    void* const blocks[] = {sim->limb,        sim->pressing,   sim->part_of_limb, sim->group,
                            sim->order,       sim->number,     sim->start,        sim->span,
                            sim->worker_sole, sim->worker_pose};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
    dp_motion_destroy(sim->motion);
    sim->motion = NULL, sim->limb = NULL, sim->pressing = NULL, sim->span = NULL;
    sim->part_of_limb = sim->group = sim->order = sim->number = sim->start = NULL;
    sim->worker_sole = NULL, sim->worker_pose = NULL;
    sim->cast = (DpGait){0};
}

// How long a limb's soles are, one after the other [m].
static double length_of(const DpGait* cast, const Limb* limb)
{
    double length = 0.0;
    for (int p = 0; p < limb->part_count; ++p) {
        const DpMesh* sole = &cast->sole[limb->part[p]];
        DpVec3        low = dp_vec3(INFINITY, INFINITY, INFINITY), high = dp_scale(low, -1.0);
        for (int v = 0; v < sole->vertex_count; ++v) {
            const float* at = sole->vertex + 3 * (size_t)v;
            low = dp_vec3(fmin(low.x, at[0]), fmin(low.y, at[1]), fmin(low.z, at[2]));
            high = dp_vec3(fmax(high.x, at[0]), fmax(high.y, at[1]), fmax(high.z, at[2]));
        }
        if (sole->vertex_count > 0) length += dp_length(dp_sub(high, low));
    }
    return length;
}

// Which parts belong to which limb, in the recording's order.
static DpStatus make_limbs(DpSim* sim)
{
    const DpGait* cast = &sim->cast;
    const size_t  limbs = (size_t)cast->limbs, parts = (size_t)cast->parts;
    const size_t  workers = (size_t)sim->worker_count;
    sim->limb = dp_alloc(limbs, sizeof *sim->limb);
    sim->pressing = dp_alloc(limbs, sizeof *sim->pressing);
    sim->part_of_limb = dp_alloc(parts, sizeof *sim->part_of_limb);
    sim->group = dp_alloc(limbs, sizeof *sim->group);
    sim->number = dp_alloc(limbs, sizeof *sim->number);
    sim->order = dp_alloc(limbs, sizeof *sim->order);
    sim->start = dp_alloc(limbs + 1, sizeof *sim->start);
    sim->span = dp_alloc(limbs, sizeof *sim->span);
    if (!sim->limb || !sim->pressing || !sim->part_of_limb || !sim->group || !sim->number ||
        !sim->order || !sim->start || !sim->span)
        return DP_NO_MEMORY;
    for (int p = 0; p < cast->parts; ++p) ++sim->limb[cast->part_limb[p]].part_count;
    int* next = sim->part_of_limb;
    int  most = 1;
    for (int l = 0; l < cast->limbs; ++l) {
        Limb* limb = &sim->limb[l];
        limb->walker = cast->limb_walker[l];
        limb->part = next;
        limb->boxed = -1;
        limb->law = sim->cast.contact_law[limb->walker] == DP_LAW_ANY
                        ? sim->options.law
                        : (DpContactLaw)sim->cast.contact_law[limb->walker];
        next += limb->part_count;
        most = limb->part_count > most ? limb->part_count : most;
        limb->part_count = 0;
    }
    for (int p = 0; p < cast->parts; ++p) {
        Limb* limb = &sim->limb[cast->part_limb[p]];
        limb->part[limb->part_count++] = p;
    }
    for (int l = 0; l < cast->limbs; ++l) {
        Limb* limb = &sim->limb[l];
        limb->length = length_of(cast, limb);
        limb->samples = dp_imprint_samples(sim->grid.cell, limb->length);
        if (limb->law == DP_CONTACT_CARVE && limb->part_count * DP_CARVE_STEPS > most)
            most = limb->part_count * DP_CARVE_STEPS;
    }
    sim->worker_sole = dp_alloc(workers * (size_t)most, sizeof *sim->worker_sole);
    sim->worker_pose = dp_alloc(workers * (size_t)most, sizeof *sim->worker_pose);
    if (!sim->worker_sole || !sim->worker_pose) return DP_NO_MEMORY;
    sim->limb_parts = most;
    return DP_OK;
}

// Heights count from the terrain's datum, which is near to where a walker first treads.
static void set_datum(DpSim* sim)
{
    const double height = dp_motion_first_touch(sim->motion);
    if (isfinite(height) && !sim->stage.plants) dp_terrain_move_datum(sim->terrain, height);
    sim->datum = dp_terrain_datum(sim->terrain);
}

DpStatus dp_sim_follow(DpSim* sim, DpMotion* motion)
{
    if (!sim || !motion) return DP_BAD_ARGUMENT;
    DpSim old = *sim;  // with all that is dropped when the new motion has its limbs
    sim->motion = motion, sim->cast = *dp_motion_cast(motion);
    sim->limb = NULL, sim->pressing = NULL, sim->span = NULL;
    sim->part_of_limb = sim->group = sim->order = sim->number = sim->start = NULL;
    sim->worker_sole = NULL, sim->worker_pose = NULL;
    sim->stage = dp_stage_empty(&old.stage);
    dp_spray_leave(&sim->spray, &old.spray);
    DpStatus status = make_limbs(sim);
    if (status == DP_OK) status = dp_carry_fit(sim);
    if (status == DP_OK) status = dp_stage_fit(sim, sim->cast.parts, sim->cast.limbs);
    if (status != DP_OK) {
        sim->motion = NULL;  // it stays the caller's
        dp_sim_forget(sim);
        *sim = old;
        return status;
    }
    dp_carry_gone(&old, &sim->gone);
    dp_sim_forget(&old);
    sim->speculation.planned = false, sim->speculation.count = 0;
    for (int b = 0; b < sim->worker_count; ++b) {
        sim->scratch[b].sole = sim->worker_sole + b * sim->limb_parts;
        sim->scratch[b].pose = sim->worker_pose + b * sim->limb_parts;
    }
    sim->groups = 0;
    sim->next = 0;
    set_datum(sim);
    return DP_OK;
}

DpStatus dp_sim_load(DpSim* sim, const DpGait* gait, const uint8_t* touching, const double* force,
                     const double* pressure_point)
{
    if (!sim || !gait) return DP_BAD_ARGUMENT;
    const DpLoadedPoses poses = {gait->pose, touching, force, pressure_point};
    DpMotion*           motion = NULL;
    DpStatus            status = dp_motion_record(&motion, gait, &poses);
    if (status == DP_OK) status = dp_sim_follow(sim, motion);
    if (status != DP_OK) dp_motion_destroy(motion);
    return status;
}

DpStatus dp_sim_push(DpSim* sim, double time, const uint8_t* present, const DpLoadedPoses* poses)
{
    if (!sim || !sim->motion) return DP_BAD_ARGUMENT;
    const DpStatus status = dp_motion_push(sim->motion, time, present, poses);
    if (status == DP_OK && dp_terrain_tile_count(sim->terrain) == 0) set_datum(sim);
    return status;
}

int dp_sim_walkers(const DpSim* sim)
{
    return sim->cast.walkers;
}

DpStatus dp_sim_begin_at(DpSim* sim, int sample)
{
    if (!sim || !sim->motion || sim->next > 0 || dp_motion_is_live(sim->motion) || sample < 0 ||
        sample >= dp_motion_samples(sim->motion))
        return DP_BAD_ARGUMENT;
    sim->next = sample;
    return DP_OK;
}
