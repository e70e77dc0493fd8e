// tests/native/maps/disk.h - a disk that fills up, in place of the system's: on Linux this program's own write() and
// close() stand in for those of the C library, on Windows its own pointers for those of kernel32.
#pragma once
#include "maps/world.h"

#include <dirent.h>

typedef enum DiskError
{
    DISK_HEALTHY,
    DISK_FULL,
    DISK_QUOTA,
    DISK_BROKEN,
} DiskError;

static long      disk_room = -1;  // bytes that still fit; -1 = a healthy disk
static DiskError disk_error = DISK_FULL;
static DiskError close_error;

// how many of `count` bytes go to the disk; -1 for none and an error
static long disk_takes(size_t count)
{
    if (disk_room < 0) return (long)count;
    if (disk_room == 0) return -1;
    const long taken =
        count > (size_t)disk_room ? disk_room : (long)count;  // the last bytes that fit
    disk_room -= taken;
    return taken;
}

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

static int holders;  // times that a place is found open by somebody else

// the system's function of a name, past the pointer that stands in for it
static void disk_system(const char* name, void* function)
{
    const FARPROC found = GetProcAddress(GetModuleHandleW(L"kernel32.dll"), name);
    if (!found) abort();
    memcpy(function, &found, sizeof found);
}

static BOOL disk_fails(DiskError error)
{
    static const DWORD number[] = {0, ERROR_DISK_FULL, ERROR_DISK_QUOTA_EXCEEDED,
                                   ERROR_WRITE_FAULT};
    SetLastError(number[error]);
    return FALSE;
}

static BOOL WINAPI disk_write(HANDLE file, LPCVOID from, DWORD count, LPDWORD done,
                              LPOVERLAPPED place)
{
    BOOL(WINAPI * real)(HANDLE, LPCVOID, DWORD, LPDWORD, LPOVERLAPPED);
    disk_system("WriteFile", &real);
    const long taken = disk_takes(count);
    return taken < 0 ? disk_fails(disk_error) : real(file, from, (DWORD)taken, done, place);
}

static BOOL WINAPI disk_close(HANDLE file)
{
    BOOL(WINAPI * real)(HANDLE);
    disk_system("CloseHandle", &real);
    const BOOL done = real(file);
    return close_error ? disk_fails(close_error) : done;
}

static BOOL WINAPI disk_move(LPCWSTR from, LPCWSTR to, DWORD how)
{
    BOOL(WINAPI * real)(LPCWSTR, LPCWSTR, DWORD);
    disk_system("MoveFileExW", &real);
    if (holders <= 0) return real(from, to, how);
    SetLastError(--holders % 2 ? ERROR_ACCESS_DENIED : ERROR_SHARING_VIOLATION);
    return FALSE;
}

extern BOOL(WINAPI* const __imp_WriteFile)(HANDLE, LPCVOID, DWORD, LPDWORD, LPOVERLAPPED);
extern BOOL(WINAPI* const __imp_CloseHandle)(HANDLE);
extern BOOL(WINAPI* const __imp_MoveFileExW)(LPCWSTR, LPCWSTR, DWORD);
BOOL(WINAPI* const __imp_WriteFile)(HANDLE, LPCVOID, DWORD, LPDWORD, LPOVERLAPPED) = disk_write;
BOOL(WINAPI* const __imp_CloseHandle)(HANDLE) = disk_close;
BOOL(WINAPI* const __imp_MoveFileExW)(LPCWSTR, LPCWSTR, DWORD) = disk_move;
#else
#include <errno.h>
#include <sys/syscall.h>

static int interruptions;  // writes that a signal stops first

static int disk_fails(DiskError error)
{
    static const int number[] = {0, ENOSPC, EDQUOT, EIO};
    errno = number[error];
    return -1;
}

ssize_t write(int file, const void* from, size_t count)
{
    if (file > 2 && interruptions > 0) {
        --interruptions;
        errno = EINTR;
        return -1;
    }
    const long taken = file > 2 ? disk_takes(count) : (long)count;
    return taken < 0 ? disk_fails(disk_error) : syscall(SYS_write, file, from, (size_t)taken);
}

int close(int file)
{
    const int done = (int)syscall(SYS_close, file);
    return file > 2 && close_error ? disk_fails(close_error) : done;
}
#endif

static int files_there(void)
{
    int  count = 0;
    DIR* folder = opendir(world_folder);
    if (!folder) return -1;
    for (struct dirent* entry; (entry = readdir(folder));) count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}
