// What soils are like at rest, and how that differs from place to place. MODEL 6.7
#include <math.h>

#include "base/alloc.h"
#include "base/noise.h"
#include "terrain/terrain_inside.h"

#define PLATE_SEED 61u
#define PIECE_WIDTH 3.0  // of a crust, in its thickness
#define STANDS 1.57      // walls of soils with a larger wall angle all stand [rad]
#define WALL_SEED 11u    // of what differs: walls ..
#define PIECE_SEED 31u
#define REPOSE_SEED 47u    // .. rest angle, rims and rebound
#define EACH 0.70710678f   // waves and pieces count alike: 1/sqrt(2)
#define REPOSE_SHARE 0.5f  // of rho, by which the rest slope differs
#define FLATTEST 0.3f      // .. and no further than by these factors
#define STEEPEST 2.0f

bool dp_rough_soils(DpTerrain* terrain)
{
    const size_t soils = (size_t)terrain->soil_count;
    terrain->slope = dp_alloc(soils, sizeof *terrain->slope);
    terrain->wall = dp_alloc(soils, sizeof *terrain->wall);
    if (!terrain->slope || !terrain->wall) return false;
    const DpSoil* all = terrain->row ? terrain->row : terrain->soils;  // rows as they were given
    for (size_t s = 0; s < soils * (terrain->row ? (size_t)terrain->times : 1); ++s) {
        const DpSoil now = terrain->row ? dp_wet_soil(&all[s]) : all[s];
        terrain->walls = terrain->walls || (double)now.wall_angle <= STANDS;
        terrain->rough = terrain->rough || all[s].roughness > 0.0f;
        terrain->springs = terrain->springs || all[s].rebound > 0.0f;
        terrain->crusts = terrain->crusts || dp_has_crust(&all[s]);
    }
    dp_soil_slopes(terrain);
    return true;
}

void dp_soil_slopes(DpTerrain* terrain)
{
    for (int s = 0; s < terrain->soil_count; ++s) {
        const double wall = (double)terrain->soils[s].wall_angle;
        terrain->slope[s] = (float)tan((double)terrain->soils[s].rest_angle);
        terrain->wall[s] = wall > STANDS ? INFINITY : (float)tan(wall);
    }
    ++terrain->revision;
}

// the cells of one kind: as their soil is, times what their place makes of it
static void rough_kind(const DpTerrain* terrain, const Tile* tile, int kind, const float* walls,
                       const float* repose_waves, float* rough)
{
    const float rho = terrain->soils[kind].roughness;
    for (int n = 0; n < TILE_CELLS; ++n) {
        if (terrain->soil_count > 1 && tile->kind[n] != kind) continue;
        const float repose = 1.0f + REPOSE_SHARE * rho * repose_waves[n];
        const float held = repose < FLATTEST ? FLATTEST : repose > STEEPEST ? STEEPEST : repose;
        const float wall = (float)dp_noise_growth((double)(rho * walls[n]));
        rough[n] = terrain->slope[kind] * held;
        rough[TILE_CELLS + n] = terrain->wall[kind] * wall;
        rough[2 * TILE_CELLS + n] = rho * repose_waves[n];
    }
}

// whether a soil is rough now, or at any other time
static bool is_rough(const DpTerrain* terrain, int kind)
{
    bool rough = terrain->soils[kind].roughness > 0.0f;
    for (int t = 0; t < terrain->times && !rough; ++t)
        rough = terrain->row[t * terrain->soil_count + kind].roughness > 0.0f;
    return rough;
}

void dp_rough_again(const DpTerrain* terrain, Tile* tile)
{
    tile->revision = terrain->revision;
    if (!terrain->rough) return;
    const float* waves = tile_waves(terrain, tile);
    for (int kind = 0; kind < terrain->soil_count; ++kind)
        rough_kind(terrain, tile, kind, waves, waves + TILE_CELLS, tile_rough(terrain, tile));
}

// waves of a soil that the ground shows where it lies, for when the soil has changed
static void keep_waves(const DpTerrain* terrain, Tile* tile, int kind, const float* walls,
                       const float* repose_waves)
{
    float* waves = tile_waves(terrain, tile);
    for (int n = 0; n < TILE_CELLS; ++n) {
        if (terrain->soil_count > 1 && tile->kind[n] != kind) continue;
        waves[n] = walls[n];
        waves[TILE_CELLS + n] = repose_waves[n];
    }
}

void dp_rough_tile(const DpTerrain* terrain, Tile* tile)
{
    const DpCellRect cells = dp_cells(tile->tx * DP_TILE, tile->ty * DP_TILE, DP_TILE, DP_TILE);
    bool             there[256] = {false};
    float            walls[TILE_CELLS], repose_waves[TILE_CELLS], pieces[TILE_CELLS];
    for (int n = 0; n < TILE_CELLS; ++n) there[terrain->soil_count > 1 ? tile->kind[n] : 0] = true;
    for (int kind = 0; kind < terrain->soil_count; ++kind) {
        if (!there[kind]) continue;
        const double grain = (double)terrain->soils[kind].grain_size;
        if (is_rough(terrain, kind)) {
            dp_noise_waves(&terrain->grid, cells, 4.0 * grain, 0.5 * grain, WALL_SEED, walls);
            dp_noise_pieces(&terrain->grid, cells, 2.0 * grain, PIECE_SEED, pieces);
            dp_noise_waves(&terrain->grid, cells, 2.0 * grain, 0.5 * grain, REPOSE_SEED,
                           repose_waves);
            for (int n = 0; n < TILE_CELLS; ++n) walls[n] = EACH * (walls[n] + pieces[n]);
        } else {
            for (int n = 0; n < TILE_CELLS; ++n) walls[n] = repose_waves[n] = 0.0f;
        }
        rough_kind(terrain, tile, kind, walls, repose_waves, tile_rough(terrain, tile));
        if (terrain->row) keep_waves(terrain, tile, kind, walls, repose_waves);
    }
}

void dp_plate_tile(const DpTerrain* terrain, Tile* tile)
{
    const DpCellRect cells = dp_cells(tile->tx * DP_TILE, tile->ty * DP_TILE, DP_TILE, DP_TILE);
    uint32_t         pieces[TILE_CELLS], *plates = tile_plates(terrain, tile);
    for (int kind = 0; kind < terrain->soil_count; ++kind) {
        float thickest = terrain->soils[kind].crust_depth;
        for (int t = 0; t < terrain->times; ++t)
            thickest = fmaxf(thickest, terrain->row[t * terrain->soil_count + kind].crust_depth);
        if (thickest > 0.0f)
            dp_noise_plates(&terrain->grid, cells, PIECE_WIDTH * (double)thickest, PLATE_SEED,
                            pieces);
        for (int n = 0; n < TILE_CELLS; ++n)
            if (terrain->soil_count == 1 || tile->kind[n] == kind)
                plates[n] = thickest > 0.0f ? pieces[n] : 0;
    }
}
