// plants/plant_wear.c - what bending costs a stem, and how it gets it back. TRAIL (6)
//
// Departures
//   TRAIL (6): the loss is by seconds, not by frames, and its sum over a step is exact while phi
//   stays in its range, so any dt gives the same strength. What breaks by phi > phi_max breaks at
//   once.
//   A bend above a broken one is held by nothing: it neither wears nor recovers, and
//   TRAIL (7) does not count it, so that half the stems broken at their feet is half the cover.
//   Regrowth (ours): d alpha/dt = r (w + (1 - w) alpha) (1 - alpha), alpha the cover around a plant
//   as far as runners and heavy seeds come, four times its roots' reach: a lane grows again from its
//   borders, too. A share w comes from seeds that lie in the soil or fly in, wherever it is bare.
//   Strength is a double: a day's recovery in steps of a frame is below what a float can hold.
#include "base/wide.h"

#include <string.h>

#include "base/alloc.h"
#include "plants/plant_inside.h"

#define PI 3.14159265358979323846

double dp_plant_wear(const DpPlantKind* kind, double reserve, double strength, double angle,
                     double dt)
{
    const double loss = (double)kind->degrade_rate * dt, gain = (double)kind->recover_rate * dt;
    if (strength <= 0.0) return 0.0;                    // what is broken stays broken
    if (angle > (double)kind->break_angle) return 0.0;  // TRAIL (6), phi > phi_max
    if (angle >= (double)kind->degrade_angle)
        return strength > loss ? strength - loss : 0.0;            // TRAIL (6), loses mu_deg dt
    return strength + gain < reserve ? strength + gain : reserve;  // TRAIL (6), regains mu_rec dt
}

double dp_plant_regrow(const DpPlantKind* kind, double alpha, double seconds)
{
    const double share = dp_clamp(alpha, 0.0, 1.0), w = (double)kind->seed_share;
    const double source = w + (1.0 - w) * share;
    if (!(source > 0.0)) return 0.0;
    // of d alpha/dt = r (w + (1 - w) alpha) (1 - alpha): what is bare, by what it grows from, decays
    const double bare = (1.0 - share) / source * exp(-(double)kind->regrow_rate * seconds);
    return (1.0 - w * bare) / (1.0 + (1.0 - w) * bare);
}

// cosines of the angles at which a bend wears and breaks; -2 = it never does
static void limits(const PlantStand* stand, int bend, double* wears, double* breaks)
{
    const DpPlantKind* kind = &stand->kind;
    const int          rows = stand->shape.rows, stem = bend / (rows - 2), row = bend % (rows - 2);
    const float*       at = stand->rest + 3 * (stem * rows + row);
    double             dot = 0.0, a2 = 0.0, b2 = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double a = (double)at[3 + d] - (double)at[d],
                     b = (double)at[6 + d] - (double)at[3 + d];
        dot += a * b, a2 += a * a, b2 += b * b;
    }
    const double size = sqrt(a2 * b2);
    const double rest = size > 0.0 ? acos(dp_clamp(dot / size, -1.0, 1.0)) : 0.0;  // phi_0
    const double low = rest + (double)kind->degrade_angle, high = rest + (double)kind->break_angle;
    *wears = low < PI ? cos(low) : -2.0;
    *breaks = high < PI ? cos(high) : -2.0;
}

// one bend of all lanes; the cosine tells, no angle is needed.
DP_CLONES
static void wear_bend(const float* const at[3], int p, double wears, double breaks, double loss,
                      double gain, const double* reserve, const float* limp, double* strength)
{
    const float *x = at[0] + p * DP_LANES, *y = at[1] + p * DP_LANES, *z = at[2] + p * DP_LANES;
    for (int l = 0; l < DP_LANES; ++l) {
        const double ax = (double)(x[DP_LANES + l] - x[l]);
        const double ay = (double)(y[DP_LANES + l] - y[l]);
        const double az = (double)(z[DP_LANES + l] - z[l]);
        const double bx = (double)(x[2 * DP_LANES + l] - x[DP_LANES + l]);
        const double by = (double)(y[2 * DP_LANES + l] - y[DP_LANES + l]);
        const double bz = (double)(z[2 * DP_LANES + l] - z[DP_LANES + l]);
        const double dot = ax * bx + ay * by + az * bz;
        const double size = sqrt((ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz));
        const double was = strength[l];
        const double worn = was - loss > 0.0 ? was - loss : 0.0;                  // TRAIL (6)
        const double rested = was + gain < reserve[l] ? was + gain : reserve[l];  // TRAIL (6)
        double       now = dot <= wears * size && size > 0.0 ? worn : rested;
        now = dot < breaks * size ? 0.0 : now;  // TRAIL (6)
        now = limp[l] > 0.0f ? was : now;
        strength[l] = was > 0.0 ? now : 0.0;
    }
}

