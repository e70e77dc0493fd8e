// walker/walker.h - from what a walker did to the forces its limbs put on the ground.
//
//   gait_resample ---Gait at one rate---> foot_contact ---touching---> foot_force
//   MODEL 3.2                             TRAIL (4)                    TRAIL (3), SOFT22 (3)-(8)
//
//   foot_place: a Gait of the floor ---> a Gait of the slope, before all that. TRAIL (1) (2)
//
// These are whole-clip functions: forces are filtered without phase, so they need what comes after.
// They know no terrain; the height of the ground below each contact point is given, or asked for.
#pragma once
#include "base/number.h"
#include "base/status.h"
#include "base/types.h"

// ---- MODEL 3.2: a recording at another rate -------------------------------------------------

// How many samples a recording from first to last [s] has at `rate` [1/s]: every k / rate that
// fits.
int dp_gait_resample_count(double first, double last, double rate);

// Fill com (W, count, 3) and pose (P, count, 7) at times first + k / rate (written to time
// (count)): cubic in time for positions and rotations. One sample in: copied to all. Needs
// memory for nothing. DP_BAD_ARGUMENT if count does not match dp_gait_resample_count.
DpStatus dp_gait_resample(const DpGait* gait, double rate, int count, double* time, double* com,
                          double* pose);

// ---- TRAIL (1) (2): feet on a slope ---------------------------------------------------------------

// The base ground, asked for where feet come to be.
typedef struct DpGroundBelow
{
    const void* ground;
    double (*height)(const void* ground, double x, double y);                 // NaN = no ground [m]
    DpVec3 (*normal)(const void* ground, double x, double y, double radius);  // unit, smoothed
} DpGroundBelow;

// X(name, unit, low, high, usual, meaning), as base/number.h has them
// clang-format off
#define DP_PLACE_NUMBERS(X) \
    X(max_clearance, "m", 1e-6, 1e6, 0.20, "d_max, feet this high over the ground are as recorded") \
    X(toe_slope, "rad", 0.0, 0.5 * DP_PI, 15.0 * DP_PI / 180.0, "theta_0, up steeper slopes only the toes carry") \
    X(foot_radius, "m", 1e-6, 1e6, 0.25, "the ground is smoothed over this under a foot") \
    X(body_radius, "m", 1e-6, 1e6, 0.5, "and over this under the body") \
    X(floor, "m", -1e9, 1e9, 0.0, "height of the floor it was recorded on, of who is carried")
// clang-format on

// Start from dp_place_options_default().
typedef struct DpPlaceOptions
{
    DP_PLACE_NUMBERS(DP_DOUBLE_MEMBER)
    bool flat;   // near the ground feet lie flat on it, as printed; else they keep their roll: they
                 //   stand on the slope as they stood on the floor [-]
    bool carry;  // recorded on level floor: feet and body rise and sink with the ground [-]
} DpPlaceOptions;

DpPlaceOptions dp_place_options_default(void);

// Turn one walker's feet to the ground below them; none is pushed into it. TRAIL (1) (2).
// @param clearance  resting height of each point over floor (carry) or ground  [m] (K)
// @param pose       changed where the walker's parts are             [m, -] (P, T, 7)
// @param com        changed where the walker is carried              [m]    (W, T, 3)
// pose and com are copies of the gait's own to begin with, of which other walkers' rows stay.
// DP_NO_GROUND if one who is carried has a foot or the body never over the ground.
DpStatus dp_foot_place(const DpGait* gait, int walker, const DpGroundBelow* below,
                       const DpPlaceOptions* options, const double* clearance, double* pose,
                       double* com);

// ---- TRAIL (4): which part touches when ---------------------------------------------------------

// clang-format off
#define DP_CONTACT_NUMBERS(X) \
    X(touch_height, "m", 0.0, 1e6, 0.03, "d below which it may touch") \
    X(release_height, "m", 0.0, 1e6, 0.03, "d above which a heel lets go") \
    X(release_height_toe, "m", 0.0, 1e6, 0.05, "d above which a ball or tip lets go") \
    X(touch_speed, "m/s", 0.0, 1e6, 0.3, "|v| below which it may touch: this + share * |v_com|") \
    X(touch_speed_share, "-", 0.0, 1e6, 0.4, "that share") \
    X(release_speed, "m/s", 0.0, 1e6, 1.2, "|v| above which it lets go") \
    X(slow_speed, "m/s", 0.0, 1e6, 0.25, "calibration looks at samples slower than this") \
    X(shortest, "s", 0.0, 1e6, 0.03, "ticks and gaps below this are closed") \
    X(point_cutoff, "Hz", 1e-3, 1e6, 20.0, "low-pass of a point's speed") \
    X(com_cutoff, "Hz", 1e-3, 1e6, 3.0, "low-pass of the centre's speed") \
    X(support_fall, "-", 0.0, 1e6, 0.5, "nobody touches and a_z > -this * g: somebody carries") \
    X(frame_time, "s", 0.0, 1e6, 0.0, "frames lay so far apart before it was resampled")
