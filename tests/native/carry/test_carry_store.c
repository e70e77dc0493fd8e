// tests of carry_store.c: blocks are found again, amounts are exact, and damaged stores are refused
#include "base/alloc.h"
#include "carry/carry_inside.h"
#include "check.h"

#define CELL 0.01
#define COATS 2
#define SIDE 17  // blocks along each axis of a part

// blocks of both parts, those around the origin too, in an order that follows no axis
static Block nth(int n)
{
    const int mixed = (n * 2731) % (2 * SIDE * SIDE * SIDE);
    return (Block){mixed % 2, mixed / 2 % SIDE - SIDE / 2, mixed / 2 / SIDE % SIDE - SIDE / 2,
                   mixed / 2 / SIDE / SIDE - SIDE / 2};
}

static DpCarry* store(double cell)
{
    DpCarry* carry = NULL;
    CHECK(dp_carry_create(&carry, COATS, cell) == DP_OK);
    return carry;
}

TEST(every_block_is_found_again_by_its_place)
{
    DpCarry*  carry = store(CELL);
    const int many = 2 * SIDE * SIDE * SIDE;
    for (int n = 0; n < many; ++n) {
        CHECK(dp_carry_block(carry, nth(n)) == n);  // new, so the next number
        for (int k = 0; k < COATS; ++k) {
            const int at = n * COATS + k;
            CHECK(carry->amount[at] <= 0.0 && carry->brought[at] <= 0.0 && carry->asked[at] <= 0.0);
            carry->amount[at] = 10.0 * n + k, carry->brought[at] = 1.0, carry->asked[at] = 2.0;
        }
        CHECK(carry->held[n] == 0 && 2 * carry->blocks <= carry->slots);
        carry->held[n] = n;
    }
    for (int n = 0; n < many; ++n) {
        CHECK(dp_carry_block(carry, nth(n)) == n && carry->held[n] == n);
        for (int k = 0; k < COATS; ++k) CHECK_NEAR(carry->amount[n * COATS + k], 10.0 * n + k, 0.0);
    }
    CHECK(carry->blocks == many);
    dp_carry_destroy(carry);
}

TEST(a_block_is_two_cells_wide_but_never_finer_than_5_mm)
{
    const double cells[] = {0.0005, 0.002, 0.01, 0.05};
    for (int n = 0; n < 4; ++n) {
        DpCarry* carry = store(cells[n]);
        CHECK_NEAR(carry->side, fmax(2.06 * cells[n], 0.005), 1e-12);
        // amounts up to what fills a block keep 40 bits or more, and sums of them are exact in any order
        const double full = carry->side * carry->side * carry->side;
        const double third = (full / 3.0 + carry->grid) - carry->grid;
        const double seventh = (full / 7.0 + carry->grid) - carry->grid;
        CHECK_CLOSE(third, full / 3.0, ldexp(1.0, -40));
        CHECK((third + seventh) - third == seventh && (full + carry->grid) - carry->grid > 0.0);
        dp_carry_destroy(carry);
    }
}

TEST(volumes_are_of_each_soil)
{
    DpCarry* carry = store(CELL);
    CHECK(dp_carry_volume(carry, 0) <= 0.0 && dp_carry_volume(carry, 1) <= 0.0);
    for (int n = 0; n < 5; ++n) {
        const int at = COATS * dp_carry_block(carry, nth(n));
        carry->amount[at] = 1.0 + n, carry->amount[at + 1] = 100.0;
    }
    carry->taken[0] = 20.0, carry->taken[1] = 600.0;
    CHECK_NEAR(dp_carry_volume(carry, 0), 15.0, 1e-12);
    CHECK_NEAR(dp_carry_volume(carry, 1), 500.0, 1e-12);
    CHECK_NEAR(dp_carry_taken(carry, 0), 20.0, 0.0);
    CHECK_NEAR(dp_carry_taken(carry, 1), 600.0, 0.0);
    dp_carry_destroy(carry);
}

static void touch(DpCarry* carry, long i, long j, int block, float share)
{
    CHECK(dp_make_room(&carry->touch, (size_t)carry->touches + 1, sizeof *carry->touch));
    carry->touch[carry->touches++] =
        (Touch){.i = i, .j = j, .block = block, .share = share, .peak = 3.0};
    ++carry->held[block];
}

static void fill(DpCarry* carry)
{
    for (int n = 0; n < 3; ++n) {
        const int at = COATS * dp_carry_block(carry, nth(n));
        carry->amount[at] = 0.25 * n, carry->amount[at + 1] = 0.5;
        carry->brought[at] = 0.125, carry->brought[at + 1] = 2.0 * n;
    }
    carry->taken[0] = 8.0, carry->taken[1] = 9.0;
    touch(carry, -7, -2, 0, 0.5f), touch(carry, 3, -2, 2, 1.0f), touch(carry, -9, 4, 2, 0.25f);
}

