// walker/gait_filter.c - smoothing without phase, and rates of change.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/vec.h"
#include "walker/walker_inside.h"

typedef struct Section
{
    double b0, b1, b2, a1, a2;
} Section;

// a 2nd-order Butterworth by the bilinear transform, its cut-off kept in place
static Section butterworth(double rate, double cutoff)
{
    const double  k = tan(DP_PI * cutoff / rate);
    const double  norm = 1.0 / (1.0 + sqrt(2.0) * k + k * k);
    const Section s = {k * k * norm, 2.0 * k * k * norm, k * k * norm, 2.0 * (k * k - 1.0) * norm,
                       (1.0 - sqrt(2.0) * k + k * k) * norm};
    return s;
}

// one pass in place, started as if the first value had always been there
static void pass(const Section* s, double* value, int count, int step)
{
    double* v = step > 0 ? value : value + count - 1;
    double  z1 = v[0] * (1.0 - s->b0);
    double  z2 = v[0] * (s->b2 - s->a2);
    for (int k = 0; k < count; ++k, v += step) {
        const double in = *v;
        const double out = s->b0 * in + z1;
        z1 = s->b1 * in - s->a1 * out + z2;
        z2 = s->b2 * in - s->a2 * out;
        *v = out;
    }
}

// how far the signal is continued beyond each end: three periods of the cut-off, if it is that long
static int padding(int count, double rate, double cutoff)
{
    const double wanted = 3.0 * rate / cutoff;
    return wanted < (double)(count - 1) ? (int)wanted : count - 1;
}

static bool smooths(int count, double rate, double cutoff)
{
    return count >= 3 && cutoff > 0.0 && cutoff < 0.45 * rate;
}

size_t dp_walker_low_pass_scratch(int count, double rate, double cutoff)
{
    if (!smooths(count, rate, cutoff)) return 1;
    return (size_t)count + 2 * (size_t)padding(count, rate, cutoff);
}

void dp_walker_low_pass(double* value, int count, double rate, double cutoff, double* scratch)
{
    if (!smooths(count, rate, cutoff)) return;
    const int     pad = padding(count, rate, cutoff);
    const Section s = butterworth(rate, cutoff);
    // turned about the end points: a motion that is under way stays under way
    for (int k = 1; k <= pad; ++k) {
        scratch[pad - k] = 2.0 * value[0] - value[k];
        scratch[pad + count - 1 + k] = 2.0 * value[count - 1] - value[count - 1 - k];
    }
    memcpy(scratch + pad, value, (size_t)count * sizeof *value);
    pass(&s, scratch, count + 2 * pad, 1);
    pass(&s, scratch, count + 2 * pad, -1);
    memcpy(value, scratch + pad, (size_t)count * sizeof *value);
}

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

void dp_walker_sort(double* value, size_t count)
{
    qsort(value, count, sizeof *value, by_value);
}

double dp_walker_median(double* value, size_t count)
{
    dp_walker_sort(value, count);
    return value[count / 2];
}

double dp_walker_velocity(const double* value, int count, int at, double rate)
{
    if (count < 2) return 0.0;
    const int before = at > 0 ? at - 1 : at, after = at < count - 1 ? at + 1 : at;
    return (value[after] - value[before]) * rate / (double)(after - before);
}

double dp_walker_acceleration(const double* value, int count, int at, double rate)
{
    if (count < 3) return 0.0;
    const int mid = at < 1 ? 1 : at > count - 2 ? count - 2 : at;
    return (value[mid + 1] - 2.0 * value[mid] + value[mid - 1]) * rate * rate;
}

double dp_walker_rate(const DpGait* gait)
{
    if (gait->times < 2) return 0.0;
    const double lasts = gait->time[gait->times - 1] - gait->time[0];
    const double step = lasts / (double)(gait->times - 1);
    if (!(step > 0.0) || !isfinite(step)) return 0.0;
    for (int k = 1; k < gait->times; ++k)
        if (!(fabs(gait->time[k] - gait->time[k - 1] - step) < 1e-3 * step)) return 0.0;
    return 1.0 / step;
}

static bool all_finite(const double* value, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (!isfinite(value[k])) return false;
    return true;
}

static bool owners_ok(const int32_t* owner, int count, int owners)
{
    for (int k = 0; k < count; ++k)
        if (owner[k] < 0 || owner[k] >= owners) return false;
    return true;
}

bool dp_walker_gait_ok(const DpGait* gait)
{
    if (!gait || gait->times < 1 || gait->walkers < 1 || gait->limbs < 1 || gait->parts < 1)
        return false;
    if (gait->points < 1 || !gait->time || !gait->com || !gait->mass || !gait->pose) return false;
    if (!gait->limb_walker || !gait->part_limb || !gait->point || !gait->point_part) return false;
    if (!gait->point_role) return false;
    const size_t times = (size_t)gait->times;
    for (int w = 0; w < gait->walkers; ++w)
        if (!(gait->mass[w] > 0.0) || !isfinite(gait->mass[w])) return false;
    return owners_ok(gait->limb_walker, gait->limbs, gait->walkers) &&
           owners_ok(gait->part_limb, gait->parts, gait->limbs) &&
           owners_ok(gait->point_part, gait->points, gait->parts) &&
           owners_ok(gait->point_role, gait->points, 3) && all_finite(gait->time, times) &&
           all_finite(gait->com, 3 * times * (size_t)gait->walkers) &&
           all_finite(gait->pose, 7 * times * (size_t)gait->parts) &&
           all_finite(gait->point, 3 * (size_t)gait->points);
}
