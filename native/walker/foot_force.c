// walker/foot_force.c - how hard every part presses. TRAIL (3), SOFT22 (3)-(8), design 4.3.
//
//   touching ---ramps---> s_i ---zero-moment point---> a_i ---m (g - a_com)---> force of each limb
//                                                                    \--same rule--> of each part
//
// Departures
//   TRAIL (3): `inertia` replaces weight and landing impulse by Newton's law for the whole body, so
//   that runs, jumps and push-offs carry what they really carry. test_foot_force.c, jump_weighs_right.
//   SOFT22 (5): the denominator is |p_R - p_L|^2; see dp_foot_share.
//   TRAIL (3): v(t0 - dt) is measured over a fixed 1/30 s before touch-down, so that the landing does not
//   depend on the frame rate. test_foot_force.c, impulse_of_fall.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "walker/walker_inside.h"

#define PI 3.14159265358979323846
#define LATCH_TIME (1.0 / 30.0)  // v0 is measured over this before touch-down      [s]
#define LEAST_PULL 0.2           // a_z + g counts as no less than this share of g   [-]
#define STILL 0.1                // accelerations below this share of g are near rest [-]
#define SOLE_LIFT 0.04           // a point this far above its part's lowest carries nothing [m]
#define STEP_SHORTEST 0.15       // touch-downs closer than this are one step         [s]

DpLoadOptions dp_load_options_default(void)
{
    const DpLoadOptions options = {.model = DP_LOAD_INERTIA,
                                   .settle_time = 0.2,
                                   .half_sine = false,
                                   .cutoff_share = 3.0,
                                   .cutoff_low = 5.0,
                                   .cutoff_high = 10.0,
                                   .overlap_most = 0.3,
                                   .ramp_standing = 0.1,
                                   .ramp_alone = 0.03,
                                   .ramp_trust = 0.25,
                                   .reach = 0.3};
    return options;
}

// one walker: its limbs and parts in a row, and what they do over the clip
typedef struct Load
{
    const DpGait*        gait;
    const DpLoadOptions* options;
    const double*        ground;
    double               rate;
    int                  walker, limbs, parts;
    int*                 limb;          // index of each limb                  (limbs)
    int*                 part;          // index of each part, limb by limb    (parts)
    int*                 first;         // first part of each limb             (limbs + 1)
    uint8_t*             limb_on;       //                                     (limbs, T)
    uint8_t*             part_on;       //                                     (parts, T)
    double*              limb_weight;   // W_i of limbs                        (limbs, T)
    double*              part_weight;   // and of parts within their limb      (parts, T)
    double*              accel;         // a_com                               (3, T)
    DpVec3*              landing;       // v0 latched for the impulse          (limbs)
    int*                 landed;        // its sample; -1 = never              (limbs)
    double*              share;         // scratch                             (limbs + parts)
    DpVec3*              at;            // centres of contact                  (limbs + parts)
} Load;

static void close_load(Load* l)
{
    dp_free(l->limb), dp_free(l->part), dp_free(l->first), dp_free(l->limb_on);
    dp_free(l->part_on), dp_free(l->limb_weight), dp_free(l->part_weight), dp_free(l->accel);
    dp_free(l->landing), dp_free(l->landed), dp_free(l->share), dp_free(l->at);
}

static bool open_load(Load* l)
{
    const size_t limbs = (size_t)l->gait->limbs, parts = (size_t)l->gait->parts;
    const size_t times = (size_t)l->gait->times;
    l->limb = dp_alloc(limbs, sizeof(int));
    l->part = dp_alloc(parts, sizeof(int));
    l->first = dp_alloc(limbs + 1, sizeof(int));
    l->limb_on = dp_alloc(limbs * times, 1);
    l->part_on = dp_alloc(parts * times, 1);
    l->limb_weight = dp_alloc(limbs * times, sizeof(double));
    l->part_weight = dp_alloc(parts * times, sizeof(double));
    l->accel = dp_alloc(3 * times, sizeof(double));
    l->landing = dp_alloc(limbs, sizeof(DpVec3));
    l->landed = dp_alloc(limbs, sizeof(int));
    l->share = dp_alloc(limbs + parts, sizeof(double));
    l->at = dp_alloc(limbs + parts, sizeof(DpVec3));
    return l->limb && l->part && l->first && l->limb_on && l->part_on && l->limb_weight &&
           l->part_weight && l->accel && l->landing && l->landed && l->share && l->at;
}

