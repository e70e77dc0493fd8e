// motion/motion_cast.c - who walks: walkers, limbs, parts and soles, and numbers that can be worked with.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "motion/motion_inside.h"

#define FARTHEST 1e9     // of anything from the origin [m]
#define TURN_SLACK 1e-2  // a unit quaternion's length may be so far off

bool dp_motion_times_hold(const double* time, int count)
{
    for (int t = 1; t < count; ++t)
        if (!(time[t] > time[t - 1])) return false;
    return isfinite(time[0]) && isfinite(time[count - 1]);
}

bool dp_motion_poses_hold(const DpLoadedPoses* poses, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        const double* p = poses->pose + 7 * k;
        const double* f = poses->force + 3 * k;
        const double  length = sqrt(p[3] * p[3] + p[4] * p[4] + p[5] * p[5] + p[6] * p[6]);
        if (!(fabs(p[0]) <= FARTHEST && fabs(p[1]) <= FARTHEST && fabs(p[2]) <= FARTHEST &&
              fabs(length - 1.0) <= TURN_SLACK))
            return false;
        if (!isfinite(f[0]) || !isfinite(f[1]) || !isfinite(f[2])) return false;
    }
    return true;
}

// Owners in range, masses and soles that can be worked with.
static bool cast_holds(const DpGait* g)
{
    if (g->walkers < 1 || g->limbs < 1 || g->parts < 1) return false;
    for (int w = 0; w < g->walkers; ++w)
        if (!(g->mass[w] > 0.0 && isfinite(g->mass[w]))) return false;
    for (int w = 0; g->contact_law && w < g->walkers; ++w)
        if (g->contact_law[w] >= DP_LAW_COUNT && g->contact_law[w] != DP_LAW_ANY) return false;
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
    return true;
}

static bool copy_soles(DpMotion* motion, const DpGait* cast)
{
    size_t vertices = 0, triangles = 0;
    for (int p = 0; p < cast->parts; ++p) {
        vertices += (size_t)cast->sole[p].vertex_count;
        triangles += (size_t)cast->sole[p].triangle_count;
    }
    motion->sole = dp_alloc((size_t)cast->parts, sizeof *motion->sole);
    motion->vertex = dp_alloc(3 * vertices, sizeof *motion->vertex);
    motion->triangle = dp_alloc(3 * triangles, sizeof *motion->triangle);
    if (!motion->sole || !motion->vertex || !motion->triangle) return false;
    float*   vertex = motion->vertex;
    int32_t* triangle = motion->triangle;
    for (int p = 0; p < cast->parts; ++p) {
        const DpMesh* sole = &cast->sole[p];
        memcpy(vertex, sole->vertex, 3 * (size_t)sole->vertex_count * sizeof *vertex);
        memcpy(triangle, sole->triangle, 3 * (size_t)sole->triangle_count * sizeof *triangle);
        motion->sole[p] = (DpMesh){sole->vertex_count, sole->triangle_count, vertex, triangle};
        vertex += 3 * sole->vertex_count;
        triangle += 3 * sole->triangle_count;
    }
    return true;
}

DpStatus dp_motion_open(DpMotion** motion_out, const DpGait* cast)
{
    if (!motion_out || !cast || !cast_holds(cast)) return DP_BAD_ARGUMENT;
    const size_t walkers = (size_t)cast->walkers, limbs = (size_t)cast->limbs;
    const size_t parts = (size_t)cast->parts;
    DpMotion*    motion = dp_alloc(1, sizeof *motion);
    if (!motion) return DP_NO_MEMORY;
    motion->mass = dp_alloc(walkers, sizeof *motion->mass);
    motion->owner = dp_alloc(limbs + parts, sizeof *motion->owner);
    motion->walker_of = dp_alloc(parts, sizeof *motion->walker_of);
    motion->own_number = dp_alloc(parts, sizeof *motion->own_number);
    motion->own_parts = dp_alloc(walkers, sizeof *motion->own_parts);
    motion->law = dp_alloc(walkers, sizeof *motion->law);
    motion->first_touch = NAN;
    if (!motion->mass || !motion->owner || !motion->walker_of || !motion->own_number ||
        !motion->own_parts || !motion->law || !copy_soles(motion, cast)) {
        dp_motion_drop(motion);
        return DP_NO_MEMORY;
    }
    memcpy(motion->mass, cast->mass, walkers * sizeof *motion->mass);
    memset(motion->law, DP_LAW_ANY, walkers);
    if (cast->contact_law) memcpy(motion->law, cast->contact_law, walkers);
    memcpy(motion->owner, cast->limb_walker, limbs * sizeof *motion->owner);
    memcpy(motion->owner + limbs, cast->part_limb, parts * sizeof *motion->owner);
    for (int p = 0; p < cast->parts; ++p) {
        motion->walker_of[p] = cast->limb_walker[cast->part_limb[p]];
        motion->own_number[p] = motion->own_parts[motion->walker_of[p]]++;
    }
    motion->cast = (DpGait){.walkers = cast->walkers,
                            .limbs = cast->limbs,
                            .parts = cast->parts,
                            .mass = motion->mass,
                            .limb_walker = motion->owner,
                            .part_limb = motion->owner + limbs,
                            .sole = motion->sole,
                            .contact_law = motion->law};
    *motion_out = motion;
    return DP_OK;
}

void dp_motion_drop(DpMotion* motion)
{
    if (!motion) return;
    for (int b = 0; motion->start && b < motion->start[motion->cast.walkers]; ++b)
        dp_block_drop(&motion->block[b]);
    dp_block_drop(&motion->window);
    void* const blocks[] = {
        motion->mass,      motion->owner,     motion->sole,       motion->vertex, motion->triangle,
        motion->walker_of, motion->own_parts, motion->own_number, motion->time,   motion->block,
        motion->start,     motion->present,   motion->law};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
    dp_free(motion);
}

DpStatus dp_block_open(Block* block, int parts, int first, int count)
{
    const size_t size = (size_t)parts * (size_t)count;
    *block = (Block){.first = first, .count = count};
    if (size == 0) return DP_OK;  // a walker without parts
    block->pose = dp_alloc(7 * size, sizeof *block->pose);
    block->force = dp_alloc(3 * size, sizeof *block->force);
    block->pressure_point = dp_alloc(3 * size, sizeof *block->pressure_point);
    block->touching = dp_alloc(size, sizeof *block->touching);
    if (block->pose && block->force && block->pressure_point && block->touching) return DP_OK;
    dp_block_drop(block);
    return DP_NO_MEMORY;
}

void dp_block_drop(Block* block)
{
    dp_free(block->pose), dp_free(block->force), dp_free(block->pressure_point);
    dp_free(block->touching);
    *block = (Block){0};
}

void dp_block_take(Block* block, size_t to, const DpLoadedPoses* poses, size_t from, size_t count)
{
    memcpy(block->pose + 7 * to, poses->pose + 7 * from, 7 * count * sizeof(double));
    memcpy(block->force + 3 * to, poses->force + 3 * from, 3 * count * sizeof(double));
    memcpy(block->pressure_point + 3 * to, poses->pressure_point + 3 * from,
           3 * count * sizeof(double));
    memcpy(block->touching + to, poses->touching + from, count);
}

DpPartState dp_block_state(const Block* block, size_t at)
{
    const double *p = block->pose + 7 * at, *f = block->force + 3 * at;
    const double* c = block->pressure_point + 3 * at;
    return (DpPartState){.pose = {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}},
                         .touching = block->touching[at],
                         .force = {f[0], f[1], f[2]},
                         .pressure_point = {c[0], c[1], c[2]}};
}
