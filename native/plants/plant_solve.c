// plants/plant_solve.c - how plants move: bends, edges, stems, one small step at a time. TRAIL (5)
// MODEL 7.2
//
// XPBD with one pass a sub-step: a correction is C / (sum of weights + compliance / h^2), so
// stiffness depends neither on passes nor on the time step. Lanes are plants: all do the same sums
// in the same order, in narrow or wide registers.
#include "base/inline.h"
#include "base/wide.h"

#include "plants/plant_inside.h"

#if defined(__clang__)
#define LANES _Pragma("clang loop vectorize(assume_safety)") for (int l = 0; l < DP_LANES; ++l)
#elif defined(__GNUC__)
#define LANES _Pragma("GCC ivdep") _Pragma("GCC unroll 1") for (int l = 0; l < DP_LANES; ++l)
#else
#define LANES for (int l = 0; l < DP_LANES; ++l)
#endif

#define BEYOND 1.02f  // edges between stems are hard when longer than this
#define LAST_PASSES 16
#define STICK 0.95f  // what is limp slides by no more than the rest of its way over the ground
#define TINY 1e-18f  // squared length of what has none [m^2]

// let particles go on as they moved; where they were is kept
DP_INLINE void go_on(float* restrict at, float* restrict speed, float* restrict before, float keep,
                     float h)
{
    LANES
    {
        before[l] = at[l];
        speed[l] *= keep;
        at[l] += h * speed[l];
    }
}

// three particles of a stem turn back to their rest bend. TRAIL (5), C_b
DP_INLINE void unbend(float* restrict x0, float* restrict x1, float* restrict x2,
                      const float* restrict give, const float* restrict rest, float w0, float w1)
{
    LANES
    {
        const float off = give[l] * (x0[l] - 2.0f * x1[l] + x2[l] - rest[l]);  // TRAIL (5)
        x0[l] -= w0 * off;
        x1[l] += 2.0f * w1 * off;
        x2[l] -= off;
    }
}

// two particles come to their distance: softly, and hard when far beyond it. TRAIL (5), C_s
DP_INLINE void pull(float* restrict ax, float* restrict ay, float* restrict az, float* restrict bx,
                    float* restrict by, float* restrict bz, const PlantEdge*        edge,
                    const float* restrict rest, const float* restrict joined, float soft)
{
    const float wa = edge->share_a, wb = edge->share_b;
    LANES
    {
        const float dx = bx[l] - ax[l], dy = by[l] - ay[l], dz = bz[l] - az[l];
        const float inverse = 1.0f / sqrtf(dx * dx + dy * dy + dz * dz + TINY);
        const float easy = soft * (1.0f - rest[l] * inverse);  // TRAIL (5)
        const float hard = 1.0f - BEYOND * rest[l] * inverse;
        const float share = joined[l] * (easy > hard ? easy : hard);
        ax[l] += wa * share * dx, ay[l] += wa * share * dy, az[l] += wa * share * dz;
        bx[l] -= wb * share * dx, by[l] -= wb * share * dy, bz[l] -= wb * share * dz;
    }
}

// the same for a stem, which keeps its length
DP_INLINE void pull_stem(float* restrict ax, float* restrict ay, float* restrict az,
                         float* restrict bx, float* restrict by, float* restrict bz,
                         const PlantEdge* edge)
{
    const float rest = edge->rest, wa = edge->share_a, wb = edge->share_b;
    LANES
    {
        const float dx = bx[l] - ax[l], dy = by[l] - ay[l], dz = bz[l] - az[l];
        const float share = 1.0f - rest / sqrtf(dx * dx + dy * dy + dz * dz + TINY);
        ax[l] += wa * share * dx, ay[l] += wa * share * dy, az[l] += wa * share * dz;
        bx[l] -= wb * share * dx, by[l] -= wb * share * dy, bz[l] -= wb * share * dz;
    }
}

