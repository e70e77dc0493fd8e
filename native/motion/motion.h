// motion/motion.h - where poses and loads come from, sample by sample. MODEL 3.7
//
//   recorded   a Gait: everybody is there all the time                    ---.
//   tracks     many short recordings, each with a walker and a start      ---+--> who is there, where
//   live       poses pushed one sample at a time, as they are made        ---'    parts are, how hard
//
// Whoever asks does not know which it is. Memory grows with the walkers that are there, never with
// walkers times samples; of a live motion only the samples that are still needed are kept.
#pragma once
#include "base/status.h"
#include "base/types.h"

#define DP_HELD 128  // in `touching`: no time passes for the part from this sample to the next

typedef struct DpMotion DpMotion;

// What parts do at some samples, with how they touch and press (walker/walker.h).
typedef struct DpLoadedPoses
{
    const double*  pose;      // at (x, y, z), unit quaternion (w, x, y, z) [m, -] (parts, n, 7)
    const uint8_t* touching;  // 0, or 1 with or without DP_HELD            [-]    (parts, n)
    const double*  force;     // of the part on the ground                  [N]    (parts, n, 3)
    const double*
        pressure_point;  // NaN where nothing presses                  [m]    (parts, n, 3)
} DpLoadedPoses;

// A walker that is there from sample `first` on for `count` samples. `poses` are those of its own
// parts, in their order. Tracks of one walker that follow each other without a gap are one motion.
typedef struct DpTrack
{
    int           walker, first, count;  // count >= 1
    DpLoadedPoses poses;
} DpTrack;

// All of these copy what they are given. Numbers that cannot be worked with: DP_BAD_ARGUMENT, and no
// motion.

// A Gait of two or more samples: one track a walker.
DpStatus dp_motion_record(DpMotion** motion, const DpGait* gait, const DpLoadedPoses* loads);
// The walkers, limbs, parts, soles and times of `cast`, whose poses are not looked at, and when each
// is there. Tracks stand in any order; those of one walker must not overlap.
DpStatus dp_motion_tracks(DpMotion** motion, const DpGait* cast, const DpTrack* tracks, int count);
// The same walkers, of whom nothing is known yet; neither are times.
DpStatus dp_motion_live(DpMotion** motion, const DpGait* cast);
// The next sample of a live motion, later than those before; poses (parts, 1, ..). present (walkers)
// tells who is there; NULL: all. What cannot be worked with: DP_BAD_ARGUMENT, nothing was pushed.
DpStatus dp_motion_push(DpMotion* motion, double time, const uint8_t* present,
                        const DpLoadedPoses* poses);
// Samples before this one are not asked for any more.
void dp_motion_forget(DpMotion* motion, int sample);
void dp_motion_destroy(DpMotion* motion);

// ---- who walks ---------------------------------------------------------------------------------

// Walkers, limbs, parts, mass, owners, soles and laws; no times, poses or points.
const DpGait* dp_motion_cast(const DpMotion* motion);
bool          dp_motion_is_live(const DpMotion* motion);
// How many samples there are (recorded, tracks), or were pushed (live), and their times [s].
int    dp_motion_samples(const DpMotion* motion);
double dp_motion_time(const DpMotion* motion, int sample);

// ---- what they do; asked from several threads ----------------------------------------------------

// One part at one sample.
typedef struct DpPartState
{
    DpPose  pose;
    uint8_t touching;
    DpVec3  force, pressure_point;
} DpPartState;

bool    dp_motion_there(const DpMotion* motion, int walker, int sample);
DpPose  dp_motion_pose(const DpMotion* motion, int part, int sample);      // of one who is there
uint8_t dp_motion_touching(const DpMotion* motion, int part, int sample);  // 0 for who is not
// All of it; false: its walker is not there.
bool dp_motion_part(const DpMotion* motion, int part, int sample, DpPartState* state);

// Samples first <= k < end in which a walker is there, its `number`-th stay from 0 on; false: there
// are no more.
bool dp_motion_stay(const DpMotion* motion, int walker, int number, int* first, int* end);
// The height of the first part, in their order, that ever touches, where it first does [m]; NaN:
// none does, or it is not known yet.
double dp_motion_first_touch(const DpMotion* motion);

// Bytes that poses and loads take now.
size_t dp_motion_bytes(const DpMotion* motion);
