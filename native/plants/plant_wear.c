// plants/plant_wear.c - what bending costs a stem, and how it gets it back. TRAIL (6), MODEL 7.3
//
// Departures
//   TRAIL (6): the loss is by seconds, not by frames, and its sum over a step is exact while phi
//   stays in its range, so any dt gives the same strength. What breaks by phi > phi_max breaks at
//   once.
//   A bend above a broken one is held by nothing: it neither wears nor recovers, and
//   TRAIL (7) does not count it, so that half the stems broken at their feet is half the cover.
//   Strength is a double: a day's recovery in steps of a frame is below what a float can hold.
#include "base/wide.h"

#include <string.h>

#include "plants/plant_inside.h"

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
        const double worn = was - loss > 0.0 ? was - loss : 0.0;                     // TRAIL (6)
        const double recovered = was + gain < reserve[l] ? was + gain : reserve[l];  // TRAIL (6)
        double       now = dot <= wears * size && size > 0.0 ? worn : recovered;
        now = dot < breaks * size ? 0.0 : now;  // TRAIL (6)
        now = limp[l] > 0.0f ? was : now;
        strength[l] = was > 0.0 ? now : 0.0;
    }
}

void dp_plant_wear_block(const PlantStand* stand, PlantBlock* block, double dt)
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
    if (broke) dp_plant_count_broken(stand, block);
}

// alpha_k and what hangs limp, from the bends' strength
void dp_plant_count_broken(const PlantStand* stand, PlantBlock* block)
{
    const DpPlantShape shape = stand->shape;
    PlantState*        state = block->state;
    for (int l = 0; l < DP_LANES; ++l) {
        int intact = 0;
        for (int stem = 0; stem < shape.stems; ++stem) {
            float limp = 0.0f;
            for (int row = 0; row + 2 < shape.rows; ++row) {
                const int b = stem * (shape.rows - 2) + row;
                if (!(state->strength[b * DP_LANES + l] > 0.0)) limp = 1.0f;
                intact += !(limp > 0.0f);
                state->limp[(stem * shape.rows + row + 2) * DP_LANES + l] = limp;
            }
        }
        const float was = block->alpha[l];
        block->alpha[l] = (float)intact / (float)shape.bends;  // TRAIL (7), N_c / N_c0
        if (l >= block->count || !(was < block->alpha[l] || was > block->alpha[l])) continue;
        block->changed = true;
        block->broke += (int)lround(((double)was - (double)block->alpha[l]) * shape.bends);
    }
}
