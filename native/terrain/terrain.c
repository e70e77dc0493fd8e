// A terrain: the ground as it was given, its soils, and what is asked of all of it.
#include "terrain/terrain.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "terrain/terrain_inside.h"

#define DATUM_STEP 16.0  // [m]: floats over the datum are good to half a micrometre

static bool is_soil(const DpSoil* soil)
{
    return isfinite(soil->young_modulus) && soil->young_modulus > 0.0f && soil->rest_angle > 0.0f &&
           (double)soil->rest_angle < acos(0.0) && soil->wall_angle > 0.0f &&
           soil->roughness >= 0.0f && soil->roughness <= 1.0f && soil->grain_size > 0.0f &&
           soil->rebound >= 0.0f && soil->rebound < 1.0f;
}

static bool are_options(const DpTerrainOptions* options)
{
    if (!(options->grid.cell > 0.0) || !isfinite(options->grid.cell) ||
        !isfinite(options->grid.x0) || !isfinite(options->grid.y0))
        return false;
    if (options->soil_count < 1 || options->soil_count > 255 || !options->soils) return false;
    if (options->times < 0 || (options->times > 0 && !options->time)) return false;
    for (int s = 0; s < options->soil_count * (options->times > 0 ? options->times : 1); ++s)
        if (!is_soil(&options->soils[s])) return false;
    return true;
}

DpStatus dp_terrain_create(DpTerrain** terrain, const DpTerrainOptions* options,
                           const DpGround* ground)
{
    if (!terrain || !options || !ground || !are_options(options)) return DP_BAD_ARGUMENT;
    if (ground->kind_count < 0 || ground->kind_count > options->soil_count) return DP_BAD_ARGUMENT;

    DpTerrain* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    const size_t soils = (size_t)options->soil_count;
    created->grid = options->grid;
    created->workers = options->workers < 1 ? 1 : options->workers;
    created->soil_count = options->soil_count;
    created->soils = dp_alloc(soils, sizeof *created->soils);
    DpStatus status = created->soils ? dp_source_create(&created->source, ground, created->workers)
                                     : DP_NO_MEMORY;
    if (status == DP_OK) {
        for (size_t s = 0; s < soils; ++s) created->soils[s] = dp_wet_soil(&options->soils[s]);
        status = dp_times_keep(created, options);
        if (status == DP_OK && !dp_rough_soils(created)) status = DP_NO_MEMORY;
        if (status == DP_OK) status = dp_coats_find(created);
    }
    if (status != DP_OK) {
        dp_terrain_destroy(created);
        return status;
    }
    *terrain = created;
    dp_terrain_move_datum(created, created->source.somewhere);
    return DP_OK;
}

void dp_terrain_destroy(DpTerrain* terrain)
{
    if (!terrain) return;
    for (size_t t = 0; t < terrain->tiles; ++t) dp_tile_destroy(terrain->sorted[t]);
    dp_free(terrain->sorted);
    dp_free(terrain->marked);
    dp_free(terrain->slot);
    dp_source_destroy(&terrain->source);
    dp_free(terrain->soils);
    dp_free(terrain->row);
    dp_free(terrain->time);
    dp_free(terrain->slope);
    dp_free(terrain->wall);
    dp_free(terrain->coat_of_soil);
    dp_free(terrain->name_of_soil);
    dp_free(terrain->layers);
    dp_free(terrain->layer_start);
    dp_free(terrain);
}

DpGrid dp_terrain_grid(const DpTerrain* terrain)
{
    return terrain->grid;
}

double dp_terrain_datum(const DpTerrain* terrain)
{
    return terrain->datum;
}

void dp_terrain_move_datum(DpTerrain* terrain, double height)
{
    if (terrain->tiles == 0 && !terrain->cover)
        terrain->datum = DATUM_STEP * rint(height / DATUM_STEP);
}

int dp_terrain_soil_count(const DpTerrain* terrain)
{
    return terrain->soil_count;
}

const DpSoil* dp_terrain_soils(const DpTerrain* terrain)
{
    return terrain->soils;
}

bool dp_terrain_springs(const DpTerrain* terrain)
{
    return terrain->springs;
}

size_t dp_terrain_tile_count(const DpTerrain* terrain)
{
    return terrain->tiles;
}

void dp_terrain_totals(const DpTerrain* terrain, double* heaped, double* pressed, double* deepest)
{
    const double area = terrain->grid.cell * terrain->grid.cell;
    double       heap = 0.0, compression = 0.0;
    float        highest = 0.0f;
    for (size_t t = 0; t < terrain->tiles; ++t) {
        const Tile* tile = tile_at(terrain, t);
        for (int n = 0; n < TILE_CELLS; ++n) {
            heap += (double)tile->heap[n];
            compression += (double)tile->compression[n];
            highest = tile->compression[n] > highest ? tile->compression[n] : highest;
        }
    }
    *heaped = heap * area;
    *pressed = compression * area;
    *deepest = (double)highest;
}
