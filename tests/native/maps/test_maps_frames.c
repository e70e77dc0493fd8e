// Frames for playback: what is set is what is read, bit for bit, and only what changed is packed.
#include "maps/world.h"

#include "base/digest.h"
#include "base/parallel.h"

#define SIDE DP_TILE

// the colours of tile (tx, ty) in its state `seed`
static void paint(float* rgba, int tx, int ty, unsigned seed)
{
    for (int j = 0; j < SIDE; ++j)
        for (int i = 0; i < SIDE; ++i)
            for (int c = 0; c < 4; ++c)
                rgba[(j * SIDE + i) * 4 + c] = world_value(tx * SIDE + i, ty * SIDE + j, c, seed);
}

static int same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

// how many values of the file differ from tiles painted with seeds[ty * tiles_x + tx], 0 = zeros
static long differences(const DpMapFile* map, int tiles_x, int tiles_y, const unsigned* seeds)
{
    static const char names[] = "ABGR";
    static const int  at[] = {3, 2, 1, 0};
    if (map->nx != tiles_x * SIDE || map->ny != tiles_y * SIDE || map->channel_count != 4)
        return -1;
    long bad = 0;
    for (int c = 0; c < 4; ++c) {
        if (map->channel[c][0] != names[c] || map->channel[c][1]) return -2;
        for (int j = 0; j < map->ny; ++j)
            for (int i = 0; i < map->nx; ++i) {
                const unsigned seed = seeds[j / SIDE * tiles_x + i / SIDE];
                const float    want = seed ? world_value(i, j, at[c], seed) : 0.0f;
                bad +=
                    !same(map->value[((size_t)c * (size_t)map->ny + (size_t)j) * (size_t)map->nx +
                                     (size_t)i],
                          want);
            }
    }
    return bad;
}

TEST(what_is_set_is_what_is_read)
{
    static float rgba[SIDE * SIDE * 4];
    unsigned     seeds[6] = {0};
    const char*  path = world_path("frame.exr");
    DpFrames*    frames;
    const DpNote notes[] = {{"cell", NULL, 0.01}, {"soil", "dry-sand \xc3\xa9", 0}};
    CHECK(dp_frames_create(&frames, 3, 2, RGBA, 4, notes, 2) == DP_OK);
    const struct
    {
        int      tx, ty;
        unsigned seed;
    } steps[] = {{0, 0, 1}, {2, 1, 2}, {1, 0, 3}, {0, 0, 4}};
    for (int k = 0; k < 4; ++k) {
        paint(rgba, steps[k].tx, steps[k].ty, steps[k].seed);
        CHECK(dp_frames_set_tile(frames, steps[k].tx, steps[k].ty, rgba, k) == DP_OK);
        seeds[steps[k].ty * 3 + steps[k].tx] = steps[k].seed;
        CHECK(dp_frames_write(frames, path, 0.25 * k) == DP_OK);
        DpMapFile* map = NULL;
        CHECK(dp_maps_read(path, &map) == DP_OK);
        if (!map) break;
        CHECK(differences(map, 3, 2, seeds) == 0);
        CHECK(map->note_count == 3);
        CHECK(strcmp(map->note_name[0], "time") == 0 && map->note_number[0] == 0.25 * k);
        CHECK(strcmp(map->note_name[1], "cell") == 0 && map->note_number[1] == 0.01);
        CHECK(strcmp(map->note_text[2], "dry-sand \xc3\xa9") == 0);
        dp_map_file_destroy(map);
    }
    remove(path);
    dp_frames_destroy(frames);
}

