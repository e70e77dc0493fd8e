// spray/spray_stick.c - grains that stick to a part, and come off it. SUMNER99, MODEL 6.15
//
//   places on triangles, by area ---touch, leave---> a grain is taken ---speed, time---> it comes off
//
// Departures
//   SUMNER99: volume falls off by dv = v (e^-(t-tc)/h - e^-(t-tc+dt)/h), and is made particles of, which are let go by
//   chance. Here each grain comes off by chance once, at the same rate: the mean is the same, and nothing is lost that
//   was not let go. test_spray_stick.c, falls_off_by_the_law.
#include "spray/spray.h"

#include <math.h>

#include "base/alloc.h"
#include "base/noise.h"
#include "base/vec.h"

#define TOUCHES 0.003        // so near to the surface it is touched [m]
#define CORNER_SEED 0x51u    // of chance: where on a triangle,
#define SHED_SEED 0x7a3u     // when a grain comes off,
#define SCATTER_SEED 0xc19u  // how fast

enum
{
    TOUCHING = 1,  // at the end of the last step
    HOLDING = 2
};

struct DpCoat
{
    DpSprayNumbers numbers;
    uint32_t       seed;
    int            count, held, touching;
    float*         at;     // places in the part's frame [m] (count, 3)
    float*         dose;   // time since the ground was left over h, by speed (count)
    uint16_t*      turn;   // how many grains it has held (count)
    uint8_t*       kind;   // soil of the grain (count)
    uint8_t*       state;  // TOUCHING, HOLDING (count)
};

// ---- places ------------------------------------------------------------------------------------

static DpVec3 corner(const DpMesh* part, int triangle, int k)
{
    const float* at = part->vertex + 3 * (size_t)part->triangle[3 * (size_t)triangle + (size_t)k];
    return dp_vec3((double)at[0], (double)at[1], (double)at[2]);
}

static double area_of(const DpMesh* part, int triangle)
{
    const DpVec3 a = corner(part, triangle, 0);
    return 0.5 * dp_length(dp_cross(dp_sub(corner(part, triangle, 1), a),
                                    dp_sub(corner(part, triangle, 2), a)));
}

double dp_coat_wanted(const DpMesh* part, const DpSprayNumbers* numbers)
{
    double area = 0.0;
    for (int t = 0; t < part->triangle_count; ++t) area += area_of(part, t);
    return area * numbers->adhesion / dp_spray_volume(numbers);
}

// Evenly spread by area, one after the other along the triangles.
static void place(DpCoat* coat, const DpMesh* part)
{
    double total = 0.0, passed = 0.0;
    int    n = 0;
    for (int t = 0; t < part->triangle_count; ++t) total += area_of(part, t);
    for (int t = 0; t < part->triangle_count; ++t) {
        passed += area_of(part, t);
        for (; n < coat->count && (n + 0.5) * total <= passed * coat->count; ++n) {
            const uint32_t bits = dp_noise_bits(n, 0, coat->seed + CORNER_SEED);
            double         r = dp_noise_unit(bits), s = dp_noise_unit(bits >> 16);
            if (r + s > 1.0) r = 1.0 - r, s = 1.0 - s;
            const DpVec3 a = corner(part, t, 0);
            const DpVec3 b = dp_sub(corner(part, t, 1), a), c = dp_sub(corner(part, t, 2), a);
            const DpVec3 at = dp_add(a, dp_add(dp_scale(b, r), dp_scale(c, s)));
            float*       to = coat->at + 3 * (size_t)n;
            to[0] = (float)at.x, to[1] = (float)at.y, to[2] = (float)at.z;
        }
    }
    coat->count = n;  // rounding may leave the last one out
}

DpStatus dp_coat_create(DpCoat** coat_out, const DpMesh* part, const DpSprayNumbers* numbers,
                        uint32_t seed)
{
    const double wanted = dp_coat_wanted(part, numbers);
    if (!(wanted <= DP_COAT_MOST)) return DP_BAD_ARGUMENT;
    DpCoat* coat = dp_alloc(1, sizeof *coat);
    if (!coat) return DP_NO_MEMORY;
    coat->numbers = *numbers, coat->seed = seed;
    coat->count = (int)lround(wanted);
    const size_t room = (size_t)coat->count + 1;
    coat->at = dp_alloc(room, 3 * sizeof *coat->at);
    coat->dose = dp_alloc(room, sizeof *coat->dose);
    coat->turn = dp_alloc(room, sizeof *coat->turn);
    coat->kind = dp_alloc(room, 1), coat->state = dp_alloc(room, 1);
    if (!coat->at || !coat->dose || !coat->turn || !coat->kind || !coat->state) {
        dp_coat_destroy(coat);
        return DP_NO_MEMORY;
    }
    place(coat, part);
    *coat_out = coat;
    return DP_OK;
}

void dp_coat_destroy(DpCoat* coat)
{
    if (!coat) return;
    void* const blocks[] = {coat->at, coat->dose, coat->turn, coat->kind, coat->state};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; ++b) dp_free(blocks[b]);
    dp_free(coat);
}

int dp_coat_held(const DpCoat* coat)
{
    return coat ? coat->held : 0;
}

// ---- a step ------------------------------------------------------------------------------------

