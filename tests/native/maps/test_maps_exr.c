// Named channels written and read again, bit for bit.
#include "maps/world.h"

#define NX 83
#define NY 37

static float grid[3][NX * NY];

static void fill(void)
{
    for (int c = 0; c < 3; ++c)
        for (int j = 0; j < NY; ++j)
            for (int i = 0; i < NX; ++i) grid[c][j * NX + i] = world_value(i, j, c, 5);
}

TEST(what_is_written_is_what_is_read)
{
    const char*        path = world_path("maps.exr");
    const DpMapChannel channels[] = {
        {"pressure_time", grid[0]}, {"compression", grid[1]}, {"heap", grid[2]}};
    const DpNote notes[] = {{"cell", NULL, 0.005}, {"unit.heap", "m", 0}, {"empty", "", 0}};
    static const char* const sorted[] = {"compression", "heap", "pressure_time"};
    static const int         from[] = {1, 2, 0};
    fill();
    CHECK(dp_maps_write(path, NX, NY, channels, 3, notes, 3) == DP_OK);
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    if (!map) return;
    CHECK(map->nx == NX && map->ny == NY && map->channel_count == 3 && map->note_count == 3);
    for (int c = 0; c < 3; ++c) {
        CHECK(strcmp(map->channel[c], sorted[c]) == 0);
        CHECK(memcmp(map->value + c * NX * NY, grid[from[c]], sizeof grid[0]) == 0);
    }
    CHECK(strcmp(map->note_name[0], "cell") == 0 && !map->note_text[0]);
    CHECK(map->note_number[0] == 0.005);
    CHECK(strcmp(map->note_name[1], "unit.heap") == 0 && strcmp(map->note_text[1], "m") == 0);
    CHECK(map->note_text[2] && strcmp(map->note_text[2], "") == 0);
    dp_map_file_destroy(map);
    remove(path);
}

TEST(one_cell_is_a_map_too)
{
    const char*        path = world_path("cell.exr");
    const float        one = 0.125f;
    const DpMapChannel channel = {"Y", &one};
    CHECK(dp_maps_write(path, 1, 1, &channel, 1, NULL, 0) == DP_OK);
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    CHECK(map && map->nx == 1 && map->ny == 1 && map->value[0] == 0.125f && map->note_count == 0);
    dp_map_file_destroy(map);
    remove(path);
}

TEST(bad_arguments_are_refused)
{
    const char*        path = world_path("refused.exr");
    const DpMapChannel good = {"heap", grid[0]}, nameless = {NULL, grid[0]}, bare = {"heap", NULL};
    const DpMapChannel empty = {"", grid[0]}, twice[] = {{"heap", grid[0]}, {"heap", grid[1]}};
    const DpNote       taken = {"dataWindow", NULL, 1.0}, same[] = {{"a", "1", 0}, {"a", "2", 0}};
    CHECK(dp_maps_write(path, 0, NY, &good, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, -1, &good, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, 1 << 17, (1 << 15) + 1, &good, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, (1 << 28) + 1, 1, &good, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, 1, (1 << 28) + 1, &good, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &good, 0, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, NULL, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &nameless, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &bare, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &empty, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, twice, 2, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &good, 1, &taken, 1) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &good, 1, same, 2) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(path, NX, NY, &good, 1, NULL, 1) == DP_BAD_ARGUMENT);
    CHECK(dp_maps_write(NULL, NX, NY, &good, 1, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(access(path, F_OK) != 0);
}

TEST(no_memory_is_survived)
{
    const char*        path = world_path("memory.exr");
    const DpMapChannel channels[] = {{"b", grid[0]}, {"a", grid[1]}};
    const DpNote       note = {"soil", "mud", 0};
    DpStatus           status = DP_NO_MEMORY;
    long               tries = 0;
    for (; status != DP_OK && tries < 1000; ++tries) {
        dp_alloc_fail_after(tries);
        status = dp_maps_write(path, NX, NY, channels, 2, &note, 1);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
    }
    CHECK(status == DP_OK && tries > 10);
    DpMapFile* map = NULL;
    for (tries = 0, status = DP_NO_MEMORY; status != DP_OK && tries < 1000; ++tries) {
        dp_alloc_fail_after(tries);
        status = dp_maps_read(path, &map);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
        CHECK(status == DP_OK || !map);
    }
    dp_alloc_fail_after(-1);
    CHECK(status == DP_OK && tries > 10);
    CHECK(map && memcmp(map->value, grid[1], sizeof grid[1]) == 0);
    dp_map_file_destroy(map);
    remove(path);
}

int main(void)
{
    RUN(what_is_written_is_what_is_read);
    RUN(one_cell_is_a_map_too);
    RUN(bad_arguments_are_refused);
    RUN(no_memory_is_survived);
    world_end();
    return check_done();
}
