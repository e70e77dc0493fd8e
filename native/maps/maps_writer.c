// maps/maps_writer.c - files written in the background: what changed is copied, one thread packs it
// and writes it, in order, while the ground goes on changing.
#include <stdatomic.h>
#include <string.h>

#include "base/alloc.h"
#include "base/memory.h"
#include "base/os.h"
#include "base/parallel.h"
#include "maps/maps.h"

#define MAX_WAITING 4  // given and not yet written: more would only take memory
#define MANY_TILES 16  // changed at once: worth every core

struct DpTiles
{
    DpTiles*   next;
    DpFrames*  frames;
    size_t     size;   // floats of a tile
    int*       tile;   // place in the picture (count, 2)
    float*     value;  // (count, size)
    int        count;
    char*      path;  // "" = only packed
    double     time;
    atomic_int failed;  // DpStatus of a tile that could not be packed
};

struct DpWriter
{
    DpThread thread;
    DpLock   lock;
    DpSignal given, written;
    DpTiles *first, *last;  // waiting
    DpTiles* idle;          // their memory is used again
    int      pending;       // waiting or being written
    int      workers;
    bool     threaded, leave;
    DpStatus status;  // of the first failure nobody has heard of
    char*    path;    // and its file
    char*    failed;
};

// ---- what is given -----------------------------------------------------------------------------

static void free_tiles(DpTiles* tiles)
{
    while (tiles) {
        DpTiles* next = tiles->next;
        dp_free(tiles->tile);
        dp_free(tiles->value);
        dp_free(tiles->path);
        dp_free(tiles);
        tiles = next;
    }
}

float* dp_tiles_add(DpTiles* tiles, int tx, int ty)
{
    const size_t count = (size_t)tiles->count + 1;
    if (!dp_make_room(&tiles->tile, 2 * count, sizeof *tiles->tile) ||
        !dp_make_room(&tiles->value, count * tiles->size, sizeof *tiles->value))
        return NULL;
    dp_memory_ease(tiles->size * sizeof *tiles->value);
    tiles->tile[2 * tiles->count] = tx;
    tiles->tile[2 * tiles->count + 1] = ty;
    return tiles->value + tiles->size * (size_t)tiles->count++;
}

static bool set_path(DpTiles* tiles, const char* path)
{
    const size_t size = path ? strlen(path) + 1 : 1;
    if (!dp_make_room(&tiles->path, size, 1)) return false;
    memcpy(tiles->path, path ? path : "", size);
    return true;
}

// ---- the thread --------------------------------------------------------------------------------

static void pack_tile(void* context, int index, int worker)
{
    DpTiles*       tiles = context;
    const int*     at = tiles->tile + 2 * index;
    const DpStatus status = dp_frames_set_tile(tiles->frames, at[0], at[1],
                                               tiles->value + tiles->size * (size_t)index, worker);
    if (status != DP_OK) atomic_store(&tiles->failed, (int)status);
}

static DpStatus write_out(DpTiles* tiles, int workers)
{
    // the other cores simulate; only a flood of tiles is worth taking them
    atomic_store(&tiles->failed, DP_OK);
    dp_parallel_for(tiles->count, tiles->count < MANY_TILES ? 1 : workers, pack_tile, tiles);
    const DpStatus status = (DpStatus)atomic_load(&tiles->failed);
    if (status != DP_OK || !*tiles->path) return status;
    return dp_frames_write(tiles->frames, tiles->path, tiles->time);
}

static void put_away(DpWriter* writer, DpTiles* tiles)
{
    tiles->next = writer->idle;
    writer->idle = tiles;
}

static DpTiles* take_first(DpWriter* writer)
{
    DpTiles* tiles = writer->first;
    writer->first = tiles->next;
    if (!writer->first) writer->last = NULL;
    return tiles;
}

// Keep what failed, with its file's name; what waits is left out.
static void fail(DpWriter* writer, DpTiles* tiles, DpStatus status)
{
    writer->status = status;
    dp_free(writer->path);
    writer->path = tiles->path;
    tiles->path = NULL;
    while (writer->first) {
        put_away(writer, take_first(writer));
        --writer->pending;
    }
}

