// carry/carry_store.c - blocks of a body's surface, and how much lies on each. MODEL 6.16
#include <math.h>

#include "base/alloc.h"
#include "carry/carry_inside.h"

#define SMALLEST 0.005  // side of a block [m], at least ..
#define CELLS \
    2.06  // .. and in cells: each is met by some, and no sole's underside lies on a border by chance
#define STEPS 44  // bits of an amount, of what fills a block
#define MIN_SLOTS 64
#define MAX_BLOCKS (1 << 24)
#define BLOCK_BYTES 16  // of a state, at least
#define TOUCH_BYTES 32

DpStatus dp_carry_create(DpCarry** carry, int coats, double cell)
{
    if (!carry || coats < 1 || !(cell > 0.0)) return DP_BAD_ARGUMENT;
    DpCarry* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    created->taken = dp_alloc((size_t)coats, sizeof *created->taken);
    if (!created->taken) {
        dp_free(created);
        return DP_NO_MEMORY;
    }
    created->coats = coats;
    created->side = CELLS * cell > SMALLEST ? CELLS * cell : SMALLEST;
    int exponent = 0;
    (void)frexp(created->side, &exponent);
    created->grid = ldexp(1.5, 52 + 3 * exponent - STEPS);
    *carry = created;
    return DP_OK;
}

void dp_carry_destroy(DpCarry* carry)
{
    if (!carry) return;
    dp_free(carry->block), dp_free(carry->amount), dp_free(carry->slot);
    dp_free(carry->brought), dp_free(carry->held);
    dp_free(carry->touch), dp_free(carry->next), dp_free(carry->gone);
    dp_free(carry->taken), dp_free(carry->asked), dp_free(carry->had);
    dp_free(carry);
}

static bool is_same(Block a, Block b)
{
    return a.part == b.part && a.x == b.x && a.y == b.y && a.z == b.z;
}

// where a block is, or the empty slot where it belongs
static int* slot_of(const DpCarry* carry, Block key)
{
    uint64_t mixed = (uint64_t)(uint32_t)key.part * 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ (uint64_t)(uint32_t)key.x) * 0xc2b2ae3d27d4eb4fu;
    mixed = (mixed ^ mixed >> 29 ^ (uint64_t)(uint32_t)key.y) * 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ mixed >> 29 ^ (uint64_t)(uint32_t)key.z) * 0xbf58476d1ce4e5b9u;
    mixed ^= mixed >> 32;
    int at = (int)(mixed & (uint64_t)(carry->slots - 1));
    while (carry->slot[at] >= 0 && !is_same(carry->block[carry->slot[at]], key))
        at = (at + 1) & (carry->slots - 1);
    return &carry->slot[at];
}

// room for one block more; without memory all stays as it was
static bool fit(DpCarry* carry)
{
    const size_t wanted = (size_t)carry->blocks + 1;
    if (wanted > MAX_BLOCKS || !dp_make_room(&carry->block, wanted, sizeof *carry->block) ||
        !dp_make_room(&carry->held, wanted, sizeof *carry->held) ||
        !dp_make_room(&carry->amount, wanted * (size_t)carry->coats, sizeof *carry->amount) ||
        !dp_make_room(&carry->had, wanted * (size_t)carry->coats, sizeof *carry->had) ||
        !dp_make_room(&carry->asked, wanted * (size_t)carry->coats, sizeof *carry->asked) ||
        !dp_make_room(&carry->brought, wanted * (size_t)carry->coats, sizeof *carry->brought))
        return false;
    if (2 * wanted <= (size_t)carry->slots) return true;
    const int slots = carry->slots ? 2 * carry->slots : MIN_SLOTS;
    int*      slot = dp_alloc((size_t)slots, sizeof *slot);
    if (!slot) return false;
    dp_free(carry->slot);
    carry->slot = slot, carry->slots = slots;
    for (int k = 0; k < slots; ++k) slot[k] = -1;
    for (int b = 0; b < carry->blocks; ++b) *slot_of(carry, carry->block[b]) = b;
    return true;
}

int dp_carry_block(DpCarry* carry, Block key)
{
    if (carry->slots > 0 && *slot_of(carry, key) >= 0) return *slot_of(carry, key);
    if (!fit(carry)) return -1;
    const int created = carry->blocks++;
    carry->block[created] = key;
    const int at = created * carry->coats;
    carry->held[created] = 0;
    for (int k = 0; k < carry->coats; ++k)
        carry->amount[at + k] = carry->brought[at + k] = carry->asked[at + k] = 0.0;
    return *slot_of(carry, key) = created;
}

