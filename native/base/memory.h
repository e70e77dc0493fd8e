// base/memory.h - memory that keeps to a limit: what does not fit waits on the disk.
//
//   dp_memory_hold(path, limit)   from now on blocks of alloc.h lie in a file of pages
//   dp_memory_ease(bytes)         so much was touched: where the limit is near, pages leave for the disk
//   dp_memory_release()           blocks come from the system again
//
// Pointers stay as they are, and who touches what has left gets it back from the system. So no room knows where its
// memory lies; those that go through much of it say so by dp_memory_ease. The file has no name: it is gone with the
// process, however that ends.
#pragma once
#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"

#define DP_HELD_LEAST 1024  // smaller blocks are the system's as ever [bytes]

// What this process takes [bytes] is held below a limit, as far as it is memory of dp_alloc from now on. `path` is where
// the file begins its short life. Within another hold the smaller limit counts, and its file. Each is released once.
// A limit of 0 or a system that does not tell what a process takes: DP_BAD_ARGUMENT; DP_CANNOT_OPEN, DP_DISK_FULL.
DpStatus dp_memory_hold(const char* path, size_t limit);

// Blocks that lie in the file stay there until they are freed, and so does the file.
void dp_memory_release(void);

// Work has touched about so many bytes since it last said so. May be called at any time by any thread.
void dp_memory_ease(size_t bytes);
#define DP_EASE_NOW ((size_t)1 << 22)   // so many that the limit is looked at
#define DP_EASE_PAGE ((size_t)1 << 16)  // what may come back with one page that is touched

// All that may leave leaves now.
void dp_memory_leave(void);

// What this process took when all that may leave had last left [bytes]; 0: it never had to.
size_t dp_memory_needs(void);

// What went wrong with the file since the last call: DP_OK, DP_DISK_FULL, DP_CANNOT_WRITE. dp_alloc has said there is
// no memory.
DpStatus dp_memory_trouble(void);

// ---- for alloc.c ----------------------------------------------------------------------------------

// Memory of at least *bytes, aligned to a cache line, of which *bytes says how much it is then; *front is NULL where the
// disk gives no more. False while nothing is held: the system's is to be taken.
bool dp_held_take(size_t* bytes, void** front);
void dp_held_give(void* front, size_t bytes);
