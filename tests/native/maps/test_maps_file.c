// Files appear whole or not at all. This program's own write() and close() stand in for a disk that
// fills up.
#define _DEFAULT_SOURCE  // syscall
#include "maps/world.h"

#include <dirent.h>
#include <errno.h>
#include <sys/stat.h>
#include <sys/syscall.h>

static long disk_room = -1;  // bytes that still fit; -1 = a healthy disk
static int  disk_error = ENOSPC;
static int  close_error;
static int  interruptions;

ssize_t write(int file, const void* from, size_t count)
{
    if (file > 2 && interruptions > 0) {
        --interruptions;
        errno = EINTR;
        return -1;
    }
    if (file > 2 && disk_room >= 0) {
        if (disk_room == 0) {
            errno = disk_error;
            return -1;
        }
        if (count > (size_t)disk_room) count = (size_t)disk_room;  // the last bytes that fit
        disk_room -= (long)count;
    }
    return syscall(SYS_write, file, from, count);
}

int close(int file)
{
    const int done = (int)syscall(SYS_close, file);
    if (file <= 2 || !close_error) return done;
    errno = close_error;
    return -1;
}

static int files_there(void)
{
    int  count = 0;
    DIR* folder = opendir(world_folder);
    if (!folder) return -1;
    for (struct dirent* entry; (entry = readdir(folder));) count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

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
    disk_error = EDQUOT;
    disk_room = 10;
    CHECK(save(path, 2.0f) == DP_DISK_FULL);
    disk_error = EIO;
    disk_room = 10;
    CHECK(save(path, 2.0f) == DP_CANNOT_WRITE);
    disk_error = ENOSPC;
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
    close_error = ENOSPC;
    const DpStatus status = save(path, 2.0f);
    close_error = 0;
    CHECK(status == DP_DISK_FULL);
    CHECK(holds(path, 1.0f));
    CHECK(files_there() == 1);
    remove(path);
}

TEST(an_interrupted_write_goes_on)
{
    const char* path = world_path("signal.exr");
    interruptions = 3;
    CHECK(save(path, 4.0f) == DP_OK);
    CHECK(interruptions == 0);
    CHECK(holds(path, 4.0f));
    remove(path);
}

TEST(a_target_that_cannot_be_replaced)
{
    const char* path = world_path("folder.exr");
    CHECK(mkdir(path, 0700) == 0);
    CHECK(save(path, 1.0f) == DP_CANNOT_WRITE);
    CHECK(files_there() == 1);
    rmdir(path);
    CHECK(save(world_path("missing/map.exr"), 1.0f) == DP_CANNOT_OPEN);
    CHECK(files_there() == 0);
}

int main(void)
{
    RUN(a_full_disk_leaves_the_old_file);
    RUN(a_full_disk_leaves_the_old_frame);
    RUN(a_disk_that_says_so_when_closing);
    RUN(an_interrupted_write_goes_on);
    RUN(a_target_that_cannot_be_replaced);
    world_end();
    return check_done();
}
