// walker/gait_resample.c - a recording at another rate. MODEL 3.2
//
// Positions follow a cubic through their neighbours, and so do rotations, in the turn from the
// sample before.
//
// Departures
//   MODEL 3.2: a slerp changes a foot's spin at frames only, and with 24 of them in a second its ball
//   is lifted hardest at a frame, not when it leaves the ground.
//   test_gait_resample.c, turns_without_a_jerk_at_frames.
#include <math.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define FARTHEST 2.5  // turns of more than this, of the half circle there is, are slerped [rad]

int dp_gait_resample_count(double first, double last, double rate)
{
    if (!(last >= first) || !(rate > 0.0)) return 0;
    const double steps = floor((last - first) * rate + 1e-6);
    return steps < 2147483646.0 ? (int)steps + 1 : 0;
}

// weights with which the samples near `at` give the slope there: the slope of the polynomial
// through up to five of them. Returns the first one's index, count in *used.
static int slope_weights(const double* time, int count, int at, double weight[5], int* used)
{
    const int n = count < 5 ? count : 5;
    int       from = at - n / 2;
    if (from < 0) from = 0;
    if (from > count - n) from = count - n;
    for (int a = 0; a < n; ++a) {
        const double t = time[at], ta = time[from + a];
        double       w = 0.0;
        if (from + a == at) {
            for (int b = 0; b < n; ++b)
                if (b != a) w += 1.0 / (t - time[from + b]);
        } else {
            w = 1.0 / (ta - t);
            for (int b = 0; b < n; ++b)
                if (b != a && from + b != at) w *= (t - time[from + b]) / (ta - time[from + b]);
        }
        weight[a] = w;
    }
    *used = n;
    return from;
}

// Everything that depends on time alone, for one new sample between old ones i and i + 1.
typedef struct Between
{
    int    i;          // the old sample before
    double u;          // 0 at i, 1 at i + 1
    double step;       // time from i to i + 1 [s]
    int    from0, n0;  // samples that give the slope at i
    int    from1, n1;  // and at i + 1
    double w0[5], w1[5];
} Between;

static double cubic(const Between* b, const double* value, int stride)
{
    double slope0 = 0.0, slope1 = 0.0;
    for (int k = 0; k < b->n0; ++k)
        slope0 += b->w0[k] * value[(size_t)(b->from0 + k) * (size_t)stride];
    for (int k = 0; k < b->n1; ++k)
        slope1 += b->w1[k] * value[(size_t)(b->from1 + k) * (size_t)stride];
    const double p0 = value[(size_t)b->i * (size_t)stride];
    const double p1 = value[(size_t)(b->i + 1) * (size_t)stride];
    const double u = b->u, u2 = u * u, u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * p0 + (u3 - 2.0 * u2 + u) * b->step * slope0 +
           (3.0 * u2 - 2.0 * u3) * p1 + (u3 - u2) * b->step * slope1;
}

// the shortest turn from a to b, as an axis in the frame of a times its angle [rad]
static DpVec3 turn_to(DpQuat a, DpQuat b)
{
    const DpQuat q = dp_quat_product(dp_quat_back(a), b);
    const double sign = q.w < 0.0 ? -1.0 : 1.0;
    const DpVec3 v = dp_vec3(sign * q.x, sign * q.y, sign * q.z);
    const double s = dp_length(v);
    return dp_scale(v, s > 1e-9 ? 2.0 * atan2(s, sign * q.w) / s : 2.0);
}

static DpQuat turned(const double* pose, int at)
{
    const double* p = pose + 7 * (size_t)at;
    return (DpQuat){p[3], p[4], p[5], p[6]};
}

// Spin at an old sample, in its own frame, from the turns to those near it [rad/s]. False where one
// turns so far that its way is not told by where it ends.
static bool spin_at(DpVec3* spin, const double* pose, int at, int from, int count, const double* w)
{
    *spin = dp_vec3(0.0, 0.0, 0.0);
    for (int k = 0; k < count; ++k) {
        const DpVec3 turn = turn_to(turned(pose, at), turned(pose, from + k));
        if (dp_length(turn) > FARTHEST) return false;
        *spin = dp_add(*spin, dp_scale(turn, w[k]));
    }
    return true;
}

