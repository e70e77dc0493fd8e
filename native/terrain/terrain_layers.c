// Ground in layers: what lies on what, of each kind. MODEL 6.17
#include <string.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

#define MAX_LAYERS 4    // of a kind, with the ground below
#define THICKEST 100.0  // [m]
#define MAX_NAMES 256   // of soils

static bool are_layers(const DpTerrain* terrain, const DpLayer* layers, const int* start)
{
    if (!layers || !start || start[0] != 0 || terrain->row || terrain->layers) return false;
    for (int k = 0; k < terrain->soil_count; ++k) {
        const int count = start[k + 1] - start[k];
        if (count < 0 || count > MAX_LAYERS) return false;
        for (int n = start[k]; n < start[k + 1]; ++n)
            if (!(layers[n].thickness > 0.0 && layers[n].thickness <= THICKEST) ||
                layers[n].name < 0 || layers[n].name >= MAX_NAMES)
                return false;
    }
    return start[terrain->soil_count] > 0;
}

DpStatus dp_terrain_set_layers(DpTerrain* terrain, const DpLayer* layers, const int* start)
{
    if (!terrain || terrain->tiles > 0 || !are_layers(terrain, layers, start))
        return DP_BAD_ARGUMENT;
    const size_t soils = (size_t)terrain->soil_count, count = (size_t)start[soils];
    DpLayer*     kept = dp_alloc(count, sizeof *kept);
    int*         kept_start = dp_alloc(soils + 1, sizeof *kept_start);
    if (!kept || !kept_start) {
        dp_free(kept), dp_free(kept_start);
        return DP_NO_MEMORY;
    }
    memcpy(kept_start, start, (soils + 1) * sizeof *kept_start);
    for (size_t n = 0; n < count; ++n)
        kept[n] = (DpLayer){dp_wet_soil(&layers[n].soil), layers[n].thickness, layers[n].name,
                            layers[n].place};
    terrain->layers = kept, terrain->layer_start = kept_start;
    terrain->names = 0;
    for (size_t n = 0; n < count; ++n)
        if (kept[n].name >= terrain->names) terrain->names = kept[n].name + 1;
    for (size_t k = 0; k < soils; ++k)
        if (start[k + 1] > start[k]) terrain->name_of_soil[k] = kept[start[k]].name;
    return dp_coats_count(terrain);
}

const DpLayer* dp_terrain_layers(const DpTerrain* terrain, int kind, int* count)
{
    const int first = terrain->layers ? terrain->layer_start[kind] : 0;
    *count = terrain->layers ? terrain->layer_start[kind + 1] - first : 0;
    return *count > 0 ? terrain->layers + first : NULL;
}
