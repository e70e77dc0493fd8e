// How grass lies, and how stems were laid, is kept with the plants and taken back, to the bit.
#include "bed.h"

#define FRAMES 90

static bool same(const DpStateWriter* a, const DpStateWriter* b)
{
    return a->status == DP_OK && a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
}

static void check_shown(const Bed* a, const Bed* b)
{
    static float at[2][3 * 1024], plane[2][3][120 * 120];
    for (int s = 0; s < 2; ++s)
        for (int k = 0; k < BED_SIDE * BED_SIDE; ++k) {
            const size_t size = 3 * sizeof(float) * (size_t)dp_plants_shape(a->plants, s).particles;
            CHECK(dp_plant_display_read(a->display, NULL, s, k, at[0]) == DP_OK);
            CHECK(dp_plant_display_read(b->display, NULL, s, k, at[1]) == DP_OK);
            CHECK(memcmp(at[0], at[1], size) == 0);
        }
    dp_grass_read(a->grass, -10, -10, 120, 120, plane[0][0], plane[0][1], plane[0][2]);
    dp_grass_read(b->grass, -10, -10, 120, 120, plane[1][0], plane[1][1], plane[1][2]);
    CHECK(memcmp(plane[0], plane[1], sizeof plane[0]) == 0);
}

static void note_tile(void* context, long tx, long ty)
{
    unsigned* sum = context;
    *sum = 31 * *sum + (unsigned)(7 * tx + ty) + 1;
}

TEST(it_goes_on_as_if_it_had_never_stopped)
{
    const int stops[4] = {0, 13, 47, 65};
    Bed       undisturbed = bed_create();
    bed_walk(&undisturbed, 0, FRAMES);
    DpStateWriter end = bed_save(&undisturbed);
    for (int n = 0; n < 4; ++n) {
        Bed before = bed_create(), after = bed_create();
        bed_walk(&before, 0, stops[n]);
        DpStateWriter at_stop = bed_save(&before);
        CHECK(bed_load(&after, at_stop.bytes, at_stop.size) == DP_OK);
        check_shown(&before, &after);
        bed_walk(&after, stops[n], FRAMES);
        check_shown(&undisturbed, &after);
        DpStateWriter at_end = bed_save(&after);
        CHECK(same(&end, &at_end));
        dp_write_drop(&at_stop), dp_write_drop(&at_end);
        bed_destroy(&before), bed_destroy(&after);
    }
    dp_write_drop(&end);
    bed_destroy(&undisturbed);
}

TEST(tiles_that_changed_are_told_once)
{
    Bed      before = bed_create(), after = bed_create();
    unsigned all = 0, first = 0, second = 0;
    bed_walk(&before, 0, 60);
    dp_grass_changed(before.grass, note_tile, &all);
    bed_walk(&before, 60, 62);
    DpStateWriter writer = bed_save(&before);
    CHECK(bed_load(&after, writer.bytes, writer.size) == DP_OK);
    dp_grass_changed(before.grass, note_tile, &first);
    dp_grass_changed(after.grass, note_tile, &second);
    CHECK(first == second && first != 0 && first != all);
    dp_write_drop(&writer);
    bed_destroy(&before), bed_destroy(&after);
}

// 9 tiles that something touched are 1.6 MB in memory
TEST(its_state_is_small)
{
    Bed bed = bed_create();
    bed_walk(&bed, 0, FRAMES);
    DpStateWriter writer = {0};
    dp_grass_save(bed.grass, &writer);
    printf("  grass of %d frames: %zu bytes\n", FRAMES, writer.size);
    CHECK(writer.size < 400000);
    dp_write_drop(&writer);
    dp_plant_display_save(bed.display, &writer);
    printf("  laid stems: %zu bytes\n", writer.size);
    CHECK(writer.size < 200000);
    dp_write_drop(&writer);
    bed_destroy(&bed);
}

