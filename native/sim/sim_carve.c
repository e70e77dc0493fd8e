// sim/sim_carve.c - a body that goes where it is moved to, through whatever ground is there. SUMNER99, MODEL 6.11
//
//   poses between two samples --(lower envelope of all)--> imprint --> pressed and cut --> laid around and ahead
#include "base/vec.h"
#include "sim/sim_inside.h"

#define PROBES 24     // places along a side of a body's box at which the surface is looked at
#define PROBED 512    // vertices looked at to tell how fast it moves
#define LOW_PART 0.5  // of a body's height: what is lower may be in the ground
#define STILL 1e-6    // what moves by less along the ground in a step pushes nothing ahead [m]
#define BEHIND \
    160000L  // cells of a way, after which what lies behind comes to rest: 4 x 4 m in cells of 1 cm
#define BEHIND_MARGIN 32  // cells around it onto which soil may slide
#define ALL_DOWN 1e6      // as if a body had come down from there: what it meets is pressed [m]

static DpBox joined(DpBox a, DpBox b)
{
    return (DpBox){fmin(a.x0, b.x0), fmin(a.y0, b.y0), fmin(a.z0, b.z0),
                   fmax(a.x1, b.x1), fmax(a.y1, b.y1), fmax(a.z1, b.z1)};
}

static DpBox box_of(const DpSim* sim, const Limb* limb, int sample, double w)
{
    DpBox box = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (int p = 0; p < limb->part_count; ++p) {
        const DpMesh* sole = &sim->cast.sole[limb->part[p]];
        box = joined(box, dp_imprint_box(sole, dp_limb_pose(sim, limb->part[p], sample, w)));
    }
    return box;
}

// from where to where the body goes in an interval; most come from the one before
static DpBox swept_box(const DpSim* sim, Limb* limb, int sample)
{
    const bool goes_on = limb->boxed == sample - 1 && sample > 0;
    limb->from = goes_on ? limb->to : box_of(sim, limb, sample, 0.0);
    limb->to = box_of(sim, limb, sample, 1.0);
    limb->boxed = sample;
    return joined(limb->from, limb->to);
}

DpCellRect dp_carve_cells(const DpSim* sim, const Limb* limb, double margin)
{
    const DpBox box = joined(limb->from, limb->to);
    return dp_box_cells(sim, &box, margin);
}

double dp_carve_depth(const DpSim* sim, Limb* limb, int sample)
{
    const DpBox  box = swept_box(sim, limb, sample);
    const double cell = sim->grid.cell, wide = box.x1 - box.x0, deep = box.y1 - box.y0;
    const int    nx = (int)dp_clamp(ceil(wide / cell), 1.0, PROBES);
    const int    ny = (int)dp_clamp(ceil(deep / cell), 1.0, PROBES);
    double       highest = -INFINITY;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const double z =
                dp_terrain_surface_at(sim->terrain, box.x0 + wide * i / nx, box.y0 + deep * j / ny);
            if (z > highest) highest = z;
        }
    // between two probes it may be higher, as on a slope of 45 degrees
    return fmax(highest + fmax(wide / nx, deep / ny) + cell - box.z0, 0.0);
}

// So many poses that nothing low moves by more than half a cell from one to the next.
static int steps_of(const DpSim* sim, const Limb* limb, int sample)
{
    const DpBox  box = limb->from;
    const double high = box.z0 + LOW_PART * (box.z1 - box.z0);
    const double farthest = dp_limb_probe(sim, limb, sample, PROBED, high).farthest;
    const double moves = ceil(farthest / (0.5 * sim->grid.cell));
    return (int)dp_clamp(moves, 1.0, DP_CARVE_STEPS - 1);
}

// The parts in all poses since the sample; returns how many.
static int sweep(const DpSim* sim, const Limb* limb, int sample, WorkerScratch* scratch)
{
    const int steps = steps_of(sim, limb, sample);
    int       count = 0;
    for (int u = limb->begins ? 0 : 1; u <= steps; ++u)
        for (int p = 0; p < limb->part_count; ++p) {
            scratch->sole[count] = sim->cast.sole[limb->part[p]];
            scratch->pose[count++] = dp_limb_pose(sim, limb->part[p], sample, (double)u / steps);
        }
    return count;
}

// The mean of its parts.
static DpDescent descent_of(const DpSim* sim, const Limb* limb, int sample,
                            const DpSoilPatch* patch)
{
    const double xm = patch->x0 + 0.5 * (double)(patch->nx - 1) * patch->cell;
    const double ym = patch->y0 + 0.5 * (double)(patch->ny - 1) * patch->cell;
    const double share = 1.0 / limb->part_count;
    DpDescent    descent = {0};
    for (int p = 0; p < limb->part_count; ++p) {
        const Moved  m = dp_limb_moved(sim, limb->part[p], sample, 0.0, 1.0);
        const DpVec3 z = dp_turn(dp_quat_back(m.turn), dp_vec3(0.0, 0.0, 1.0));
        descent.at += share * (z.x * (xm - m.to.x) + z.y * (ym - m.to.y) - z.z * m.to.z + m.from.z);
        descent.along_x += share * z.x;
        descent.along_y += share * z.y;
        descent.along_z += share * (z.z - 1.0);
    }
    return descent;
}

