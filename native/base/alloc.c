#include "base/alloc.h"

#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "base/os.h"

#define ALIGNMENT 64               // a cache line, and the widest vector
#define STRETCH ((size_t)1 << 20)  // of memory that is cleared or copied at once [bytes]

// What stands in the line before a block.
typedef struct Head
{
    size_t bytes;   // of the block
    size_t padded;  // with this line and the rest of the last
    bool   held;    // memory.c has it from its file
} Head;

static atomic_size_t live;
static atomic_size_t peak;
static atomic_long   successes_left = -1;

static Head* head_of(void* block)
{
    return (Head*)(void*)((char*)block - ALIGNMENT);
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

// memory that held is no more in memory than a stretch
static void fill(char* to, const char* from, size_t bytes)
{
    for (size_t done = 0; done < bytes; done += STRETCH) {
        const size_t n = bytes - done < STRETCH ? bytes - done : STRETCH;
        if (from)
            memcpy(to + done, from + done, n);
        else
            memset(to + done, 0, n);
        if (n == STRETCH) dp_memory_ease(from ? 2 * n : n);
    }
}

void* dp_alloc(size_t count, size_t size)
{
    if (count == 0 || size == 0 || count > (SIZE_MAX - 4 * ALIGNMENT) / size) return NULL;
    if (!may_allocate()) return NULL;
    const size_t bytes = count * size;
    size_t       padded = (bytes + 2 * ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    void*        front = NULL;
    const bool   held = bytes >= DP_HELD_LEAST && dp_held_take(&padded, &front);
    if (!held) front = dp_os_memory(ALIGNMENT, padded);
    if (!front) return NULL;
    void* block = (char*)front + ALIGNMENT;
    *head_of(block) = (Head){bytes, padded, held};
    if (held) dp_memory_ease(bytes % STRETCH);
    fill(block, NULL, bytes);
    count_in(bytes);
    return block;
}

void* dp_realloc(void* block, size_t count, size_t size)
{
    void* fresh = dp_alloc(count, size);
    if (!fresh || !block) return fresh;
    const size_t old = head_of(block)->bytes;
    fill(fresh, block, old < count * size ? old : count * size);
    dp_free(block);
    return fresh;
}

bool dp_make_room(void* array, size_t count, size_t size)
{
    void* block;
    memcpy(&block, array, sizeof block);
    if (count == 0 || (block && head_of(block)->bytes / size >= count)) return true;
    void* more = count <= SIZE_MAX / 2 ? dp_realloc(block, count + count / 2, size) : NULL;
    if (!more) return false;
    memcpy(array, &more, sizeof more);
    return true;
}

void dp_free(void* block)
{
    if (!block) return;
    const Head head = *head_of(block);
    atomic_fetch_sub(&live, head.bytes);
    if (head.held)
        dp_held_give((char*)block - ALIGNMENT, head.padded);
    else
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
