// Written in the background is written as if nobody had waited, and nothing after a failure.
#include "maps/world.h"

#define SIDE DP_TILE

static void paint(float* rgba, int k)
{
    for (int n = 0; n < SIDE * SIDE * 4; ++n) rgba[n] = (float)(n % 97 * (k + 1));
}

// a picture in which tile k % 4 changes in file k, with the writer or without; its files as bytes
static size_t film(bool background, unsigned char* bytes, size_t most)
{
    static float rgba[SIDE * SIDE * 4];
    DpFrames*    frames;
    DpWriter*    writer = NULL;
    const char*  failed;
    char         name[32];
    size_t       size = 0;
    CHECK(dp_frames_create(&frames, 2, 2, RGBA, 4, NULL, 0) == DP_OK);
    if (background) CHECK(dp_writer_create(&writer, 2) == DP_OK);
    for (int k = 0; k < 30; ++k) {  // more than may wait
        snprintf(name, sizeof name, "film_%02d.exr", k);
        const char* path = k % 3 == 2 ? NULL : world_path(name);  // some are only packed
        if (writer) {
            DpTiles* tiles = dp_writer_tiles(writer, frames);
            paint(dp_tiles_add(tiles, k % 2, k / 2 % 2), k);
            CHECK(dp_writer_give(writer, tiles, path, k) == DP_OK);
        } else {
            paint(rgba, k);
            CHECK(dp_frames_set_tile(frames, k % 2, k / 2 % 2, rgba, 0) == DP_OK);
            if (path) CHECK(dp_frames_write(frames, path, k) == DP_OK);
        }
    }
    if (writer) CHECK(dp_writer_outcome(writer, true, &failed) == DP_OK && !*failed);
    for (int k = 0; k < 30; ++k) {
        if (k % 3 == 2) continue;
        snprintf(name, sizeof name, "film_%02d.exr", k);
        size += world_bytes(world_path(name), bytes + size, most - size);
        remove(world_path(name));
    }
    dp_writer_destroy(writer);
    dp_frames_destroy(frames);
    return size;
}

TEST(the_same_files_in_the_background)
{
    enum
    {
        MAX_BYTES = 4000000
    };
    unsigned char* plain = malloc(MAX_BYTES);
    unsigned char* other = malloc(MAX_BYTES);
    const size_t   size = film(false, plain, MAX_BYTES);
    CHECK(size > 20000 && size < MAX_BYTES);
    CHECK(film(true, other, MAX_BYTES) == size && memcmp(plain, other, size) == 0);
    free(plain);
    free(other);
}

