// plants/plant_sleep.c - blocks that wake and fall asleep, and what their time asleep gave back.
#include <string.h>

#include "base/alloc.h"
#include "plants/plant_inside.h"

double dp_plant_recovered(const PlantStand* stand, const PlantBlock* block, int b, int l,
                          double gain)
{
    const int    rows = stand->shape.rows, stem = b / (rows - 2), row = b % (rows - 2);
    const double now = block->state->strength[b * DP_LANES + l];
    const bool   limp = block->state->limp[(stem * rows + row + 1) * DP_LANES + l] > 0.0f;
    return now > 0.0 && !limp ? fmin(now + gain, block->reserve[l]) : now;
}

void dp_plant_catch_up(const PlantStand* stand, PlantBlock* block, double seconds)
{
    const double gain = (double)stand->kind.recover_rate * seconds;
    for (int b = 0; block->state && b < stand->shape.bends; ++b)
        for (int l = 0; l < DP_LANES; ++l)
            block->state->strength[b * DP_LANES + l] = dp_plant_recovered(stand, block, b, l, gain);
}

PlantState* dp_plant_state_create(const PlantStand* stand)
{
    const size_t places = (size_t)stand->shape.particles * DP_LANES;
    const size_t bends = (size_t)stand->shape.bends * DP_LANES;
    const size_t head = (sizeof(PlantState) + 63) / 64 * 64;
    char*        memory = dp_alloc(1, head + bends * sizeof(double) + 10 * places * sizeof(float));
    if (!memory) return NULL;
    PlantState* state = (PlantState*)(void*)memory;
    state->strength = (double*)(void*)(memory + head);
    float* grid = (float*)(void*)(memory + head + bends * sizeof(double));
    for (int d = 0; d < 3; ++d, grid += places) state->at[d] = grid;
    for (int d = 0; d < 3; ++d, grid += places) state->speed[d] = grid;
    state->limp = grid;
    state->floor = grid + places;
    for (int d = 0; d < 2; ++d) state->seen[d] = grid + (size_t)(2 + d) * places;
    return state;
}

bool dp_plant_wake(DpPlants* plants, PlantStand* stand, PlantBlock* block)
{
    if (!block->state) {
        PlantState* state = block->state = dp_plant_state_create(stand);
        if (!state) return false;
        for (int p = 0; p < stand->shape.particles; ++p)
            for (int l = 0; l < DP_LANES; ++l) {
                const DpVec3 at = dp_plant_rest_at(stand, block, p, l);
                state->at[0][p * DP_LANES + l] = (float)at.x;
                state->at[1][p * DP_LANES + l] = (float)at.y;
                state->at[2][p * DP_LANES + l] = (float)at.z;
            }
        for (int k = 0; k < stand->shape.bends * DP_LANES; ++k)
            state->strength[k] = block->reserve[k % DP_LANES];
    } else if (!block->awake) {
        dp_plant_catch_up(stand, block, plants->now - block->asleep_since);
    }
    for (int k = 0; !block->awake && k < stand->shape.particles * DP_LANES; ++k)
        block->state->floor[k] = DP_NO_FLOOR;
    block->awake = true;
    block->quiet = 0.0;
    return true;
}

void dp_plant_put_to_sleep(const DpPlants* plants, const PlantStand* stand, PlantBlock* block)
{
    const size_t places = (size_t)stand->shape.particles * DP_LANES;
    for (int d = 0; d < 3; ++d) memset(block->state->speed[d], 0, places * sizeof(float));
    block->awake = false;
    block->asleep_since = plants->now;
}
