// plants/plant_save.c - what plants have become, kept and taken back.
//
// Kept is what differs from plants that were just planted: blocks that a foot woke, or the ground
// raised or sank. Of those asleep places and strength suffice; alpha, and what hangs limp, follow
// from strength.
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "base/assert.h"
#include "base/digest.h"
#include "base/stream.h"
#include "plants/plant_inside.h"

#define NAME "plnt"
#define VERSION 1
#define MIN_BLOCK 100  // bytes of a block are no fewer

typedef enum Kept
{
    KEPT_STATE = 1,  // places and strength follow
    KEPT_AWAKE = 2   // speeds and the ground below, too
} Kept;

typedef struct SavedBlock
{
    int        stand, block;
    PlantBlock is;
} SavedBlock;

struct DpPlantsState
{
    const DpPlants* plants;
    double          now;
    uint64_t        advances;
    SavedBlock*     saved;
    size_t          count;
};

// ---- which plants these are ----------------------------------------------------------------------

static uint64_t fold(uint64_t sum, const void* bytes, size_t count)
{
    uint64_t words[DP_DIGEST_WORDS];
    dp_digest(bytes, count, words);
    for (int k = 0; k < DP_DIGEST_WORDS; ++k) sum = (sum ^ words[k]) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 32;
}

// a number that other stands do not have: of its kind, where it was planted, how strong it was
static uint64_t name_of(const PlantStand* stand)
{
    uint64_t sum = fold((uint64_t)stand->count, &stand->kind, sizeof stand->kind);
    for (int b = 0; b < stand->blocks; ++b) {
        const PlantBlock* block = &stand->block[b];
        sum = fold(sum, block->root[0], sizeof block->root[0]);
        sum = fold(sum, block->root[1], sizeof block->root[1]);
        sum = fold(sum, block->turn, sizeof block->turn);
        sum = fold(sum, block->reserve, sizeof block->reserve);
    }
    return sum;
}

static size_t places_of(const PlantStand* stand)
{
    return (size_t)stand->shape.particles * DP_LANES;
}

static size_t bends_of(const PlantStand* stand)
{
    return (size_t)stand->shape.bends * DP_LANES;
}

// ---- saving --------------------------------------------------------------------------------------

static bool is_kept(const PlantBlock* block)
{
    return block->state || block->moved;
}

// has no bend lost anything?
static bool is_unworn(const PlantBlock* block, size_t bends)
{
    for (size_t k = 0; k < bends; ++k) {
        const double strength = block->state->strength[k], full = block->reserve[k % DP_LANES];
        if (strength < full || strength > full) return false;
    }
    return true;
}

static void write_state(DpStateWriter* writer, const PlantStand* stand, const PlantBlock* block)
{
    const PlantState* state = block->state;
    const size_t      places = places_of(stand), bends = bends_of(stand);
    const bool        unworn = is_unworn(block, bends);
    dp_write_u8(writer, unworn);
    if (!unworn) dp_write_doubles(writer, state->strength, bends);
    for (int d = 0; d < 3; ++d) dp_write_floats(writer, state->at[d], places);
    if (!block->awake) return;
    for (int d = 0; d < 3; ++d) dp_write_floats(writer, state->speed[d], places);
    dp_write_floats(writer, state->floor, places);
    for (int d = 0; d < 2; ++d) dp_write_floats(writer, state->seen[d], places);
}

