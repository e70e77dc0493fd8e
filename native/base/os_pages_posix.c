// base/os_pages_posix.c - pages of a file as memory, on Linux and macOS.
#ifndef __APPLE__
#define _DEFAULT_SOURCE  // declares madvise
#endif
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/os.h"
#ifdef __APPLE__
#include <mach/mach.h>
#endif

DpStatus dp_scratch_create(const char* path, DpFile* file)
{
    unlink(path);
    *file = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (*file < 0) return errno == ENOSPC || errno == EDQUOT ? DP_DISK_FULL : DP_CANNOT_OPEN;
    unlink(path);
    return DP_OK;
}

// 0 or the number of an error
static int reserve(int file, off_t from, off_t bytes)
{
#ifdef __APPLE__
    fstore_t wanted = {F_ALLOCATEALL, F_PEOFPOSMODE, 0, bytes, 0};
    if (fcntl(file, F_PREALLOCATE, &wanted) < 0) return errno;
    return ftruncate(file, from + bytes) < 0 ? errno : 0;
#else
    return posix_fallocate(file, from, bytes);
#endif
}

DpStatus dp_scratch_grow(DpFile file, int64_t bytes)
{
    struct stat about;
    if (fstat((int)file, &about) < 0) return DP_CANNOT_WRITE;
    int error = EINTR;
    while (error == EINTR) error = reserve((int)file, about.st_size, (off_t)bytes - about.st_size);
    if (error == 0) return DP_OK;
    if (ftruncate((int)file, about.st_size) < 0) return DP_CANNOT_WRITE;
    return error == ENOSPC || error == EDQUOT || error == EFBIG ? DP_DISK_FULL : DP_CANNOT_WRITE;
}

// A process that is forked would write into the same pages: it does not get them.
static bool keep_from_children(void* at, size_t bytes)
{
#ifdef __APPLE__
    return minherit(at, bytes, VM_INHERIT_NONE) == 0;
#else
    return madvise(at, bytes, MADV_DONTFORK) == 0;
#endif
}

static void* map(void* at, int how, DpFile file, int64_t offset, size_t bytes)
{
    void* mapped =
        mmap(at, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | how, (int)file, (off_t)offset);
    if (mapped == MAP_FAILED) return NULL;
    if (keep_from_children(mapped, bytes)) return mapped;
    munmap(mapped, bytes);
    return NULL;
}

void* dp_pages_map(DpFile file, int64_t offset, size_t bytes)
{
    return map(NULL, 0, file, offset, bytes);
}

void dp_pages_unmap(void* at, size_t bytes)
{
    munmap(at, bytes);
}

// On macOS the same bytes at the same place once more: what the old mapping held of memory goes with it, in one step.
bool dp_pages_leave(DpFile file, int64_t offset, void* at, size_t bytes)
{
#ifdef __APPLE__
    return map(at, MAP_FIXED, file, offset, bytes) != NULL;
#else
    (void)file, (void)offset;
    return madvise(at, bytes, MADV_DONTNEED) == 0;
#endif
}

size_t dp_os_resident(void)
{
#ifdef __APPLE__
    mach_task_basic_info_data_t about;
    mach_msg_type_number_t      count = MACH_TASK_BASIC_INFO_COUNT;
    if (task_info(mach_task_self(), MACH_TASK_BASIC_INFO, (task_info_t)&about, &count) !=
        KERN_SUCCESS)
        return 0;
    return (size_t)about.resident_size;
#else
    char      text[128];  // pages of addresses, then pages in memory
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    const ssize_t size = read(file, text, sizeof text - 1);
    close(file);
    if (size <= 0) return 0;
    text[size] = 0;
    char*      rest;
    const long page = sysconf(_SC_PAGESIZE);
    (void)strtoull(text, &rest, 10);
    return page > 0 ? (size_t)strtoull(rest, NULL, 10) * (size_t)page : 0;
#endif
}
