// plants/plant_roots.c - where plants stand, and how one plant is read and written. TRAIL 4.1
#include <string.h>

#include "base/alloc.h"
#include "plants/plant_inside.h"

// no particle of a plant stays below the surface
static void lift_out(const PlantStand* stand, const PlantBlock* block, const DpPlantGround* ground,
                     int l)
{
    for (int p = 0; p < stand->shape.particles; ++p) {
        const int    k = p * DP_LANES + l;
        const double own = block->origin[2] + (double)block->state->at[2][k];
        if (p % stand->shape.rows < DP_PLANT_HELD || own > (double)block->ceiling[l]) continue;
        const double height =
            dp_plant_ground_at(ground, block->origin[0] + (double)block->state->at[0][k],
                               block->origin[1] + (double)block->state->at[1][k]);
        if (own < height) block->state->at[2][k] = (float)(height - block->origin[2]);
    }
}

// plants within one piece of the ground
static void follow(DpPlants* plants, const DpPlantGround* ground, const DpPlantGround* piece)
{
    const double x0 = piece->x0 - piece->cell, x1 = piece->x0 + piece->nx * piece->cell;
    const double y0 = piece->y0 - piece->cell, y1 = piece->y0 + piece->ny * piece->cell;
    for (int s = 0; s < plants->stands; ++s) {
        PlantStand*  stand = &plants->stand[s];
        const double lies = piece->rose ? (double)stand->extent : 0.0;  // how far from its root
        for (int b = 0; b < stand->blocks; ++b) {
            const float* box = stand->box + 4 * b;
            if ((double)box[0] > x1 + lies || (double)box[2] < x0 - lies ||
                (double)box[1] > y1 + lies || (double)box[3] < y0 - lies)
                continue;
            PlantBlock* block = &stand->block[b];
            for (int l = 0; l < DP_LANES; ++l) {
                if (block->awake) {  // the step sees to its roots
                    if (piece->rose) lift_out(stand, block, ground, l);
                    continue;
                }
                PlantBlock was = *block;
                dp_plant_ground_lane(stand, block, ground, l);
                if (!block->state) continue;
                for (int p = 0; p < stand->shape.particles; ++p)  // a sleeper rises and sinks whole
                    block->state->at[2][p * DP_LANES + l] +=
                        (float)(dp_plant_rest_at(stand, block, p, l).z -
                                dp_plant_rest_at(stand, &was, p, l).z);
                if (piece->rose) lift_out(stand, block, ground, l);
            }
        }
    }
}

DpStatus dp_plants_follow(DpPlants* plants, const DpPlantGround* ground)
{
    if (!plants || !ground || !dp_plant_ground_ok(ground)) return DP_BAD_ARGUMENT;
    for (const DpPlantGround* piece = ground; piece; piece = piece->next)
        if (!piece->at) follow(plants, ground, piece);
    return DP_OK;
}

double dp_plants_extent(const DpPlants* plants)
{
    double max = 0.0;
    for (int s = 0; s < plants->stands; ++s)
        max = fmax(max, (double)plants->stand[s].extent + (double)plants->stand[s].kind.radius);
    return max;
}

double dp_plants_height(const DpPlants* plants)
{
    double max = 0.0;
    for (int s = 0; s < plants->stands; ++s) max = fmax(max, (double)plants->stand[s].kind.height);
    return max;
}

double dp_plants_root_radius(const DpPlants* plants)
{
    double max = 0.0;
    for (int s = 0; s < plants->stands; ++s)
        max = fmax(max, (double)plants->stand[s].kind.root_radius);
    return max;
}

DpStatus dp_plants_slope(DpPlants* plants, int name, const float* slope)
{
    if (!plants || name < 0 || name >= plants->stands || !slope) return DP_BAD_ARGUMENT;
    PlantStand* stand = &plants->stand[name];
    for (int k = 0; k < 2 * stand->count; ++k)
        if (!isfinite(slope[k])) return DP_BAD_ARGUMENT;
    for (int slot = 0; slot < stand->blocks * DP_LANES; ++slot) {
        PlantBlock* block = &stand->block[slot / DP_LANES];
        const int   lane = slot % DP_LANES, plant = block->plant[lane];
        for (int d = 0; d < 2; ++d)
            block->slope[d][lane] = fminf(fmaxf(slope[2 * plant + d], -1.0f), 1.0f);
    }
    return DP_OK;
}