static void gather(Load* l, int walker, const uint8_t* touching)
{
    const DpGait* gait = l->gait;
    const size_t  times = (size_t)gait->times;
    l->walker = walker, l->limbs = 0, l->parts = 0;
    memset(l->limb_on, 0, (size_t)gait->limbs * times);
    for (int limb = 0; limb < gait->limbs; ++limb) {
        if (gait->limb_walker[limb] != walker) continue;
        l->first[l->limbs] = l->parts;
        for (int part = 0; part < gait->parts; ++part) {
            if (gait->part_limb[part] != limb) continue;
            uint8_t*       mine = l->part_on + (size_t)l->parts * times;
            const uint8_t* on = touching + (size_t)part * times;
            for (size_t t = 0; t < times; ++t) {
                mine[t] = on[t] != 0;
                l->limb_on[(size_t)l->limbs * times + t] |= mine[t];
            }
            l->part[l->parts++] = part;
        }
        l->limb[l->limbs++] = limb;
    }
    l->first[l->limbs] = l->parts;
    walker_ramps(l->limb_on, l->limbs, gait->times, l->rate, l->options, l->limb_weight);
    for (int i = 0; i < l->limbs; ++i) {
        const size_t row = (size_t)l->first[i] * times;
        walker_ramps(l->part_on + row, l->first[i + 1] - l->first[i], gait->times, l->rate, l->options,
                     l->part_weight + row);
    }
}

// ---- how fast the walker steps ------------------------------------------------------------------

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

static bool begins(const uint8_t* on, int t)
{
    return t > 0 && on[t] && !on[t - 1];
}

// median time between touch-downs of one limb, of any limbs if none comes down twice; 0 if unknown
static double step_time(const Load* l, double* scratch)
{
    const int times = l->gait->times;
    int       count = 0;
    for (int i = 0; i < l->limbs; ++i) {
        const uint8_t* on = l->limb_on + (size_t)i * (size_t)times;
        int            last = -1;
        for (int t = 1; t < times; ++t) {
            if (!begins(on, t)) continue;
            if (last >= 0 && (double)(t - last) > STEP_SHORTEST * l->rate && count < times)
                scratch[count++] = (double)(t - last) / l->rate / (l->limbs > 1 ? 2.0 : 1.0);
            last = t;
        }
    }
    if (count == 0) {
        int last = -1;
        for (int t = 1; t < times; ++t) {
            bool lands = false;
            for (int i = 0; i < l->limbs; ++i)
                lands = lands || begins(l->limb_on + (size_t)i * (size_t)times, t);
            if (!lands) continue;
            if (last >= 0 && (double)(t - last) > STEP_SHORTEST * l->rate)
                scratch[count++] = (double)(t - last) / l->rate;
            last = t;
        }
    }
    if (count == 0) return 0.0;
    qsort(scratch, (size_t)count, sizeof *scratch, by_value);
    return scratch[count / 2];
}

// does the walker ever leave the ground?
static bool flies(const Load* l)
{
    for (int t = 0; t < l->gait->times; ++t) {
        bool on = false;
        for (int i = 0; i < l->limbs; ++i)
            on = on || l->limb_on[(size_t)i * (size_t)l->gait->times + (size_t)t];
        if (!on) return true;
    }
    return false;
}

