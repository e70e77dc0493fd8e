// walker/foot_force.c - how hard every part presses. TRAIL (3), SOFT22 (3)-(8), MODEL 4.3.
//
//   touching ---ramps---> s_i ---zero-moment point---> a_i ---m (g - a_com)---> force of each limb
//                                                                    \--same rule--> of each part
//
// Departures
//   TRAIL (3): `inertia` replaces weight and landing impulse by Newton's law for the whole body, so
//   that runs, jumps and push-offs carry what they really carry. test_foot_force.c,
//   jump_weighs_right.
//   SOFT22 (5): the denominator is |p_R - p_L|^2; see dp_foot_share.
//   TRAIL (3): v(t0 - dt) does not depend on the frame rate; see foot_landing.c.
//   MODEL 4.3, step 2: mu is whole only while feet change or the force leans along the line between
//   them, and none at rest; see doubtful(). tests/core/test_trials.py, squats.
#include <math.h>

#include "base/vec.h"
#include "walker/foot_load.h"

#define MIN_PULL 0.2  // a_z + g counts as no less than this share of g   [-]
#define STILL 0.1     // accelerations below this share of g are near rest [-]
#define THROWN 2.0    // accelerations upward of so many g turn the body too   [-]
#define TRAVEL 0.5    // who moves this fast is under way                  [m/s]
#define GRIP 0.6      // feet oppose each other by no more of their load   [-]

#define MAX_SUPPORTS 64  // limbs of a walker, or points of a limb, that share at one time

// ---- landing -------------------------------------------------------------------------------------

static bool begins(const uint8_t* on, int t)
{
    return t > 0 && on[t] && !on[t - 1];
}

static bool is_heel(const DpLoad* l, int k)
{
    return l->gait->point_role[l->point[k]] == DP_POINT_HEEL;
}

// The limb lands: with its heel, with its toe, or with both, as one foot. TRAIL (4)
static void land(DpLoad* l, int i, int t)
{
    const size_t times = (size_t)l->gait->times;
    const int    first = l->first[i], end = l->first[i + 1];
    bool         heel = false, toe = false;
    int          point[MAX_SUPPORTS];
    DpLanding    landing = {.point = point};
    l->tau[i] = l->options->settle_time;
    for (int k = first; k < end; ++k) {
        if (!l->point_on[(size_t)k * times + (size_t)t]) continue;
        *(is_heel(l, k) ? &heel : &toe) = true;
        if (l->options->settle)
            l->tau[i] = l->options->settle[(size_t)l->point[k] * times + (size_t)t];
    }
    for (int k = first; k < end && landing.count < MAX_SUPPORTS; ++k)
        if ((heel && toe) || is_heel(l, k) == heel) point[landing.count++] = l->point[k];
    l->landed[i] = t;
    l->landing[i] =
        dp_walker_landing_velocity(l->gait, &landing, l->limb_on, l->limbs, l->rate, t - 1);
}

// J / tau of the limb at a sample, for a mass of 1. TRAIL (3), SOFT22 (6)-(8)
static DpVec3 landing_push(const DpLoad* l, int limb, int t)
{
    const double tau = l->tau[limb];
    const double since = (double)(t - l->landed[limb]) / l->rate;
    if (l->landed[limb] < 0 || since > tau - 0.5 / l->rate) return dp_vec3(0.0, 0.0, 0.0);
    const double now = dp_clamp((since + 0.5 / l->rate) / tau, 0.0, 1.0);
    const double shape = l->options->half_sine ? DP_PI / 2.0 * sin(DP_PI * now) : 1.0;
    return dp_scale(l->landing[limb], shape / tau);
}

// ---- sharing -------------------------------------------------------------------------------------

// those among which a load is shared at one sample
typedef struct Supports
{
    int    count;
    int    index[MAX_SUPPORTS];
    DpVec3 at[MAX_SUPPORTS];      // centre of contact
    double weight[MAX_SUPPORTS];  // W_i
    double share[MAX_SUPPORTS];   // in: what the ramps give, not yet summing to 1; out: a_i
} Supports;

// trust in the ramps: whole while somebody changes feet or is accelerated, none at rest
static double trust(const DpLoad* l, const Supports* s, DpVec3 accel)
{
    double change = dp_smoothstep(dp_length(accel) / (STILL * DP_GRAVITY));
    for (int i = 0; i < s->count; ++i) change = fmax(change, 1.0 - s->weight[i]);
    return l->options->ramp_trust * change;
}