TEST(cells_that_are_touched)
{
    DpCarry* carry = store(CELL);
    CHECK(dp_cells_empty(dp_carry_cells(carry)));
    fill(carry);
    const DpCellRect cells = dp_carry_cells(carry);
    CHECK(cells.i0 == -9 && cells.i1 == 4 && cells.j0 == -2 && cells.j1 == 5);
    dp_carry_destroy(carry);
}

static DpStateWriter kept(const DpCarry* carry)
{
    DpStateWriter writer = {0};
    dp_write_chunk(&writer, "crry", 1), dp_carry_save(carry, &writer), dp_write_end(&writer);
    CHECK(writer.status == DP_OK);
    return writer;
}

// what comes of loading a store as it was saved
static DpStatus again(const DpCarry* carry, DpCarry* into)
{
    DpStateWriter writer = kept(carry);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    dp_read_chunk(&reader, "crry", 1);
    DpStatus status = dp_carry_load(into, &reader);
    if (status == DP_OK) dp_read_end(&reader);
    if (status == DP_OK) status = reader.status;
    dp_write_drop(&writer);
    return status;
}

TEST(a_store_is_taken_back_to_the_bit)
{
    DpCarry *carry = store(CELL), *other = store(CELL);
    fill(carry);
    CHECK(again(carry, other) == DP_OK);
    DpStateWriter one = kept(carry), two = kept(other);
    CHECK(one.size == two.size && memcmp(one.bytes, two.bytes, one.size) == 0);
    CHECK(other->held[0] == 1 && other->held[1] == 0 && other->held[2] == 2);
    for (int n = 0; n < 4; ++n) CHECK(dp_carry_block(other, nth(n)) == n);
    dp_write_drop(&one), dp_write_drop(&two);
    dp_carry_destroy(carry), dp_carry_destroy(other);
}

TEST(a_store_that_cannot_be_is_refused)
{
    for (int bad = 0; bad < 10; ++bad) {
        DpCarry *carry = store(CELL), *other = store(CELL);
        fill(carry);
        Touch* at = carry->touch;
        if (bad == 0)
            carry->block[2] = carry->block[0], at[1].block = at[2].block = 1;  // twice the same
        if (bad == 1) carry->amount[3] = -1.0;
        if (bad == 2) carry->brought[2] = (double)NAN;
        if (bad == 3) carry->taken[1] = -1.0;
        if (bad == 4) at[1].block = 3;  // there are three
        if (bad == 5) at[2].share = 0.0f;
        if (bad == 6) at[2].share = 1.5f;
        if (bad == 7) at[1].i = -7;  // the cell of the first
        if (bad == 8) at[2].j = -3;  // a row back
        if (bad == 9) at[0].peak = -1.0;
        CHECK(again(carry, other) == DP_BAD_FILE && other->touches == 0);
        dp_carry_destroy(carry), dp_carry_destroy(other);
    }
}

TEST(without_memory_the_blocks_there_are_stay)
{
    for (long n = 0; n < 40; ++n) {
        DpCarry* carry = store(CELL);
        int      blocks = 0, found = 0;
        dp_alloc_fail_after(n);
        while (blocks < 200 && (found = dp_carry_block(carry, nth(blocks))) >= 0) ++blocks;
        dp_alloc_fail_after(-1);
        CHECK(found >= 0 || carry->blocks == blocks);
        for (int b = 0; b < 200; ++b) CHECK(dp_carry_block(carry, nth(b)) == b);
        dp_carry_destroy(carry);
    }
    DpCarry* carry = NULL;
    CHECK(dp_carry_create(&carry, 0, CELL) == DP_BAD_ARGUMENT);
    CHECK(dp_carry_create(&carry, 1, 0.0) == DP_BAD_ARGUMENT);
    CHECK(dp_carry_create(&carry, 1, (double)NAN) == DP_BAD_ARGUMENT);
    CHECK(dp_carry_create(NULL, 1, CELL) == DP_BAD_ARGUMENT && !carry);
    dp_carry_destroy(NULL);
}

int main(void)
{
    RUN(every_block_is_found_again_by_its_place);
    RUN(a_block_is_two_cells_wide_but_never_finer_than_5_mm);
    RUN(volumes_are_of_each_soil);
    RUN(cells_that_are_touched);
    RUN(a_store_is_taken_back_to_the_bit);
    RUN(a_store_that_cannot_be_is_refused);
    RUN(without_memory_the_blocks_there_are_stay);
    return check_done();
}
