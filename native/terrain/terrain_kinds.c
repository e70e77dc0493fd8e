// Which soil the ground is painted with: the kind that weighs most.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

DpStatus dp_source_copy_weights(Source* source, const DpGround* ground, size_t weights)
{
    if (ground->kind_count == 0) return DP_OK;
    if (!ground->kind_weight || weights == 0) return DP_BAD_ARGUMENT;  // flat ground is not painted
    const size_t count = (size_t)ground->kind_count * weights;
    for (size_t n = 0; n < count; ++n)
        if (!(ground->kind_weight[n] >= 0.0f) || isinf(ground->kind_weight[n]))
            return DP_BAD_ARGUMENT;
    source->kind_weight = dp_alloc(count, sizeof(float));
    if (!source->kind_weight) return DP_NO_MEMORY;
    memcpy(source->kind_weight, ground->kind_weight, count * sizeof(float));
    source->kind_count = ground->kind_count;
    source->weights = weights;
    return DP_OK;
}

uint8_t dp_source_kind(const Source* source, int count, const size_t* of, const double* share)
{
    int    best = 0;
    double heaviest = -1.0;
    for (int k = 0; k < source->kind_count; ++k) {
        const float* weight = source->kind_weight + (size_t)k * source->weights;
        double       sum = 0.0;
        for (int n = 0; n < count; ++n) sum += share[n] * (double)weight[of[n]];
        if (sum > heaviest) {
            heaviest = sum;
            best = k;
        }
    }
    return (uint8_t)best;
}
