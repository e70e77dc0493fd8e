// base/os.h - what differs from one system to the next: threads, files, processors, memory. All else of the core asks
// here; os_posix.c, os_files_posix.c and os_pages_posix.c answer on Linux and macOS, the files ending in _windows.c on
// Windows.
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

// ---- threads --------------------------------------------------------------------------------------

#ifdef _WIN32
typedef struct DpLock
{
    void* word;  // an SRWLOCK
} DpLock;
typedef struct DpSignal
{
    void* word;  // a CONDITION_VARIABLE
} DpSignal;
#define DP_LOCK_READY \
    {                 \
        0             \
    }
#define DP_SIGNAL_READY \
    {                   \
        0               \
    }
#else
#include <pthread.h>
typedef pthread_mutex_t DpLock;
typedef pthread_cond_t  DpSignal;
#define DP_LOCK_READY PTHREAD_MUTEX_INITIALIZER
#define DP_SIGNAL_READY PTHREAD_COND_INITIALIZER
#endif

// A lock that one thread holds at a time, not twice. Static ones begin as DP_LOCK_READY.
void dp_lock_create(DpLock* lock);
void dp_lock_destroy(DpLock* lock);
void dp_lock_take(DpLock* lock);
void dp_lock_give(DpLock* lock);

// What threads sleep on. wait: gives the lock while it sleeps; may wake for nothing, so ask again.
void dp_signal_create(DpSignal* signal);
void dp_signal_destroy(DpSignal* signal);
void dp_signal_wait(DpSignal* signal, DpLock* lock);
void dp_signal_one(DpSignal* signal);
void dp_signal_all(DpSignal* signal);

// A thread that calls run(context), to be joined once; false where the system gives none.
typedef struct DpThread
{
    void (*run)(void* context);
    void*    context;
    uint64_t number;  // the system's
} DpThread;
bool dp_thread_start(DpThread* thread, void (*run)(void* context), void* context);
void dp_thread_join(DpThread* thread);

// Let a thread that was started go on by itself, in place of joining it; it ends with the process.
void dp_thread_leave(DpThread* thread);

// Have every process that is forked from this one call `forget` first, as it has none of the threads. Any number of
// calls with the same function count as one; one thread calls at a time.
void dp_forks_watch(void (*forget)(void));

// ---- the machine ----------------------------------------------------------------------------------

// Time since some moment, never backwards [ns].
int64_t dp_os_time(void);

// Processors that work now, >= 1.
int dp_os_processors(void);

// Memory that begins at a multiple of `alignment`, a power of two that divides `bytes`; NULL when there is none.
void* dp_os_memory(size_t alignment, size_t bytes);
void  dp_os_memory_free(void* memory);

// Memory of the machine that this process takes now, files it has mapped too [bytes]; 0 where nobody tells.
size_t dp_os_resident(void);

// ---- files ----------------------------------------------------------------------------------------
//
// Paths are UTF-8 on Windows, of any length there, and the system's own bytes elsewhere.

typedef intptr_t DpFile;
#define DP_NO_FILE ((DpFile)-1)

// The last part of a path.
const char* dp_os_name(const char* path);

// This process among those that are there.
long dp_os_process(void);

// A new empty file to write; what stood there is removed. DP_DISK_FULL, DP_CANNOT_OPEN.
DpStatus dp_file_create(const char* path, DpFile* file);

// A file that is there, to write at its end, no link. DP_CANNOT_OPEN.
DpStatus dp_file_append(const char* path, DpFile* file);

// A file that is there, to read, and its size [bytes]. DP_CANNOT_OPEN; DP_BAD_FILE for what is no plain file.
DpStatus dp_file_open(const char* path, DpFile* file, int64_t* size);

// All of the bytes. DP_DISK_FULL, DP_CANNOT_WRITE.
DpStatus dp_file_write(DpFile file, const void* data, size_t size);

// Bytes from `offset` on: how many there were, fewer only at the end; -1 when they cannot be read.
int64_t dp_file_read(DpFile file, void* into, size_t size, int64_t offset);

// Close; DP_NO_FILE is fine. Some disks only say here that they are full: DP_DISK_FULL, DP_CANNOT_WRITE.
DpStatus dp_file_close(DpFile file);

// Give a file the place of another, at one moment. DP_DISK_FULL, DP_CANNOT_WRITE: both are as they were.
DpStatus dp_file_replace(const char* from, const char* to);

// Remove a file, if it is there.
void dp_file_remove(const char* path);

// ---- pages of a file ------------------------------------------------------------------------------

// A new empty file to map, which nobody else finds and which is gone when it is closed or the process ends.
// DP_DISK_FULL, DP_CANNOT_OPEN.
DpStatus dp_scratch_create(const char* path, DpFile* file);

// Let it have so many bytes, a multiple of 64 KiB; there is room on the disk for all of them. DP_DISK_FULL,
// DP_CANNOT_WRITE: it is as it was.
DpStatus dp_scratch_grow(DpFile file, int64_t bytes);

// Some of its bytes as memory, from a multiple of 64 KiB on; NULL when there is no room for them among addresses.
void* dp_pages_map(DpFile file, int64_t offset, size_t bytes);
void  dp_pages_unmap(void* at, size_t bytes);

// All that was mapped leaves memory: who touches it again, now or in another thread, finds it as it was. False
// where the system does not let it.
bool dp_pages_leave(DpFile file, int64_t offset, void* at, size_t bytes);
