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

// The rest ground, asked for where feet come to be.
typedef struct DpGroundBelow
{
    const void* ground;
    double (*height)(const void* ground, double x, double y);                 // NaN = no ground [m]
    DpVec3 (*normal)(const void* ground, double x, double y, double radius);  // unit, smoothed
} DpGroundBelow;

// Start from dp_place_options_default().
typedef struct DpPlaceOptions
{
    double max_clearance;  // d_max, feet this high over the ground are as recorded     [m]   > 0
    double toe_slope;      // theta_0, up steeper slopes only the toes carry            [rad] >= 0
    double foot_radius;    // the ground is smoothed over this under a foot             [m]   > 0
    double body_radius;    // and over this under the body                              [m]   > 0
    bool   flat;           // near the ground feet lie flat on it, as printed; else they keep their
                           //   roll: they stand on the slope as they stood on the floor [-]
    bool   carry;  // recorded on level floor: feet and body rise and sink with the ground [-]
    double floor;  // height of that floor                                      [m]
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

// When a contact point touches and lets go. Start from dp_contact_limits_default().
typedef struct DpContactLimits
{
    double touch_height;        // d below which it may touch                          [m]   > 0
    double release_height;      // d above which a heel lets go                        [m]   > 0
    double release_height_toe;  // d above which a ball or tip lets go                 [m]   > 0
    double touch_speed;         // |v| below which it may touch: this + share * |v_com| [m/s] > 0
    double touch_speed_share;   //                                                     [-]   >= 0
    double release_speed;       // |v| above which it lets go                          [m/s] > 0
    double slow_speed;          // calibration looks at samples slower than this       [m/s] > 0
    double shortest;            // ticks and gaps below this are closed                [s]   >= 0
    double point_cutoff;        // low-pass of a point's speed                         [Hz]  > 0
    double com_cutoff;          // low-pass of the centre's speed                      [Hz]  > 0
    double support_fall;        // nobody touches and a_z > -this * g: somebody carries [-]  > 0
    double frame_time;          // frames lay so far apart before it was resampled     [s]   >= 0
} DpContactLimits;

DpContactLimits dp_contact_limits_default(void);

// Which part touches the ground at which time. TRAIL (4), with the clip's own resting clearance.
// @param gait       evenly sampled (see dp_gait_resample)
// @param ground     height of the rest ground below each contact point [m] (K, T); NaN = no ground
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

typedef struct DpLoadOptions
{
    DpLoadModel   model;
    double        settle_time;  // tau of `impulse`, TRAIL (3)                     [s] > 0
    const double* settle;       // the same of the soil under each contact point; NULL: as above
                                //                                                 [s] > 0 (K, T)
    bool half_sine;             // `impulse`: spread J as a half-sine, else evenly [-]

    // `inertia`, MODEL 4.3
    double cutoff_share;   // low-pass of a_com in step frequencies               [-]  > 0
    double cutoff_low;     // and its bounds                                      [Hz] > 0
    double cutoff_high;    //                                                     [Hz] >= cutoff_low
    double cutoff_flight;  // and the lower one of who flies                      [Hz] > 0
    double cutoff_knock;   // the upper one of a landing whose flight shows no noise [Hz] > 0
    double noise_share;    // so many times the noise of flights may be smoothed away [-] > 0
    double cutoff_level;   // of a_com over the ground, in shares of that upward  [-]  > 0
    double max_overlap;    // longer overlaps are standing, not a change of feet  [s]  > 0
    double ramp_standing;  // ramp of a limb that joins others that stay          [s]  > 0
    double ramp_alone;     // ramp of a limb that relieves none                   [s]  > 0
    double ramp_trust;     // mu, trust in ramps against the zero-moment point    [-]  >= 0
    double support_span;   // spread at which that point gets half its say        [m]  > 0
    double frame_time;     // frames lay so far apart before it was resampled     [s]  >= 0
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