// the ground under a particle as a step's end saw it, or the plane a plant stands on. What is limp
// sticks to it.
DP_INLINE void stay_above(float* restrict x, float* restrict y, float* restrict z,
                          const float* restrict was_x, const float* restrict was_y,
                          const float* restrict limp, const float* restrict floor,
                          const PlantBlock* block)
{
    LANES
    {
        const float plane = block->foot[2][l] + block->slope[0][l] * (x[l] - block->foot[0][l]) +
                            block->slope[1][l] * (y[l] - block->foot[1][l]);
        const float ground = floor[l] > DP_NO_FLOOR ? floor[l] : plane;
        const float stick = z[l] > ground ? 0.0f : STICK * limp[l];
        x[l] += stick * (was_x[l] - x[l]);
        y[l] += stick * (was_y[l] - y[l]);
        z[l] = z[l] > ground ? z[l] : ground;
    }
}

// stiffness of edges over a sub-step: how much of a correction is made
void dp_plant_soften(const PlantStand* stand, float* soft, double h)
{
    for (int e = 0; e < stand->edges; ++e) {
        const PlantEdge* edge = &stand->edge[e];
        const double     weight = edge->share_a > 0.0f && edge->share_b > 0.0f ? 2.0 : 1.0;
        soft[e] = edge->rate > 0.0f
                      ? (float)(weight / (weight + 1.0 / ((double)edge->rate * h * h)))
                      : 1.0f;
    }
}

// stems stand upright on whatever ground their feet found: what joins them is as long as it is
// there, be it on a slope or over the edge of a print; what is limp lets go of its neighbours
DP_CLONES
static void lengths_of_edges(const PlantStand* stand, const PlantBlock* block, float* length)
{
    for (int e = 0; e < stand->edges; ++e) {
        const PlantEdge* edge = &stand->edge[e];
        const int        rows = stand->shape.rows;
        const float *    a = stand->rest + 3 * edge->a, *b = stand->rest + 3 * edge->b;
        const float*     za = block->state->at[2] + edge->a / rows * rows * DP_LANES;  // their feet
        const float*     zb = block->state->at[2] + edge->b / rows * rows * DP_LANES;
        const float      dx = b[0] - a[0], dy = b[1] - a[1], dz = b[2] - a[2];
        float *          to = length + 2 * e * DP_LANES, *joined = to + DP_LANES;
        const float*     la = block->state->limp + edge->a * DP_LANES;
        const float*     lb = block->state->limp + edge->b * DP_LANES;
        LANES
        {
            const float up = dz + (zb[l] - za[l]);
            to[l] = sqrtf(dx * dx + dy * dy + up * up);
            joined[l] = (1.0f - la[l]) * (1.0f - lb[l]);
        }
    }
}

// a bend is as stiff as its strength is whole
DP_CLONES
static void prepare(const PlantStand* stand, const PlantBlock* block, float* give, double h)
{
    const float  alpha = (float)(1.0 / ((double)stand->bend_rate * h * h));
    const double max = 1.0;
    float        inverse[DP_LANES];
    for (int l = 0; l < DP_LANES; ++l) inverse[l] = (float)(max / block->reserve[l]);
    const int a_stem = stand->shape.rows - 2;
    for (int b = 0; b < stand->shape.bends; ++b) {
        const int     row = b % a_stem;
        const float   weight = row == 0 ? 1.0f : row == 1 ? 5.0f : 6.0f;
        const double* strength = block->state->strength + b * DP_LANES;
        float*        to = give + b * DP_LANES;
        LANES
        {
            const float firmness = (float)strength[l] * inverse[l];
            to[l] = firmness / (weight * firmness + alpha);
        }
    }
}