DpCellRect dp_carry_cells(const DpCarry* carry)
{
    DpCellRect cells = {0, 0, 0, 0};
    for (int t = 0; t < carry->touches; ++t)
        cells = dp_cells_join(cells, dp_cells(carry->touch[t].i, carry->touch[t].j, 1, 1));
    return cells;
}

double dp_carry_volume(const DpCarry* carry, int coat)
{
    double sum = 0.0;
    for (int b = 0; b < carry->blocks; ++b) sum += carry->amount[b * carry->coats + coat];
    return sum;
}

double dp_carry_taken(const DpCarry* carry, int coat)
{
    return carry->taken[coat];
}

// ---- kept from run to run ----------------------------------------------------------------------

void dp_carry_save(const DpCarry* carry, DpStateWriter* writer)
{
    dp_write_doubles(writer, carry->taken, (size_t)carry->coats);
    dp_write_u64(writer, (uint64_t)carry->blocks);
    for (int b = 0; b < carry->blocks; ++b) {
        const Block*  at = &carry->block[b];
        const int32_t place[4] = {at->part, at->x, at->y, at->z};
        dp_write_ints(writer, place, 4);
        dp_write_doubles(writer, carry->amount + b * carry->coats, (size_t)carry->coats);
        dp_write_doubles(writer, carry->brought + b * carry->coats, (size_t)carry->coats);
    }
    dp_write_u64(writer, (uint64_t)carry->touches);
    for (int t = 0; t < carry->touches; ++t) {
        const Touch* at = &carry->touch[t];
        dp_write_i64(writer, at->i), dp_write_i64(writer, at->j);
        dp_write_u64(writer, (uint64_t)at->block);
        dp_write_floats(writer, &at->share, 1);
        dp_write_f64(writer, at->peak);
    }
}

static bool read_blocks(DpCarry* carry, DpStateReader* reader)
{
    const size_t count = dp_read_count(reader, MAX_BLOCKS, BLOCK_BYTES);
    for (size_t b = 0; b < count && reader->status == DP_OK; ++b) {
        int32_t at[4];
        dp_read_ints(reader, at, 4);
        const int created = dp_carry_block(carry, (Block){at[0], at[1], at[2], at[3]});
        if (created < 0) return false;
        dp_read_check(reader, (size_t)created == b);  // each stands there once
        for (int k = 0; k < carry->coats; ++k)
            carry->amount[created * carry->coats + k] = dp_read_number(reader, 0.0, 1e9);
        for (int k = 0; k < carry->coats; ++k)
            carry->brought[created * carry->coats + k] = dp_read_number(reader, 0.0, 1e9);
    }
    return true;
}

DpStatus dp_carry_load(DpCarry* carry, DpStateReader* reader)
{
    const int64_t far = 1LL << 40;
    for (int k = 0; k < carry->coats; ++k) carry->taken[k] = dp_read_number(reader, 0.0, 1e30);
    if (!read_blocks(carry, reader)) return DP_NO_MEMORY;
    const size_t count = dp_read_count(reader, MAX_BLOCKS, TOUCH_BYTES);
    if (reader->status != DP_OK) return reader->status;
    if (!dp_make_room(&carry->touch, count + 1, sizeof *carry->touch)) return DP_NO_MEMORY;
    for (size_t t = 0; t < count; ++t) {
        Touch* at = &carry->touch[t];
        at->i = (long)dp_read_int(reader, -far, far), at->j = (long)dp_read_int(reader, -far, far);
        at->block = (int)dp_read_int(reader, 0, carry->blocks - 1);
        dp_read_floats(reader, &at->share, 1);
        at->peak = dp_read_number(reader, 0.0, 1e30);
        const bool ascends = t == 0 || at[-1].j < at->j || (at[-1].j == at->j && at[-1].i < at->i);
        dp_read_check(reader, ascends && at->share > 0.0f && at->share <= 1.0f);
        if (reader->status == DP_OK) ++carry->held[at->block];
    }
    if (reader->status == DP_OK) carry->touches = (int)count;
    return reader->status;
}