// noise does not get smaller by packing: it is kept as it is, beside tiles that do
TEST(what_cannot_be_packed_is_kept_as_it_is)
{
    static float rgba[SIDE * SIDE * 4];
    const char*  path = world_path("noise.exr");
    DpFrames*    frames;
    DpMapFile*   map = NULL;
    uint64_t     state = 7;
    for (int k = 0; k < SIDE * SIDE * 4; ++k) {
        uint32_t bits;
        do {
            state = state * 6364136223846793005u + 1442695040888963407u;
            bits = (uint32_t)(state >> 32);
        } while ((bits >> 23 & 255u) == 255u);  // finite
        memcpy(&rgba[k], &bits, 4);
    }
    CHECK(dp_frames_create(&frames, 2, 1, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_frames_set_tile(frames, 1, 0, rgba, 0) == DP_OK);
    CHECK(dp_frames_write(frames, path, 0.0) == DP_OK);
    CHECK(dp_maps_read(path, &map) == DP_OK);
    long bad = 0;
    for (int c = 0; map && c < 4; ++c)  // A, B, G, R
        for (int j = 0; j < SIDE; ++j)
            for (int i = 0; i < 2 * SIDE; ++i)
                bad += !same(map->value[(size_t)((c * SIDE + j) * 2 * SIDE + i)],
                             i < SIDE ? 0.0f : rgba[(j * SIDE + i - SIDE) * 4 + 3 - c]);
    CHECK(map && bad == 0);
    dp_map_file_destroy(map);
    remove(path);
    dp_frames_destroy(frames);
}

TEST(untouched_ground_costs_next_to_nothing)
{
    const char*  path = world_path("zeros.exr");
    unsigned     seeds[256] = {0};
    DpFrames*    frames;
    const size_t before = dp_bytes_live();
    CHECK(dp_frames_create(&frames, 16, 16, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_bytes_live() - before < 2000000);  // pixels would take 16.8 MB
    CHECK(dp_frames_write(frames, path, 0.0) == DP_OK);
    static unsigned char bytes[100000];
    const size_t         size = world_bytes(path, bytes, sizeof bytes);
    CHECK(size > 1000 && size < 50000);
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    CHECK(map && differences(map, 16, 16, seeds) == 0);
    dp_map_file_destroy(map);
    remove(path);
    dp_frames_destroy(frames);
}

typedef struct Job
{
    DpFrames* frames;
    float*    rgba;  // (64 tiles)
} Job;

static void set_one(void* context, int index, int worker)
{
    Job*   job = context;
    float* rgba = job->rgba + (size_t)index * SIDE * SIDE * 4;
    paint(rgba, index % 8, index / 8, (unsigned)index + 7);
    if (dp_frames_set_tile(job->frames, index % 8, index / 8, rgba, worker) != DP_OK) abort();
}

TEST(the_same_bytes_for_any_number_of_workers)
{
    static unsigned char first[2000000], other[2000000];
    size_t               size = 0;
    float*               rgba = malloc(64 * SIDE * SIDE * 4 * sizeof *rgba);
    for (int workers = 1; workers <= 4; workers += 3) {
        Job         job = {NULL, rgba};
        const char* path = world_path("threads.exr");
        CHECK(dp_frames_create(&job.frames, 8, 8, RGBA, 4, NULL, 0) == DP_OK);
        dp_parallel_for(64, workers, set_one, &job);
        CHECK(dp_frames_write(job.frames, path, 1.0) == DP_OK);
        if (workers == 1) {
            size = world_bytes(path, first, sizeof first);
        } else {
            CHECK(world_bytes(path, other, sizeof other) == size);
            CHECK(size > 100000 && memcmp(first, other, size) == 0);
        }
        remove(path);
        dp_frames_destroy(job.frames);
    }
    free(rgba);
}

TEST(channels_are_found_by_name)
{
    static float      value[SIDE * SIDE * 3];
    const char* const channel[] = {"pressure_time", "compression", "heap"};
    const char*       path = world_path("maps.exr");
    DpFrames*         frames;
    CHECK(dp_frames_create(&frames, 1, 1, channel, 3, NULL, 0) == DP_OK);
    CHECK(dp_frames_channels(frames) == 3);
    for (int k = 0; k < SIDE * SIDE * 3; ++k) value[k] = (float)(k % 3 * 10000 + k / 3);
    CHECK(dp_frames_set_tile(frames, 0, 0, value, 0) == DP_OK);
    CHECK(dp_frames_write(frames, path, 1.0) == DP_OK);
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    CHECK(map && map->channel_count == 3);
    for (int c = 0; map && c < 3; ++c)
        for (int k = 0; k < 3; ++k) {
            if (strcmp(map->channel[c], channel[k]) != 0) continue;
            for (int n = 0; n < SIDE * SIDE; ++n)
                CHECK(map->value[c * SIDE * SIDE + n] == (float)(k * 10000 + n));
        }
    dp_map_file_destroy(map);
    remove(path);
    dp_frames_destroy(frames);
}

TEST(bad_arguments_are_refused)
{
    DpFrames*    frames = NULL;
    const DpNote nameless = {NULL, "x", 0}, taken = {"compression", "x", 0},
                 twice = {"time", "x", 0};
    const DpNote empty = {"", "x", 0}, endless = {"a-name-of-more-than-thirty-one-letters", "x", 0};
    CHECK(dp_frames_create(&frames, 0, 4, RGBA, 4, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(&frames, 4, -1, RGBA, 4, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(&frames, 65536, 65536, RGBA, 4, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(&frames, 1, 1, RGBA, 4, NULL, 1) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(NULL, 1, 1, RGBA, 4, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(&frames, 1, 1, RGBA, 0, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(&frames, 1, 1, NULL, 4, NULL, 0) == DP_BAD_ARGUMENT);
    const char *const twice_named[] = {"heap", "heap"}, *const unnamed[] = {"heap", NULL};
    CHECK(dp_frames_create(&frames, 1, 1, twice_named, 2, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_create(&frames, 1, 1, unnamed, 2, NULL, 0) == DP_BAD_ARGUMENT);
    const DpNote* bad[] = {&nameless, &taken, &twice, &empty, &endless};
    for (int k = 0; k < 5; ++k)
        CHECK(dp_frames_create(&frames, 1, 1, RGBA, 4, bad[k], 1) == DP_BAD_ARGUMENT);
    CHECK(frames == NULL);
    static float rgba[SIDE * SIDE * 4];
    CHECK(dp_frames_create(&frames, 2, 1, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_frames_set_tile(frames, 2, 0, rgba, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_set_tile(frames, 0, 1, rgba, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_set_tile(frames, -1, 0, rgba, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_set_tile(frames, 0, 0, rgba, 64) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_set_tile(frames, 0, 0, NULL, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_write(frames, "", 0.0) == DP_BAD_ARGUMENT);
    CHECK(dp_frames_write(frames, world_path("no/such/folder.exr"), 0.0) == DP_CANNOT_OPEN);
    dp_frames_destroy(frames);
    dp_frames_destroy(NULL);
}

// every allocation that can fail does, once; nothing leaks and the tile set before is still there
TEST(no_memory_is_survived)
{
    static float rgba[SIDE * SIDE * 4];
    const char*  path = world_path("memory.exr");
    unsigned     seeds[4] = {0, 0, 0, 0};
    DpNote       note = {"soil", "mud", 0};
    DpFrames*    frames = NULL;
    long         tries = 0;
    DpStatus     status;
    do {
        dp_alloc_fail_after(tries++);
        status = dp_frames_create(&frames, 2, 2, RGBA, 4, &note, 1);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
    } while (status != DP_OK && tries < 1000);
    CHECK(status == DP_OK && tries > 5);
    dp_alloc_fail_after(-1);

    unsigned seed = 1;
    for (tries = 0, status = DP_NO_MEMORY; status != DP_OK && tries < 1000; ++tries) {
        paint(rgba, 1, 1, ++seed);
        dp_alloc_fail_after(tries);
        status = dp_frames_set_tile(frames, 1, 1, rgba, 3);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
    }
    CHECK(status == DP_OK && tries > 2);
    dp_alloc_fail_after(-1);
    seeds[3] = seed;
    for (tries = 0, status = DP_NO_MEMORY; status != DP_OK && tries < 1000; ++tries) {
        dp_alloc_fail_after(tries);
        status = dp_frames_write(frames, path, 1.0);
        CHECK(status == DP_OK || status == DP_NO_MEMORY);
    }
    CHECK(status == DP_OK && tries > 3);
    dp_alloc_fail_after(-1);
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    CHECK(map && differences(map, 2, 2, seeds) == 0);
    dp_map_file_destroy(map);
    remove(path);
    dp_frames_destroy(frames);
}

TEST(files_are_listed_with_what_they_hold)
{
    static unsigned char byte[1 << 16];
    static char          want[1024], line[1024];
    const char*          list = world_path("list.txt");
    const char*          path = world_path("frame.exr");
    DpFrames*            frames;
    CHECK(dp_frames_create(&frames, 1, 1, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_frames_list(frames, list) == DP_CANNOT_OPEN);  // it is made by whoever wants it
    fclose(fopen(list, "w"));
    CHECK(dp_frames_list(frames, list) == DP_OK);
    CHECK(dp_frames_write(frames, path, 0.0) == DP_OK);

    FILE*        file = fopen(path, "rb");
    const size_t size = fread(byte, 1, sizeof byte, file);
    fclose(file);
    uint64_t words[DP_DIGEST_WORDS];
    dp_digest(byte, size, words);
    int end = snprintf(want, sizeof want, "frame.exr %zu:", size);
    for (size_t k = 0; k < sizeof words; ++k)
        end += snprintf(want + end, 3, "%02x", ((unsigned char*)words)[k]);
    file = fopen(list, "r");
    CHECK(fgets(line, sizeof line, file) && line[end] == '\n');
    line[end] = 0;
    CHECK(strcmp(line, want) == 0 && !fgets(line, sizeof line, file));
    fclose(file);
    remove(list), remove(path);
    dp_frames_destroy(frames);
}

int main(void)
{
    RUN(files_are_listed_with_what_they_hold);
    RUN(what_is_set_is_what_is_read);
    RUN(what_cannot_be_packed_is_kept_as_it_is);
    RUN(untouched_ground_costs_next_to_nothing);
    RUN(the_same_bytes_for_any_number_of_workers);
    RUN(channels_are_found_by_name);
    RUN(bad_arguments_are_refused);
    RUN(no_memory_is_survived);
    world_end();
    return check_done();
}
