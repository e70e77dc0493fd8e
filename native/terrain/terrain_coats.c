// What soles have left on the ground, and which soil is seen. MODEL 6.16
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

static bool sticks(const DpTerrain* terrain, int soil)
{
    bool any = terrain->soils[soil].adhesion > 0.0f;
    for (int t = 0; t < terrain->times; ++t)
        any = any || terrain->row[t * terrain->soil_count + soil].adhesion > 0.0f;
    return any;
}

// which coat has this name, -1 = none
static int coat_named(const DpTerrain* terrain, int name)
{
    for (int k = 0; k < terrain->coats; ++k)
        if (terrain->name_of_soil[terrain->coat_soil[k]] == name) return k;
    return -1;
}

DpStatus dp_coats_count(DpTerrain* terrain)
{
    terrain->coats = 0;
    for (int s = 0; s < terrain->soil_count; ++s) {
        const bool one = sticks(terrain, s);
        const int  known = one ? coat_named(terrain, terrain->name_of_soil[s]) : -1;
        terrain->coat_of_soil[s] = known;
        if (!one || known >= 0) continue;
        if (terrain->coats == DP_MAX_COATS) return DP_BAD_ARGUMENT;
        terrain->coat_of_soil[s] = terrain->coats;
        terrain->coat_soil[terrain->coats++] = s;
    }
    return DP_OK;
}

DpStatus dp_coats_find(DpTerrain* terrain)
{
    const size_t soils = (size_t)terrain->soil_count;
    terrain->coat_of_soil = dp_alloc(soils, sizeof *terrain->coat_of_soil);
    terrain->name_of_soil = dp_alloc(soils, sizeof *terrain->name_of_soil);
    if (!terrain->coat_of_soil || !terrain->name_of_soil) return DP_NO_MEMORY;
    for (int s = 0; s < terrain->soil_count; ++s) terrain->name_of_soil[s] = s;
    terrain->names = terrain->soil_count;
    return dp_coats_count(terrain);
}

int dp_terrain_coats(const DpTerrain* terrain, const int** soils)
{
    if (soils) *soils = terrain->coat_soil;
    return terrain->coats;
}

double dp_terrain_coat_volume(const DpTerrain* terrain, int coat)
{
    double sum = 0.0;
    for (size_t t = 0; t < terrain->tiles; ++t) {
        const float* lies = tile_coats(terrain, tile_at(terrain, t)) + (size_t)coat * TILE_CELLS;
        for (int n = 0; n < TILE_CELLS; ++n) sum += (double)lies[n];
    }
    return sum * terrain->grid.cell * terrain->grid.cell;
}

#define ONE_OF_THEM(ID, name, number, unit, equation, meaning) case DP_FIELD_##ID:

bool dp_terrain_knows(const DpTerrain* terrain, int field)
{
    switch (field) {
        DP_TERRAIN_FIELDS(ONE_OF_THEM, ONE_OF_THEM)
        return true;
        default:
            break;
    }
    const int name = field - (field >= DP_FIELD_COAT ? DP_FIELD_COAT : DP_FIELD_SURFACE);
    return name >= 0 && name < terrain->names;
}

// thickness of all coats of a cell [m]
static double thickness(const DpTerrain* terrain, const float* lies)
{
    double sum = 0.0;
    for (int k = 0; k < terrain->coats; ++k) sum += (double)lies[(size_t)k * TILE_CELLS];
    return sum;
}

void dp_coats_row(const DpTerrain* terrain, const Tile* tile, size_t at, int count, int field,
                  const uint8_t* kind, float* out)
{
    const bool   surface = field >= DP_FIELD_SURFACE && field < DP_FIELD_COAT;
    const int    name = field - (surface ? DP_FIELD_SURFACE : DP_FIELD_COAT);
    const int    own = field == DP_FIELD_HEIGHT_CHANGE ? -1 : coat_named(terrain, name);
    const float* coats = tile && terrain->coats ? tile_coats_in(terrain, tile) + at : NULL;
    for (int i = 0; i < count; ++i) {
        const float* lies = coats ? coats + i : NULL;
        const double all = lies ? thickness(terrain, lies) : 0.0;
        const double part = lies && own >= 0 ? (double)lies[(size_t)own * TILE_CELLS] : 0.0;
        if (field == DP_FIELD_HEIGHT_CHANGE) {
            if (all > 0.0) out[i] = (float)((double)out[i] + all);
            continue;
        }
        const double hides = fmin(all / DP_COVERS, 1.0);  // MODEL 6.16
        const bool   below = terrain->name_of_soil[kind[i]] == name;
        const double seen = (below ? 1.0 - hides : 0.0) + (all > 0.0 ? hides * part / all : 0.0);
        out[i] = (float)(surface ? seen : part);
    }
}
