// Files appear whole or not at all.
#define _DEFAULT_SOURCE  // syscall
#include "maps/disk.h"

static float              grid[50 * 40];
static const DpMapChannel heap = {"heap", grid};

static DpStatus save(const char* path, float value)
{
    for (int k = 0; k < 50 * 40; ++k) grid[k] = value * (float)(k % 7);
    return dp_maps_write(path, 50, 40, &heap, 1, NULL, 0);
}

// the file at `path` is whole and was saved with `value`
static int holds(const char* path, float value)
{
    DpMapFile* map = NULL;
    const int  good = dp_maps_read(path, &map) == DP_OK && map->value[3] == value * 3.0f;
    dp_map_file_destroy(map);
    return good;
}

TEST(a_full_disk_leaves_the_old_file)
{
    const char* path = world_path("old.exr");
    CHECK(save(path, 1.0f) == DP_OK);
    CHECK(holds(path, 1.0f));
    for (long room = 0; room < 300; room += 50) {
        disk_room = room;
        CHECK(save(path, 2.0f) == DP_DISK_FULL);
        disk_room = -1;
        CHECK(holds(path, 1.0f));
        CHECK(files_there() == 1);
    }
    disk_error = DISK_QUOTA;
    disk_room = 10;
    CHECK(save(path, 2.0f) == DP_DISK_FULL);
    disk_error = DISK_BROKEN;
    disk_room = 10;
    CHECK(save(path, 2.0f) == DP_CANNOT_WRITE);
    disk_error = DISK_FULL;
    disk_room = -1;
    CHECK(holds(path, 1.0f));
    CHECK(save(path, 3.0f) == DP_OK);
    CHECK(holds(path, 3.0f));
    remove(path);
}

TEST(a_full_disk_leaves_the_old_frame)
{
    static float rgba[DP_TILE * DP_TILE * 4];
    const char*  path = world_path("frame.exr");
    DpFrames*    frames;
    for (int k = 0; k < DP_TILE * DP_TILE * 4; ++k) rgba[k] = 0.5f;
    CHECK(dp_frames_create(&frames, 2, 2, RGBA, 4, NULL, 0) == DP_OK);
    CHECK(dp_frames_write(frames, path, 0.0) == DP_OK);
    CHECK(dp_frames_set_tile(frames, 0, 0, rgba, 0) == DP_OK);
    disk_room = 100;
    CHECK(dp_frames_write(frames, path, 1.0) == DP_DISK_FULL);
    disk_room = -1;
    DpMapFile* map = NULL;
    CHECK(dp_maps_read(path, &map) == DP_OK);
    CHECK(map && map->value[0] == 0.0f);
    dp_map_file_destroy(map);
    CHECK(files_there() == 1);
    CHECK(dp_frames_write(frames, path, 1.0) == DP_OK);  // room was made: the bake goes on
    CHECK(dp_maps_read(path, &map) == DP_OK);
    CHECK(map && map->value[0] == 0.5f);
    dp_map_file_destroy(map);
    dp_frames_destroy(frames);
    remove(path);
}

TEST(a_disk_that_says_so_when_closing)
{
    const char* path = world_path("late.exr");
    CHECK(save(path, 1.0f) == DP_OK);
    close_error = DISK_FULL;
    const DpStatus status = save(path, 2.0f);
    close_error = DISK_HEALTHY;
    CHECK(status == DP_DISK_FULL);
    CHECK(holds(path, 1.0f));
    CHECK(files_there() == 1);
    remove(path);
}

#ifdef _WIN32
// a search or a scanner has it open for a moment; who keeps it open keeps it
TEST(a_place_that_is_open_is_asked_for_again)
{
    const char* path = world_path("open.exr");
    CHECK(save(path, 1.0f) == DP_OK);
    holders = 5;
    CHECK(save(path, 2.0f) == DP_OK);
    CHECK(holders == 0);
    CHECK(holds(path, 2.0f));
    holders = 1000;
    CHECK(save(path, 3.0f) == DP_CANNOT_WRITE);
    CHECK(holders > 900);
    holders = 0;
    CHECK(holds(path, 2.0f));
    CHECK(files_there() == 1);
    remove(path);
}
#else
TEST(an_interrupted_write_goes_on)
{
    const char* path = world_path("signal.exr");
    interruptions = 3;
    CHECK(save(path, 4.0f) == DP_OK);
    CHECK(interruptions == 0);
    CHECK(holds(path, 4.0f));
    remove(path);
}
#endif

TEST(a_target_that_cannot_be_replaced)
{
    const char* path = world_path("folder.exr");
    CHECK(FOLDER_MAKE(path) == 0);
    CHECK(save(path, 1.0f) == DP_CANNOT_WRITE);
    CHECK(files_there() == 1);
    FOLDER_REMOVE(path);
    CHECK(save(world_path("missing/map.exr"), 1.0f) == DP_CANNOT_OPEN);
    CHECK(files_there() == 0);
}

int main(void)
{
    RUN(a_full_disk_leaves_the_old_file);
    RUN(a_full_disk_leaves_the_old_frame);
    RUN(a_disk_that_says_so_when_closing);
#ifdef _WIN32
    RUN(a_place_that_is_open_is_asked_for_again);
#else
    RUN(an_interrupted_write_goes_on);
#endif
    RUN(a_target_that_cannot_be_replaced);
    world_end();
    return check_done();
}
