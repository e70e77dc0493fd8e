// plants/plant_broadphase.c - which plants a collider can meet in a step.
#include <string.h>

#include "plants/plant_inside.h"

static bool finite3(DpVec3 v)
{
    return fabs(v.x) < 1e9 && fabs(v.y) < 1e9 && fabs(v.z) < 1e9;
}

bool dp_plant_collider_ok(const DpPlantCollider* c)
{
    if (!finite3(c->velocity) || !(c->friction >= 0.0 && c->friction < 1e9)) return false;
    if (!c->bottom) return finite3(c->from) && finite3(c->to) && c->radius > 0.0 && c->radius < 1e6;
    return c->nx > 0 && c->ny > 0 && c->row >= c->nx && c->cell > 0.0 && c->cell < 1e6 &&
           fabs(c->x0) < 1e9 && fabs(c->y0) < 1e9 && c->thickness > 0.0 && c->thickness < 1e6;
}

// the box a collider goes through; false if it is nowhere
bool dp_plant_sweep(PlantPush* push, double dt)
{
    const DpPlantCollider* c = push->collider;
    if (c->bottom) {
        int   i0 = c->nx, i1 = -1, j0 = c->ny, j1 = -1;
        float low = INFINITY, high = -INFINITY;
        for (int j = 0; j < c->ny; ++j)
            for (int i = 0; i < c->nx; ++i) {
                const float b = c->bottom[(size_t)j * (size_t)c->row + (size_t)i];
                if (!isfinite(b)) continue;
                i0 = i < i0 ? i : i0, i1 = i > i1 ? i : i1, j0 = j < j0 ? j : j0, j1 = j;
                low = fminf(low, b), high = fmaxf(high, b);
            }
        if (i1 < 0) return false;
        push->x0 = c->x0 + (i0 - 0.5) * c->cell, push->x1 = c->x0 + (i1 + 0.5) * c->cell;
        push->y0 = c->y0 + (j0 - 0.5) * c->cell, push->y1 = c->y0 + (j1 + 0.5) * c->cell;
        push->z0 = (double)low, push->z1 = (double)high + c->thickness;
    } else {
        push->x0 = fmin(c->from.x, c->to.x) - c->radius,
        push->x1 = fmax(c->from.x, c->to.x) + c->radius;
        push->y0 = fmin(c->from.y, c->to.y) - c->radius,
        push->y1 = fmax(c->from.y, c->to.y) + c->radius;
        push->z0 = fmin(c->from.z, c->to.z) - c->radius,
        push->z1 = fmax(c->from.z, c->to.z) + c->radius;
    }
    const DpVec3 back = dp_scale(c->velocity, -dt);
    push->x0 += fmin(back.x, 0.0), push->x1 += fmax(back.x, 0.0);
    push->y0 += fmin(back.y, 0.0), push->y1 += fmax(back.y, 0.0);
    push->z0 += fmin(back.z, 0.0), push->z1 += fmax(back.z, 0.0);
    return true;
}

// how far from its root a plant can be met
double dp_plant_span(const PlantStand* stand)
{
    return (double)stand->extent + (double)stand->kind.radius;
}

// how far to a side each plant of a block stands or lies, at most
static void lies_aside(const PlantStand* stand, const PlantBlock* block, double aside[DP_LANES])
{
    float max[DP_LANES];
    for (int l = 0; l < DP_LANES; ++l) max[l] = block->state ? 0.0f : stand->aside;
    for (int p = 0; block->state && p < stand->shape.particles; ++p)
        for (int d = 0; d < 2; ++d) {
            const float* at = block->state->at[d] + p * DP_LANES;
            for (int l = 0; l < DP_LANES; ++l) {
                const float off = fabsf(at[l] - block->foot[d][l]);
                max[l] = off > max[l] ? off : max[l];
            }
        }
    for (int l = 0; l < DP_LANES; ++l) aside[l] = (double)max[l];
}

// mark the plants that a collider can meet, as they are and as far as they move in a step of dt
void dp_plant_touch(const PlantStand* stand, PlantBlock* block, const PlantPush* push, int count,
                    double dt)
{
    const double half = 0.5 * (double)fmaxf(stand->kind.width, stand->kind.depth);
    const double high = (double)(DP_MAX_STRETCH * stand->kind.height + stand->kind.radius) + 0.01;
    const double spare = (double)stand->kind.radius + (double)DP_MAX_SPEED * dt + 0.01;
    double       aside[DP_LANES];
    lies_aside(stand, block, aside);
    block->touched = false;
    for (int l = 0; l < DP_LANES; ++l) {
        const double x = (double)block->root[0][l], y = (double)block->root[1][l];
        const double z = (double)block->root[2][l];
        const double lift = (double)(fabsf(block->slope[0][l]) + fabsf(block->slope[1][l])) * half;
        const double tall = high + lift;  // outer stems stand higher on a slope
        const double span = fmin(dp_plant_span(stand), aside[l] + spare);
        const double deep = dp_plant_span(stand);
        bool         meets = false;
        for (int k = 0; k < count && l < block->count; ++k)
            meets =
                meets || (x + span > push[k].x0 && x - span < push[k].x1 && y + span > push[k].y0 &&
                          y - span < push[k].y1 && z + tall > push[k].z0 && z - deep < push[k].z1);
        block->touched_lane[l] = meets;
        block->touched = block->touched || meets;
    }
}

// can any of the colliders, which may be far apart, meet a block whose roots lie within the box?
bool dp_plant_meets_any(const float box[4], const PlantPush* push, int count, double span)
{
    for (int k = 0; k < count; ++k)
        if ((double)box[0] < push[k].x1 + span && (double)box[2] > push[k].x0 - span &&
            (double)box[1] < push[k].y1 + span && (double)box[3] > push[k].y0 - span)
            return true;
    return false;
}
