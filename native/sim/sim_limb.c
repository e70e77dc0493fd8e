// sim/sim_limb.c - where a limb is between two samples, and how hard it presses. MODEL 5.2
#include <limits.h>

#include "base/vec.h"
#include "sim/sim_inside.h"

#define MAX_SUBSTEPS 64
#define PROBED 96         // vertices of a sole looked at to tell how fast it slides
#define LOADED_BAND 0.02  // [m] above the lowest of them: may be loaded

bool dp_limb_there(const DpSim* sim, const Limb* limb, int sample)
{
    return dp_motion_there(sim->motion, limb->walker, sample);
}

static bool touches(const DpSim* sim, const Limb* limb, int sample, int mask)
{
    for (int p = 0; p < limb->part_count; ++p)
        if (dp_motion_touching(sim->motion, limb->part[p], sample) & mask) return true;
    return false;
}

bool dp_limb_touches(const DpSim* sim, const Limb* limb, int sample)
{
    return touches(sim, limb, sample, 255);
}

bool dp_limb_held(const DpSim* sim, const Limb* limb, int sample)
{
    return touches(sim, limb, sample, DP_HELD);
}

// heights count from the terrain's datum
static DpPose pose_at(const DpSim* sim, int part, int sample)
{
    DpPose pose = dp_motion_pose(sim->motion, part, sample);
    pose.at.z -= sim->datum;
    return pose;
}

DpPose dp_limb_pose(const DpSim* sim, int part, int sample, double w)
{
    const bool last = sample + 1 >= dp_motion_samples(sim->motion);
    if (w >= 1.0 && !last) return pose_at(sim, part, sample + 1);  // as the next interval begins
    const DpPose a = pose_at(sim, part, sample);
    if (w <= 0.0 || last) return a;
    const DpPose b = pose_at(sim, part, sample + 1);
    const DpPose pose = {dp_add(dp_scale(a.at, 1.0 - w), dp_scale(b.at, w)),
                         dp_slerp(a.turn, b.turn, w)};
    return pose;
}

// from fraction w0 to w1 of the interval
Moved dp_limb_moved(const DpSim* sim, int part, int sample, double w0, double w1)
{
    const DpPose a = dp_limb_pose(sim, part, sample, w0), b = dp_limb_pose(sim, part, sample, w1);
    return (Moved){dp_quat_product(a.turn, dp_quat_back(b.turn)), a.at, b.at};
}

// The parts of one limb are one sole: their forces add, their centres of pressure are weighed.
DpFootForce dp_limb_force(const DpSim* sim, const Limb* limb, int sample, double w)
{
    const int   last = dp_motion_samples(sim->motion) - 1;
    DpFootForce foot = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    double      weight = 0.0;
    for (int p = 0; p < limb->part_count; ++p) {
        for (int end = 0; end < 2; ++end) {
            const int    at = sample + end < last ? sample + end : last;
            const double share = end ? w : 1.0 - w;
            DpPartState  part;
            if (!dp_motion_part(sim->motion, limb->part[p], at, &part)) continue;
            DpVec3       c = part.pressure_point;
            const double load = share * fmax(0.0, -part.force.z);
            foot.force = dp_add(foot.force, dp_scale(part.force, share));
            c.z -= sim->datum;
            if (load <= 0.0 || !isfinite(c.x + c.y + c.z)) continue;
            foot.point = dp_add(foot.point, dp_scale(c, load));
            weight += load;
        }
    }
    if (weight > 0.0) foot.point = dp_scale(foot.point, 1.0 / weight);
    return foot;
}

// a cell's number, or one that no ground has
static long number_of(double cells)
{
    return (long)dp_clamp(cells, (double)LONG_MIN / 4.0, (double)LONG_MAX / 4.0);
}

