// walker/foot_place.c - feet recorded on a floor, put on a slope. TRAIL (1) (2), MODEL 4.1
//
//   q_kin ---clearance of its tip: w---> towards the slope (1) ---steep: heel up (2)---> set down
//
// Departures
//   TRAIL (1): q_perp keeps the roll the foot has over its floor: what was flat on the floor is flat
//   on the slope, a heel that strikes or leaves does so there too. As printed (`flat`) every foot
//   near the ground is flat on it, on level ground too. test_foot_place.c,
//   level_ground_changes_nothing.
//   TRAIL (2): a roll that is kept would have the heel strike up a slope that only toes carry on;
//   what the toes are up over the floor fades to nothing at 2 theta_0. test_place.py,
//   prints_of_a_hill.
//   The parts of a foot hang together at the ball; where it was how high over the floor, it is so
//   high over the ground.
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define LATTICE 6  // points from the middle of the disc to its rim, along each axis

// mean height of the ground about a place, less and less towards the rim; NaN where there is none
static double smooth_height(const DpGroundBelow* below, DpVec3 at, double radius)
{
    const double step = radius / LATTICE;
    double       sum = 0.0, weights = 0.0;
    for (int b = -LATTICE; b <= LATTICE; ++b)
        for (int a = -LATTICE; a <= LATTICE; ++a) {
            const double near = 1.0 - (double)(a * a + b * b) / (LATTICE * LATTICE);
            if (near <= 0.0) continue;
            const double z = below->height(below->ground, at.x + a * step, at.y + b * step);
            if (!isfinite(z)) continue;
            sum += near * near * z;
            weights += near * near;
        }
    return weights > 0.0 ? sum / weights : (double)NAN;
}

// ---- one limb ---------------------------------------------------------------------------------

typedef struct Limb
{
    int limb;
    int lead;   // the part the others hang on: the heel, or the first
    int hinge;  // the part whose origin is the ball; -1 = none
    int heel;   // the point at the heel; -1 = none
} Limb;

// the point of a part by whose height the part is near the ground: c_heel, c_toe
static int tip_of(const DpGait* gait, int part)
{
    int tip = -1;
    for (int k = 0; k < gait->points; ++k) {
        if (gait->point_part[k] != part) continue;
        if (gait->point_role[k] == DP_POINT_HEEL) return k;
        if (tip < 0 || gait->point_role[k] == DP_POINT_TIP) tip = k;
    }
    return tip;
}

static Limb look_at_limb(const DpGait* gait, int limb)
{
    Limb found = {.limb = limb, .lead = -1, .hinge = -1, .heel = -1};
    for (int k = 0; k < gait->points && found.heel < 0; ++k)
        if (gait->part_limb[gait->point_part[k]] == limb && gait->point_role[k] == DP_POINT_HEEL)
            found.heel = k;
    if (found.heel >= 0) found.lead = gait->point_part[found.heel];
    for (int p = 0; p < gait->parts; ++p) {
        if (gait->part_limb[p] != limb) continue;
        if (found.lead < 0) found.lead = p;
        if (p != found.lead && found.hinge < 0) found.hinge = p;
    }
    return found;
}

// where the limb stays while it turns: its ball
static DpVec3 pivot_of(const DpGait* gait, const Limb* limb, int t)
{
    if (limb->hinge >= 0) return dp_walker_pose(gait, limb->hinge, t).at;
    const DpPose pose = dp_walker_pose(gait, limb->lead, t);
    for (int k = 0; k < gait->points; ++k)
        if (gait->point_part[k] == limb->lead && gait->point_role[k] == DP_POINT_BALL)
            return dp_place(pose, dp_walker_point(gait, k));
    return pose.at;
}

// over what the recording stood on
static double clearance_of(const DpGroundBelow* below, const DpPlaceOptions* o, DpVec3 point)
{
    return point.z - (o->carry ? o->floor : below->height(below->ground, point.x, point.y));
}

static DpVec3 middle_of(const DpGait* gait, const Limb* limb, int t)
{
    DpVec3 sum = {0.0, 0.0, 0.0};
    int    count = 0;
    for (int k = 0; k < gait->points; ++k) {
        const int part = gait->point_part[k];
        if (gait->part_limb[part] != limb->limb) continue;
        sum = dp_add(sum, dp_place(dp_walker_pose(gait, part, t), dp_walker_point(gait, k)));
        ++count;
    }
    return count ? dp_scale(sum, 1.0 / count) : pivot_of(gait, limb, t);
}

// ---- where a foot is turned to ---------------------------------------------------------------