// Write what waits longest, with the lock held before and after.
static void write_next(DpWriter* writer)
{
    DpTiles* tiles = take_first(writer);
    dp_lock_give(&writer->lock);
    const DpStatus status = write_out(tiles, writer->workers);
    dp_lock_take(&writer->lock);
    if (status != DP_OK) fail(writer, tiles, status);
    put_away(writer, tiles);
    --writer->pending;
    dp_signal_all(&writer->written);
}

static void run(void* context)
{
    DpWriter* writer = context;
    dp_lock_take(&writer->lock);
    for (;;) {
        while (!writer->first && !writer->leave) dp_signal_wait(&writer->given, &writer->lock);
        if (!writer->first) break;
        write_next(writer);
    }
    dp_lock_give(&writer->lock);
}

// ---- a life ------------------------------------------------------------------------------------

DpStatus dp_writer_create(DpWriter** writer, int workers)
{
    DpWriter* created = dp_alloc(1, sizeof *created);
    if (!created) return DP_NO_MEMORY;
    created->workers = workers < 1 ? 1 : workers;
    dp_lock_create(&created->lock);
    dp_signal_create(&created->given);
    dp_signal_create(&created->written);
    created->threaded = dp_thread_start(&created->thread, run, created);
    *writer = created;
    return DP_OK;
}

void dp_writer_destroy(DpWriter* writer)
{
    if (!writer) return;
    dp_lock_take(&writer->lock);
    writer->leave = true;
    dp_signal_all(&writer->given);
    dp_lock_give(&writer->lock);
    if (writer->threaded) dp_thread_join(&writer->thread);
    dp_signal_destroy(&writer->written);
    dp_signal_destroy(&writer->given);
    dp_lock_destroy(&writer->lock);
    free_tiles(writer->first);
    free_tiles(writer->idle);
    dp_free(writer->path);
    dp_free(writer->failed);
    dp_free(writer);
}

DpTiles* dp_writer_tiles(DpWriter* writer, DpFrames* frames)
{
    const size_t size = (size_t)DP_TILE * DP_TILE * (size_t)dp_frames_channels(frames);
    dp_lock_take(&writer->lock);
    while (writer->pending >= MAX_WAITING) dp_signal_wait(&writer->written, &writer->lock);
    DpTiles* tiles = writer->idle;
    if (tiles) writer->idle = tiles->next;
    dp_lock_give(&writer->lock);
    if (!tiles) tiles = dp_alloc(1, sizeof *tiles);
    if (!tiles) return NULL;
    tiles->next = NULL;
    tiles->frames = frames;
    tiles->size = size;
    tiles->count = 0;
    return tiles;
}

DpStatus dp_writer_give(DpWriter* writer, DpTiles* tiles, const char* path, double time)
{
    if (!set_path(tiles, path)) {
        dp_writer_drop(writer, tiles);
        return DP_NO_MEMORY;
    }
    tiles->time = time;
    dp_lock_take(&writer->lock);
    if (writer->status != DP_OK) {
        put_away(writer, tiles);
    } else {
        if (writer->last)
            writer->last->next = tiles;
        else
            writer->first = tiles;
        writer->last = tiles;
        ++writer->pending;
        if (!writer->threaded) write_next(writer);
        dp_signal_one(&writer->given);
    }
    dp_lock_give(&writer->lock);
    return DP_OK;
}

void dp_writer_drop(DpWriter* writer, DpTiles* tiles)
{
    dp_lock_take(&writer->lock);
    put_away(writer, tiles);
    dp_lock_give(&writer->lock);
}

void dp_writer_wait(DpWriter* writer)
{
    dp_lock_take(&writer->lock);
    while (writer->pending > 0) dp_signal_wait(&writer->written, &writer->lock);
    dp_lock_give(&writer->lock);
}

DpStatus dp_writer_outcome(DpWriter* writer, bool wait, const char** path)
{
    if (wait) dp_writer_wait(writer);
    dp_lock_take(&writer->lock);
    const DpStatus status = writer->status;
    writer->status = DP_OK;
    if (status != DP_OK) {
        dp_free(writer->failed);
        writer->failed = writer->path;
        writer->path = NULL;
    }
    dp_lock_give(&writer->lock);
    *path = status != DP_OK && writer->failed ? writer->failed : "";
    return status;
}