DpCellRect dp_box_cells(const DpSim* sim, const DpBox* box, double margin)
{
    const double cell = sim->grid.cell, ox = sim->grid.x0, oy = sim->grid.y0;
    return (DpCellRect){number_of(floor((box->x0 - margin - ox) / cell)),
                        number_of(ceil((box->x1 + margin - ox) / cell)),
                        number_of(floor((box->y0 - margin - oy) / cell)),
                        number_of(ceil((box->y1 + margin - oy) / cell))};
}

// DpCellRect under the limb's soles at sample and sample + 1, with `margin` [m] around.
DpCellRect dp_limb_cells(const DpSim* sim, const Limb* limb, int sample, double margin)
{
    DpCellRect cells = {0, 0, 0, 0};
    for (int p = 0; p < limb->part_count; ++p) {
        for (int end = 0; end < 2; ++end) {
            const DpBox box = dp_imprint_box(&sim->cast.sole[limb->part[p]],
                                             dp_limb_pose(sim, limb->part[p], sample, end));
            cells = dp_cells_join(cells, dp_box_cells(sim, &box, margin));
        }
    }
    return cells;
}

// The middle of what is lowest of a body, horizontally: what it rolls on, though no point of it slides.
static DpVec3 lowest_spot(const DpMesh* sole, DpPose pose)
{
    DpVec3 sum = {0, 0, 0};
    double lowest = INFINITY, count = 0.0;
    for (int pass = 0; pass < 2; ++pass)
        for (int v = 0; v < sole->vertex_count; ++v) {
            const float* at = sole->vertex + 3 * v;
            const DpVec3 point =
                dp_place(pose, dp_vec3((double)at[0], (double)at[1], (double)at[2]));
            if (pass == 0)
                lowest = fmin(lowest, point.z);
            else if (point.z < lowest + LOADED_BAND)
                sum = dp_add(sum, dp_vec3(point.x, point.y, 0.0)), count += 1.0;
        }
    return count > 0.0 ? dp_scale(sum, 1.0 / count) : sum;
}

DpProbe dp_limb_probe(const DpSim* sim, const Limb* limb, int sample, int count, double high)
{
    DpProbe found = {INFINITY, 0.0};
    for (int p = 0; p < limb->part_count; ++p) {
        const DpMesh* sole = &sim->cast.sole[limb->part[p]];
        const DpPose  a = dp_limb_pose(sim, limb->part[p], sample, 0.0);
        const DpPose  b = dp_limb_pose(sim, limb->part[p], sample, 1.0);
        const int     stride = sole->vertex_count / count + 1;
        for (int v = 0; v < sole->vertex_count; v += stride) {
            const float* at = sole->vertex + 3 * (size_t)v;
            const DpVec3 point = dp_vec3((double)at[0], (double)at[1], (double)at[2]);
            const DpVec3 from = dp_place(a, point);
            found.lowest = fmin(found.lowest, from.z);
            if (from.z > high) continue;
            const DpVec3 displacement = dp_sub(dp_place(b, point), from);
            found.farthest = fmax(found.farthest, hypot(displacement.x, displacement.y));
        }
    }
    return found;
}

// So many sub-steps that no column which may be loaded moves by more than half a cell in one, nor
// does the place a rigid body rolls on. A foot's two parts roll from one to the other.
int dp_limb_substeps(const DpSim* sim, const Limb* limb, int sample)
{
    const double lowest = dp_limb_probe(sim, limb, sample, PROBED, -INFINITY).lowest;
    double       farthest = dp_limb_probe(sim, limb, sample, PROBED, lowest + LOADED_BAND).farthest;
    if (limb->part_count == 1) {
        const DpMesh* sole = &sim->cast.sole[limb->part[0]];
        const DpVec3  rolled =
            dp_sub(lowest_spot(sole, dp_limb_pose(sim, limb->part[0], sample, 1.0)),
                   lowest_spot(sole, dp_limb_pose(sim, limb->part[0], sample, 0.0)));
        farthest = fmax(farthest, dp_length(rolled));
    }
    const double steps = ceil(farthest / (0.5 * sim->grid.cell));  // MODEL 5.2
    return (int)dp_clamp(steps, 1.0, MAX_SUBSTEPS);
}
