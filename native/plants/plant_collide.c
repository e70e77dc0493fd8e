// plants/plant_collide.c - one particle out of everything that a step pushes through it.
//
// A particle under a sole stays between it and the ground; one that a sole has run into leaves by
// the shorter way, down or to the side. Legs push along the shortest way out.
#include "plants/plant_collide.h"

#include <string.h>

#define CERTAIN 1e-6  // this far out of a sole's swept box it is not met [m]

// distances to the nearest cell without sole, by the two-pass chamfer metric; a border of none
void dp_plant_side_field(const DpPlantCollider* c, float* out)
{
    const float     one = (float)c->cell, two = (float)(c->cell * 1.4142135623730951);
    const ptrdiff_t row = c->nx + 2;
    memset(out, 0, PLANT_SIDE_CELLS(c) * sizeof *out);
    for (int pass = 0; pass < 2; ++pass) {
        const ptrdiff_t step = pass ? 1 : -1;  // towards the neighbours that were seen before
        for (int jj = 0; jj < c->ny; ++jj) {
            const int    j = pass ? c->ny - 1 - jj : jj;
            const float* bottom = c->bottom + (size_t)j * (size_t)c->row;
            float*       here = out + (j + 1) * row + (pass ? c->nx : 1);
            for (int ii = 0; ii < c->nx; ++ii, here -= step) {
                if (!(bottom[pass ? c->nx - 1 - ii : ii] < INFINITY)) continue;  // 0 it is
                const float* beyond = here + step * row;
                float        far = pass ? *here : INFINITY;
                far = beyond[0] + one < far ? beyond[0] + one : far;
                far = beyond[-1] + two < far ? beyond[-1] + two : far;
                far = beyond[1] + two < far ? beyond[1] + two : far;
                *here = here[step] + one < far ? here[step] + one : far;
            }
        }
    }
}

// the ground below a point
double dp_plant_ground_below(const PlantProbe* probe, double x, double y)
{
    return dp_plant_floor_at(probe->block, probe->ground, probe->lane, x, y);
}

// cell of a sole over (x, y), -1 where there is none
static ptrdiff_t cell_under(const DpPlantCollider* c, double left, double x, double y)
{
    const double u = (x - c->x0 + c->velocity.x * left) / c->cell + 0.5;
    const double v = (y - c->y0 + c->velocity.y * left) / c->cell + 0.5;
    if (!(u >= 0.0 && v >= 0.0 && u < c->nx && v < c->ny)) return -1;
    const ptrdiff_t at = (ptrdiff_t)(int)v * c->row + (int)u;
    return isfinite(c->bottom[at]) ? at : -1;
}

// is a point surely outside of what a sole goes through in this step? Cheaper than to find its cell
static bool is_clear(const PlantPush* push, const DpVec3* p)
{
    return p->x < push->x0 - CERTAIN || p->x > push->x1 + CERTAIN || p->y < push->y0 - CERTAIN ||
           p->y > push->y1 + CERTAIN || p->z > push->z1 + CERTAIN;
}

// underside of the lowest sole whose column holds (x, y, z): +inf if none
double dp_plant_sole_over(const PlantProbe* probe, const DpVec3* p, const PlantPush** which)
{
    double lowest = INFINITY;
    for (int k = 0; k < probe->count; ++k) {
        const PlantPush*       push = &probe->push[k];
        const DpPlantCollider* c = push->collider;
        if (!c->bottom || is_clear(push, p)) continue;
        const ptrdiff_t at = cell_under(c, probe->left, p->x, p->y);
        if (at < 0) continue;
        const double bottom = (double)c->bottom[at] - c->velocity.z * probe->left;
        if (p->z >= bottom + c->thickness || bottom >= lowest) continue;
        lowest = bottom;
        if (which) *which = push;
    }
    return lowest;
}

