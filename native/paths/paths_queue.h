// paths/paths_queue.h - cells in the order of their times: a ring of buckets, and a heap of the one that is open.
//
// What is asked for next lies in the open bucket, a small heap; what comes later waits unordered. The order is that of
// one heap of all: by time, then by cell.
#pragma once
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"

#define DP_RING \
    4096  // buckets; what lies farther ahead waits in the last and is laid anew when that opens

// Whether a key is still asked for: others are left out when their bucket opens.
typedef bool (*DpStillWaits)(const void* of, uint64_t key);

typedef struct DpWaiting
{
    uint64_t key;
    uint32_t next;  // in its bucket, 0 = the last
} DpWaiting;

typedef struct DpQueue
{
    double     buckets;        // in a unit of time
    uint64_t   now;            // the bucket that is open
    uint32_t   ring[DP_RING];  // first of each bucket, 0 = empty
    DpWaiting* pool;           // [0] is nobody
    uint32_t   pool_used, free;
    size_t     waiting;
    uint64_t*  heap;  // of keys, from 1 on
    size_t     heap_count, heap_room, pool_room;
} DpQueue;

// times of 0 and more are ordered as their bits are
static inline uint64_t dp_queue_key(float time, uint32_t cell)
{
    uint32_t bits;
    memcpy(&bits, &time, sizeof bits);
    return (uint64_t)bits << 32 | cell;
}

static inline float dp_queue_time(uint64_t key)
{
    const uint32_t bits = (uint32_t)(key >> 32);
    float          time;
    memcpy(&time, &bits, sizeof time);
    return time;
}

static inline uint64_t dp_queue_bucket(const DpQueue* q, uint64_t key)
{
    const double at = (double)dp_queue_time(key) * q->buckets;
    return at < 9e18 ? (uint64_t)at : (uint64_t)9e18;
}

static inline bool dp_queue_heap_push(DpQueue* q, uint64_t key)
{
    if (q->heap_count + 2 > q->heap_room) {
        if (!dp_make_room(&q->heap, q->heap_room + 1024, sizeof *q->heap)) return false;
        q->heap_room += 1024;
    }
    size_t at = ++q->heap_count;
    for (; at > 1 && q->heap[at / 2] > key; at /= 2) q->heap[at] = q->heap[at / 2];
    q->heap[at] = key;
    return true;
}

static inline uint64_t dp_queue_heap_pop(DpQueue* q)
{
    uint64_t* const heap = q->heap;
    const uint64_t  first = heap[1], last = heap[q->heap_count--];
    const size_t    count = q->heap_count;
    size_t          at = 1;
    for (size_t below = 2; below <= count; below = 2 * at) {
        below += below < count && heap[below + 1] < heap[below];
        if (heap[below] >= last) break;
        heap[at] = heap[below];
        at = below;
    }
    heap[at] = last;
    return first;
}

static inline void dp_queue_lay(DpQueue* q, uint32_t node, uint64_t bucket)
{
    const uint64_t most = q->now + DP_RING - 1;
    uint32_t*      first = &q->ring[(bucket < most ? bucket : most) % DP_RING];
    q->pool[node].next = *first;
    *first = node;
}

// false when there is no memory
static inline bool dp_queue_push(DpQueue* q, float time, uint32_t cell)
{
    const uint64_t key = dp_queue_key(time, cell), bucket = dp_queue_bucket(q, key);
    if (bucket <= q->now) return dp_queue_heap_push(q, key);
    uint32_t node = q->free;
    if (node)
        q->free = q->pool[node].next;
    else {
        if ((size_t)q->pool_used + 2 > q->pool_room) {
            const size_t more = q->pool_room + q->pool_room / 2 + 4096;
            if (more > UINT32_MAX || !dp_make_room(&q->pool, more, sizeof *q->pool)) return false;
            q->pool_room = more;
        }
        node = ++q->pool_used;
    }
    q->pool[node].key = key;
    dp_queue_lay(q, node, bucket);
    q->waiting += 1;
    return true;
}

// open the next bucket that holds something; false when there is no memory
static inline bool dp_queue_open(DpQueue* q, DpStillWaits waits, const void* of)
{
    do q->now += 1;
    while (!q->ring[q->now % DP_RING]);
    uint32_t* const first = &q->ring[q->now % DP_RING];
    uint32_t        list = *first;
    size_t          count = 0;
    uint64_t        least = UINT64_MAX;
    for (uint32_t node = list; node; node = q->pool[node].next, ++count) {
        const uint64_t bucket = dp_queue_bucket(q, q->pool[node].key);
        if (bucket < least) least = bucket;
    }
    if (count == q->waiting && least > q->now) q->now = least;  // nothing lies between
    *first = 0;
    while (list) {
        const uint32_t node = list;
        list = q->pool[node].next;
        const uint64_t bucket = dp_queue_bucket(q, q->pool[node].key);
        if (bucket > q->now) {
            dp_queue_lay(q, node, bucket);
            continue;
        }
        if (waits(of, q->pool[node].key) && !dp_queue_heap_push(q, q->pool[node].key)) return false;
        q->pool[node].next = q->free;
        q->free = node;
        q->waiting -= 1;
    }
    return true;
}

// The least key, taken out: 1; 0 when none is left; -1 when there is no memory.
static inline int dp_queue_pop(DpQueue* q, uint64_t* key, DpStillWaits waits, const void* of)
{
    while (q->heap_count == 0) {
        if (q->waiting == 0) return 0;
        if (!dp_queue_open(q, waits, of)) return -1;
    }
    *key = dp_queue_heap_pop(q);
    return 1;
}

static inline void dp_queue_free(DpQueue* q)
{
    dp_free(q->pool);
    dp_free(q->heap);
}