// How far what is now at a place has gone along the ground, the mean of the parts.
static DpVec3 gone(const DpSim* sim, const Limb* limb, int sample, DpVec3 place)
{
    DpVec3 sum = {0, 0, 0};
    for (int p = 0; p < limb->part_count; ++p) {
        const Moved  m = dp_limb_moved(sim, limb->part[p], sample, 0.0, 1.0);
        const DpVec3 was = dp_add(m.from, dp_turn(m.turn, dp_sub(place, m.to)));
        sum = dp_add(sum, dp_scale(dp_sub(place, was), 1.0 / limb->part_count));
    }
    sum.z = 0.0;
    return sum;
}

static void count(Limb* limb, const DpCarved* carved)
{
    limb->sink = 0.0;
    limb->firm += carved->pressed.firm;
    limb->loose += carved->pressed.loose;
    limb->rebounded -= carved->pressed.elastic;
    limb->loosened += carved->cut_firm;
    limb->laid -= carved->cut_firm + carved->cut_loose;  // what is laid of it was not displaced
    limb->deepest = fmax(limb->deepest, carved->pressed.deepest);
}

DpStatus dp_limb_carve(DpSim* sim, Limb* limb, DpSoilPatch* patch, WorkerScratch* scratch,
                       int sample)
{
    DpStatus status = dp_pressing_open(&sim->pressing[limb - sim->limb], limb, patch);
    if (status != DP_OK) return status;
    const int poses = sweep(sim, limb, sample, scratch);
    status = dp_imprint_foot(&scratch->imprint, patch, scratch->sole, scratch->pose, poses,
                             limb->samples, scratch->imprint_scratch);
    if (status != DP_OK) return status;

    const DpBox     box = limb->to;
    const DpVec3    low = dp_vec3(0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1), box.z0);
    const DpVec3    displacement = gone(sim, limb, sample, low);
    const double    far = dp_length(displacement);
    const bool      pushes = far > STILL && !limb->begins;
    const DpDescent straight = {ALL_DOWN, 0.0, 0.0, 0.0};
    const DpDescent descent = pushes ? descent_of(sim, limb, sample, patch) : straight;
    DpCarved        carved;
    status =
        dp_soil_carve(patch, &scratch->imprint, &descent, dp_sim_interval(sim, sample), &carved);
    if (status != DP_OK || carved.pressed.area <= 0.0) return status;
    count(limb, &carved);
    status = dp_limb_carry(sim, limb, patch, scratch, poses);
    if (status != DP_OK) return status;

    const double cut = carved.cut_firm + carved.cut_loose;
    const double volume = carved.pressed.displaced + cut;
    const double ahead = pushes && volume > 0.0 ? cut / volume : 0.0;  // beta of TRAIL (13)
    const DpVec3 cut_ahead =
        ahead > 0.0 ? dp_scale(displacement, ahead / far) : dp_vec3(0.0, 0.0, 0.0);
    const DpFootForce foot = {
        {0.0, 0.0, 0.0}, dp_vec3(carved.x, carved.y, box.z0), {0.0, 0.0, 1.0}};
    return dp_limb_lay(sim, limb, patch, scratch, &foot, volume, 1.0, cut_ahead);
}

static long count_cells(DpCellRect at)
{
    return dp_cells_empty(at) ? 0 : (at.i1 - at.i0) * (at.j1 - at.j0);
}

DpStatus dp_carve_behind(DpSim* sim, Limb* limb)
{
    if (count_cells(limb->trodden) < BEHIND ||
        count_cells(limb->trodden) < 4 * count_cells(limb->patch))
        return DP_OK;
    WorkerScratch*   scratch = &sim->scratch[0];
    const DpCellRect at = dp_cells_grown(limb->trodden, BEHIND_MARGIN);
    DpSoilPatch*     patch = NULL;
    DpStatus         status = dp_limb_lease(sim, scratch, at, &patch);
    if (status != DP_OK) return status;
    for (long j = limb->patch.j0; j < limb->patch.j1; ++j)  // where it is now nothing moves
        for (long i = limb->patch.i0; i < limb->patch.i1; ++i)
            scratch->imprint.ring[(j - at.j0) * patch->row + (i - at.i0)] = 0;
    (void)dp_hold_all(sim, at, &scratch->imprint, patch->row);
    DpSettled settled;
    status = dp_soil_stabilize(patch, &scratch->imprint, NULL, sim->options.tolerance,
                               sim->options.max_sweeps, scratch->soil_scratch, &settled);
    if (status != DP_OK) return status;
    dp_terrain_commit(sim->terrain, scratch->lease, settled.changed);
    limb->loosened += settled.loosened;
    limb->trodden = limb->patch;
    return DP_OK;
}