DP_CLONES
static void substep(const PlantStand* stand, PlantBlock* block, const float* give,
                    const float* length, float* before, const float* soft, double h_long)
{
    const DpPlantShape shape = stand->shape;
    const int          rows = shape.rows, size = shape.particles * DP_LANES;
    const float        h = (float)h_long;
    const float        keep = (float)(1.0 / (1.0 + (double)stand->kind.damping * h_long));
    const float        fall = (float)(DP_GRAVITY * h_long);
    PlantState*        state = block->state;
    float *            x = state->at[0], *y = state->at[1], *z = state->at[2];

    // semi-implicit Euler: speeds first, then places
    for (int p = 0; p < shape.particles; ++p) {
        const int at = p * DP_LANES;
        if (p % rows < DP_PLANT_HELD) continue;
        LANES state->speed[2][at + l] -= fall * state->limp[at + l];
        go_on(x + at, state->speed[0] + at, before + at, keep, h);
        go_on(y + at, state->speed[1] + at, before + size + at, keep, h);
        go_on(z + at, state->speed[2] + at, before + 2 * size + at, keep, h);
    }

    // bends, row by row over all stems: neighbours in this order share no particle
    for (int row = 0; row + 2 < rows; ++row) {
        const float w0 = row < DP_PLANT_HELD ? 0.0f : 1.0f,
                    w1 = row + 1 < DP_PLANT_HELD ? 0.0f : 1.0f;
        for (int stem = 0; stem < shape.stems; ++stem) {
            const int    b = stem * (rows - 2) + row, at = (stem * rows + row) * DP_LANES;
            const float* rest = stand->rest_bend + 3 * b;
            const float* share = give + b * DP_LANES;
            float        tx[DP_LANES], ty[DP_LANES], tz[DP_LANES];
            LANES
            {
                tx[l] = block->turn[0][l] * rest[0] - block->turn[1][l] * rest[1];
                ty[l] = block->turn[1][l] * rest[0] + block->turn[0][l] * rest[1];
                tz[l] = rest[2];
            }
            unbend(x + at, x + at + DP_LANES, x + at + 2 * DP_LANES, share, tx, w0, w1);
            unbend(y + at, y + at + DP_LANES, y + at + 2 * DP_LANES, share, ty, w0, w1);
            unbend(z + at, z + at + DP_LANES, z + at + 2 * DP_LANES, share, tz, w0, w1);
        }
    }

    for (int e = 0; e < stand->edges; ++e) {
        const PlantEdge* edge = &stand->edge[e];
        const int        a = edge->a * DP_LANES, b = edge->b * DP_LANES;
        if (edge->rate > 0.0f)
            pull(x + a, y + a, z + a, x + b, y + b, z + b, edge, length + 2 * e * DP_LANES,
                 length + (2 * e + 1) * DP_LANES, soft[e]);
        else
            pull_stem(x + a, y + a, z + a, x + b, y + b, z + b, edge);
    }

    for (int p = 0; p < shape.particles; ++p) {
        const int at = p * DP_LANES;
        if (p % rows < DP_PLANT_HELD) continue;
        stay_above(x + at, y + at, z + at, before + at, before + size + at, state->limp + at,
                   state->floor + at, block);
    }
}

// rows come together, except under soles, who see to that themselves; how far the most stretched of
// them was beyond its length, 1 = not at all
DP_INLINE float shorten_rows(const PlantStand* stand, PlantBlock* block, const float* length,
                             const float* open)
{
    const int rows = stand->shape.rows;
    float *   x = block->state->at[0], *y = block->state->at[1], *z = block->state->at[2];
    float     longest[DP_LANES] = {0};
    for (int e = 0; e < stand->edges; ++e) {
        const PlantEdge* edge = &stand->edge[e];
        const int        a = edge->a * DP_LANES, b = edge->b * DP_LANES;
        if (edge->b - edge->a != rows) continue;
        const float *rest = length + 2 * e * DP_LANES, *joined = rest + DP_LANES;
        LANES
        {
            const float dx = x[b + l] - x[a + l], dy = y[b + l] - y[a + l],
                        dz = z[b + l] - z[a + l];
            const float far = sqrtf(dx * dx + dy * dy + dz * dz + TINY);
            const float over = 1.0f - BEYOND * rest[l] / far, held = open[l] * joined[l];
            const float back = 0.5f * held * (over > 0.0f ? over : 0.0f);
            const float share = held * far / (rest[l] > TINY ? rest[l] : TINY);
            longest[l] = share > longest[l] ? share : longest[l];
            x[a + l] += back * dx, y[a + l] += back * dy, z[a + l] += back * dz;
            x[b + l] -= back * dx, y[b + l] -= back * dy, z[b + l] -= back * dz;
        }
    }
    float max = 0.0f;
    for (int l = 0; l < DP_LANES; ++l) max = longest[l] > max ? longest[l] : max;
    return max;
}

