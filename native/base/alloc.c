#include "base/alloc.h"

#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/os.h"

#define ALIGNMENT \
    64  // a cache line, and the widest vector; the size stands in the line before a block

static atomic_size_t live;
static atomic_size_t peak;
static atomic_long   successes_left = -1;

static size_t* size_of(void* block)
{
    return (size_t*)(void*)((char*)block - ALIGNMENT);
}

static int may_allocate(void)
{
    long left = atomic_load(&successes_left);
    while (left >= 0) {
        if (left == 0) return 0;
        if (atomic_compare_exchange_weak(&successes_left, &left, left - 1)) break;
    }
    return 1;
}

static void count_in(size_t bytes)
{
    const size_t now = atomic_fetch_add(&live, bytes) + bytes;
    size_t       top = atomic_load(&peak);
    while (now > top && !atomic_compare_exchange_weak(&peak, &top, now)) continue;
}

void* dp_alloc(size_t count, size_t size)
{
    if (count == 0 || size == 0 || count > (SIZE_MAX - 4 * ALIGNMENT) / size) return NULL;
    if (!may_allocate()) return NULL;
    const size_t bytes = count * size;
    const size_t padded = (bytes + 2 * ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    char*        front = dp_os_memory(ALIGNMENT, padded);
    if (!front) return NULL;
    void* block = front + ALIGNMENT;
    *size_of(block) = bytes;
    memset(block, 0, bytes);
    count_in(bytes);
    return block;
}

void* dp_realloc(void* block, size_t count, size_t size)
{
    void* fresh = dp_alloc(count, size);
    if (!fresh || !block) return fresh;
    const size_t old = *size_of(block);
    memcpy(fresh, block, old < count * size ? old : count * size);
    dp_free(block);
    return fresh;
}

bool dp_make_room(void* array, size_t count, size_t size)
{
    void* block;
    memcpy(&block, array, sizeof block);
    if (count == 0 || (block && *size_of(block) / size >= count)) return true;
    void* more = count <= SIZE_MAX / 2 ? dp_realloc(block, count + count / 2, size) : NULL;
    if (!more) return false;
    memcpy(array, &more, sizeof more);
    return true;
}

void dp_free(void* block)
{
    if (!block) return;
    atomic_fetch_sub(&live, *size_of(block));
    dp_os_memory_free((char*)block - ALIGNMENT);
}

size_t dp_bytes_live(void)
{
    return atomic_load(&live);
}

size_t dp_bytes_peak(void)
{
    return atomic_load(&peak);
}

void dp_bytes_peak_reset(void)
{
    atomic_store(&peak, atomic_load(&live));
}

void dp_alloc_fail_after(long successes)
{
    atomic_store(&successes_left, successes);
}