TEST(a_flood_of_tiles_is_one_file)
{
    DpFrames*   frames;
    DpWriter*   writer;
    const char *failed, *path = world_path("flood.exr");
    CHECK(dp_frames_create(&frames, 6, 6, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_writer_create(&writer, 4) == DP_OK);
    DpTiles* tiles = dp_writer_tiles(writer, frames);
    for (int k = 0; k < 36; ++k) paint(dp_tiles_add(tiles, k % 6, k / 6), k);
    CHECK(dp_writer_give(writer, tiles, path, 0.0) == DP_OK);
    CHECK(dp_writer_outcome(writer, true, &failed) == DP_OK);
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    for (int k = 0; map && k < 36; ++k)  // of channel A, the first in the file; its first cell is 3
        CHECK(map->value[(size_t)(k / 6 * SIDE) * 6 * SIDE + (size_t)(k % 6 * SIDE)] ==
              (float)(3 * (k + 1)));
    dp_map_file_destroy(map);
    remove(path);
    dp_writer_destroy(writer);
    dp_frames_destroy(frames);
}

// what is given faster than it is written waits its turn: no more than four pictures are held at once
TEST(no_more_waits_than_memory_bears)
{
    enum
    {
        MANY = 60,
        SIDES = 3
    };
    DpFrames*    frames;
    DpWriter*    writer;
    const char*  failed;
    const size_t picture = (size_t)SIDES * SIDES * SIDE * SIDE * 4 * sizeof(float);
    CHECK(dp_frames_create(&frames, SIDES, SIDES, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_writer_create(&writer, 1) == DP_OK);
    dp_bytes_peak_reset();
    const size_t before = dp_bytes_live();
    for (int k = 0; k < MANY; ++k) {
        DpTiles* tiles = dp_writer_tiles(writer, frames);
        for (int n = 0; n < SIDES * SIDES; ++n) paint(dp_tiles_add(tiles, n % SIDES, n / SIDES), k);
        CHECK(dp_writer_give(writer, tiles, NULL, k) == DP_OK);
    }
    CHECK(dp_writer_outcome(writer, true, &failed) == DP_OK);
    // four, the one that is filled meanwhile, what a growing list takes, and what is packed
    CHECK(dp_bytes_peak() - before < 12 * picture);
    dp_writer_destroy(writer);
    dp_frames_destroy(frames);
}

TEST(nothing_is_written_after_a_failure_until_it_was_told)
{
    DpFrames*   frames;
    DpWriter*   writer;
    const char* failed;
    char        bad[200], name[32];
    snprintf(bad, sizeof bad, "%s", world_path("nowhere/film.exr"));
    CHECK(dp_frames_create(&frames, 1, 1, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_writer_create(&writer, 1) == DP_OK);
    CHECK(dp_writer_give(writer, dp_writer_tiles(writer, frames), bad, 0.0) == DP_OK);
    for (int k = 0; k < 5; ++k) {
        snprintf(name, sizeof name, "after_%d.exr", k);
        CHECK(dp_writer_give(writer, dp_writer_tiles(writer, frames), world_path(name), k) ==
              DP_OK);
    }
    CHECK(dp_writer_outcome(writer, true, &failed) == DP_CANNOT_OPEN);
    CHECK(strcmp(failed, bad) == 0);
    for (int k = 0; k < 5; ++k) {
        snprintf(name, sizeof name, "after_%d.exr", k);
        CHECK(access(world_path(name), F_OK) != 0);
    }
    CHECK(dp_writer_outcome(writer, true, &failed) == DP_OK && !*failed);  // told once
    const char* path = world_path("again.exr");
    CHECK(dp_writer_give(writer, dp_writer_tiles(writer, frames), path, 0.0) == DP_OK);
    CHECK(dp_writer_outcome(writer, true, &failed) == DP_OK);
    CHECK(access(path, F_OK) == 0);
    remove(path);
    DpTiles* tiles = dp_writer_tiles(writer, frames);
    dp_writer_drop(writer, tiles);
    dp_writer_destroy(writer);
    dp_writer_destroy(NULL);
    dp_frames_destroy(frames);
}

// whatever there is no memory for: where all went well the tile is there, in the file that is written next
TEST(a_tile_that_could_not_be_packed_is_told)
{
    const char* path = world_path("tight.exr");
    int         refused = 0, written = 0;
    for (int tries = 0; tries < 500 && !written; ++tries) {
        DpFrames*   frames;
        DpWriter*   writer;
        const char* failed;
        CHECK(dp_frames_create(&frames, 1, 1, RGBA, 4, NULL, 0) == DP_OK);
        CHECK(dp_writer_create(&writer, 1) == DP_OK);
        DpTiles* tiles = dp_writer_tiles(writer, frames);
        paint(dp_tiles_add(tiles, 0, 0), 4);
        dp_alloc_fail_after(tries);
        DpStatus       status = dp_writer_give(writer, tiles, NULL, 0.0);
        const DpStatus outcome = dp_writer_outcome(writer, true, &failed);
        dp_alloc_fail_after(-1);
        if (status == DP_OK) status = outcome;
        if (status == DP_OK) {
            DpMapFile* map = NULL;
            CHECK(dp_frames_write(frames, path, 0.0) == DP_OK);
            CHECK(dp_maps_read(path, &map) == DP_OK);
            CHECK(map && map->value[0] == 15.0f);  // of channel A
            dp_map_file_destroy(map);
            remove(path);
            written = 1;
        } else {
            CHECK(status == DP_NO_MEMORY);
            ++refused;
        }
        dp_writer_destroy(writer);
        dp_frames_destroy(frames);
    }
    CHECK(written && refused > 0);
}

int main(void)
{
    RUN(the_same_files_in_the_background);
    RUN(a_flood_of_tiles_is_one_file);
    RUN(no_more_waits_than_memory_bears);
    RUN(nothing_is_written_after_a_failure_until_it_was_told);
    RUN(a_tile_that_could_not_be_packed_is_told);
    world_end();
    return check_done();
}