static PlantBlock* find(const DpPlants* plants, int stand, int plant, int* lane)
{
    if (!plants || stand < 0 || stand >= plants->stands) return NULL;
    const PlantStand* at = &plants->stand[stand];
    if (plant < 0 || plant >= at->count) return NULL;
    *lane = at->where[plant] % DP_LANES;
    return &at->block[at->where[plant] / DP_LANES];
}

DpStatus dp_plants_read(const DpPlants* plants, int stand_name, int plant, float* position,
                        float* velocity, double* strength)
{
    int               lane = 0;
    const PlantBlock* block = find(plants, stand_name, plant, &lane);
    if (!block) return DP_BAD_ARGUMENT;
    const PlantStand* stand = &plants->stand[stand_name];
    for (int p = 0; p < stand->shape.particles; ++p)
        for (int d = 0; d < 3; ++d) {
            const int    at = p * DP_LANES + lane;
            const DpVec3 rest = dp_plant_rest_at(stand, block, p, lane);
            const double still = d == 0 ? rest.x : d == 1 ? rest.y : rest.z;
            const double from = block->state ? (double)block->state->at[d][at] : still;
            if (position) position[3 * p + d] = (float)(block->origin[d] + from);
            if (velocity) velocity[3 * p + d] = block->state ? block->state->speed[d][at] : 0.0f;
        }
    const double slept = block->awake ? 0.0 : plants->now - block->asleep_since;
    for (int b = 0; strength && b < stand->shape.bends; ++b) {
        const double gain = (double)stand->kind.recover_rate * slept;
        const double now =
            block->state ? dp_plant_recovered(stand, block, b, lane, gain) : block->reserve[lane];
        strength[b] = now;
    }
    return DP_OK;
}

DpStatus dp_plants_write(DpPlants* plants, int stand_name, int plant, const float* position,
                         const float* velocity, const double* strength)
{
    int         lane = 0;
    PlantBlock* block = find(plants, stand_name, plant, &lane);
    if (!block) return DP_BAD_ARGUMENT;
    PlantStand* stand = &plants->stand[stand_name];
    for (int k = 0; k < 3 * stand->shape.particles; ++k)
        if ((position && !(fabsf(position[k]) < 1e7f)) ||
            (velocity && !(fabsf(velocity[k]) < 1e4f)))
            return DP_BAD_ARGUMENT;
    for (int b = 0; strength && b < stand->shape.bends; ++b)
        if (!(strength[b] >= 0.0 && strength[b] <= 1.000001 * block->reserve[lane]))
            return DP_BAD_ARGUMENT;
    if (!dp_plant_wake(plants, stand, block)) return DP_NO_MEMORY;
    stand->up[block - stand->block] = 1;
    for (int p = 0; p < stand->shape.particles; ++p)
        for (int d = 0; d < 3; ++d) {
            const int at = p * DP_LANES + lane;
            if (position)
                block->state->at[d][at] = (float)((double)position[3 * p + d] - block->origin[d]);
            if (velocity) block->state->speed[d][at] = velocity[3 * p + d];
        }
    for (int b = 0; strength && b < stand->shape.bends; ++b)
        block->state->strength[b * DP_LANES + lane] = fmin(strength[b], block->reserve[lane]);
    dp_plant_count_broken(stand, block);
    return DP_OK;
}

double dp_plants_reserve(const DpPlants* plants, int stand, int plant)
{
    int               lane = 0;
    const PlantBlock* block = find(plants, stand, plant, &lane);
    return block ? block->reserve[lane] : 0.0;
}

DpStatus dp_plants_vary(DpPlants* plants, int stand_name, const float* z)
{
    const int count = stand_name >= 0 ? dp_plants_count(plants, stand_name) : 0;
    if (count < 1 || !z) return DP_BAD_ARGUMENT;
    const PlantStand* stand = &plants->stand[stand_name];
    for (int k = 0; k < count; ++k)
        if (!(fabsf(z[k]) <= 8.0f)) return DP_BAD_ARGUMENT;
    for (int b = 0; b < stand->blocks; ++b)
        if (stand->block[b].state) return DP_BAD_ARGUMENT;
    for (int slot = 0; slot < stand->blocks * DP_LANES; ++slot) {
        PlantBlock*  block = &stand->block[slot / DP_LANES];
        const int    lane = slot % DP_LANES;
        const double by = (double)stand->kind.spread * (double)z[block->plant[lane]];
        block->reserve[lane] = (double)stand->kind.strength * exp(by);
    }
    return DP_OK;
}

double dp_plants_alpha(const DpPlants* plants, int stand, int plant)
{
    int               lane = 0;
    const PlantBlock* block = find(plants, stand, plant, &lane);
    return block ? (double)block->alpha[lane] : 0.0;
}
