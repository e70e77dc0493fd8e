// motion/motion_live.c - poses as they are made: the last samples, those that are still needed.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "motion/motion_inside.h"

#define FIRST_ROOM 4  // samples

DpStatus dp_motion_live(DpMotion** motion, const DpGait* cast)
{
    const DpStatus status = dp_motion_open(motion, cast);
    if (status == DP_OK) (*motion)->live = true;
    return status;
}

// Room for one more sample: what is kept moves to a larger window.
static DpStatus widen(DpMotion* motion)
{
    const int kept = motion->samples - motion->oldest, parts = motion->cast.parts;
    if (kept < motion->room) return DP_OK;
    const int    room = motion->room > 0 ? 2 * motion->room : FIRST_ROOM;
    const size_t walkers = (size_t)motion->cast.walkers;
    double*      time = dp_alloc((size_t)room, sizeof *time);
    uint8_t*     present = dp_alloc((size_t)room * walkers, sizeof *present);
    Block        window = {0};
    DpStatus     status = time && present ? DP_OK : DP_NO_MEMORY;
    if (status == DP_OK) status = dp_block_open(&window, parts, 0, room);
    if (status != DP_OK) {
        dp_free(time), dp_free(present);
        return status;
    }
    const Block*        old = &motion->window;
    const DpLoadedPoses from = {old->pose, old->touching, old->force, old->pressure_point};
    for (int k = motion->oldest; k < motion->samples; ++k) {
        const size_t to = (size_t)(k % room), was = (size_t)(k % motion->room);
        time[to] = motion->time[was];
        memcpy(present + to * walkers, motion->present + was * walkers, walkers);
        for (int p = 0; p < parts; ++p)
            dp_block_take(&window, (size_t)p * (size_t)room + to, &from,
                          (size_t)p * (size_t)motion->room + was, 1);
    }
    dp_block_drop(&motion->window);
    dp_free(motion->time), dp_free(motion->present);
    motion->window = window, motion->time = time, motion->present = present;
    motion->room = room;
    return DP_OK;
}

// Poses of walkers who are not there are not looked at.
static bool sample_holds(const DpMotion* motion, const uint8_t* present, const DpLoadedPoses* poses)
{
    for (int p = 0; p < motion->cast.parts; ++p) {
        const DpLoadedPoses one = {poses->pose + 7 * p, poses->touching + p, poses->force + 3 * p,
                                   poses->pressure_point + 3 * p};
        if (present && !present[motion->walker_of[p]]) continue;
        if (!dp_motion_poses_hold(&one, 1)) return false;
    }
    return true;
}

DpStatus dp_motion_push(DpMotion* motion, double time, const uint8_t* present,
                        const DpLoadedPoses* poses)
{
    if (!motion || !motion->live || !poses || !poses->pose || !poses->touching || !poses->force ||
        !poses->pressure_point || !isfinite(time) || !sample_holds(motion, present, poses))
        return DP_BAD_ARGUMENT;
    if (motion->samples > motion->oldest &&
        !(time > motion->time[(motion->samples - 1) % motion->room]))
        return DP_BAD_ARGUMENT;
    const DpStatus status = widen(motion);
    if (status != DP_OK) return status;
    const size_t at = (size_t)(motion->samples % motion->room), room = (size_t)motion->room;
    const size_t walkers = (size_t)motion->cast.walkers;
    motion->time[at] = time;
    for (size_t w = 0; w < walkers; ++w)
        motion->present[at * walkers + w] = !present || present[w] != 0;
    for (size_t p = 0; p < (size_t)motion->cast.parts; ++p) {
        dp_block_take(&motion->window, p * room + at, poses, p, 1);
        if (motion->present[at * walkers + (size_t)motion->walker_of[p]] &&
            isnan(motion->first_touch) && poses->touching[p])
            motion->first_touch = poses->pose[7 * p + 2];
    }
    ++motion->samples;
    return DP_OK;
}

void dp_motion_forget(DpMotion* motion, int sample)
{
    const int last = motion->samples - 1;  // the next step begins with it
    if (!motion->live) return;
    if (sample > last) sample = last;
    if (sample > motion->oldest) motion->oldest = sample;
}
