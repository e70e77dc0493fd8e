// soil/soil_slide_read.c - what of a patch can slide, and how a row of it is read. TRAIL (14), MODEL 6.4, MODEL 6.8
#include "base/wide.h"  // first: it says how loops may be widened
#include "soil/soil_slide.h"

#define LANES 16  // the highest of so many columns at once

DP_CLONES
static void highest_of_row(const float* restrict base_height, int count, float* restrict high)
{
    for (int i = 0; i < count; i += LANES) {
        const int lanes = count - i < LANES ? count - i : LANES;
        for (int k = 0; k < lanes; ++k)
            high[k] = base_height[i + k] > high[k] ? base_height[i + k] : high[k];
    }
}

double dp_slide_level(const DpSoilPatch* patch, DpCellRect box)
{
    float high[LANES];
    for (int k = 0; k < LANES; ++k) high[k] = -INFINITY;
    for (long j = box.j0; j < box.j1; ++j)
        highest_of_row(patch->base_height + soil_at(patch, box.i0, j), (int)(box.i1 - box.i0),
                       high);
    for (int k = 1; k < LANES; ++k) high[0] = high[k] > high[0] ? high[k] : high[0];
    return isfinite(high[0]) ? floor((double)high[0]) : 0.0;
}

DP_CLONES
static int any_loose(const float* heap, int count)
{
    int loose = 0;
    for (int i = 0; i < count; ++i) loose |= heap[i] > 0.0f;
    return loose;
}

// the cells of a box between which `heap` is not 0; empty without any
static DpCellRect loose_in(const DpSoilPatch* patch, DpCellRect box, const float* grid)
{
    DpCellRect loose = {box.i1, box.i0, box.j1, box.j0};
    for (long j = box.j0; j < box.j1; ++j) {
        const float* heap = grid + soil_at(patch, 0, j);
        long         first = box.i0, last = box.i1 - 1;
        if (!any_loose(heap + first, (int)(box.i1 - first))) continue;
        while (!(heap[first] > 0.0f)) ++first;
        while (!(heap[last] > 0.0f)) --last;
        loose.i0 = first < loose.i0 ? first : loose.i0;
        loose.i1 = last >= loose.i1 ? last + 1 : loose.i1;
        loose.j0 = j < loose.j0 ? j : loose.j0;
        loose.j1 = j + 1;
    }
    return loose;
}

DpCellRect dp_slide_movable(const DpSoilPatch* patch, DpCellRect box)
{
    const DpCellRect loose = loose_in(patch, box, patch->heap);
    if (!patch->wall_slope) return loose;
    const DpCellRect pressed = loose_in(patch, box, patch->compression);
    if (dp_cells_empty(pressed)) return loose;
    return dp_cells_join(loose, soil_grown(pressed, 1, patch));
}

// ---- rows -------------------------------------------------------------------------------------

DP_CLONES
static int all_alike(const float* numbers, int count)
{
    int other = 0;
    for (int i = 0; i < count; ++i) other |= numbers[i] != numbers[0];
    return !other;
}

DP_CLONES
static void fill(const Row* to, const float* restrict base_height,
                 const float* restrict compression, const float* restrict loose,
                 const float* restrict rest_slope, const int32_t* restrict ring, int count,
                 double cell, double level, double tan_slack)
{
    float* restrict firm = to->firm, * restrict height = to->height, * restrict heap = to->heap;
    float* restrict fall = to->fall, * restrict slack = to->slack;
    double* restrict sum = to->sum;
    for (int i = 0; i < count; ++i) {
        const int   open = (base_height[i] == base_height[i]) & (ring[i] > 0);
        const float ground = (float)((double)base_height[i] - (double)compression[i] - level);
        const float lies = open ? loose[i] : 0.0f;
        firm[i] = open ? ground : BARRIER;
        sum[i] = (double)lies;
        heap[i] = lies;
        height[i] = open ? ground + lies : BARRIER;
    }
    const int   alike = all_alike(rest_slope, count);  // most rows are of one soil
    const float falls = (float)((double)*rest_slope * cell);
    const float holds = (float)(tan_slack * (1.0 + (double)*rest_slope * *rest_slope) * cell);
    for (int i = 0; alike && i < count; ++i) {
        fall[i] = firm[i] < BARRIER ? falls : 0.0f;
        slack[i] = firm[i] < BARRIER ? holds : 0.0f;
    }
    for (int i = 0; !alike && i < count; ++i) {
        const int    open = firm[i] < BARRIER;
        const double slope = (double)rest_slope[i];
        fall[i] = open ? (float)(slope * cell) : 0.0f;
        // tan(gamma + slack) - tan(gamma), from its first order: a little stricter
        slack[i] = open ? (float)(tan_slack * (1.0 + slope * slope) * cell) : 0.0f;
    }
}

DP_CLONES
static void fill_walls(const Walls* to, const float* restrict base_height,
                       const float* restrict wall_slope, const int32_t* restrict ring, int count,
                       double cell, double level, double tan_slack)
{
    float* restrict base = to->base, * restrict steep = to->steep, * restrict slack = to->slack;
    for (int i = 0; i < count; ++i) {
        const int    open = (base_height[i] == base_height[i]) & (ring[i] > 0);
        const double slope = (double)wall_slope[i];
        const int    falls = open & (slope < 1e6);
        const double fall = falls ? slope : 0.0;
        base[i] = open ? (float)((double)base_height[i] - level) : 0.0f;
        steep[i] = falls ? (float)(fall * cell) : BARRIER;
        slack[i] = (float)(tan_slack * (1.0 + fall * fall) * cell);
    }
}

// ---- the doors of those above ------------------------------------------------------------------

void dp_slide_fill(const Row* to, const float* restrict base_height,
                   const float* restrict compression, const float* restrict loose,
                   const float* restrict rest_slope, const int32_t* restrict ring, int count,
                   double cell, double level, double tan_slack)
{
    fill(to, base_height, compression, loose, rest_slope, ring, count, cell, level, tan_slack);
}

void dp_walls_fill(const Walls* to, const float* restrict base_height,
                   const float* restrict wall_slope, const int32_t* restrict ring, int count,
                   double cell, double level, double tan_slack)
{
    fill_walls(to, base_height, wall_slope, ring, count, cell, level, tan_slack);
}
