// motion/motion_tracks.c - recordings: of all walkers all the time, or many short ones.
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "motion/motion_inside.h"

static bool complete(const DpLoadedPoses* poses)
{
    return poses->pose && poses->touching && poses->force && poses->pressure_point;
}

static int by_walker_and_start(const void* a, const void* b)
{
    const DpTrack *const *x = a, *const *y = b;
    if ((*x)->walker != (*y)->walker) return ((*x)->walker > (*y)->walker) * 2 - 1;
    return ((*x)->first > (*y)->first) - ((*x)->first < (*y)->first);
}

static DpStatus keep_times(DpMotion* motion, const DpGait* gait)
{
    motion->samples = gait->times;
    motion->time = dp_alloc((size_t)gait->times, sizeof *motion->time);
    if (!motion->time) return DP_NO_MEMORY;
    memcpy(motion->time, gait->time, (size_t)gait->times * sizeof *motion->time);
    return DP_OK;
}

// A motion with room for `count` blocks, of which there are none yet.
static DpStatus open_blocks(DpMotion** motion, const DpGait* cast, int count)
{
    if (!cast || cast->times < 2 || !cast->time || !dp_motion_times_hold(cast->time, cast->times))
        return DP_BAD_ARGUMENT;
    DpMotion* opened = NULL;
    DpStatus  status = dp_motion_open(&opened, cast);
    if (status != DP_OK) return status;
    opened->start = dp_alloc((size_t)cast->walkers + 1, sizeof *opened->start);
    opened->block = dp_alloc((size_t)count + 1, sizeof *opened->block);
    status = opened->start && opened->block ? keep_times(opened, cast) : DP_NO_MEMORY;
    if (status == DP_OK)
        *motion = opened;
    else
        dp_motion_drop(opened);
    return status;
}

DpStatus dp_motion_record(DpMotion** motion, const DpGait* gait, const DpLoadedPoses* loads)
{
    if (!motion || !gait || !loads || !complete(loads) || gait->times < 2 || gait->parts < 1 ||
        !dp_motion_poses_hold(loads, (size_t)gait->parts * (size_t)gait->times))
        return DP_BAD_ARGUMENT;
    const size_t times = (size_t)gait->times;
    DpMotion*    opened = NULL;
    DpStatus     status = open_blocks(&opened, gait, gait->walkers);
    for (int w = 0; w < gait->walkers && status == DP_OK; ++w) {
        status = dp_block_open(&opened->block[w], opened->own_parts[w], 0, gait->times);
        for (int v = w + 1; v <= gait->walkers; ++v) opened->start[v] = w + 1;
    }
    for (int p = 0; p < gait->parts && status == DP_OK; ++p)
        dp_block_take(&opened->block[opened->walker_of[p]], (size_t)opened->own_number[p] * times,
                      loads, (size_t)p * times, times);
    if (status == DP_OK)
        *motion = opened;
    else
        dp_motion_drop(opened);
    return status;
}

// Of walkers that there are, within the times, with poses that can be worked with, one at a time.
static bool tracks_hold(const DpMotion* motion, const DpTrack* const* track, int count)
{
    for (int n = 0; n < count; ++n) {
        const DpTrack* each = track[n];
        if (each->walker < 0 || each->walker >= motion->cast.walkers || each->first < 0 ||
            each->count < 1 || each->count > motion->samples - each->first ||
            !complete(&each->poses) ||
            !dp_motion_poses_hold(&each->poses,
                                  (size_t)motion->own_parts[each->walker] * (size_t)each->count))
            return false;
        if (n > 0 && track[n - 1]->walker == each->walker &&
            track[n - 1]->first + track[n - 1]->count > each->first)
            return false;
    }
    return true;
}

static DpStatus take_tracks(DpMotion* motion, const DpTrack* const* track, int count)
{
    for (int n = 0; n < count; ++n) {
        const int      w = track[n]->walker, parts = motion->own_parts[w];
        const DpStatus status =
            dp_block_open(&motion->block[n], parts, track[n]->first, track[n]->count);
        if (status != DP_OK) return status;
        for (int v = w + 1; v <= motion->cast.walkers; ++v) motion->start[v] = n + 1;
        if (parts > 0)
            dp_block_take(&motion->block[n], 0, &track[n]->poses, 0,
                          (size_t)parts * (size_t)track[n]->count);
    }
    return DP_OK;
}

DpStatus dp_motion_tracks(DpMotion** motion, const DpGait* cast, const DpTrack* tracks, int count)
{
    if (!motion || !cast || count < 0 || (count > 0 && !tracks)) return DP_BAD_ARGUMENT;
    const DpTrack** sorted = dp_alloc((size_t)count + 1, sizeof *sorted);
    if (!sorted) return DP_NO_MEMORY;
    for (int n = 0; n < count; ++n) sorted[n] = &tracks[n];
    qsort(sorted, (size_t)count, sizeof *sorted, by_walker_and_start);
    DpMotion* opened = NULL;
    DpStatus  status = open_blocks(&opened, cast, count);
    if (status == DP_OK && !tracks_hold(opened, sorted, count)) status = DP_BAD_ARGUMENT;
    if (status == DP_OK) status = take_tracks(opened, sorted, count);
    if (status == DP_OK)
        *motion = opened;
    else
        dp_motion_drop(opened);
    dp_free(sorted);
    return status;
}
