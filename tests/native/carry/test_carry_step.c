// what a sole takes from ground that sticks, and leaves on ground that does not
#include "carry/carry.h"
#include "check.h"

#define SIDE 24  // cells of the patch, of which the sole covers SOLE x SOLE from FIRST on
#define SOLE 12
#define FIRST 4
#define CELL 0.01
#define STICKS 0.004
#define P0 1e5

typedef struct Field
{
    DpSoilPatch patch;
    DpImprint   imprint;
    DpSoil      soil[2];  // mud, road
    float       base[SIDE * SIDE], compression[SIDE * SIDE], heap[SIDE * SIDE], time[SIDE * SIDE];
    float       pressure[SIDE * SIDE], coat[SIDE * SIDE], bottom[SIDE * SIDE], cover[SIDE * SIDE];
    int32_t     ring[SIDE * SIDE];
    uint8_t     kind[SIDE * SIDE];
    int         coat_soil[1], coat_of_soil[2];
} Field;

static Field* field_make(void)
{
    Field* f = dp_alloc(1, sizeof *f);
    f->soil[0] =
        (DpSoil){.layer_depth = 0.3f, .adhesion = (float)STICKS, .release_pressure = (float)P0};
    f->soil[1] = (DpSoil){.layer_depth = 0.3f, .release_pressure = (float)P0};
    f->coat_of_soil[1] = -1;
    f->patch = (DpSoilPatch){.nx = SIDE,
                             .ny = SIDE,
                             .row = SIDE,
                             .cell = CELL,
                             .base_height = f->base,
                             .compression = f->compression,
                             .heap = f->heap,
                             .pressure_time = f->time,
                             .kind = f->kind,
                             .soils = f->soil,
                             .soil_count = 2,
                             .pressure = f->pressure,
                             .coat = f->coat,
                             .coat_stride = SIDE * SIDE,
                             .coat_soil = f->coat_soil,
                             .coat_of_soil = f->coat_of_soil};
    f->imprint = (DpImprint){.bottom = f->bottom,
                             .cover = f->cover,
                             .ring = f->ring,
                             .i0 = FIRST,
                             .i1 = FIRST + SOLE,
                             .j0 = FIRST,
                             .j1 = FIRST + SOLE};
    return f;
}

// all cells of the sole touch with a pressure [Pa], or none
static void tread(Field* f, DpCarry* carry, float pressure, DpCarried* carried)
{
    const DpPose     pose = {{0.1037, 0.1021, 0.0}, {1, 0, 0, 0}};
    const DpCarrying by = {&pose, 1, 1, 100, -50};
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i) {
            const bool on = i >= FIRST && i < FIRST + SOLE && j >= FIRST && j < FIRST + SOLE;
            f->ring[j * SIDE + i] = on && pressure > 0.0f ? 0 : DP_RING_FAR;
            f->cover[j * SIDE + i] = on ? 1.0f : 0.0f;
            f->pressure[j * SIDE + i] = on ? pressure : 0.0f;
        }
    CHECK(dp_carry_step(carry, &f->patch, &f->imprint, &by, carried) == DP_OK);
}

static double sum(const float* grid)
{
    double all = 0.0;
    for (int k = 0; k < SIDE * SIDE; ++k) all += (double)grid[k];
    return all * CELL * CELL;
}

static const double area = SOLE * SOLE * CELL * CELL;

TEST(takes_what_sticks)
{
    Field*    f = field_make();
    DpCarry*  carry = NULL;
    DpCarried carried = {0};
    CHECK(dp_carry_create(&carry, 1, CELL) == DP_OK);
    for (int k = 0; k < SIDE * SIDE; ++k) f->compression[k] = 0.02f, f->heap[k] = 0.001f;
    tread(f, carry, 1e5f, &carried);
    CHECK(carried.firm <= 0.0 && carried.loose <= 0.0 && carried.left <= 0.0);  // while it stands
    tread(f, carry, 0.0f, &carried);
    CHECK_CLOSE(carried.loose, 0.001 * area, 0.05);  // heaps first
    CHECK_CLOSE(carried.firm, 0.003 * area, 0.2);    // and no more than there is room for
    CHECK(carried.firm + carried.loose <= STICKS * area * 1.00001);
    CHECK_CLOSE(dp_carry_volume(carry, 0), carried.firm + carried.loose, 1e-9);
    CHECK_CLOSE(sum(f->compression) - 0.02 * SIDE * SIDE * CELL * CELL, carried.firm, 1e-5);
    CHECK(dp_cells_empty(dp_carry_cells(carry)));
    const double full = dp_carry_volume(carry, 0);
    for (int n = 0; n < 8; ++n) tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried);
    CHECK(dp_carry_volume(carry, 0) < 1.5 * full);  // it is full at some time
    const double most = dp_carry_volume(carry, 0);
    tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried);
    CHECK_CLOSE(dp_carry_volume(carry, 0), most, 1e-6);
    dp_carry_destroy(carry);
    dp_free(f);
}

