// tests of plant_laid.c: how soles laid stems is kept in memory, and taken back as it was
#include "lawn.h"
#include "plants/plant_laid.h"

#define SIDE 5

static DpStemLean nowhere(const void* context, double x, double y)
{
    (void)context, (void)x, (void)y;
    return (DpStemLean){0};
}

// two stands of different kinds
typedef struct Bed
{
    DpPlants*       plants;
    DpPlantDisplay* display;
    DpPlantShape    shape[2];
} Bed;

static void make(Bed* bed, float taller)
{
    DpPlantKind kind[2] = {dp_plant_kind_default(), dp_plant_kind_default()};
    kind[1].height *= taller, kind[1].width = 0.0f;
    float root[3 * SIDE * SIDE] = {0};
    int   stand;
    for (int k = 0; k < SIDE * SIDE; ++k)
        root[3 * k] = 0.05f * (float)(k % SIDE), root[3 * k + 1] = 0.05f * (float)(k / SIDE);
    bed->plants = dp_plants_create(3);
    for (int s = 0; s < 2; ++s) {
        CHECK(dp_plants_add(bed->plants, &kind[s], root, NULL, SIDE * SIDE, &stand) == DP_OK);
        bed->shape[s] = dp_plant_shape(&kind[s]);
    }
    CHECK(dp_plant_display_create(&bed->display, bed->plants, nowhere, NULL) == DP_OK);
}

static void unmake(Bed* bed)
{
    dp_plant_display_destroy(bed->display);
    dp_plants_destroy(bed->plants);
}

static size_t stems_of(const DpPlantShape* shape)
{
    return (size_t)shape->stems * DP_LANES;
}

static size_t segments_of(const DpPlantShape* shape)
{
    return stems_of(shape) * (size_t)(shape->rows - DP_PLANT_HELD);
}

// numbers that tell where they belong
static void fill(LaidBlock* block, const DpPlantShape* shape, int seed)
{
    for (size_t k = 0; k < stems_of(shape); ++k) {
        block->laid[k] = (uint8_t)((k + (size_t)seed) % 3 == 0);
        block->share[k] = (float)((k * 7 + (size_t)seed) % 101) / 100.0f;
    }
    for (int d = 0; d < 3; ++d)
        for (size_t k = 0; k < segments_of(shape); ++k)
            block->segment[d][k] = (float)((k * 3 + (size_t)(d + seed)) % 199) / 2.0f - 49.0f;
}

static bool is_filled(const LaidBlock* block, const DpPlantShape* shape, int seed)
{
    bool holds = true;
    for (size_t k = 0; k < stems_of(shape); ++k)
        holds = holds && block->laid[k] == ((k + (size_t)seed) % 3 == 0) &&
                block->share[k] == (float)((k * 7 + (size_t)seed) % 101) / 100.0f;
    for (int d = 0; d < 3; ++d)
        for (size_t k = 0; k < segments_of(shape); ++k)
            holds = holds && block->segment[d][k] ==
                                 (float)((k * 3 + (size_t)(d + seed)) % 199) / 2.0f - 49.0f;
    return holds;
}

// the second block of the first stand, and the first and third of the second one
static void lay(Bed* bed)
{
    const int at[3][2] = {{0, 1}, {1, 0}, {1, 2}};
    CHECK(dp_plant_laid_fit(&bed->display->laid, bed->plants));
    for (int n = 0; n < 3; ++n) {
        LaidBlock** block = &bed->display->laid.stand[at[n][0]][at[n][1]];
        *block = dp_plant_laid_create(&bed->shape[at[n][0]]);
        fill(*block, &bed->shape[at[n][0]], n);
    }
}

TEST(a_block_has_room_for_all_of_its_stems)
{
    Bed bed;
    make(&bed, 2.0f);
    for (int s = 0; s < 2; ++s) {
        LaidBlock* block = dp_plant_laid_create(&bed.shape[s]);
        LaidBlock* other = dp_plant_laid_create(&bed.shape[s]);
        bool       zero = true;
        for (size_t k = 0; k < stems_of(&bed.shape[s]); ++k)
            zero = zero && block->laid[k] == 0 && block->share[k] <= 0.0f;
        CHECK(zero);
        fill(block, &bed.shape[s], 1), fill(other, &bed.shape[s], 2);
        CHECK(is_filled(block, &bed.shape[s], 1) && is_filled(other, &bed.shape[s], 2));
        dp_free(block), dp_free(other);
    }
    dp_alloc_fail_after(0);
    CHECK(!dp_plant_laid_create(&bed.shape[0]));
    dp_alloc_fail_after(-1);
    unmake(&bed);
}