// from the foot upward, no stem is longer than it may be
DP_INLINE void shorten_stems(const PlantStand* stand, PlantBlock* block)
{
    const float max = DP_MAX_STRETCH * stand->gap;
    for (int p = 0; p < stand->shape.particles; ++p) {
        if (p % stand->shape.rows < DP_PLANT_HELD) continue;
        float *x = block->state->at[0] + p * DP_LANES, *y = block->state->at[1] + p * DP_LANES;
        float* z = block->state->at[2] + p * DP_LANES;
        LANES
        {
            const float dx = x[l] - x[l - DP_LANES], dy = y[l] - y[l - DP_LANES];
            const float dz = z[l] - z[l - DP_LANES];
            const float over = 1.0f - max / sqrtf(dx * dx + dy * dy + dz * dz + TINY);
            const float back = over > 0.0f ? over : 0.0f;
            x[l] -= back * dx, y[l] -= back * dy, z[l] -= back * dz;
        }
    }
}

// The last word of a step. Mostly one pass will do; who was just let go by a sole may need more.
DP_CLONES
static void shorten(const PlantStand* stand, PlantBlock* block, const float* length)
{
    float open[DP_LANES];
    for (int l = 0; l < DP_LANES; ++l) open[l] = block->touched_lane[l] ? 0.0f : 1.0f;
    float longest = shorten_rows(stand, block, length, open);
    for (int pass = 0; pass < LAST_PASSES; ++pass) {
        if (pass > 0 || longest > BEYOND) longest = shorten_rows(stand, block, length, open);
        shorten_stems(stand, block);
        if (!(longest > DP_MAX_STRETCH)) return;
    }
}

// speeds are what was gone in h; nothing in grass is faster than DP_MAX_SPEED
DP_CLONES
static float speeds_of(const PlantStand* stand, PlantBlock* block, const float* before, double h)
{
    const int   rows = stand->shape.rows, size = stand->shape.particles * DP_LANES;
    const float rate = (float)(1.0 / h);
    float       fastest[DP_LANES] = {0};
    PlantState* state = block->state;
    for (int p = 0; p < stand->shape.particles; ++p) {
        if (p % rows < DP_PLANT_HELD) continue;
        for (int d = 0; d < 3; ++d) {
            const float* was = before + d * size + p * DP_LANES;
            const float* at = state->at[d] + p * DP_LANES;
            float*       speed = state->speed[d] + p * DP_LANES;
            LANES
            {
                float v = rate * (at[l] - was[l]);
                v = v > DP_MAX_SPEED ? DP_MAX_SPEED : v;
                v = v < -DP_MAX_SPEED ? -DP_MAX_SPEED : v;
                speed[l] = v;
                fastest[l] = v * v > fastest[l] ? v * v : fastest[l];
            }
        }
    }
    float max = 0.0f;
    for (int l = 0; l < DP_LANES; ++l) max = fastest[l] > max ? fastest[l] : max;
    return max;
}

// ---- the door of this file: loaders pick the build of static functions only

void dp_plant_prepare(const PlantStand* stand, const PlantBlock* block, float* give, double h)
{
    prepare(stand, block, give, h);
}

void dp_plant_lengths(const PlantStand* stand, const PlantBlock* block, float* length)
{
    lengths_of_edges(stand, block, length);
}

void dp_plant_substep(const PlantStand* stand, PlantBlock* block, const float* give,
                      const float* length, float* before, const float* soft, double h)
{
    substep(stand, block, give, length, before, soft, h);
}

void dp_plant_shorten(const PlantStand* stand, PlantBlock* block, const float* length)
{
    shorten(stand, block, length);
}

float dp_plant_speeds(const PlantStand* stand, PlantBlock* block, const float* before, double h)
{
    return speeds_of(stand, block, before, h);
}