static void write_block(DpStateWriter* writer, const PlantStand* stand, int b)
{
    const PlantBlock* block = &stand->block[b];
    uint8_t           touched = 0;
    dp_memory_ease(DP_EASE_PAGE);
    for (int l = 0; l < DP_LANES; ++l) touched |= (uint8_t)(block->touched_lane[l] << l);
    dp_write_i64(writer, b);
    dp_write_u8(writer,
                (uint8_t)((block->state ? KEPT_STATE : 0) | (block->awake ? KEPT_AWAKE : 0)));
    dp_write_u8(writer, touched);
    dp_write_f64(writer, block->quiet);
    dp_write_f64(writer, block->asleep_since);
    dp_write_floats(writer, block->root[2], DP_LANES);
    dp_write_floats(writer, block->foot[2], DP_LANES);
    for (int d = 0; d < 2; ++d) dp_write_floats(writer, block->slope[d], DP_LANES);
    dp_write_floats(writer, block->ceiling, DP_LANES);
    if (block->state) write_state(writer, stand, block);
}

void dp_plants_save(const DpPlants* plants, DpStateWriter* writer)
{
    dp_write_chunk(writer, NAME, VERSION);
    dp_write_u64(writer, plants->seed);
    dp_write_f64(writer, plants->now);
    dp_write_u64(writer, plants->advances);
    dp_write_u64(writer, (uint64_t)plants->stands);
    for (int s = 0; s < plants->stands; ++s) {
        const PlantStand* stand = &plants->stand[s];
        uint64_t          kept = 0;
        for (int b = 0; b < stand->blocks; ++b) kept += is_kept(&stand->block[b]);
        dp_write_u64(writer, name_of(stand));
        dp_write_u64(writer, kept);
        for (int b = 0; b < stand->blocks; ++b)
            if (is_kept(&stand->block[b])) write_block(writer, stand, b);
    }
    dp_write_end(writer);
}

// ---- loading -------------------------------------------------------------------------------------

// floats of which none is beyond +-limit, or NaN
static void read_within(DpStateReader* reader, float* value, size_t count, float limit)
{
    bool holds = true;
    dp_read_floats(reader, value, count);
    for (size_t k = 0; k < count; ++k) holds = holds && fabsf(value[k]) <= limit;
    dp_read_check(reader, holds);
}

static void read_state(DpStateReader* reader, const PlantStand* stand, const PlantBlock* block)
{
    PlantState*  state = block->state;
    const size_t places = places_of(stand), bends = bends_of(stand);
    bool         holds = true;
    if (dp_read_u8(reader)) {
        for (size_t k = 0; k < bends; ++k) state->strength[k] = block->reserve[k % DP_LANES];
    } else {
        dp_read_doubles(reader, state->strength, bends);
    }
    for (size_t k = 0; k < bends; ++k)
        holds = holds && state->strength[k] >= 0.0 &&
                state->strength[k] <= block->reserve[k % DP_LANES];
    dp_read_check(reader, holds);
    for (int d = 0; d < 3; ++d) read_within(reader, state->at[d], places, 1e7f);
    if (!block->awake) return;
    for (int d = 0; d < 3; ++d) read_within(reader, state->speed[d], places, 1e4f);
    read_within(reader, state->floor, places, -DP_NO_FLOOR);
    for (int d = 0; d < 2; ++d) read_within(reader, state->seen[d], places, 1e7f);
}

// one block; false without memory
static bool read_block(DpStateReader* reader, const DpPlants* plants, int s, int after,
                       SavedBlock* to)
{
    const PlantStand* stand = &plants->stand[s];
    const int         b = (int)dp_read_int(reader, after + 1, stand->blocks - 1);
    const int         kept = dp_read_u8(reader), touched = dp_read_u8(reader);
    dp_read_check(reader, kept <= (KEPT_STATE | KEPT_AWAKE) && kept != KEPT_AWAKE);
    if (reader->status != DP_OK) return true;
    to->stand = s, to->block = b, to->is = stand->block[b];
    PlantBlock* block = &to->is;
    block->moved = true;
    block->quiet = dp_read_number(reader, 0.0, 1e12);
    block->asleep_since = dp_read_number(reader, 0.0, 1e15);
    read_within(reader, block->root[2], DP_LANES, 1e7f);
    read_within(reader, block->foot[2], DP_LANES, 2e7f);
    for (int d = 0; d < 2; ++d) read_within(reader, block->slope[d], DP_LANES, 1.0f);
    read_within(reader, block->ceiling, DP_LANES, INFINITY);
    for (int l = 0; l < DP_LANES; ++l) {
        block->touched_lane[l] = touched >> l & 1;
        block->touched = block->touched || block->touched_lane[l];
    }
    if (!(kept & KEPT_STATE) || reader->status != DP_OK) return true;
    block->state = dp_plant_state_create(stand);
    if (!block->state) return false;
    block->awake = kept & KEPT_AWAKE;
    read_state(reader, stand, block);
    for (size_t k = 0; !block->awake && k < places_of(stand); ++k)
        block->state->floor[k] = DP_NO_FLOOR;
    if (reader->status == DP_OK) dp_plant_count_broken(stand, block);
    block->changed = false, block->broke = 0;
    return true;
}

