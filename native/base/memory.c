// base/memory.c - blocks in a file of pages, which leave memory when it comes near its limit.
//
//   file = segment, segment, ..     each mapped at one place for as long as any block is in use
//   segment = block, block, ..      of classes of sizes; what is given back is used again for the same class
//
// When the process takes more than HIGH of its limit, all pages leave at once: those in use come back one by one for a
// microsecond each, while the rest stay away. Nobody has to know which are which.
#include "base/memory.h"

#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/os.h"

#define LINE 64  // blocks are whole cache lines [bytes]
#define STEPS 8  // classes from one power of two to the next
#define CLASSES (64 * STEPS)
#define SEGMENTS 8192                      // of one file
#define FIRST_SEGMENT ((size_t)4 << 20)    // [bytes]; those after it double ..
#define LARGE_SEGMENT ((size_t)256 << 20)  // .. up to this
#define GRAIN ((size_t)1 << 16)  // segments begin and end at multiples, as every system wants them
#define HIGH(limit) ((limit) / 8 * 7)  // between two looks at it more is touched
#define STEP(limit) ((limit) / 128 < DP_EASE_NOW ? (limit) / 128 : DP_EASE_NOW)

typedef struct Segment
{
    char*   at;
    size_t  bytes, used;
    int64_t offset;  // in the file
} Segment;

// The one file, which stays while blocks of it are in use.
typedef struct Store
{
    DpLock  lock;
    DpFile  file;
    int64_t size;           // of the file
    size_t  blocks;         // in use
    void*   idle[CLASSES];  // blocks that were given back; each begins with the next one
    Segment segment[SEGMENTS];
    int     segments;
    int     holds;
} Store;

static Store         store = {.lock = DP_LOCK_READY, .file = DP_NO_FILE};
static atomic_size_t most;  // the limit; 0: nothing is held
static atomic_size_t touched, needs;
static atomic_int    trouble;
static DpLock        looking = DP_LOCK_READY;

size_t dp_memory_needs(void)
{
    return atomic_load(&needs);
}

DpStatus dp_memory_trouble(void)
{
    return (DpStatus)atomic_exchange(&trouble, DP_OK);
}

// ---- blocks ---------------------------------------------------------------------------------------

// Which class has blocks of at least so many bytes, and how many they have; at most an eighth more.
static int class_of(size_t* bytes)
{
    const size_t lines = (*bytes + LINE - 1) / LINE;
    int          power = 0;
    while (lines >> (power + 1)) ++power;
    const size_t low = (size_t)1 << power, step = low > STEPS ? low / STEPS : 1;
    const size_t over = (lines - low + step - 1) / step;  // 0..STEPS
    *bytes = (low + over * step) * LINE;
    return over == STEPS ? (power + 1) * STEPS : power * STEPS + (int)over;
}

static bool add_segment(size_t least)
{
    size_t bytes = FIRST_SEGMENT;
    for (int k = 0; k < store.segments && bytes < LARGE_SEGMENT; ++k) bytes *= 2;
    if (bytes < least) bytes = (least + GRAIN - 1) / GRAIN * GRAIN;
    if (store.segments == SEGMENTS) return false;
    const DpStatus status = dp_scratch_grow(store.file, store.size + (int64_t)bytes);
    if (status != DP_OK) {
        atomic_store(&trouble, (int)status);
        return false;
    }
    char* at = dp_pages_map(store.file, store.size, bytes);
    if (!at) return false;
    store.segment[store.segments++] = (Segment){at, bytes, 0, store.size};
    store.size += (int64_t)bytes;
    return true;
}

static void* take(int class, size_t bytes)
{
    void* front = store.idle[class];
    if (front) {
        memcpy(&store.idle[class], front, sizeof front);
    } else {
        Segment* last = store.segments ? &store.segment[store.segments - 1] : NULL;
        if ((!last || last->bytes - last->used < bytes) && !add_segment(bytes)) return NULL;
        last = &store.segment[store.segments - 1];
        front = last->at + last->used;
        last->used += bytes;
    }
    ++store.blocks;
    return front;
}

bool dp_held_take(size_t* bytes, void** front)
{
    *front = NULL;
    if (atomic_load_explicit(&most, memory_order_relaxed) == 0) return false;
    dp_lock_take(&store.lock);
    const bool held = store.holds > 0;
    if (held && *bytes <= SIZE_MAX / 4) {
        const int class = class_of(bytes);
        *front = take(class, *bytes);
    }
    dp_lock_give(&store.lock);
    return held;
}

// Nobody uses it any more, with its lock held.
static void drop_file(void)
{
    for (int k = 0; k < store.segments; ++k)
        dp_pages_unmap(store.segment[k].at, store.segment[k].bytes);
    dp_file_close(store.file);
    store.file = DP_NO_FILE;
    store.size = 0, store.segments = 0;
    memset(store.idle, 0, sizeof store.idle);
}

void dp_held_give(void* front, size_t bytes)
{
    const int class = class_of(&bytes);
    dp_lock_take(&store.lock);
    memcpy(front, &store.idle[class], sizeof front);
    store.idle[class] = front;
    if (--store.blocks == 0 && store.holds == 0) drop_file();
    dp_lock_give(&store.lock);
    dp_memory_ease(DP_EASE_PAGE);
}

// ---- the limit ------------------------------------------------------------------------------------

DpStatus dp_memory_hold(const char* path, size_t limit)
{
    if (!path || limit == 0 || dp_os_resident() == 0) return DP_BAD_ARGUMENT;
    DpStatus status = DP_OK;
    dp_lock_take(&store.lock);
    if (store.file == DP_NO_FILE) status = dp_scratch_create(path, &store.file);
    if (status == DP_OK && store.holds++ == 0) {
        atomic_store(&touched, 0), atomic_store(&needs, 0);
        atomic_store(&trouble, DP_OK);
        atomic_store(&most, limit);
    } else if (status == DP_OK && limit < atomic_load(&most)) {
        atomic_store(&most, limit);
    }
    dp_lock_give(&store.lock);
    return status;
}

void dp_memory_release(void)
{
    dp_lock_take(&store.lock);
    if (store.holds > 0 && --store.holds == 0) {
        atomic_store(&most, 0);
        if (store.blocks == 0) drop_file();
    }
    dp_lock_give(&store.lock);
}

// All pages leave; those in use come back as they are touched.
static void let_leave(void)
{
    bool left = true;
    dp_lock_take(&store.lock);
    for (int k = 0; k < store.segments; ++k) {
        const Segment* segment = &store.segment[k];
        left = dp_pages_leave(store.file, segment->offset, segment->at, segment->bytes) && left;
    }
    dp_lock_give(&store.lock);
    if (!left) atomic_store(&trouble, DP_CANNOT_WRITE);
    atomic_store(&needs, dp_os_resident());
}

void dp_memory_leave(void)
{
    if (atomic_load(&most) != 0) let_leave();
}

void dp_memory_ease(size_t bytes)
{
    const size_t limit = atomic_load_explicit(&most, memory_order_relaxed);
    if (limit == 0 || atomic_fetch_add(&touched, bytes) + bytes < STEP(limit)) return;
    dp_lock_take(&looking);  // nobody touches more while others let pages leave
    if (atomic_load(&touched) >= STEP(limit)) {
        atomic_store(&touched, 0);
        if (dp_os_resident() > HIGH(limit)) let_leave();
    }
    dp_lock_give(&looking);
}