// distance to the side at a cell, 0 off the sole
static double side_at(const PlantPush* push, int i, int j)
{
    const DpPlantCollider* c = push->collider;
    const bool             inside = i >= 0 && j >= 0 && i < c->nx && j < c->ny;
    return inside ? (double)push->out[(ptrdiff_t)(j + 1) * (c->nx + 2) + i + 1] : 0.0;
}

// out of a sole by its side, if that is shorter than `down`
static bool leave_by_side(const PlantProbe* probe, const PlantPush* push, DpVec3* p, double down)
{
    const DpPlantCollider* c = push->collider;
    const int              i = (int)((p->x - c->x0 + c->velocity.x * probe->left) / c->cell + 0.5);
    const int              j = (int)((p->y - c->y0 + c->velocity.y * probe->left) / c->cell + 0.5);
    const double           distance = side_at(push, i, j) + probe->radius;
    if (!(distance < down)) return false;
    const double gx = side_at(push, i - 1, j) - side_at(push, i + 1, j);
    const double gy = side_at(push, i, j - 1) - side_at(push, i, j + 1);
    const double size = sqrt(gx * gx + gy * gy);
    if (!(size > 0.0)) return false;
    const DpVec3 aside = {p->x + distance * gx / size, p->y + distance * gy / size, p->z};
    if (isfinite(dp_plant_sole_over(probe, &aside, NULL))) return false;
    *p = aside;
    return true;
}

static bool leave_capsule(const DpPlantCollider* c, double left, double radius, DpVec3* p)
{
    const DpVec3 back = dp_scale(c->velocity, -left);
    const DpVec3 from = dp_add(c->from, back), axis = dp_sub(c->to, c->from);
    const double length2 = dp_dot(axis, axis);
    const double t =
        length2 > 0.0 ? dp_clamp(dp_dot(dp_sub(*p, from), axis) / length2, 0.0, 1.0) : 0;
    const DpVec3 away = dp_sub(*p, dp_add(from, dp_scale(axis, t)));
    const double far = dp_length(away), most = c->radius + radius;
    if (far >= most) return false;
    DpVec3 out = dp_unit(away);
    if (!(far > 1e-9)) out = dp_unit(dp_vec3(c->velocity.x, c->velocity.y, 1e-6));
    *p = dp_add(*p, dp_scale(out, most - far));
    return true;
}

// bring a particle out of everything; returns how far it was pushed, and by what
double dp_plant_clear(const PlantProbe* probe, DpVec3* p, const DpPlantCollider** by)
{
    const DpVec3 was = *p;
    double       pushed = 0.0;
    for (int k = 0; k < probe->count; ++k) {
        const DpPlantCollider* c = probe->push[k].collider;
        if (c->bottom || !leave_capsule(c, probe->left, probe->radius, p)) continue;
        pushed = dp_length(dp_sub(*p, was));
        *by = c;
    }
    const double high = (double)probe->block->ceiling[probe->lane];
    double       ground = -INFINITY;  // not asked for yet
    for (int pass = 0; pass < 3; ++pass) {
        const PlantPush* push = NULL;
        const double     bottom = dp_plant_sole_over(probe, p, &push);
        if (!push && p->z > high) return pushed;  // in the open, over all ground around
        if (!(ground > -INFINITY)) ground = dp_plant_ground_below(probe, p->x, p->y);
        if (!push) break;
        const double floor_here = fmin(ground, bottom);
        const double room = dp_clamp(0.5 * (bottom - floor_here), 0.0, probe->radius);
        const double most = bottom - room;
        if (p->z <= most) {
            ground = floor_here;
            break;
        }
        *by = push->collider;
        pushed = fmax(pushed, p->z - most);
        if (!probe->only_down && leave_by_side(probe, push, p, p->z - most)) {
            ground = dp_plant_ground_below(probe, p->x, p->y);
            continue;
        }
        p->z = most;
        ground = floor_here;
    }
    if (p->z < ground) p->z = ground;
    return pushed;
}