// a_com, low-passed at three times the step frequency
static DpStatus accelerate(Load* l)
{
    const DpLoadOptions* o = l->options;
    const int            times = l->gait->times;
    double*              line = dp_alloc((size_t)times, sizeof(double));
    double*              scratch = dp_alloc(3 * (size_t)times + 8, sizeof(double));
    if (!line || !scratch) {
        dp_free(line), dp_free(scratch);
        return DP_NO_MEMORY;
    }
    const double step = step_time(l, line);
    const double cutoff = step > 0.0 ? dp_clamp(o->cutoff_share / step, o->cutoff_low, o->cutoff_high)
                          : flies(l) ? o->cutoff_high
                                     : o->cutoff_low;
    for (int c = 0; c < 3; ++c) {
        for (int t = 0; t < times; ++t) {
            const DpVec3 com = walker_com(l->gait, l->walker, t);
            line[t] = c == 0 ? com.x : c == 1 ? com.y : com.z;
        }
        walker_low_pass(line, times, l->rate, cutoff, scratch);
        for (int t = 0; t < times; ++t)
            l->accel[c * times + t] = walker_acceleration(line, times, t, l->rate);
    }
    dp_free(line), dp_free(scratch);
    return DP_OK;
}

// ---- where the load goes in ------------------------------------------------------------------------

// centre of a part's contact: its points, those that hang over the lowest one counting less
static DpVec3 part_centre(const Load* l, int part, int t)
{
    const DpGait* gait = l->gait;
    const DpPose  pose = walker_pose(gait, part, t);
    double        lowest = INFINITY, sum = 0.0;
    DpVec3        centre = {0};
    for (int pass = 0; pass < 2; ++pass)
        for (int k = 0; k < gait->points; ++k) {
            if (gait->point_part[k] != part) continue;
            DpVec3       at = dp_place(pose, walker_point(gait, k));
            const double below = l->ground[(size_t)k * (size_t)gait->times + (size_t)t];
            const double d = isfinite(below) ? at.z - below : at.z;
            if (pass == 0) {
                lowest = fmin(lowest, d);
                continue;
            }
            const double weight = dp_smoothstep(1.0 - (d - lowest) / SOLE_LIFT);
            if (isfinite(below)) at.z = below;
            centre = dp_add(centre, dp_scale(at, weight));
            sum += weight;
        }
    return sum > 0.0 ? dp_scale(centre, 1.0 / sum) : pose.at;
}

// the velocity of the mass centre at a sample, from the parabola through the last 1/30 s
static DpVec3 latched_velocity(const Load* l, int t)
{
    const double half = LATCH_TIME / 2.0 * l->rate;  // in samples
    if ((double)t < 2.0 * half) {
        const int    from = 0, to = t > 0 ? t : 1;
        const DpVec3 d =
            dp_sub(walker_com(l->gait, l->walker, to), walker_com(l->gait, l->walker, from));
        return dp_scale(d, l->rate / (double)(to - from));
    }
    DpVec3 x[3];
    for (int k = 0; k < 3; ++k) {
        // the parabola through the three samples around the time asked for
        const double when = (double)t - half * (double)k;
        int          mid = (int)floor(when + 0.5);
        mid = mid < 1 ? 1 : mid > t - 1 && t >= 2 ? t - 1 : mid;
        const double u = when - (double)mid;
        const DpVec3 a = walker_com(l->gait, l->walker, mid - 1);
        const DpVec3 b = walker_com(l->gait, l->walker, mid);
        const DpVec3 c = walker_com(l->gait, l->walker, mid + 1);
        x[k] = dp_add(dp_add(dp_scale(a, u * (u - 1.0) / 2.0), dp_scale(b, 1.0 - u * u)),
                      dp_scale(c, u * (u + 1.0) / 2.0));
    }
    const DpVec3 d = dp_add(dp_sub(dp_scale(x[0], 3.0), dp_scale(x[1], 4.0)), x[2]);
    return dp_scale(d, l->rate / (2.0 * half));
}

// J / tau of the limb at a sample, for a mass of 1. TRAIL (3), SOFT22 (6)-(8)
static DpVec3 landing_push(const Load* l, int limb, int t)
{
    const double tau = l->options->settle_time;
    const double since = (double)(t - l->landed[limb]) / l->rate;
    if (l->landed[limb] < 0 || since > tau - 0.5 / l->rate) return dp_vec3(0.0, 0.0, 0.0);
    const double now = dp_clamp((since + 0.5 / l->rate) / tau, 0.0, 1.0);
    const double shape = l->options->half_sine ? PI / 2.0 * sin(PI * now) : 1.0;
    return dp_scale(l->landing[limb], shape / tau);
}

