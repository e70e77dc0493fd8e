// base/os_posix.c - threads, processors and memory of Linux and macOS.
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/os.h"

void dp_lock_create(DpLock* lock)
{
    pthread_mutex_init(lock, NULL);
}

void dp_lock_destroy(DpLock* lock)
{
    pthread_mutex_destroy(lock);
}

void dp_lock_take(DpLock* lock)
{
    pthread_mutex_lock(lock);
}

void dp_lock_give(DpLock* lock)
{
    pthread_mutex_unlock(lock);
}

void dp_signal_create(DpSignal* signal)
{
    pthread_cond_init(signal, NULL);
}

void dp_signal_destroy(DpSignal* signal)
{
    pthread_cond_destroy(signal);
}

void dp_signal_wait(DpSignal* signal, DpLock* lock)
{
    pthread_cond_wait(signal, lock);
}

void dp_signal_one(DpSignal* signal)
{
    pthread_cond_signal(signal);
}

void dp_signal_all(DpSignal* signal)
{
    pthread_cond_broadcast(signal);
}

// ---- threads --------------------------------------------------------------------------------------

static void* begin(void* context)
{
    DpThread* thread = context;
    thread->run(thread->context);
    return NULL;
}

bool dp_thread_start(DpThread* thread, void (*run)(void* context), void* context)
{
    pthread_t number;
    *thread = (DpThread){run, context, 0};
    if (pthread_create(&number, NULL, begin, thread) != 0) return false;
    _Static_assert(sizeof number <= sizeof thread->number, "a thread's number fits");
    memcpy(&thread->number, &number, sizeof number);
    return true;
}

void dp_thread_join(DpThread* thread)
{
    pthread_t number;
    memcpy(&number, &thread->number, sizeof number);
    pthread_join(number, NULL);
}

void dp_thread_leave(DpThread* thread)
{
    pthread_t number;
    memcpy(&number, &thread->number, sizeof number);
    pthread_detach(number);
}

static pthread_once_t watched = PTHREAD_ONCE_INIT;
static void (*in_child)(void);

static void watch(void)
{
    pthread_atfork(NULL, NULL, in_child);
}

void dp_forks_watch(void (*forget)(void))
{
    in_child = forget;
    pthread_once(&watched, watch);
}

// ---- the machine ----------------------------------------------------------------------------------

int64_t dp_os_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

int dp_os_processors(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > 1 << 20 ? 1 << 20 : (int)online;
}

void* dp_os_memory(size_t alignment, size_t bytes)
{
    void* memory = NULL;
    return posix_memalign(&memory, alignment, bytes) == 0 ? memory : NULL;
}

void dp_os_memory_free(void* memory)
{
    free(memory);
}