TEST(what_is_damaged_is_refused_or_lived_with)
{
    Bed bed = bed_create();
    bed_walk(&bed, 0, 25);
    unsigned chance = 7;
    int      refused[2] = {0, 0};
    for (int k = 0; k < 40; ++k) {
        DpStateWriter whole = {0}, damaged = {0};
        if (k % 2)
            dp_grass_save(bed.grass, &whole);
        else
            dp_plant_display_save(bed.display, &whole);
        dp_write_chunk(&damaged, k % 2 ? "gras" : "laid", 1);
        dp_write_bytes(&damaged, whole.bytes + 24, whole.size - 24 - (k % 8 == 7));
        const size_t among = k % 4 < 2 ? 160 : damaged.size - 24;
        for (int n = 0; n < 3; ++n)
            damaged.bytes[24 + (size_t)(check_random(&chance) * (double)among)] ^=
                (unsigned char)(1u << (int)(8 * check_random(&chance)));
        dp_write_end(&damaged);
        DpStateReader        reader = dp_read_open(damaged.bytes, damaged.size);
        DpGrassState*        grass = NULL;
        DpPlantDisplayState* display = NULL;
        const DpStatus       status = k % 2 ? dp_grass_load(bed.grass, &reader, &grass)
                                            : dp_plant_display_load(bed.display, &reader, &display);
        CHECK(status == (grass || display ? DP_OK : DP_BAD_FILE));
        refused[k % 2] += status != DP_OK;
        if (grass) dp_grass_restore(bed.grass, grass);
        if (display) dp_plant_display_restore(bed.display, display);
        bed_walk(&bed, 25 + k, 26 + k);
        dp_write_drop(&whole), dp_write_drop(&damaged);
    }
    CHECK(refused[0] > 5 && refused[0] < 20 && refused[1] > 5 && refused[1] < 20);
    bed_destroy(&bed);
}

TEST(cells_elsewhere_and_no_memory_are_refused)
{
    Bed bed = bed_create();
    bed_walk(&bed, 0, 5);
    DpStateWriter writer = {0};
    dp_grass_save(bed.grass, &writer), dp_plant_display_save(bed.display, &writer);
    DpGrass*             other;
    DpGrassState*        state = NULL;
    DpPlantDisplayState* laid = NULL;
    CHECK(dp_grass_create(&other, bed.plants, (DpGrid){BED_CELL, 0.001, 0.0}) == DP_OK);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_grass_load(other, &reader, &state) == DP_BAD_FILE && !state);
    dp_grass_destroy(other);
    CHECK(dp_grass_create(&other, bed.plants, (DpGrid){0.5 * BED_CELL, 0.0, 0.0}) == DP_OK);
    reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_grass_load(other, &reader, &state) == DP_BAD_FILE && !state);
    CHECK(dp_grass_load(bed.grass, NULL, &state) == DP_BAD_ARGUMENT);
    for (long left = 0; left < 3; ++left) {
        reader = dp_read_open(writer.bytes, writer.size);
        dp_alloc_fail_after(left);
        CHECK(dp_grass_load(bed.grass, &reader, &state) == DP_NO_MEMORY && !state);
        dp_alloc_fail_after(-1);
        reader = dp_read_open(writer.bytes, writer.size);
        CHECK(dp_grass_load(bed.grass, &reader, &state) == DP_OK);
        dp_grass_state_destroy(state), state = NULL;
        dp_alloc_fail_after(left);
        CHECK(dp_plant_display_load(bed.display, &reader, &laid) == DP_NO_MEMORY && !laid);
        dp_alloc_fail_after(-1);
    }
    dp_grass_destroy(other);
    dp_write_drop(&writer);
    bed_destroy(&bed);
}

int main(void)
{
    RUN(it_goes_on_as_if_it_had_never_stopped);
    RUN(tiles_that_changed_are_told_once);
    RUN(its_state_is_small);
    RUN(what_is_damaged_is_refused_or_lived_with);
    RUN(cells_elsewhere_and_no_memory_are_refused);
    return check_done();
}
