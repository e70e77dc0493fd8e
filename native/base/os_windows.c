// base/os_windows.c - threads, processors and memory of Windows.
#include <process.h>
#include <stdlib.h>

#include "base/os.h"
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

_Static_assert(sizeof(SRWLOCK) == sizeof(DpLock), "a lock is one word");
_Static_assert(sizeof(CONDITION_VARIABLE) == sizeof(DpSignal), "a signal is one word");

static SRWLOCK* lock_of(DpLock* lock)
{
    return (SRWLOCK*)(void*)lock;
}

static CONDITION_VARIABLE* signal_of(DpSignal* signal)
{
    return (CONDITION_VARIABLE*)(void*)signal;
}

void dp_lock_create(DpLock* lock)
{
    InitializeSRWLock(lock_of(lock));
}

void dp_lock_destroy(DpLock* lock)
{
    (void)lock;
}

void dp_lock_take(DpLock* lock)
{
    AcquireSRWLockExclusive(lock_of(lock));
}

void dp_lock_give(DpLock* lock)
{
    ReleaseSRWLockExclusive(lock_of(lock));
}

void dp_signal_create(DpSignal* signal)
{
    InitializeConditionVariable(signal_of(signal));
}

void dp_signal_destroy(DpSignal* signal)
{
    (void)signal;
}

void dp_signal_wait(DpSignal* signal, DpLock* lock)
{
    SleepConditionVariableSRW(signal_of(signal), lock_of(lock), INFINITE, 0);
}

void dp_signal_one(DpSignal* signal)
{
    WakeConditionVariable(signal_of(signal));
}

void dp_signal_all(DpSignal* signal)
{
    WakeAllConditionVariable(signal_of(signal));
}

// ---- threads --------------------------------------------------------------------------------------

static unsigned __stdcall begin(void* context)
{
    DpThread* thread = context;
    thread->run(thread->context);
    return 0;
}

bool dp_thread_start(DpThread* thread, void (*run)(void* context), void* context)
{
    *thread = (DpThread){run, context, 0};
    thread->number = (uint64_t)_beginthreadex(NULL, 0, begin, thread, 0, NULL);
    return thread->number != 0;
}

void dp_thread_join(DpThread* thread)
{
    HANDLE handle = (HANDLE)(uintptr_t)thread->number;
    WaitForSingleObject(handle, INFINITE);
    CloseHandle(handle);
}

void dp_thread_leave(DpThread* thread)
{
    CloseHandle((HANDLE)(uintptr_t)thread->number);
}

void dp_forks_watch(void (*forget)(void))
{
    (void)forget;  // nothing forks here
}

// ---- the machine ----------------------------------------------------------------------------------

int64_t dp_os_time(void)
{
    LARGE_INTEGER ticks, rate;
    QueryPerformanceCounter(&ticks);
    QueryPerformanceFrequency(&rate);
    return ticks.QuadPart / rate.QuadPart * 1000000000 +
           ticks.QuadPart % rate.QuadPart * 1000000000 / rate.QuadPart;
}

int dp_os_processors(void)
{
    const DWORD active = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
    return active < 1 ? 1 : active > 1 << 20 ? 1 << 20 : (int)active;
}

void* dp_os_memory(size_t alignment, size_t bytes)
{
    return _aligned_malloc(bytes, alignment);
}

void dp_os_memory_free(void* memory)
{
    _aligned_free(memory);
}