void plant_wear_block(const PlantStand* stand, PlantBlock* block, double dt)
{
    const DpPlantShape shape = stand->shape;
    PlantState*        state = block->state;
    const float* const at[3] = {state->at[0], state->at[1], state->at[2]};
    const double       loss = (double)stand->kind.degrade_rate * dt;
    const double       gain = (double)stand->kind.recover_rate * dt;
    bool               broke = false;
    block->wearing = false;
    for (int b = 0; b < shape.bends; ++b) {
        const int stem = b / (shape.rows - 2), row = b % (shape.rows - 2);
        double*   strength = state->strength + b * DP_LANES;
        double    was[DP_LANES], wears = stand->limit[2 * b], breaks = stand->limit[2 * b + 1];
        memcpy(was, strength, sizeof was);
        wear_bend(at, stem * shape.rows + row, wears, breaks, loss, gain, block->reserve,
                  state->limp + (stem * shape.rows + row + 1) * DP_LANES, strength);
        for (int l = 0; l < block->count; ++l) {
            broke = broke || (was[l] > 0.0 && !(strength[l] > 0.0));
            block->wearing = block->wearing || strength[l] < was[l];
        }
    }
    if (broke) plant_count_broken(stand, block);
}

// alpha_k and what hangs limp, from the bends' strength
void plant_count_broken(const PlantStand* stand, PlantBlock* block)
{
    const DpPlantShape shape = stand->shape;
    PlantState*        state = block->state;
    for (int l = 0; l < DP_LANES; ++l) {
        int whole = 0;
        for (int stem = 0; stem < shape.stems; ++stem) {
            float limp = 0.0f;
            for (int row = 0; row + 2 < shape.rows; ++row) {
                const int b = stem * (shape.rows - 2) + row;
                if (!(state->strength[b * DP_LANES + l] > 0.0)) limp = 1.0f;
                whole += !(limp > 0.0f);
                state->limp[(stem * shape.rows + row + 2) * DP_LANES + l] = limp;
            }
        }
        const float was = block->alpha[l];
        block->alpha[l] = (float)whole / (float)shape.bends;  // TRAIL (7), N_c / N_c0
        if (l >= block->count || !(was < block->alpha[l] || was > block->alpha[l])) continue;
        block->changed = true;
        block->broke += (int)lround(((double)was - (double)block->alpha[l]) * shape.bends);
    }
}

void plant_limits(PlantStand* stand)
{
    for (int b = 0; b < stand->shape.bends; ++b)
        limits(stand, b, &stand->limit[2 * b], &stand->limit[2 * b + 1]);
}

void plant_catch_up(const PlantStand* stand, PlantBlock* block, double seconds)
{
    const double gain = (double)stand->kind.recover_rate * seconds;
    for (int b = 0; block->state && b < stand->shape.bends; ++b)
        for (int l = 0; l < DP_LANES; ++l)
            block->state->strength[b * DP_LANES + l] = plant_rested(stand, block, b, l, gain);
}

double plant_rested(const PlantStand* stand, const PlantBlock* block, int b, int l, double gain)
{
    const int    rows = stand->shape.rows, stem = b / (rows - 2), row = b % (rows - 2);
    const double now = block->state->strength[b * DP_LANES + l];
    const bool   limp = block->state->limp[(stem * rows + row + 1) * DP_LANES + l] > 0.0f;
    return now > 0.0 && !limp ? fmin(now + gain, block->reserve[l]) : now;
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
        if (!broken || !(plant_hash(seed, stems_before, (uint64_t)stem) < chance)) continue;
        for (int k = 0; k + 2 < shape.rows; ++k) strength[k * DP_LANES] = block->reserve[lane];
        for (int r = 0; r < shape.rows; ++r) {
            const int    p = stem * shape.rows + r, at = p * DP_LANES + lane;
            const DpVec3 rest = plant_rest_at(stand, block, p, lane);
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
            cover[at + (size_t)slot] = plant_cover_around(plants, block->root[0][slot % DP_LANES],
                                                          block->root[1][slot % DP_LANES]);
        }
        at += (size_t)stand->blocks * DP_LANES;
    }
    return cover;
}

static void rest_block(DpPlants* plants, const PlantStand* stand, PlantBlock* block,
                       const float* cover, double seconds)
{
    if (!block->state) return;
    if (block->awake) plant_catch_up(stand, block, seconds);
    for (int l = 0; l < block->count; ++l) {
        const double alpha = (double)cover[l];
        if (!(alpha < 1.0) || !(block->alpha[l] < 1.0f)) continue;
        const double   grown = dp_plant_regrow(&stand->kind, alpha, seconds);
        const double   chance = (grown - alpha) / (1.0 - alpha);
        const uint64_t name = plant_name(block->root[0][l], block->root[1][l]);
        regrow_plant(stand, block, l, chance, plants->seed + 77u * plants->rests, name);
    }
    plant_count_broken(stand, block);
    block->broke = 0;
}

DpStatus dp_plants_rest(DpPlants* plants, double seconds)
{
    if (!plants || !(seconds >= 0.0) || !(seconds < 1e12)) return DP_BAD_ARGUMENT;
    float* cover = cover_before(plants);
    if (!cover) return DP_NO_MEMORY;
    const float* here = cover;
    ++plants->rests;
    for (int s = 0; s < plants->stands; ++s) {
        PlantStand* stand = &plants->stand[s];
        for (int b = 0; b < stand->blocks; ++b, here += DP_LANES)
            rest_block(plants, stand, &stand->block[b], here, seconds);
    }
    plants->now += seconds;
    dp_free(cover);
    return DP_OK;
}
