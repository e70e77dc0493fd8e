// Files of other writers are read; damaged ones are refused, whatever the damage.
#include "maps/foreign.h"

TEST(other_writers_are_read)
{
    for (int s = 0; s < FOREIGN_SORTS; ++s) {
        const Foreign* as = &foreign_sorts[s];
        const char*    path = world_path("foreign.exr");
        CHECK(foreign_write(path, as) == 0);
        DpMapFile* map = NULL;
        CHECK(dp_maps_read(path, &map) == DP_OK);
        if (!map) continue;
        CHECK(map->nx == as->nx && map->ny == as->ny && map->channel_count == 3);
        long bad = 0;
        for (int c = 0; c < 3; ++c)
            for (int j = 0; j < as->ny; ++j)
                for (int i = 0; i < as->nx; ++i)
                    bad += map->value[(c * as->ny + j) * as->nx + i] !=
                           foreign_value(i, as->ny - 1 - j, c);
        if (bad) printf("  sort %d: %ld values differ\n", s, bad);
        CHECK(bad == 0);
        CHECK(map->note_count == 3);
        CHECK(strcmp(map->note_name[0], "owner") == 0);
        CHECK(strcmp(map->note_text[0], "somebody else") == 0);
        CHECK(map->note_number[1] == 43.0 && map->note_number[2] == 0.5);
        dp_map_file_destroy(map);
        remove(path);
    }
}

TEST(what_is_no_map_is_refused)
{
    DpMapFile*  map = NULL;
    const char* path = world_path("no.exr");
    CHECK(dp_maps_read(NULL, &map) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_read(path, NULL) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_read(path, &map) == DP_CANNOT_OPEN);
    CHECK(dp_maps_read(world_folder, &map) == DP_BAD_FILE);
    CHECK(dp_maps_read("/dev/zero", &map) == DP_BAD_FILE);
    world_put(path, "", 0);
    CHECK(dp_maps_read(path, &map) == DP_BAD_FILE);
    world_put(path, "\x76\x2f\x31\x01", 4);
    CHECK(dp_maps_read(path, &map) == DP_BAD_FILE);
    world_put(path, "not an image at all, but a text of some length", 46);
    CHECK(dp_maps_read(path, &map) == DP_BAD_FILE);
    CHECK(map == NULL);
    remove(path);
}

static unsigned char whole[400000], hurt[400000];

// HTJ2K, ZSTD and what else may come have numbers beyond the last one known here
TEST(a_packing_of_tomorrow_is_named)
{
    static const char named[] = "compression\0compression\0\1\0\0";
    const char*       path = world_path("tomorrow.exr");
    CHECK(foreign_write(path, &foreign_sorts[3]) == 0);
    const size_t size = world_bytes(path, whole, sizeof whole);
    size_t       at = 0;
    while (at < size && memcmp(whole + at, named, sizeof named) != 0) ++at;
    for (int packing = EXR_COMPRESSION_LAST_TYPE; packing < 256; packing += 7) {
        DpMapFile* map = NULL;
        whole[at + sizeof named] = (unsigned char)packing;
        world_put(path, whole, size);
        CHECK(dp_maps_read(path, &map) == DP_BAD_PACKING && map == NULL);
        CHECK(dp_bytes_live() == 0);
    }
    remove(path);
}

// read what is in hurt[]; nothing may crash, leak, or take memory out of proportion
static void read_hurt(const char* path, size_t size, long* refused)
{
    DpMapFile* map = NULL;
    world_put(path, hurt, size);
    dp_bytes_peak_reset();
    const size_t   before = dp_bytes_live();
    const DpStatus status = dp_maps_read(path, &map);
    CHECK(status == DP_OK || status == DP_BAD_FILE || status == DP_BAD_PACKING ||
          status == DP_NO_MEMORY);
    CHECK((status == DP_OK) == (map != NULL));
    CHECK(dp_bytes_peak() - before < 1500000000);
    *refused += status != DP_OK;
    dp_map_file_destroy(map);
    CHECK(dp_bytes_live() == before);
}

TEST(every_truncation_is_refused)
{
    const char* path = world_path("short.exr");
    const int   some[] = {0, 4, 6};
    for (int s = 0; s < 3; ++s) {
        CHECK(foreign_write(path, &foreign_sorts[some[s]]) == 0);
        const size_t size = world_bytes(path, whole, sizeof whole);
        memcpy(hurt, whole, size);
        long   refused = 0;
        size_t cuts = 0;
        for (size_t cut = 0; cut < size; cut += cut < 700 ? 1 : 97, ++cuts)
            read_hurt(path, cut, &refused);
        CHECK(refused == (long)cuts);
    }
    remove(path);
}

TEST(mutations_do_no_harm)
{
    const char* path = world_path("hurt.exr");
    unsigned    state = 2024;
    long        refused = 0, tries = 0;
    for (int s = 0; s < FOREIGN_SORTS; ++s) {
        CHECK(foreign_write(path, &foreign_sorts[s]) == 0);
        const size_t size = world_bytes(path, whole, sizeof whole);
        CHECK(size > 300 && size < sizeof whole);
        for (int k = 0; k < 400; ++k, ++tries) {
            memcpy(hurt, whole, size);
            const int changes = 1 + (int)(4.0 * check_random(&state));
            for (int c = 0; c < changes; ++c) {
                // the header is where damage is most telling
                const size_t reach = check_random(&state) < 0.7 && size > 600 ? 600 : size;
                const size_t at = (size_t)(check_random(&state) * (double)reach);
                const double how = check_random(&state);
                if (how < 0.4)
                    hurt[at] ^= (unsigned char)(1u << (int)(8.0 * check_random(&state)));
                else if (how < 0.7)
                    hurt[at] = (unsigned char)(256.0 * check_random(&state));
                else if (how < 0.85)
                    hurt[at] = 0xff;
                else if (at + 4 < size)
                    memset(hurt + at, how < 0.93 ? 0x7f : 0, 4);
            }
            read_hurt(path, size, &refused);
        }
    }
    CHECK(refused > tries / 10 && refused < tries);
    remove(path);
}

int main(void)
{
    RUN(other_writers_are_read);
    RUN(what_is_no_map_is_refused);
    RUN(a_packing_of_tomorrow_is_named);
    RUN(every_truncation_is_refused);
    RUN(mutations_do_no_harm);
    world_end();
    return check_done();
}
