// How sharp a landing may be smoothed: as its flight tells of noise.
#include "check.h"
#include "walker/walker.h"
#include "walker/walker_inside.h"

#define RATE 240.0
#define FLOOR 8.0  // the cut-off it begins with [Hz]

enum
{
    FALLS = 72,  // 0.3 s, after as long a time on a box
    N = 4 * FALLS
};

// the cut-off of a fall from a box, stopped by a knock, seen with so much noise of 5 to 9 Hz
static double sharpest(int falls, double noise, DpLoadOptions options)
{
    static uint8_t air[N];
    static double  height[N], smooth[N];
    double*        scratch = dp_alloc(dp_walker_fly_scratch(N), sizeof(double));
    const double   speed = DP_GRAVITY * falls / RATE;
    double         z = 1.5, v = 0.0;
    for (int t = 0; t < N; ++t) {
        const double since = ((double)(t - FALLS - falls) + 0.5) / RATE;
        const double knock =
            since > 0.0 ? speed * since / 9e-4 * exp(-0.5 * since * since / 9e-4) : 0.0;
        air[t] = t >= FALLS && since < 0.0;
        height[t] =
            z + noise * (sin(2.0 * 3.1416 * 5.3 * t / RATE) + sin(2.0 * 3.1416 * 8.7 * t / RATE));
        v += (air[t] ? -DP_GRAVITY : knock) / RATE;
        z += v / RATE;
    }
    const double found = dp_walker_sharpest(height, air, N, RATE, FLOOR, &options, smooth, scratch);
    dp_free(scratch);
    return found;
}

TEST(knocks_stay_where_flights_show_no_noise)
{
    CHECK(sharpest(FALLS, 0.0, dp_load_options_default()) > 14.0);
}

TEST(a_noisy_recording_is_smoothed_as_ever)
{
    CHECK_NEAR(sharpest(FALLS, 1e-3, dp_load_options_default()), FLOOR, 0.0);
}

TEST(little_noise_takes_little)
{
    double last = 1e9;
    for (double noise = 1e-5; noise < 1.3e-3; noise *= 2.0) {
        const double now = sharpest(FALLS, noise, dp_load_options_default());
        CHECK(now <= last && now >= FLOOR);
        last = now;
    }
    CHECK_NEAR(last, FLOOR, 0.0);
}

TEST(short_flights_tell_nothing)
{
    CHECK_NEAR(sharpest(FALLS / 3, 0.0, dp_load_options_default()), FLOOR, 0.0);
}

TEST(frames_show_no_more_than_half_their_rate)
{
    DpLoadOptions options = dp_load_options_default();
    options.frame_time = 1.0 / 24.0;
    CHECK(sharpest(FALLS, 0.0, options) <= 0.45 * 24.0);
    options.frame_time = 0.0;
    options.cutoff_knock = 12.0;
    CHECK(sharpest(FALLS, 0.0, options) <= 12.0);
    options.cutoff_knock = 6.0;
    CHECK_NEAR(sharpest(FALLS, 0.0, options), FLOOR, 0.0);
}

int main(void)
{
    RUN(knocks_stay_where_flights_show_no_noise);
    RUN(a_noisy_recording_is_smoothed_as_ever);
    RUN(little_noise_takes_little);
    RUN(short_flights_tell_nothing);
    RUN(frames_show_no_more_than_half_their_rate);
    return check_done();
}