// trust in the ramps: whole while somebody changes feet or is accelerated, none at rest
static double trust(const Load* l, const double* weight, const int* row, int count, int t, DpVec3 a)
{
    double change = dp_smoothstep(dp_length(a) / (STILL * DP_GRAVITY));
    for (int i = 0; i < count; ++i)
        change = fmax(change, 1.0 - weight[(size_t)row[i] * (size_t)l->gait->times + (size_t)t]);
    return l->options->ramp_trust * change;
}

// share a load among `count` supports, rows `row` of weight, centres `at`, so that it acts at target
static void share_out(const Load* l, const double* weight, const int* row, int count, int t,
                      DpVec3 accel, DpVec3 target, const DpVec3* at, double* share)
{
    const bool by_ramps = l->options->model == DP_LOAD_INERTIA;
    double     sum = 0.0;
    for (int i = 0; i < count; ++i) {
        share[i] = by_ramps ? weight[(size_t)row[i] * (size_t)l->gait->times + (size_t)t] : 1.0;
        sum += share[i];
    }
    for (int i = 0; i < count; ++i) share[i] /= sum;
    if (by_ramps)
        walker_share(share, at, count, target, trust(l, weight, row, count, t, accel),
                     l->options->reach);
    else if (count == 2) {
        const DpVec3 flat[2] = {dp_vec3(at[0].x, at[0].y, 0.0), dp_vec3(at[1].x, at[1].y, 0.0)};
        share[1] = dp_foot_share(dp_vec3(target.x, target.y, 0.0), flat[0], flat[1]);  // SOFT22 (5)
        share[0] = 1.0 - share[1];  // SOFT22 (4)
    } else
        walker_share(share, at, count, target, 0.0, l->options->reach);
}

enum { MOST = 64 };  // supports of one walker, or of one limb, that share at one time

// one limb's load to its touching parts
static void load_parts(const Load* l, int i, int t, DpVec3 force, DpVec3 accel, DpVec3 target,
                       const DpVec3* centre, double* out_force, double* out_point)
{
    const size_t times = (size_t)l->gait->times;
    int          row[MOST], count = 0;
    DpVec3       at[MOST];
    double       share[MOST];
    for (int p = l->first[i]; p < l->first[i + 1] && count < MOST; ++p)
        if (l->part_on[(size_t)p * times + (size_t)t]) at[count] = centre[p], row[count++] = p;
    share_out(l, l->part_weight, row, count, t, accel, target, at, share);
    for (int k = 0; k < count; ++k) {
        const size_t to = 3 * ((size_t)l->part[row[k]] * times + (size_t)t);
        out_force[to] = force.x * share[k];
        out_force[to + 1] = force.y * share[k];
        out_force[to + 2] = force.z * share[k];
        out_point[to] = at[k].x, out_point[to + 1] = at[k].y, out_point[to + 2] = at[k].z;
    }
}

