// walker/foot_share.c - who carries how much: ramps and the zero-moment point. SOFT22 (5), MODEL 4.3
//
// Departures
//   SOFT22 (4): as printed weight has no time in which it goes from foot to foot. Ramps are even, not
//   eased: contacts are timed by where the ground stops a foot and lets it go (foot_edge.c), and a
//   heel is stiff and takes its load at once. test_foot_force.c, ramps_ease_from_foot_to_foot.
#include <math.h>

#include "base/assert.h"
#include "base/vec.h"
#include "walker/walker_inside.h"

#define MAX_SWEEPS 400
#define CLOSE_ENOUGH 1e-12

double dp_foot_share(DpVec3 com, DpVec3 left, DpVec3 right)
{
    const DpVec3 across = dp_sub(right, left);
    const double square = dp_dot(across, across);
    if (!(square > 0.0)) return 0.5;
    return dp_clamp(dp_dot(dp_sub(com, left), across) / square, 0.0, 1.0);  // SOFT22 (5)
}

// mean square distance between the supports, weighted by what the ramps give them; for two, L
static double spread(const double* s, const DpVec3* at, int count)
{
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j) {
            const DpVec3 d = dp_sub(at[i], at[j]);
            const double both = s[i] * s[j];
            sum += both * (d.x * d.x + d.y * d.y);
            weight += both;
        }
    return weight > 0.0 ? sum / weight : 0.0;
}

// Each pair trades weight until nobody gains: for two supports that is the closed form
//   a = (mu s + 2 lambda q a*) / (mu + 2 lambda q),  q = s (1 - s),  a* = SOFT22 (5).
void dp_walker_share(double* share, const DpVec3* at, int count, DpVec3 target, double mu,
                     double support_span)
{
    enum
    {
        MAX_SUPPORTS = 64
    };  // more supports than that keep their ramps
    if (count < 2 || count > MAX_SUPPORTS) return;
    const double square = spread(share, at, count);
    if (!(square > 1e-12)) return;
    const double lambda = square / (square + support_span * support_span) / square;
    double       pull[MAX_SUPPORTS];  // mu / (4 s (1 - s)): how hard a ramp holds its share
    double       held[MAX_SUPPORTS];
    DpVec3       miss = dp_vec3(-target.x, -target.y, 0.0);  // sum a_i p_i - target
    for (int i = 0; i < count; ++i) {
        held[i] = share[i];
        pull[i] = mu / fmax(4.0 * share[i] * (1.0 - share[i]), 1e-9) + 1e-9;
        miss = dp_add(miss, dp_scale(dp_vec3(at[i].x, at[i].y, 0.0), share[i]));
    }
    for (int sweep = 0; sweep < MAX_SWEEPS; ++sweep) {
        double largest = 0.0;
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < i; ++j) {
                // whom the ramps give nothing gets nothing
                if (held[i] <= 0.0 || held[j] <= 0.0) continue;
                const DpVec3 d = dp_vec3(at[i].x - at[j].x, at[i].y - at[j].y, 0.0);
                const double slope = pull[i] * (share[i] - held[i]) -
                                     pull[j] * (share[j] - held[j]) + lambda * dp_dot(d, miss);
                const double curve = pull[i] + pull[j] + lambda * dp_dot(d, d);
                const double give = dp_clamp(-slope / curve, -share[i], share[j]);
                share[i] += give, share[j] -= give;
                miss = dp_add(miss, dp_scale(d, give));
                largest = fmax(largest, fabs(give));
            }
        if (largest < CLOSE_ENOUGH) break;
    }
}

// ---- ramps --------------------------------------------------------------------------------------

// first sample after t at which the support's state has changed, or `times`, the search's end
static int run_end(const uint8_t* on, int times, int t)
{
    const uint8_t state = on[t];
    while (t < times && on[t] == state) ++t;
    return t;
}

// first sample of the run that holds t, or `first`, the search's end
static int run_begin(const uint8_t* on, int first, int t)
{
    const uint8_t state = on[t];
    while (t > first && on[t - 1] == state) --t;
    return t;
}

// Ramp of a support that relieves none. Two that land together, or let go, never do so at quite the
// same sample: the nearer the other's edge, the more it is the ramp of both.
static double alone_time(const uint8_t* touching, int count, int times, int self, int t,
                         bool begins, double rate, const DpLoadOptions* options)
{
    double apart = options->ramp_standing;
    for (int other = 0; other < count; ++other) {
        if (other == self) continue;
        const uint8_t* on = touching + (size_t)other * (size_t)times;
        for (int k = 1; (double)k < apart * rate; ++k) {
            const int at = begins ? t + k : t - k;
            if (at < 0 || at >= times) break;
            if (on[at]) apart = (double)k / rate;
        }
    }
    return options->ramp_standing -
           (options->ramp_standing - options->ramp_alone) * apart / options->ramp_standing;
}

// Time over which a support that begins (or ends) at sample t changes weight with the others: the
// shortest overlap with one that it relieves (or that relieves it). Only its own run is searched:
// who taps beside one that stands for hours costs no more than the taps.
static double ramp_time(const uint8_t* touching, int count, int times, int self, int t, bool begins,
                        double rate, const DpLoadOptions* options, bool rolls)
{
    const size_t row = (size_t)times;
    const int    own_end = run_end(touching + (size_t)self * row, times, t);
    const int    own_begin = run_begin(touching + (size_t)self * row, 0, t);
    bool         company = false;
    double       shortest = INFINITY;
    for (int other = 0; other < count; ++other) {
        const uint8_t* on = touching + (size_t)other * row;
        if (other == self || !on[t]) continue;
        company = true;
        if (begins && on[t - 1]) {
            const int end = run_end(on, own_end, t);
            if (end < own_end) shortest = fmin(shortest, (double)(end - t));
        }
        if (!begins && on[t + 1]) {
            const int begin = run_begin(on, own_begin, t);
            if (begin > own_begin) shortest = fmin(shortest, (double)(t + 1 - begin));
        }
    }
    if (!company) return alone_time(touching, count, times, self, t, begins, rate, options);
    const double overlap = shortest / rate;
    return rolls && company && isfinite(overlap) ? overlap
           : overlap < options->max_overlap      ? overlap
                                                 : options->ramp_standing;
}

void dp_walker_ramps(const uint8_t* touching, int count, int times, double rate,
                     const DpLoadOptions* options, bool rolls, double* weight)
{
    for (int i = 0; i < count; ++i) {
        const uint8_t* on = touching + (size_t)i * (size_t)times;
        double*        w = weight + (size_t)i * (size_t)times;
        for (int t = 0; t < times;) {
            const int end = run_end(on, times, t);
            if (!on[t]) {
                for (; t < end; ++t) w[t] = 0.0;
                continue;
            }
            // a stance cut by the clip's ends was there before and stays after
            const double up =
                t > 0 ? ramp_time(touching, count, times, i, t, true, rate, options, rolls) : 0.0;
            const double down = end < times ? ramp_time(touching, count, times, i, end - 1, false,
                                                        rate, options, rolls)
                                            : 0.0;
            for (int s = t; s < end; ++s) {
                const double since = ((double)(s - t) + 0.5) / rate;
                const double left = ((double)(end - s) - 0.5) / rate;
                w[s] = fmin(up > 0.0 ? dp_clamp(since / up, 0.0, 1.0) : 1.0,
                            down > 0.0 ? dp_clamp(left / down, 0.0, 1.0) : 1.0);
            }
            t = end;
        }
    }
}
