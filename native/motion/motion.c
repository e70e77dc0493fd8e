// motion/motion.c - what is asked of a motion, whatever its source.
#include "motion/motion.h"

#include <math.h>

#include "motion/motion_inside.h"

void dp_motion_destroy(DpMotion* motion)
{
    dp_motion_drop(motion);
}

const DpGait* dp_motion_cast(const DpMotion* motion)
{
    return &motion->cast;
}

bool dp_motion_is_live(const DpMotion* motion)
{
    return motion->live;
}

int dp_motion_samples(const DpMotion* motion)
{
    return motion->samples;
}

double dp_motion_time(const DpMotion* motion, int sample)
{
    return motion->time[motion->live ? sample % motion->room : sample];
}

// The last block of a walker that begins at a sample or before; NULL where it is not there.
static const Block* block_at(const DpMotion* motion, int walker, int sample)
{
    int low = motion->start[walker], high = motion->start[walker + 1];
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (motion->block[middle].first <= sample)
            low = middle;
        else
            high = middle;
    }
    if (low == high) return NULL;
    const Block* block = &motion->block[low];
    return sample >= block->first && sample - block->first < block->count ? block : NULL;
}

// The block that holds a part at a sample, and the place in it; NULL where its walker is not there.
static const Block* find(const DpMotion* motion, int part, int sample, size_t* at)
{
    if (motion->live) {
        const size_t walkers = (size_t)motion->cast.walkers;
        if (sample < motion->oldest || sample >= motion->samples) return NULL;
        const size_t row = (size_t)(sample % motion->room);
        *at = (size_t)part * (size_t)motion->room + row;
        return motion->present[row * walkers + (size_t)motion->walker_of[part]] ? &motion->window
                                                                                : NULL;
    }
    const Block* block = block_at(motion, motion->walker_of[part], sample);
    if (block)
        *at = (size_t)motion->own_number[part] * (size_t)block->count +
              (size_t)(sample - block->first);
    return block;
}

bool dp_motion_there(const DpMotion* motion, int walker, int sample)
{
    if (!motion->live) return block_at(motion, walker, sample) != NULL;
    if (sample < motion->oldest || sample >= motion->samples) return false;
    return motion->present[(size_t)(sample % motion->room) * (size_t)motion->cast.walkers +
                           (size_t)walker] != 0;
}

bool dp_motion_part(const DpMotion* motion, int part, int sample, DpPartState* state)
{
    size_t       at = 0;
    const Block* block = find(motion, part, sample, &at);
    if (block) *state = dp_block_state(block, at);
    return block != NULL;
}

DpPose dp_motion_pose(const DpMotion* motion, int part, int sample)
{
    DpPartState state = {.pose = {{0, 0, 0}, {1, 0, 0, 0}}};
    (void)dp_motion_part(motion, part, sample, &state);
    return state.pose;
}

uint8_t dp_motion_touching(const DpMotion* motion, int part, int sample)
{
    size_t       at = 0;
    const Block* block = find(motion, part, sample, &at);
    return block ? block->touching[at] : 0;
}

bool dp_motion_stay(const DpMotion* motion, int walker, int number, int* first, int* end)
{
    if (motion->live) {
        *first = motion->oldest, *end = motion->samples;
        return number == 0 && motion->samples > motion->oldest;
    }
    const int at = motion->start[walker] + number;
    if (at >= motion->start[walker + 1]) return false;
    *first = motion->block[at].first;
    *end = *first + motion->block[at].count;
    return true;
}

double dp_motion_first_touch(const DpMotion* motion)
{
    if (motion->live) return motion->first_touch;
    for (int p = 0; p < motion->cast.parts; ++p) {
        const int w = motion->walker_of[p];
        for (int b = motion->start[w]; b < motion->start[w + 1]; ++b) {
            const Block* block = &motion->block[b];
            const size_t row = (size_t)motion->own_number[p] * (size_t)block->count;
            for (size_t k = 0; k < (size_t)block->count; ++k)
                if (block->touching[row + k]) return block->pose[7 * (row + k) + 2];
        }
    }
    return NAN;
}

size_t dp_motion_bytes(const DpMotion* motion)
{
    const size_t each = 13 * sizeof(double) + sizeof(uint8_t);
    size_t       bytes = 0;
    if (motion->live) return each * (size_t)motion->cast.parts * (size_t)motion->room;
    for (int w = 0; w < motion->cast.walkers; ++w)
        for (int b = motion->start[w]; b < motion->start[w + 1]; ++b)
            bytes += each * (size_t)motion->own_parts[w] * (size_t)motion->block[b].count;
    return bytes;
}
