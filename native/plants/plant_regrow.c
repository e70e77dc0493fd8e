// plants/plant_regrow.c - time that passes without walkers: what broke grows again. MODEL 7.5
//
// Regrowth (ours): d alpha/dt = r (w + (1 - w) alpha) (1 - alpha), alpha the cover around a plant as
// far as runners and heavy seeds come, four times its roots' radius: a lane grows again from its
// borders, too. A share w comes from seeds that lie in the soil or fly in, wherever it is bare.
#include "base/alloc.h"
#include "base/memory.h"
#include "plants/plant_inside.h"

double dp_plant_regrow(const DpPlantKind* kind, double alpha, double seconds)
{
    const double share = dp_clamp(alpha, 0.0, 1.0), w = (double)kind->seed_share;
    const double source = w + (1.0 - w) * share;
    if (!(source > 0.0)) return 0.0;
    // of d alpha/dt = r (w + (1 - w) alpha) (1 - alpha): what is bare, by what it grows from, decays
    const double bare = (1.0 - share) / source * exp(-(double)kind->regrow_rate * seconds);
    return (1.0 - w * bare) / (1.0 + (1.0 - w) * bare);  // MODEL 7.5
}

// stems that broke grow again, each with the same chance; what grew stands in its rest shape
static void regrow_plant(const PlantStand* stand, PlantBlock* block, int lane, double chance,
                         uint64_t seed, uint64_t stems_before)
{
    const DpPlantShape shape = stand->shape;
    PlantState*        state = block->state;
    for (int stem = 0; stem < shape.stems; ++stem) {
        double* strength = state->strength + stem * (shape.rows - 2) * DP_LANES + lane;
        bool    broken = false;
        for (int k = 0; k + 2 < shape.rows; ++k) broken = broken || !(strength[k * DP_LANES] > 0.0);
        if (!broken || !(dp_plant_hash(seed, stems_before, (uint64_t)stem) < chance)) continue;
        for (int k = 0; k + 2 < shape.rows; ++k) strength[k * DP_LANES] = block->reserve[lane];
        for (int r = 0; r < shape.rows; ++r) {
            const int    p = stem * shape.rows + r, at = p * DP_LANES + lane;
            const DpVec3 rest = dp_plant_rest_at(stand, block, p, lane);
            state->at[0][at] = (float)rest.x, state->at[1][at] = (float)rest.y;
            state->at[2][at] = (float)rest.z;
            for (int d = 0; d < 3; ++d) state->speed[d][at] = 0.0f;
        }
    }
}

// the cover around every plant, stand by stand: as it is before any of them grows
static float* cover_before(const DpPlants* plants)
{
    size_t slots = 0;
    for (int s = 0; s < plants->stands; ++s) slots += (size_t)plants->stand[s].blocks * DP_LANES;
    float* cover = dp_alloc(slots + 1, sizeof *cover);
    size_t at = 0;
    for (int s = 0; s < plants->stands && cover; ++s) {
        const PlantStand* stand = &plants->stand[s];
        for (int slot = 0; slot < stand->count; ++slot) {
            const PlantBlock* block = &stand->block[slot / DP_LANES];
            dp_memory_ease(sizeof *block);
            cover[at + (size_t)slot] = dp_plant_cover_around(
                plants, block->root[0][slot % DP_LANES], block->root[1][slot % DP_LANES]);
        }
        at += (size_t)stand->blocks * DP_LANES;
    }
    return cover;
}

static void rest_block(DpPlants* plants, const PlantStand* stand, PlantBlock* block,
                       const float* cover, double seconds)
{
    if (!block->state) return;
    if (block->awake) dp_plant_catch_up(stand, block, seconds);
    for (int l = 0; l < block->count; ++l) {
        const double alpha = (double)cover[l];
        if (!(alpha < 1.0) || !(block->alpha[l] < 1.0f)) continue;
        const double   grown = dp_plant_regrow(&stand->kind, alpha, seconds);
        const double   chance = (grown - alpha) / (1.0 - alpha);
        const uint64_t name = dp_plant_name(block->root[0][l], block->root[1][l]);
        regrow_plant(stand, block, l, chance, plants->seed + 77u * plants->advances, name);
    }
    dp_plant_count_broken(stand, block);
    block->broke = 0;
}

DpStatus dp_plants_advance_time(DpPlants* plants, double seconds)
{
    if (!plants || !(seconds >= 0.0) || !(seconds < 1e12)) return DP_BAD_ARGUMENT;
    float* cover = cover_before(plants);
    if (!cover) return DP_NO_MEMORY;
    const float* here = cover;
    ++plants->advances;
    for (int s = 0; s < plants->stands; ++s) {
        PlantStand* stand = &plants->stand[s];
        for (int b = 0; b < stand->blocks; ++b, here += DP_LANES) {
            dp_memory_ease(DP_EASE_PAGE);
            rest_block(plants, stand, &stand->block[b], here, seconds);
        }
    }
    plants->now += seconds;
    dp_free(cover);
    return DP_OK;
}