static void load_sample(Load* l, int t, double* out_force, double* out_point)
{
    const size_t  times = (size_t)l->gait->times;
    const double  mass = l->gait->mass[l->walker];
    const bool    inertia = l->options->model == DP_LOAD_INERTIA;
    const DpVec3  com = walker_com(l->gait, l->walker, t);
    const double* a = l->accel + t;
    const DpVec3  accel = inertia ? dp_vec3(a[0], a[times], a[2 * times]) : dp_vec3(0.0, 0.0, 0.0);
    int           row[MOST], count = 0;
    DpVec3        at[MOST], middle = {0};
    double        share[MOST];
    DpVec3*       centre = l->at + l->limbs;
    for (int i = 0; i < l->limbs; ++i) {
        if (begins(l->limb_on + (size_t)i * times, t)) {
            l->landed[i] = t;
            l->landing[i] = latched_velocity(l, t - 1);
        }
        if (!l->limb_on[(size_t)i * times + (size_t)t] || count == MOST) continue;
        DpVec3 sum = {0};
        double weights = 0.0;
        for (int p = l->first[i]; p < l->first[i + 1]; ++p) {
            const double w = l->part_weight[(size_t)p * times + (size_t)t];
            if (!l->part_on[(size_t)p * times + (size_t)t]) continue;
            centre[p] = part_centre(l, l->part[p], t);
            sum = dp_add(sum, dp_scale(centre[p], w));
            weights += w;
        }
        at[count] = dp_scale(sum, 1.0 / weights);
        middle = dp_add(middle, at[count]);
        row[count++] = i;
    }
    if (count == 0) return;  // no touching limb means zero
    const double pull = accel.z + DP_GRAVITY;
    const double rise = com.z - middle.z / (double)count;
    DpVec3       zmp = com;  // zero-moment point; at rest, what lies below the mass centre
    zmp.x -= rise / fmax(pull, LEAST_PULL * DP_GRAVITY) * accel.x;
    zmp.y -= rise / fmax(pull, LEAST_PULL * DP_GRAVITY) * accel.y;
    share_out(l, l->limb_weight, row, count, t, accel, zmp, at, share);
    DpVec3 miss = zmp;  // what the limbs' centres leave to the parts
    for (int k = 0; k < count; ++k) miss = dp_sub(miss, dp_scale(at[k], share[k]));
    for (int k = 0; k < count; ++k) {
        DpVec3 force = dp_vec3(-accel.x, -accel.y, -pull);  // of a mass of 1, on the ground
        if (!inertia) force = dp_add(force, landing_push(l, row[k], t));  // TRAIL (3)
        // ground does not pull
        force = force.z < 0.0 ? dp_scale(force, mass * share[k]) : dp_vec3(0.0, 0.0, 0.0);
        load_parts(l, row[k], t, force, accel, dp_add(at[k], miss), centre, out_force, out_point);
    }
}

static bool options_ok(const DpLoadOptions* o)
{
    return o && o->settle_time > 0.0 && isfinite(o->settle_time) && o->cutoff_share > 0.0 &&
           o->cutoff_low > 0.0 && o->cutoff_high >= o->cutoff_low && o->overlap_most > 0.0 &&
           o->ramp_standing > 0.0 && o->ramp_alone > 0.0 && o->ramp_trust >= 0.0 && o->reach > 0.0 &&
           (o->model == DP_LOAD_INERTIA || o->model == DP_LOAD_IMPULSE);
}

DpStatus dp_foot_force(const DpGait* gait, const uint8_t* touching, const double* ground,
                       const DpLoadOptions* options, double* force, double* pressure_point)
{
    if (!walker_gait_ok(gait) || !touching || !ground || !force || !pressure_point)
        return DP_BAD_ARGUMENT;
    if (!options_ok(options)) return DP_BAD_ARGUMENT;
    Load l = {.gait = gait, .options = options, .ground = ground, .rate = walker_rate(gait)};
    if (gait->times > 1 && l.rate <= 0.0) return DP_BAD_ARGUMENT;
    if (gait->times == 1) l.rate = 1.0;
    if (!open_load(&l)) {
        close_load(&l);
        return DP_NO_MEMORY;
    }
    const size_t count = 3 * (size_t)gait->parts * (size_t)gait->times;
    for (size_t k = 0; k < count; ++k) force[k] = 0.0, pressure_point[k] = NAN;
    DpStatus status = DP_OK;
    for (int walker = 0; walker < gait->walkers && status == DP_OK; ++walker) {
        gather(&l, walker, touching);
        for (int i = 0; i < l.limbs; ++i) l.landed[i] = -1;
        status = accelerate(&l);
        for (int t = 0; t < gait->times && status == DP_OK; ++t)
            load_sample(&l, t, force, pressure_point);
    }
    close_load(&l);
    return status;
}