// the axes of a thing that lies on the ground and faces the way `left` (level) is square to
typedef struct Lying
{
    DpVec3 ahead, left, up;
} Lying;

static Lying lie(DpVec3 normal, DpVec3 level_left)
{
    const DpVec3 heading =
        dp_cross(level_left, dp_vec3(0.0, 0.0, 1.0));  // seen from above it stays
    const double rise = -(normal.x * heading.x + normal.y * heading.y) / normal.z;
    Lying        out = {.ahead = dp_unit(dp_vec3(heading.x, heading.y, rise)), .up = normal};
    out.left = dp_cross(out.up, out.ahead);
    return out;
}

static DpQuat turn_to(Lying axes)
{
    // from x, y, z to these axes: first about z to the heading, then z to `up`, then about `up`
    const DpVec3 z = {0.0, 0.0, 1.0};
    const DpVec3 across = dp_cross(z, axes.up);
    const double s = dp_length(across);
    const DpQuat tilt = s > 1e-12 ? dp_quat_about(dp_scale(across, 1.0 / s), atan2(s, axes.up.z))
                                  : (DpQuat){1.0, 0.0, 0.0, 0.0};
    const DpVec3 ahead = dp_turn(dp_quat_back(tilt), axes.ahead);
    return dp_quat_product(tilt, dp_quat_about(z, atan2(ahead.y, ahead.x)));
}

// q_perp: on the slope, the heading as it was; false where the part lies on its side
static bool perpendicular(DpQuat kin, DpVec3 normal, bool flat, DpQuat* perp, Lying* on_slope)
{
    DpVec3 left = dp_turn(kin, dp_vec3(0.0, 1.0, 0.0));
    left.z = 0.0;
    if (dp_length(left) < 0.1 || !(normal.z > 0.01)) return false;
    left = dp_unit(left);
    *on_slope = lie(normal, left);
    *perp = turn_to(*on_slope);
    if (flat) return true;
    const DpQuat level = turn_to(lie(dp_vec3(0.0, 0.0, 1.0), left));
    *perp = dp_quat_product(*perp, dp_quat_product(dp_quat_back(level), kin));
    return true;
}

static DpQuat placed_turn(const DpGait* gait, const Limb* limb, int part, int t, DpVec3 normal,
                          const DpGroundBelow* below, const DpPlaceOptions* o,
                          const double* clearance)
{
    const DpPose kin = dp_walker_pose(gait, part, t);
    const int    tip = tip_of(gait, part);
    Lying        slope;
    DpQuat       perp;
    if (tip < 0 || !perpendicular(kin.turn, normal, o->flat, &perp, &slope)) return kin.turn;
    const double d =
        clearance_of(below, o, dp_place(kin, dp_walker_point(gait, tip))) - clearance[tip];
    if (isnan(d)) return kin.turn;
    const double w = dp_clamp(1.0 - d / o->max_clearance, 0.0, 1.0);  // TRAIL (1)
    DpQuat       q = dp_slerp(kin.turn, perp, w);                     // TRAIL (1)
    const double theta = asin(dp_clamp(slope.ahead.z, -1.0, 1.0));
    if (part != limb->lead || limb->heel < 0 || !(theta > o->toe_slope)) return q;
    const double toe_up = o->flat ? 0.0 : fmax(dp_turn(kin.turn, dp_vec3(1.0, 0.0, 0.0)).z, 0.0);
    const double steep = o->toe_slope > 0.0 ? fmin(theta / o->toe_slope - 1.0, 1.0) : 1.0;
    const double strike = asin(fmin(toe_up, 1.0)) * steep;
    const double offset = theta - o->toe_slope + strike;
    q = dp_quat_product(dp_quat_about(slope.left, w * offset), q);  // TRAIL (2)
    return q;
}

// ---- where it is set down --------------------------------------------------------------------