// What springs back does so from as deep as a cell is once soil has stuck to the sole.
TEST(what_is_taken_is_as_if_pressed_deeper)
{
    Field*    f = field_make();
    DpCarry*  carry = NULL;
    DpCarried carried = {0};
    float     spring[SIDE * SIDE];
    CHECK(dp_carry_create(&carry, 1, CELL) == DP_OK);
    f->patch.spring = spring;
    for (int k = 0; k < SIDE * SIDE; ++k) f->compression[k] = 0.02f, spring[k] = -0.025f;
    spring[FIRST * SIDE + FIRST] = 0.002f;  // has come back already
    tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried);
    CHECK(carried.firm > 0.0);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const bool   back = k == FIRST * SIDE + FIRST;
        const double was = back ? 0.002 : -0.025, taken = (double)f->compression[k] - 0.02;
        CHECK_NEAR((double)spring[k], back ? was : was - taken, 1e-7);
    }
    dp_carry_destroy(carry);
    dp_free(f);
}

// firm ground that was not pressed gives nothing, nor does what lies deeper than the layer
TEST(hard_ground_gives_nothing)
{
    Field*    f = field_make();
    DpCarry*  carry = NULL;
    DpCarried carried = {0};
    CHECK(dp_carry_create(&carry, 1, CELL) == DP_OK);
    tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried);
    CHECK(dp_carry_volume(carry, 0) <= 0.0);
    for (int k = 0; k < SIDE * SIDE; ++k) f->compression[k] = 0.285f;
    tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried);
    CHECK(dp_carry_volume(carry, 0) < 1e-6 * area);
    for (int k = 0; k < SIDE * SIDE; ++k) f->compression[k] = 0.02f, f->kind[k] = 1;
    tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried);
    CHECK(dp_carry_volume(carry, 0) < 1e-6 * area);  // a road
    dp_carry_destroy(carry);
    dp_free(f);
}

// V (1 - exp(-p / p0)) of all, however the pressure rises; MODEL 6.15
TEST(leaves_what_the_law_says)
{
    for (int rises = 1; rises <= 4; rises += 3) {
        Field*    f = field_make();
        DpCarry*  carry = NULL;
        DpCarried taken = {0}, left = {0};
        CHECK(dp_carry_create(&carry, 1, CELL) == DP_OK);
        for (int k = 0; k < SIDE * SIDE; ++k) f->compression[k] = 0.02f;
        tread(f, carry, 1e5f, &taken), tread(f, carry, 0.0f, &taken);
        double has = dp_carry_volume(carry, 0);
        for (int k = 0; k < SIDE * SIDE; ++k) f->kind[k] = 1;
        for (int step = 0; step < 5; ++step) {
            for (int r = 1; r <= rises; ++r) tread(f, carry, (float)(0.3 * P0 * r / rises), &left);
            tread(f, carry, (float)(0.1 * P0), &left);  // it falls again
            const double now = dp_carry_volume(carry, 0);
            CHECK_CLOSE(1.0 - now / has, 1.0 - exp(-0.3), 0.06);
            has = now;
            tread(f, carry, 0.0f, &left);
            CHECK_CLOSE(dp_carry_volume(carry, 0), now, 1e-12);  // what was left stays
        }
        CHECK_CLOSE(sum(f->coat) + has, dp_carry_taken(carry, 0), 1e-9);
        CHECK_CLOSE(left.left, sum(f->coat), 1e-9);
        dp_carry_destroy(carry);
        dp_free(f);
    }
}

TEST(is_kept_and_taken_back)
{
    Field*        f = field_make();
    DpCarry *     carry = NULL, *again = NULL;
    DpCarried     carried = {0};
    DpStateWriter writer = {0}, other = {0};
    CHECK(dp_carry_create(&carry, 1, CELL) == DP_OK && dp_carry_create(&again, 1, CELL) == DP_OK);
    for (int k = 0; k < SIDE * SIDE; ++k) f->compression[k] = 0.02f;
    tread(f, carry, 1e5f, &carried), tread(f, carry, 0.0f, &carried),
        tread(f, carry, 2e4f, &carried);
    dp_write_chunk(&writer, "crry", 1), dp_carry_save(carry, &writer), dp_write_end(&writer);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    dp_read_chunk(&reader, "crry", 1);
    CHECK(dp_carry_load(again, &reader) == DP_OK);
    dp_read_end(&reader);
    CHECK(reader.status == DP_OK);
    dp_write_chunk(&other, "crry", 1), dp_carry_save(again, &other), dp_write_end(&other);
    CHECK(other.size == writer.size && memcmp(other.bytes, writer.bytes, writer.size) == 0);
    CHECK_CLOSE(dp_carry_taken(again, 0), dp_carry_taken(carry, 0), 0.0);
    dp_write_drop(&writer), dp_write_drop(&other);
    dp_carry_destroy(carry), dp_carry_destroy(again);
    dp_free(f);
}

TEST(without_memory_nothing_is_lost)
{
    Field*   f = field_make();
    DpCarry* carry = NULL;
    for (long n = 0; n < 2; ++n) {
        dp_alloc_fail_after(n);
        CHECK(dp_carry_create(&carry, 1, CELL) == DP_NO_MEMORY);
        dp_alloc_fail_after(-1);
    }
    CHECK(dp_carry_create(&carry, 0, CELL) == DP_BAD_ARGUMENT);
    dp_free(f);
}

int main(void)
{
    RUN(takes_what_sticks);
    RUN(what_is_taken_is_as_if_pressed_deeper);
    RUN(hard_ground_gives_nothing);
    RUN(leaves_what_the_law_says);
    RUN(is_kept_and_taken_back);
    RUN(without_memory_nothing_is_lost);
    return check_done();
}
