// base/alloc.h - the one allocator; a test ends with dp_bytes_live() == 0.
#pragma once
#include <stdbool.h>
#include <stddef.h>

// Zeroed memory for count * size bytes, 64-byte aligned; NULL when there is none or count is 0.
void* dp_alloc(size_t count, size_t size);

// Grow or shrink to count * size bytes, keeping what fits; new bytes are zero.
// NULL when there is no memory: the old block then still stands.
void* dp_realloc(void* block, size_t count, size_t size);

// Room for at least count items of size bytes in *array, the address of a pointer to such memory or to NULL: what it
// holds stays, new bytes are zero, and where it grows it grows by half more. False when there is no memory: the old
// array then still stands.
bool dp_make_room(void* array, size_t count, size_t size);

// Free what dp_alloc or dp_realloc gave. NULL is fine.
void dp_free(void* block);

// Bytes allocated and not yet freed, over all threads.
size_t dp_bytes_live(void);

// The largest dp_bytes_live() there was since the last dp_bytes_peak_reset().
size_t dp_bytes_peak(void);
void   dp_bytes_peak_reset(void);

// For tests: let the next `successes` allocations pass and fail every later one; < 0 = never fail.
void dp_alloc_fail_after(long successes);