// chance of a place's grain, the same whatever the steps
static double chance(const DpCoat* coat, int n, uint32_t what)
{
    return dp_noise_unit(dp_noise_bits(n, coat->turn[n], coat->seed + what));
}

static bool is_touching(const DpCoatStep* step, DpVec3 at)
{
    if (!step->presses) return false;
    const double height = step->ground->surface(step->ground->ground, at.x, at.y);
    return at.z - step->sink <= height + TOUCHES;
}

// A grain comes off, or stays for this step.
static DpStatus shed(DpCoat* coat, int n, const DpCoatStep* step, DpVec3 from, DpVec3 to,
                     DpCloud* cloud)
{
    const DpSprayNumbers* numbers = &coat->numbers;
    const DpVec3          path = dp_sub(to, from), velocity = dp_scale(path, 1.0 / step->dt);
    const double          wide = numbers->fast_speed - numbers->slow_speed;
    const double loose = dp_clamp((dp_length(velocity) - numbers->slow_speed) / wide, 0.0, 1.0);
    if (!(loose > 0.0)) return DP_OK;
    const double before = dp_noise_growth(-(double)coat->dose[n]);
    coat->dose[n] += (float)(loose * step->dt / numbers->hold_time);
    const double after = dp_noise_growth(-(double)coat->dose[n]);  // e^-(t-tc)/h, SUMNER99
    const double when = chance(coat, n, SHED_SEED);
    if (after >= when) return DP_OK;
    const double   share = dp_clamp((before - when) / (before - after), 0.0, 1.0);
    const double   keeps = 1.0 - numbers->scatter * chance(coat, n, SCATTER_SEED);
    const DpGrain  grain = {.at = dp_add(from, dp_scale(path, share)),
                            .velocity = dp_scale(velocity, keeps),
                            .kind = coat->kind[n]};
    const DpStatus status = dp_cloud_add(cloud, &grain, share * step->dt);
    if (status != DP_OK) return status;
    coat->state[n] &= (uint8_t)~HOLDING;
    --coat->held;
    return DP_OK;
}

DpStatus dp_coat_step(DpCoat* coat, const DpCoatStep* step, DpCloud* cloud)
{
    if (!step->presses && coat->held == 0 && coat->touching == 0) return DP_OK;
    DpStatus status = DP_OK;
    for (int n = 0; n < coat->count && status == DP_OK; ++n) {
        const uint8_t state = coat->state[n];
        if (!step->presses && state == 0) continue;
        const float* at = coat->at + 3 * (size_t)n;
        const DpVec3 point = dp_vec3((double)at[0], (double)at[1], (double)at[2]);
        const DpVec3 to = dp_place(step->to, point);
        if (is_touching(step, to)) {
            coat->touching += !(state & TOUCHING);
            coat->state[n] |= TOUCHING;
            coat->dose[n] = 0.0f;
            continue;
        }
        const DpVec3 from = dp_place(step->from, point);
        if (state & TOUCHING) {
            coat->state[n] &= (uint8_t)~TOUCHING;
            --coat->touching;
            if (!(state & HOLDING) && step->dig(step->digger, from.x, from.y, &coat->kind[n])) {
                coat->state[n] |= HOLDING;
                ++coat->held, ++coat->turn[n];
            }
        }
        if ((coat->state[n] & HOLDING) && !step->jumps)
            status = shed(coat, n, step, from, to, cloud);
    }
    return status;
}

// ---- kept from run to run ----------------------------------------------------------------------

void dp_coat_save(const DpCoat* coat, DpStateWriter* writer)
{
    dp_write_u8(writer, coat != NULL);
    if (!coat) return;
    const size_t count = (size_t)coat->count;
    dp_write_u64(writer, count);
    dp_write_bytes(writer, coat->state, count);
    dp_write_bytes(writer, coat->kind, count);
    for (size_t n = 0; n < count; ++n) dp_write_u64(writer, coat->turn[n]);
    dp_write_floats(writer, coat->dose, count);
}

DpStatus dp_coat_load(DpCoat** coat_out, const DpMesh* part, const DpSprayNumbers* numbers,
                      uint32_t seed, DpStateReader* reader)
{
    DpCoat*       coat = NULL;
    const uint8_t there = dp_read_u8(reader);
    *coat_out = NULL;
    dp_read_check(reader, there <= 1);
    if (!there || reader->status != DP_OK) return reader->status;
    const DpStatus status = dp_coat_create(&coat, part, numbers, seed);
    if (status != DP_OK) return status;
    const size_t count = (size_t)coat->count;
    dp_read_check(reader, dp_read_u64(reader) == count);
    dp_read_bytes(reader, coat->state, count);
    dp_read_bytes(reader, coat->kind, count);
    for (size_t n = 0; n < count; ++n) coat->turn[n] = (uint16_t)dp_read_int(reader, 0, UINT16_MAX);
    dp_read_floats(reader, coat->dose, count);
    for (size_t n = 0; n < count; ++n) {
        dp_read_check(reader, coat->state[n] <= (TOUCHING | HOLDING) && coat->dose[n] >= 0.0f &&
                                  coat->dose[n] < INFINITY);
        coat->held += (coat->state[n] & HOLDING) != 0;
        coat->touching += coat->state[n] & TOUCHING;
    }
    if (reader->status != DP_OK) {
        dp_coat_destroy(coat);
        return reader->status;
    }
    *coat_out = coat;
    return DP_OK;
}