TEST(stands_that_come_later_find_room)
{
    Bed bed;
    make(&bed, 1.0f);
    LaidStems laid = {0};
    int       stand;
    CHECK(dp_plant_laid_fit(&laid, bed.plants) && laid.stands == 2);
    LaidBlock* kept = laid.stand[1][2] = dp_plant_laid_create(&bed.shape[1]);
    fill(kept, &bed.shape[1], 5);
    const DpPlantKind kind = dp_plant_kind_default();
    const float       root[3 * 9] = {0};
    CHECK(dp_plants_add(bed.plants, &kind, root, NULL, 9, &stand) == DP_OK);
    for (long n = 0; n < 2; ++n) {
        dp_alloc_fail_after(n);
        CHECK(!dp_plant_laid_fit(&laid, bed.plants) && laid.stands == 2);
        dp_alloc_fail_after(-1);
    }
    CHECK(dp_plant_laid_fit(&laid, bed.plants) && laid.stands == 3 && laid.stand[1][2] == kept);
    CHECK(is_filled(kept, &bed.shape[1], 5) && !laid.stand[2][0] && !laid.stand[2][1]);
    dp_plant_laid_drop(&laid, bed.plants);
    CHECK(laid.stands == 0 && !laid.stand);
    unmake(&bed);
}

static DpStateWriter kept(const Bed* bed)
{
    DpStateWriter writer = {0};
    dp_plant_display_save(bed->display, &writer);
    CHECK(writer.status == DP_OK);
    return writer;
}

static DpStatus again(const Bed* bed, Bed* into)
{
    DpStateWriter        writer = kept(bed);
    DpStateReader        reader = dp_read_open(writer.bytes, writer.size);
    DpPlantDisplayState* state = NULL;
    const DpStatus       status = dp_plant_display_load(into->display, &reader, &state);
    if (status == DP_OK) dp_plant_display_restore(into->display, state);
    dp_write_drop(&writer);
    return status;
}

TEST(what_was_laid_is_taken_back_to_the_bit)
{
    Bed bed, other;
    make(&bed, 2.0f), make(&other, 2.0f);
    CHECK(again(&bed, &other) == DP_OK);  // nothing yet
    lay(&bed);
    // a block that nothing has laid is not kept
    bed.display->laid.stand[0][2] = dp_plant_laid_create(&bed.shape[0]);
    CHECK(dp_plant_laid_fit(&other.display->laid, other.plants));
    other.display->laid.stand[0][0] = dp_plant_laid_create(&other.shape[0]);  // this goes
    CHECK(again(&bed, &other) == DP_OK);
    const LaidStems* laid = &other.display->laid;
    for (int s = 0; s < 2; ++s)
        for (int b = 0; b < other.plants->stand[s].blocks; ++b) {
            const int seed = s == 0 && b == 1   ? 0
                             : s == 1 && b == 0 ? 1
                             : s == 1 && b == 2 ? 2
                                                : -1;
            CHECK((laid->stand[s][b] != NULL) == (seed >= 0));
            if (seed >= 0) CHECK(is_filled(laid->stand[s][b], &other.shape[s], seed));
        }
    DpStateWriter one = kept(&bed), two = kept(&other);
    CHECK(one.size == two.size && memcmp(one.bytes, two.bytes, one.size) == 0);
    dp_write_drop(&one), dp_write_drop(&two);
    unmake(&bed), unmake(&other);
}

TEST(what_cannot_be_is_refused)
{
    for (int bad = 0; bad < 6; ++bad) {
        Bed bed, other;
        make(&bed, 2.0f), make(&other, bad == 0 ? 5.0f : 2.0f);  // stems of more pieces
        lay(&bed);
        LaidBlock* block = bed.display->laid.stand[1][2];
        if (bad == 1) block->share[3] = 1.5f;
        if (bad == 2) block->share[3] = -0.5f;
        if (bad == 3) block->laid[3] = 2;
        if (bad == 4) block->segment[1][5] = 101.0f;
        if (bad == 5) block->segment[2][5] = NAN;
        CHECK(again(&bed, &other) == DP_BAD_FILE && other.display->laid.stands == 0);
        unmake(&bed), unmake(&other);
    }
    Bed bed;
    make(&bed, 1.0f), lay(&bed);
    DpStateWriter        writer = kept(&bed);
    DpPlantDisplayState* state = NULL;
    for (long n = 0; n < 4; ++n) {
        DpStateReader reader = dp_read_open(writer.bytes, writer.size);
        dp_alloc_fail_after(n);
        CHECK(dp_plant_display_load(bed.display, &reader, &state) == DP_NO_MEMORY && !state);
        dp_alloc_fail_after(-1);
    }
    DpStateReader cut = dp_read_open(writer.bytes, writer.size - 9);
    CHECK(dp_plant_display_load(bed.display, &cut, &state) == DP_BAD_FILE && !state);
    CHECK(dp_plant_display_load(NULL, &cut, &state) == DP_BAD_ARGUMENT);
    dp_plant_display_state_destroy(NULL);
    dp_write_drop(&writer);
    unmake(&bed);
}

int main(void)
{
    RUN(a_block_has_room_for_all_of_its_stems);
    RUN(stands_that_come_later_find_room);
    RUN(what_was_laid_is_taken_back_to_the_bit);
    RUN(what_cannot_be_is_refused);
    return check_done();
}