// nobody trod on them yet, nor did the ground move
static bool is_fresh(const DpPlants* plants)
{
    bool fresh = true;
    for (int s = 0; s < plants->stands; ++s)
        for (int b = 0; b < plants->stand[s].blocks; ++b)
            fresh = fresh && !is_kept(&plants->stand[s].block[b]);
    return fresh;
}

void dp_plants_state_destroy(DpPlantsState* state)
{
    if (!state) return;
    for (size_t k = 0; k < state->count; ++k) dp_free(state->saved[k].is.state);
    dp_free(state->saved), dp_free(state);
}

// the blocks of one stand; false without memory
static bool read_stand(DpStateReader* reader, DpPlantsState* state, int s)
{
    const PlantStand* stand = &state->plants->stand[s];
    dp_read_check(reader, dp_read_u64(reader) == name_of(stand));
    const size_t kept = dp_read_count(reader, (size_t)stand->blocks, MIN_BLOCK);
    if (kept == 0) return true;
    SavedBlock* more = dp_realloc(state->saved, state->count + kept, sizeof *more);
    if (!more) return false;
    state->saved = more;
    int after = -1;
    for (size_t k = 0; k < kept && reader->status == DP_OK; ++k) {
        SavedBlock* saved = &state->saved[state->count++];
        if (!read_block(reader, state->plants, s, after, saved)) return false;
        after = saved->block;
    }
    return true;
}

DpStatus dp_plants_load(const DpPlants* plants, DpStateReader* reader, DpPlantsState** state)
{
    if (!plants || !reader || !state || !is_fresh(plants)) return DP_BAD_ARGUMENT;
    DpPlantsState* read = dp_alloc(1, sizeof *read);
    if (!read) return DP_NO_MEMORY;
    read->plants = plants;
    dp_read_chunk(reader, NAME, VERSION);
    dp_read_check(reader, dp_read_u64(reader) == plants->seed);
    read->now = dp_read_number(reader, 0.0, 1e15);
    read->advances = dp_read_u64(reader);
    dp_read_check(reader, dp_read_u64(reader) == (uint64_t)plants->stands);
    bool room = true;
    for (int s = 0; room && s < plants->stands && reader->status == DP_OK; ++s)
        room = read_stand(reader, read, s);
    if (room) dp_read_end(reader);
    if (!room || reader->status != DP_OK) {
        dp_plants_state_destroy(read);
        return room ? reader->status : DP_NO_MEMORY;
    }
    *state = read;
    return DP_OK;
}

void dp_plants_restore(DpPlants* plants, DpPlantsState* state)
{
    DP_ASSERT(state->plants == plants);
    plants->now = state->now, plants->advances = state->advances;
    for (size_t k = 0; k < state->count; ++k) {
        const SavedBlock* saved = &state->saved[k];
        PlantStand*       stand = &plants->stand[saved->stand];
        stand->block[saved->block] = saved->is;
        stand->up[saved->block] = saved->is.awake;
    }
    state->count = 0;  // their states are the plants' now
    dp_plants_state_destroy(state);
}