// Of an acceleration what makes the zero-moment point of two limbs doubtful, in its own terms: that
// along the line between them, as far as it leans the force; not that across, which leans on
// neither, and little of that upward, which presses both alike until the whole body turns with it.
static DpVec3 doubtful(const Supports* s, DpVec3 accel, double pull)
{
    if (s->count != 2) return accel;
    const DpVec3 line = dp_sub(s->at[1], s->at[0]);
    const DpVec3 line_of_feet = dp_unit(dp_vec3(line.x, line.y, 0.0));
    const double lean =
        dp_dot(accel, line_of_feet) * DP_GRAVITY / fmax(pull, MIN_PULL * DP_GRAVITY);
    return dp_add(dp_scale(line_of_feet, lean), dp_vec3(0.0, 0.0, STILL / THROWN * accel.z));
}

static void share_out(const DpLoad* l, Supports* s, DpVec3 accel, DpVec3 target)
{
    const bool by_ramps = l->options->model == DP_LOAD_INERTIA;
    double     sum = 0.0;
    for (int i = 0; i < s->count; ++i) {
        if (!by_ramps) s->share[i] = 1.0;
        sum += s->share[i];
    }
    for (int i = 0; i < s->count; ++i) s->share[i] /= sum;
    if (by_ramps)
        dp_walker_share(s->share, s->at, s->count, target, trust(l, s, accel),
                        l->options->support_span);
    else if (s->count == 2) {
        const DpVec3 a = dp_vec3(s->at[0].x, s->at[0].y, 0.0),
                     b = dp_vec3(s->at[1].x, s->at[1].y, 0.0);
        s->share[1] = dp_foot_share(dp_vec3(target.x, target.y, 0.0), a, b);  // SOFT22 (5)
        s->share[0] = 1.0 - s->share[1];                                      // SOFT22 (4)
    } else
        dp_walker_share(s->share, s->at, s->count, target, 0.0, l->options->support_span);
}

static void add_support(Supports* s, int index, DpVec3 at, double weight, double capacity)
{
    if (s->count == MAX_SUPPORTS) return;
    s->index[s->count] = index, s->at[s->count] = at, s->weight[s->count] = weight;
    s->share[s->count++] = weight * capacity;
}

static void limb_points(const DpLoad* l, Supports* s, int i, int t)
{
    s->count = 0;
    for (int k = l->first[i]; k < l->first[i + 1]; ++k) {
        const size_t at = (size_t)k * (size_t)l->gait->times + (size_t)t;
        if (l->point_on[at]) add_support(s, k, l->place[at], l->point_weight[at], l->capacity[k]);
    }
}

// one limb's load to its points, and theirs to the parts that carry them
static void load_parts(const DpLoad* l, int i, int t, DpVec3 force, DpVec3 accel, DpVec3 target,
                       double* out_force, double* out_point)
{
    const DpGait* gait = l->gait;
    Supports      s;
    limb_points(l, &s, i, t);
    share_out(l, &s, accel, target);
    for (int k = 0; k < s.count; ++k) {
        const int part = gait->point_part[l->point[s.index[k]]];
        double    sum = 0.0, even = 0.0;
        DpVec3    centre = {0}, middle = {0};
        bool      done = false;
        for (int j = 0; j < s.count; ++j) {
            if (gait->point_part[l->point[s.index[j]]] != part) continue;
            done = done || j < k;
            sum += s.share[j], even += 1.0;
            centre = dp_add(centre, dp_scale(s.at[j], s.share[j]));
            middle = dp_add(middle, s.at[j]);
        }
        if (done) continue;
        centre = sum > 1e-9 ? dp_scale(centre, 1.0 / sum) : dp_scale(middle, 1.0 / even);
        double* f = out_force + 3 * ((size_t)part * (size_t)gait->times + (size_t)t);
        double* p = out_point + 3 * ((size_t)part * (size_t)gait->times + (size_t)t);
        f[0] = force.x * sum, f[1] = force.y * sum, f[2] = force.z * sum;
        p[0] = centre.x, p[1] = centre.y, p[2] = centre.z;
    }
}

// Two feet under way push against each other: the one ahead brakes while the one behind drives,
// each along the line from its centre of pressure to the mass centre, so that neither turns the
// body over (Herr and Popovic 2008: walking keeps its angular momentum near zero). For a mass of 1;
// the sum is zero, so that Newton's law stays as it is. Sideways legs hang on hips as far apart as
// the feet, and with more than two legs each has a joint above it: none there.
static void oppose(const DpLoad* l, const Supports* limbs, int t, double pull, double height,
                   double* push)
{
    const DpVec3 v = dp_vec3(l->velocity[t], l->velocity[l->gait->times + t], 0.0);
    push[0] = push[1] = 0.0;
    if (l->limbs != 2 || limbs->count != 2 || !(height > 0.0) || !(dp_length(v) > 0.0)) return;
    const DpVec3 apart = dp_sub(limbs->at[1], limbs->at[0]);
    const double lever = dp_dot(apart, dp_unit(v)) / height;
    push[0] = -dp_smoothstep(dp_length(v) / TRAVEL) * fmax(pull, 0.0) * limbs->share[0] *
              limbs->share[1] * dp_clamp(lever, -GRIP, GRIP);
    push[1] = -push[0];
}