// how fast a turn changes that has come to `turn` when the part spins in its own frame
static DpVec3 change_of(DpVec3 turn, DpVec3 spin)
{
    const double angle = dp_length(turn);
    const double far =
        angle < 1e-3 ? 1.0 / 12.0 : (1.0 - 0.5 * angle / tan(0.5 * angle)) / (angle * angle);
    const DpVec3 across = dp_cross(turn, spin);
    return dp_add(dp_add(spin, dp_scale(across, 0.5)), dp_scale(dp_cross(turn, across), far));
}

static DpQuat cubic_turn(const Between* b, const double* pose)
{
    const DpQuat q0 = turned(pose, b->i), q1 = turned(pose, b->i + 1);
    DpVec3       spin0, spin1;
    if (!spin_at(&spin0, pose, b->i, b->from0, b->n0, b->w0) ||
        !spin_at(&spin1, pose, b->i + 1, b->from1, b->n1, b->w1))
        return dp_slerp(q0, q1, b->u);
    const DpVec3 total_turn = turn_to(q0, q1);
    const double u = b->u, u2 = u * u, u3 = u2 * u;
    DpVec3       turn = dp_scale(total_turn, 3.0 * u2 - 2.0 * u3);
    turn = dp_add(turn, dp_scale(spin0, (u3 - 2.0 * u2 + u) * b->step));
    turn = dp_add(turn, dp_scale(change_of(total_turn, spin1), (u3 - u2) * b->step));
    const double angle = dp_length(turn);
    return angle > 1e-12 ? dp_quat_product(q0, dp_quat_about(dp_unit(turn), angle)) : q0;
}

static void fill_pose(double* out, const Between* b, const double* pose)
{
    for (int c = 0; c < 3; ++c) out[c] = cubic(b, pose + c, 7);
    const DpQuat q = cubic_turn(b, pose);
    out[3] = q.w, out[4] = q.x, out[5] = q.y, out[6] = q.z;
}

DpStatus dp_gait_resample(const DpGait* gait, double rate, int count, double* time, double* com,
                          double* pose)
{
    if (!gait || gait->times < 1 || gait->walkers < 0 || gait->parts < 0) return DP_BAD_ARGUMENT;
    if (!gait->time || !time || !isfinite(rate)) return DP_BAD_ARGUMENT;
    const int    times = gait->times;
    const double first = gait->time[0], last = gait->time[times - 1];
    if (count < 1 || count != dp_gait_resample_count(first, last, rate)) return DP_BAD_ARGUMENT;
    for (int k = 1; k < times; ++k)
        if (!(gait->time[k] > gait->time[k - 1])) return DP_BAD_ARGUMENT;

    int i = 0;
    for (int k = 0; k < count; ++k) {
        double t = first + (double)k / rate;
        if (t > last) t = last;  // the last one may lie a rounding beyond
        time[k] = t;
        while (i < times - 2 && gait->time[i + 1] <= t) ++i;
        if (times == 1) {
            for (int w = 0; w < gait->walkers; ++w)
                for (int c = 0; c < 3; ++c) com[3 * (w * count + k) + c] = gait->com[3 * w + c];
            for (int p = 0; p < gait->parts; ++p)
                for (int c = 0; c < 7; ++c) pose[7 * (p * count + k) + c] = gait->pose[7 * p + c];
            continue;
        }
        Between b = {.i = i, .step = gait->time[i + 1] - gait->time[i]};
        b.u = dp_clamp((t - gait->time[i]) / b.step, 0.0, 1.0);
        b.from0 = slope_weights(gait->time, times, i, b.w0, &b.n0);
        b.from1 = slope_weights(gait->time, times, i + 1, b.w1, &b.n1);
        for (int w = 0; w < gait->walkers; ++w)
            for (int c = 0; c < 3; ++c)
                com[3 * ((size_t)w * (size_t)count + (size_t)k) + (size_t)c] =
                    cubic(&b, gait->com + 3 * (size_t)w * (size_t)times + c, 3);
        for (int p = 0; p < gait->parts; ++p)
            fill_pose(pose + 7 * ((size_t)p * (size_t)count + (size_t)k), &b,
                      gait->pose + 7 * (size_t)p * (size_t)times);
    }
    return DP_OK;
}