// clang-format on

// When a contact point touches and lets go. Start from dp_contact_limits_default().
typedef struct DpContactLimits
{
    DP_CONTACT_NUMBERS(DP_DOUBLE_MEMBER)
} DpContactLimits;

DpContactLimits dp_contact_limits_default(void);

// Which part touches the ground at which time. TRAIL (4), with the clip's own resting clearance.
// @param gait       evenly sampled (see dp_gait_resample)
// @param ground     height of the base ground below each contact point [m] (K, T); NaN = no ground
// @param touching   out, 1 where the part touches                      [-] (P, T)
// @param clearance  out, resting height of each point over the ground  [m] (K)
DpStatus dp_foot_contact(const DpGait* gait, const double* ground, const DpContactLimits* limits,
                         uint8_t* touching, double* clearance);

// ---- TRAIL (3): how hard ------------------------------------------------------------------------

typedef enum DpLoadModel
{
    DP_LOAD_INERTIA = 0,  // Newton on the recorded centre of mass (ours; MODEL 4.3)
    DP_LOAD_IMPULSE = 1   // weight shares and a landing impulse over tau, as in the papers
} DpLoadModel;

// of `inertia`, MODEL 4.3
// clang-format off
#define DP_LOAD_NUMBERS(X) \
    X(cutoff_share, "-", 1e-3, 1e6, 3.0, "low-pass of a_com in step frequencies") \
    X(cutoff_low, "Hz", 1e-3, 1e6, 5.0, "its lower bound") \
    X(cutoff_high, "Hz", 1e-3, 1e6, 11.0, "its upper bound, no lower than that") \
    X(cutoff_flight, "Hz", 1e-3, 1e6, 8.0, "the lower one of who flies") \
    X(cutoff_knock, "Hz", 1e-3, 1e6, 20.0, "the upper one of a landing whose flight shows no noise") \
    X(noise_share, "-", 1e-3, 1e6, 2.0, "so many times the noise of flights may be smoothed away") \
    X(cutoff_level, "-", 1e-3, 1e6, 2.0 / 3.0, "of a_com over the ground, in shares of that upward") \
    X(max_overlap, "s", 1e-3, 1e6, 0.3, "longer overlaps are standing, not a change of feet") \
    X(ramp_standing, "s", 1e-3, 1e6, 0.1, "ramp of a limb that joins others that stay") \
    X(ramp_alone, "s", 1e-3, 1e6, 0.03, "ramp of a limb that relieves none") \
    X(ramp_trust, "-", 0.0, 1e6, 0.25, "mu, trust in ramps against the zero-moment point") \
    X(support_span, "m", 1e-3, 1e6, 0.3, "spread at which that point gets half its say") \
    X(frame_time, "s", 0.0, 1e6, 0.0, "frames lay so far apart before it was resampled")
// clang-format on

typedef struct DpLoadOptions
{
    DpLoadModel   model;
    double        settle_time;  // tau of `impulse`, TRAIL (3)                     [s] > 0
    const double* settle;       // the same of the soil under each contact point; NULL: as above
                                //                                                 [s] > 0 (K, T)
    bool half_sine;             // `impulse`: spread J as a half-sine, else evenly [-]

    DP_LOAD_NUMBERS(DP_DOUBLE_MEMBER)
} DpLoadOptions;

DpLoadOptions dp_load_options_default(void);

// Force of every part on the ground and its centre of pressure. TRAIL (3), SOFT22 (3)-(8).
// @param touching  from dp_foot_contact                         [-] (P, T)
// @param ground    as for dp_foot_contact                       [m] (K, T)
// @param force     out, of the part on the ground; 0 in the air [N] (P, T, 3)
// @param pressure_point  out, on the ground; NaN in the air     [m] (P, T, 3)
DpStatus dp_foot_force(const DpGait* gait, const uint8_t* touching, const double* ground,
                       const DpLoadOptions* options, double* force, double* pressure_point);

// SOFT22 (5): share of the weight on the right foot, from the centre of mass projected on the line
// between the feet, 0..1; feet on one spot share evenly.
// Departures: as printed it is a cosine and always 1; the denominator is |p_R - p_L|^2.
double dp_foot_share(DpVec3 com, DpVec3 left, DpVec3 right);

// ---- the tables of their numbers ------------------------------------------------------------------

// In the order of the members; *count of them.
const DpNumber* dp_place_numbers(int* count);
const DpNumber* dp_contact_numbers(int* count);
const DpNumber* dp_load_numbers(int* count);

// DP_OK if each is in its range; else which is not, if `reason` is there.
DpStatus dp_place_options_check(const DpPlaceOptions* options, DpReason* reason);
DpStatus dp_contact_limits_check(const DpContactLimits* limits, DpReason* reason);
DpStatus dp_load_options_check(const DpLoadOptions* options, DpReason* reason);