static void load_sample(DpLoad* l, int t, double* out_force, double* out_point)
{
    const size_t  times = (size_t)l->gait->times;
    const double  mass = l->gait->mass[l->walker];
    const bool    inertia = l->options->model == DP_LOAD_INERTIA;
    const DpVec3  com = dp_walker_com(l->gait, l->walker, t);
    const double* a = l->accel + t;
    const DpVec3  accel = inertia ? dp_vec3(a[0], a[times], a[2 * times]) : dp_vec3(0.0, 0.0, 0.0);
    Supports      limbs = {.count = 0}, points;
    double        low = 0.0;
    for (int i = 0; i < l->limbs; ++i) {
        const size_t at = (size_t)i * times + (size_t)t;
        if (begins(l->limb_on + (size_t)i * times, t)) land(l, i, t);
        if (!l->limb_on[at]) continue;
        limb_points(l, &points, i, t);
        DpVec3 centre = {0};
        double sum = 0.0;
        for (int k = 0; k < points.count; ++k) {
            centre = dp_add(centre, dp_scale(points.at[k], points.share[k]));
            sum += points.share[k];
        }
        centre = dp_scale(centre, 1.0 / sum);
        low += centre.z;
        add_support(&limbs, i, centre, l->limb_weight[at], 1.0);
    }
    if (limbs.count == 0) return;  // no touching limb means zero
    const double pull = accel.z + DP_GRAVITY;
    const double lever = (com.z - low / (double)limbs.count) / fmax(pull, MIN_PULL * DP_GRAVITY);
    // zero-moment point; at rest, what lies below the mass centre
    const DpVec3 zmp = dp_sub(com, dp_scale(dp_vec3(accel.x, accel.y, 0.0), lever));  // MODEL 4.3
    share_out(l, &limbs, doubtful(&limbs, accel, pull), zmp);
    DpVec3 miss = zmp;  // what the limbs' centres leave to their points
    for (int k = 0; k < limbs.count; ++k)
        miss = dp_sub(miss, dp_scale(limbs.at[k], limbs.share[k]));
    double push[2] = {0.0, 0.0};
    if (inertia) oppose(l, &limbs, t, pull, com.z - low / (double)limbs.count, push);
    const DpVec3 ahead = dp_unit(dp_vec3(l->velocity[t], l->velocity[times + (size_t)t], 0.0));
    for (int k = 0; k < limbs.count; ++k) {
        const int i = limbs.index[k];
        DpVec3    force = dp_vec3(-accel.x, -accel.y, -pull);  // of a mass of 1, on the ground
        if (!inertia) force = dp_add(force, landing_push(l, i, t));  // TRAIL (3)
        // ground does not pull
        force = force.z < 0.0 ? dp_scale(force, mass * limbs.share[k]) : dp_vec3(0.0, 0.0, 0.0);
        if (limbs.count == 2) force = dp_add(force, dp_scale(ahead, mass * push[k]));
        load_parts(l, i, t, force, accel, dp_add(limbs.at[k], miss), out_force, out_point);
    }
}

DpStatus dp_foot_force(const DpGait* gait, const uint8_t* touching, const double* ground,
                       const DpLoadOptions* options, double* force, double* pressure_point)
{
    if (!dp_walker_gait_ok(gait) || !touching || !ground || !force || !pressure_point)
        return DP_BAD_ARGUMENT;
    if (dp_load_options_check(options, NULL) != DP_OK) return DP_BAD_ARGUMENT;
    DpLoad l = {.gait = gait, .options = options, .ground = ground, .rate = dp_walker_rate(gait)};
    if (gait->times > 1 && l.rate <= 0.0) return DP_BAD_ARGUMENT;
    if (gait->times == 1) l.rate = 1.0;
    if (!dp_load_open(&l)) {
        dp_load_close(&l);
        return DP_NO_MEMORY;
    }
    const size_t count = 3 * (size_t)gait->parts * (size_t)gait->times;
    for (size_t k = 0; k < count; ++k) force[k] = 0.0, pressure_point[k] = NAN;
    DpStatus status = DP_OK;
    for (int walker = 0; walker < gait->walkers && status == DP_OK; ++walker) {
        dp_load_gather(&l, walker, touching);
        for (int i = 0; i < l.limbs; ++i) l.landed[i] = -1;
        status = dp_walker_accelerate(gait, walker, l.limb_on, l.limbs, l.rate, options, l.accel,
                                      l.velocity);
        for (int t = 0; t < gait->times && status == DP_OK; ++t)
            load_sample(&l, t, force, pressure_point);
    }
    dp_load_close(&l);
    return status;
}
