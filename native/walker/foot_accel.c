// walker/foot_accel.c - how the ground accelerates a body, low-passed by how often it steps.
//
// Departures
//   MODEL 4.3: upward a_com is low-passed at three step frequencies, since the force rises and falls
//   twice a step. Over the ground it changes less often, forward once a step (brake, drive) and
//   sideways once in two, so that two step frequencies hold it, and what lies above is the
//   recording's noise, which the zero-moment point would take for steps.
//   test_foot_force.c, level_noise_is_not_a_step.
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "walker/walker_inside.h"

#define MIN_STEP_TIME 0.15  // touch-downs closer than this are one step             [s]
#define FALL_SEEN 0.1       // a fall shows in the mass centre's path over this       [s]
#define FALLS 0.5           // who flies falls with this share of g at least          [-]

static bool begins(const uint8_t* on, int t)
{
    return t > 0 && on[t] && !on[t - 1];
}

// lower median time between touch-downs of one limb, of any limbs if none comes down twice; 0 if unknown
static double step_time(const uint8_t* limb_on, int limbs, int times, double rate, double* scratch)
{
    int count = 0;
    for (int i = 0; i < limbs; ++i) {
        const uint8_t* on = limb_on + (size_t)i * (size_t)times;
        int            last = -1;
        for (int t = 1; t < times; ++t) {
            if (!begins(on, t)) continue;
            if (last >= 0 && (double)(t - last) > MIN_STEP_TIME * rate && count < times)
                scratch[count++] = (double)(t - last) / rate / (limbs > 1 ? 2.0 : 1.0);
            last = t;
        }
    }
    if (count == 0) {
        int last = -1;
        for (int t = 1; t < times; ++t) {
            bool lands = false;
            for (int i = 0; i < limbs; ++i)
                lands = lands || begins(limb_on + (size_t)i * (size_t)times, t);
            if (!lands) continue;
            if (last >= 0 && (double)(t - last) > MIN_STEP_TIME * rate)
                scratch[count++] = (double)(t - last) / rate;
            last = t;
        }
    }
    if (count == 0) return 0.0;
    dp_walker_sort(scratch, (size_t)count);
    return scratch[(count - 1) / 2];  // of two the shorter: who waits between steps steps no slower
}

// where no limb touches; is that anywhere?
static bool in_air(const uint8_t* limb_on, int limbs, int times, uint8_t* air)
{
    bool any = false;
    for (int t = 0; t < times; ++t) {
        air[t] = 1;
        for (int i = 0; i < limbs; ++i)
            if (limb_on[(size_t)i * (size_t)times + (size_t)t]) air[t] = 0;
        any = any || air[t];
    }
    return any;
}

// twice the curvature of the parabola through equally spaced values: their acceleration
static double parabola(const double* value, int count, double rate)
{
    double sum = 0.0, square = 0.0;
    for (int k = 0; k < count; ++k) {
        // the second discrete Legendre polynomial, square to every line
        const double x = (double)k - (double)(count - 1) / 2.0;
        const double p = x * x - ((double)count * (double)count - 1.0) / 12.0;
        sum += p * value[k], square += p * p;
    }
    return square > 0.0 ? 2.0 * sum / square * rate * rate : 0.0;
}

// does the body fall over `span` samples around this one, all of them in the air?
static bool falls_at(const double* height, int first, int end, int t, int span, double rate)
{
    const int latest = end - span > first ? end - span : first;
    const int before = t - span / 2;
    const int from = before < first ? first : before > latest ? latest : before;
    const int count = end - from < span ? end - from : span;
    return parabola(height + from, count, rate) < -FALLS * DP_GRAVITY;
}

// Who stands on what the ground does not show, a box too high for his feet, touches nothing either
// and flies from where he begins to fall.
bool dp_walker_falls(uint8_t* air, const double* height, int times, double rate)
{
    const int span = (int)(FALL_SEEN * rate) + 1;
    bool      any = false;
    for (int t = 0; t < times;) {
        int end = t;
        while (end < times && air[end]) ++end;
        for (int k = t; k < end; ++k) {
            air[k] = falls_at(height, t, end, k, span, rate);
            any = any || air[k];
        }
        t = end > t ? end : t + 1;
    }
    return any;
}

static void read_line(const DpGait* gait, int walker, int c, double* line)
{
    for (int t = 0; t < gait->times; ++t) {
        const DpVec3 com = dp_walker_com(gait, walker, t);
        line[t] = c == 0 ? com.x : c == 1 ? com.y : com.z;
    }
}

DpStatus dp_walker_accelerate(const DpGait* gait, int walker, const uint8_t* limb_on, int limbs,
                              double rate, const DpLoadOptions* options, double* accel,
                              double* velocity)
{
    const int times = gait->times;
    double*   line = dp_alloc((size_t)times, sizeof(double));
    double*   scratch = dp_alloc(dp_walker_fly_scratch(times) + 8, sizeof(double));
    double*   smooth = dp_alloc((size_t)times, sizeof(double));
    uint8_t*  air = dp_alloc((size_t)times, 1);
    if (!line || !scratch || !air || !smooth) {
        dp_free(line), dp_free(scratch), dp_free(air), dp_free(smooth);
        return DP_NO_MEMORY;
    }
    const double step = step_time(limb_on, limbs, times, rate, line);
    bool         flies = in_air(limb_on, limbs, times, air);
    if (flies) {
        read_line(gait, walker, 2, line);
        flies = dp_walker_falls(air, line, times, rate);
    }
    const double steps = options->cutoff_share / step;  // infinite where no step is known
    // what falls is caught by knocks, however seldom it steps
    const double lowest = flies ? options->cutoff_flight : options->cutoff_low;
    double       up = step > 0.0 ? dp_clamp(steps, lowest, options->cutoff_high)
                      : flies    ? options->cutoff_high
                                 : options->cutoff_low;
    if (flies) up = dp_walker_sharpest(line, air, times, rate, up, options, smooth, scratch);
    // quick steps may need all of the upper bound over the ground too
    const double level = step > 0.0 ? fmin(options->cutoff_level * fmax(steps, options->cutoff_low),
                                           options->cutoff_high)
                                    : options->cutoff_level * up;
    for (int c = 2; c >= 0; --c) {
        const double cutoff = c < 2 ? level : up;
        read_line(gait, walker, c, line);
        if (flies)
            dp_walker_fly(line, air, times, rate, cutoff, c == 2 ? -DP_GRAVITY : 0.0, scratch);
        else
            dp_walker_low_pass(line, times, rate, cutoff, scratch);
        for (int t = 0; t < times; ++t) {
            accel[c * times + t] = dp_walker_acceleration(line, times, t, rate);
            if (c < 2) velocity[c * times + t] = dp_walker_velocity(line, times, t, rate);
        }
    }
    dp_free(line), dp_free(scratch), dp_free(air), dp_free(smooth);
    return DP_OK;
}
