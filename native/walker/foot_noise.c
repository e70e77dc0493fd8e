// walker/foot_noise.c - how sharp a landing may be: what flights tell of a recording's noise. MODEL 4.3
//
// Who flies falls freely, whatever was recorded. What the recorded mass centre strays from its
// parabola is noise: of cameras, of skin, of a mass centre that is not quite the body's. A smoothing
// that takes more than this from a stance takes some of the stance, the knock of a landing first. So
// the cut-off rises until no more than noise is taken (Morozov's discrepancy principle), as far as
// the frames can show it. Flights of a run are too short to tell: what a line fits in them is not
// seen, and slow noise is nearly a line.
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "walker/walker_inside.h"

#define UNSURE 0.01  // flights are free of force so far from their edges ..           [s]
#define FRAMES 1.5   // .. and so many frames, as those between are made of both sides [-]
#define TELLS 3.0  // a flight of T tells 2 T cutoff numbers; a line takes two, this many are enough
#define NYQUIST 0.45  // share of the frame rate up to which frames show a change       [-]
#define ROUNDS 8      // the range of cut-offs is halved so often

// sum of the squares of what a mass centre strays from free fall in a flight [m^2]
static double strayed(const double* height, int first, int end, double rate)
{
    const double n = (double)(end - first), middle = (n - 1.0) / 2.0;
    double       mean = 0.0, slope = 0.0, moment = 0.0, sum = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int t = first; t < end; ++t) {
            const double x = (double)(t - first) - middle, since = x / rate;
            const double y = height[t] - height[first] +
                             0.5 * DP_GRAVITY * since * since;  // a line, but for noise
            if (pass == 0)
                mean += y / n, slope += x * y, moment += x * x;
            else
                sum += (y - mean - slope * x) * (y - mean - slope * x);
        }
        if (pass == 0 && moment > 0.0) slope /= moment;
    }
    return sum;
}

// root mean square of the noise that flights show, faster than `cutoff` or not much slower [m];
// infinite where all are too short to tell
static double flight_noise(const double* height, const uint8_t* air, int times, double rate,
                           double frame, double cutoff)
{
    const int aside = (int)ceil(fmax(UNSURE, FRAMES * frame) * rate);
    double    sum = 0.0, count = 0.0;
    for (int t = 0; t < times;) {
        int end = t;
        while (end < times && air[end]) ++end;
        const int    first = t + aside, last = end - aside;
        const double tells = 2.0 * cutoff * (double)(last - first) / rate;
        if (tells > TELLS) {
            sum += strayed(height, first, last, rate) / (double)(last - first) * tells;
            count += tells - 2.0;
        }
        t = end > t ? end : t + 1;
    }
    return count > 0.0 ? sqrt(sum / count) : INFINITY;
}

// root mean square of what a smoothing takes away where the ground carries [m]
static double taken(const double* height, const uint8_t* air, int times, double rate, double cutoff,
                    double* smooth, double* scratch)
{
    double sum = 0.0, count = 0.0;
    memcpy(smooth, height, (size_t)times * sizeof *smooth);
    dp_walker_fly(smooth, air, times, rate, cutoff, -DP_GRAVITY, scratch);
    for (int t = 0; t < times; ++t) {
        if (air[t]) continue;
        sum += (height[t] - smooth[t]) * (height[t] - smooth[t]), count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

double dp_walker_sharpest(const double* height, const uint8_t* air, int times, double rate,
                          double cutoff, const DpLoadOptions* options, double* smooth,
                          double* scratch)
{
    const double shown =
        options->frame_time > 0.0 ? NYQUIST / options->frame_time : options->cutoff_knock;
    double low = cutoff, high = fmin(options->cutoff_knock, shown);
    if (!(high > low)) return cutoff;
    const double noise = flight_noise(height, air, times, rate, options->frame_time, cutoff);
    const double may = options->noise_share * noise;
    if (!isfinite(noise) || taken(height, air, times, rate, low, smooth, scratch) <= may)
        return low;
    if (taken(height, air, times, rate, high, smooth, scratch) > may) return high;
    for (int k = 0; k < ROUNDS; ++k) {
        const double middle = sqrt(low * high);
        if (taken(height, air, times, rate, middle, smooth, scratch) > may)
            low = middle;
        else
            high = middle;
    }
    return sqrt(low * high);
}