// the smallest clearance of a limb's points in these poses; INFINITY where there is no ground
static double min_clearance(const DpGait* gait, int limb, int t, const double* pose,
                            const DpGroundBelow* below, const DpPlaceOptions* o, bool recorded)
{
    double lowest = INFINITY;
    for (int k = 0; k < gait->points; ++k) {
        const int part = gait->point_part[k];
        if (gait->part_limb[part] != limb) continue;
        const double* p = pose + 7 * ((size_t)part * (size_t)gait->times + (size_t)t);
        const DpPose  at = {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
        const DpVec3  point = dp_place(at, dp_walker_point(gait, k));
        const double  over = recorded ? clearance_of(below, o, point)
                                      : point.z - below->height(below->ground, point.x, point.y);
        lowest = fmin(lowest, over);  // leaves NaN out
    }
    return lowest;
}

// how much the ground is higher than the floor about a place, held where there is none
static DpStatus rise_at(const DpGroundBelow* below, const DpPlaceOptions* o, DpVec3 at,
                        double radius, double* held)
{
    const double height = smooth_height(below, at, radius);
    if (isfinite(height)) *held = height - o->floor;
    return isfinite(*held) ? DP_OK : DP_NO_GROUND;
}

static void place_limb(const DpGait* gait, const Limb* limb, int t, double rise,
                       const DpGroundBelow* below, const DpPlaceOptions* o, const double* clearance,
                       double* pose)
{
    const DpVec3 pivot = pivot_of(gait, limb, t), middle = middle_of(gait, limb, t);
    const DpVec3 normal = below->normal(below->ground, middle.x, middle.y, o->foot_radius);
    const double before = min_clearance(gait, limb->limb, t, gait->pose, below, o, true);
    const DpPose lead = dp_walker_pose(gait, limb->lead, t);
    const DpQuat led = placed_turn(gait, limb, limb->lead, t, normal, below, o, clearance);
    const DpQuat turned = dp_quat_product(led, dp_quat_back(lead.turn));
    for (int p = 0; p < gait->parts; ++p) {
        if (gait->part_limb[p] != limb->limb) continue;
        const DpVec3 arm = dp_sub(dp_walker_pose(gait, p, t).at, pivot);
        const DpVec3 at = dp_add(pivot, dp_turn(turned, arm));
        const DpQuat q =
            p == limb->lead ? led : placed_turn(gait, limb, p, t, normal, below, o, clearance);
        const double value[7] = {at.x, at.y, at.z + rise, q.w, q.x, q.y, q.z};
        memcpy(pose + 7 * ((size_t)p * (size_t)gait->times + (size_t)t), value, sizeof value);
    }
    // no deeper in the ground than it was in its own
    const double after = min_clearance(gait, limb->limb, t, pose, below, o, false);
    const double lift = fmin(before, 0.0) - after;
    if (!isfinite(lift) || lift <= 0.0) return;
    for (int p = 0; p < gait->parts; ++p)
        if (gait->part_limb[p] == limb->limb)
            pose[7 * ((size_t)p * (size_t)gait->times + (size_t)t) + 2] += lift;
}

// ---- one walker --------------------------------------------------------------------------------

// the first known rise of a track, so that what begins beside the ground has one to hold
static double first_rise(const DpGait* gait, const Limb* limb, int walker,
                         const DpGroundBelow* below, const DpPlaceOptions* o)
{
    double held = (double)NAN;
    for (int t = 0; t < gait->times && !isfinite(held); ++t)
        rise_at(below, o, limb ? pivot_of(gait, limb, t) : dp_walker_com(gait, walker, t),
                limb ? o->foot_radius : o->body_radius, &held);
    return held;
}

DpStatus dp_foot_place(const DpGait* gait, int walker, const DpGroundBelow* below,
                       const DpPlaceOptions* options, const double* clearance, double* pose,
                       double* com)
{
    if (!dp_walker_gait_ok(gait) || walker < 0 || walker >= gait->walkers || !below ||
        !below->height || !below->normal || dp_place_options_check(options, NULL) != DP_OK ||
        !clearance || !pose || !com)
        return DP_BAD_ARGUMENT;
    for (int l = 0; l < gait->limbs; ++l) {
        if (gait->limb_walker[l] != walker) continue;
        const Limb limb = look_at_limb(gait, l);
        if (limb.lead < 0) continue;
        double rise = options->carry ? first_rise(gait, &limb, walker, below, options) : 0.0;
        for (int t = 0; t < gait->times; ++t) {
            if (options->carry && rise_at(below, options, pivot_of(gait, &limb, t),
                                          options->foot_radius, &rise) != DP_OK)
                return DP_NO_GROUND;
            place_limb(gait, &limb, t, rise, below, options, clearance, pose);
        }
    }
    if (!options->carry) return DP_OK;
    double rise = first_rise(gait, NULL, walker, below, options);
    for (int t = 0; t < gait->times; ++t) {
        if (rise_at(below, options, dp_walker_com(gait, walker, t), options->body_radius, &rise) !=
            DP_OK)
            return DP_NO_GROUND;
        com[3 * ((size_t)walker * (size_t)gait->times + (size_t)t) + 2] += rise;
    }
    return DP_OK;
}
