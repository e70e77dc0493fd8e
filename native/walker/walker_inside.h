// walker/walker_inside.h - what the files of this room share; no other room comes in here.
#pragma once
#include "walker/walker.h"

// Low-pass value (count) in place without phase: a 2nd-order Butterworth forward and backward, on
// a signal continued beyond its ends by turning it about its end points, so that a clip may begin
// and end in full motion. A cut-off too near to half the rate leaves the signal as it is.
// @param scratch  (dp_walker_low_pass_scratch(count, ..)) doubles
void   dp_walker_low_pass(double* value, int count, double rate, double cutoff, double* scratch);
size_t dp_walker_low_pass_scratch(int count, double rate, double cutoff);

// The same for a body that flies: free fall wherever it is in the air, smooth as below the cut-off
// where it is carried.
// @param air   where nothing carries it (count);  fall: its acceleration there [m/s^2]
// @param scratch  (dp_walker_fly_scratch(count)) doubles
void   dp_walker_fly(double* value, const uint8_t* air, int count, double rate, double cutoff,
                     double fall, double* scratch);
size_t dp_walker_fly_scratch(int count);

// Put values in rising order; the same, and the (upper) middle of at least one.
void   dp_walker_sort(double* value, size_t count);
double dp_walker_median(double* value, size_t count);

// The cut-off with which a body that flies is smoothed: `cutoff`, or more where that would take away
// more of its stances than the noise its flights show.
// @param height  of its mass centre [m];  air: where nothing carries it (times)
// @param smooth, scratch  room for (times) and (dp_walker_fly_scratch(times))
// @return [Hz] >= cutoff
double dp_walker_sharpest(const double* height, const uint8_t* air, int times, double rate,
                          double cutoff, const DpLoadOptions* options, double* smooth,
                          double* scratch);

// First and second change in time at a sample, from its neighbours; one-sided at the ends.
double dp_walker_velocity(const double* value, int count, int at, double rate);
double dp_walker_acceleration(const double* value, int count, int at, double rate);

// Samples a second of an even recording; 0 if it is uneven or has fewer than two samples.
double dp_walker_rate(const DpGait* gait);

// Is every count, pointer, owner and number of the recording one that can be worked with?
bool dp_walker_gait_ok(const DpGait* gait);

static inline DpPose dp_walker_pose(const DpGait* gait, int part, int sample)
{
    const double* p = gait->pose + 7 * ((size_t)part * (size_t)gait->times + (size_t)sample);
    const DpPose  pose = {{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
    return pose;
}

static inline DpVec3 dp_walker_com(const DpGait* gait, int walker, int sample)
{
    const double* c = gait->com + 3 * ((size_t)walker * (size_t)gait->times + (size_t)sample);
    const DpVec3  com = {c[0], c[1], c[2]};
    return com;
}

static inline DpVec3 dp_walker_point(const DpGait* gait, int point)
{
    const double* p = gait->point + 3 * (size_t)point;
    const DpVec3  at = {p[0], p[1], p[2]};
    return at;
}

// Move the beginnings and ends of contacts to where the ground stops a foot and lets it go.
// @param height, rise  of the points over the ground [m], and their upward speed [m/s] (K, T)
// @param speed         of the points over the ground [m/s] (K, T)
// @param clearance     resting height of each point [m] (K)
// @param moves         what is faster is not at rest [m/s]
// @param fast          what comes down faster than this is timed by its height [m/s]
// @param cutoff        with which speeds were low-passed [Hz]
// @param on            the points' contacts, changed (K, T)
// @param flown         scratch (W, T)
void dp_walker_edges(const DpGait* gait, const double* height, const double* clearance,
                     const double* rise, const double* speed, double moves, double fast,
                     double cutoff, uint8_t* on, uint8_t* flown, double rate);

// A walker that does not fall is carried: where nobody touches, its lowest slowest foot does.
// @param height, speed  of the points over the ground [m] [m/s] (K, T)
// @param fall           acceleration of the mass centre upward [m/s^2] (T)
// @param on             the points' contacts, changed (K, T)
void dp_walker_support(const DpGait* gait, int walker, const double* height, const double* speed,
                       const double* clearance, const double* fall, const DpContactLimits* limits,
                       double rate, uint8_t* on);

// Take a slight slope of the recorded floor out of the heights of a walker's points.
// @param height  over the given ground, changed; NaN = no ground [m]   (K, T)
// @param speed   [m/s] (K, T);  slow: a point below this rests   [m/s]
DpStatus dp_walker_level_floor(const DpGait* gait, int walker, double* height, const double* speed,
                               double slow, double rate);

// Acceleration and velocity over the ground of a walker's mass centre, low-passed by its steps.
// @param limb_on  (limbs, T) where its limbs touch
// @param accel    out [m/s^2] (3, T);  velocity: out [m/s] (2, T)
// Needs memory: DP_NO_MEMORY.
DpStatus dp_walker_accelerate(const DpGait* gait, int walker, const uint8_t* limb_on, int limbs,
                              double rate, const DpLoadOptions* options, double* accel,
                              double* velocity);

// Keep of the times in the air the flights: those in which the body falls. Is there one?
// @param air     where nothing carries it, changed (times);  height: of its mass centre [m] (times)
bool dp_walker_falls(uint8_t* air, const double* height, int times, double rate);

// Contacts that a flight follows end where the body's momentum says, within half a frame.
// @param frame   time between the frames that were recorded [s] >= 0
// @param on      the points' contacts, changed (K, T)
// @param air, height, scratch  room for (T), (T) and (dp_walker_fly_scratch(T))
void dp_walker_bounces(const DpGait* gait, int walker, double frame, double rate, uint8_t* on,
                       uint8_t* air, double* height, double* scratch);

// The contact points of a limb with which it lands: its heel, its toe, or both. TRAIL (4)
typedef struct DpLanding
{
    const int* point;  // (count)
    int        count;
} DpLanding;

// v0 of TRAIL (3): the velocity with which these points touch after sample t, the last in the air.
// @param limb_on  where the walker's limbs touch (limbs, T)
DpVec3 dp_walker_landing_velocity(const DpGait* gait, const DpLanding* landing,
                                  const uint8_t* limb_on, int limbs, double rate, int t);

// How much of the weight each of `count` supports carries: ramps first, corrected by the
// zero-moment point where the supports are far apart. MODEL 4.3.
// @param share   in: s_i of the ramps, sum 1; out: a_i >= 0, sum 1  [-] (count)
// @param at      centres of contact, horizontal                     [m] (count)
// @param target  where the supports' mean should be                 [m]
// @param mu      trust in the ramps, 0 = none                       [-] >= 0
// @param support_span  spread at which the zero-moment point gets half its say [m] > 0
void dp_walker_share(double* share, const DpVec3* at, int count, DpVec3 target, double mu,
                     double support_span);

// Ramps of supports that touch and let go. MODEL 4.3, step 1.
// @param touching  (count, times)
// @param rolls     points of one foot: weight rolls evenly for as long as both are down
// @param weight    out: 0 in the air, easing to 1 on the ground (count, times)
void dp_walker_ramps(const uint8_t* touching, int count, int times, double rate,
                     const DpLoadOptions* options, bool rolls, double* weight);
