// Soils that change over time: ground that freezes, thaws, gets wet. MODEL 6.10
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

#define NUMBERS (sizeof(DpSoil) / sizeof(float))

// times that never fall, and places that stay where they are
static bool are_times(const DpTerrainOptions* options)
{
    for (int t = 0; t < options->times; ++t) {
        if (!isfinite(options->time[t]) || (t > 0 && options->time[t] < options->time[t - 1]))
            return false;
        for (int s = 0; s < options->soil_count; ++s) {
            const float first = options->soils[s].grain_size;
            const float grain = options->soils[t * options->soil_count + s].grain_size;
            if (grain < first || grain > first) return false;
        }
    }
    return true;
}

DpStatus dp_times_keep(DpTerrain* terrain, const DpTerrainOptions* options)
{
    if (options->times == 0) return DP_OK;
    if (!are_times(options)) return DP_BAD_ARGUMENT;
    const size_t times = (size_t)options->times, soils = (size_t)options->soil_count;
    terrain->row = dp_alloc(times * soils, sizeof *terrain->row);
    terrain->time = dp_alloc(times, sizeof *terrain->time);
    if (!terrain->row || !terrain->time) return DP_NO_MEMORY;
    memcpy(terrain->row, options->soils, times * soils * sizeof *terrain->row);
    memcpy(terrain->time, options->time, times * sizeof *terrain->time);
    terrain->times = options->times;
    return DP_OK;
}

// numbers of a soil between two rows, `w` of the way; the row's own where both are alike
static DpSoil between(const DpSoil* from, const DpSoil* to, double w)
{
    DpSoil soil;
    for (size_t k = 0; k < NUMBERS; ++k) {
        float a, b;
        memcpy(&a, (const char*)from + k * sizeof a, sizeof a);
        memcpy(&b, (const char*)to + k * sizeof b, sizeof b);
        const float value = (float)((double)a + w * ((double)b - (double)a));  // MODEL 6.10
        memcpy((char*)&soil + k * sizeof value, &value, sizeof value);
    }
    return soil;
}

void dp_terrain_set_time(DpTerrain* terrain, double time)
{
    if (!terrain->row) return;
    int after = 0;  // first row that lies later
    while (after < terrain->times && terrain->time[after] <= time) ++after;
    const int     to = after < terrain->times ? after : terrain->times - 1;
    const int     from = after > 0 ? after - 1 : 0;
    const double  span = terrain->time[to] - terrain->time[from];
    const double  w = span > 0.0 ? (time - terrain->time[from]) / span : 0.0;
    const size_t  soils = (size_t)terrain->soil_count;
    const DpSoil *before = terrain->row + (size_t)from * soils,
                 *next = terrain->row + (size_t)to * soils;
    bool differs = false;
    for (size_t s = 0; s < soils; ++s) {
        const DpSoil given = between(&before[s], &next[s], w), soil = dp_wet_soil(&given);
        differs = differs || memcmp(&soil, &terrain->soils[s], sizeof soil) != 0;
        terrain->soils[s] = soil;
    }
    if (differs) dp_soil_slopes(terrain);
}
