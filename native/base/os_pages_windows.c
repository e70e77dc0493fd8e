// base/os_pages_windows.c - pages of a file as memory, on Windows.
#include "base/os.h"
#define WIN32_LEAN_AND_MEAN
#define PSAPI_VERSION 2
#include <windows.h>
// after it
#include <psapi.h>

#include "base/os_inside_windows.h"

DpStatus dp_scratch_create(const char* path, DpFile* file)
{
    return dp_open_as(path, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW,
                      FILE_ATTRIBUTE_NORMAL | FILE_FLAG_DELETE_ON_CLOSE, file);
}

DpStatus dp_scratch_grow(DpFile file, int64_t bytes)
{
    FILE_END_OF_FILE_INFO end;
    end.EndOfFile.QuadPart = bytes;
    if (SetFileInformationByHandle((HANDLE)file, FileEndOfFileInfo, &end, sizeof end)) return DP_OK;
    return dp_status_of(GetLastError(), DP_CANNOT_WRITE);
}

void* dp_pages_map(DpFile file, int64_t offset, size_t bytes)
{
    const uint64_t end = (uint64_t)offset + bytes, begin = (uint64_t)offset;
    HANDLE mapping = CreateFileMappingW((HANDLE)file, NULL, PAGE_READWRITE, (DWORD)(end >> 32),
                                        (DWORD)end, NULL);
    if (!mapping) return NULL;
    void* at = MapViewOfFile(mapping, FILE_MAP_READ | FILE_MAP_WRITE, (DWORD)(begin >> 32),
                             (DWORD)begin, bytes);
    CloseHandle(mapping);  // the view keeps what it needs
    return at;
}

void dp_pages_unmap(void* at, size_t bytes)
{
    (void)bytes;
    UnmapViewOfFile(at);
}

// Pages that are unlocked and were not locked leave the working set, which the system then says: they were not.
bool dp_pages_leave(DpFile file, int64_t offset, void* at, size_t bytes)
{
    (void)file, (void)offset;
    return VirtualUnlock(at, bytes) || GetLastError() == ERROR_NOT_LOCKED;
}

size_t dp_os_resident(void)
{
    PROCESS_MEMORY_COUNTERS about = {.cb = sizeof about};
    return K32GetProcessMemoryInfo(GetCurrentProcess(), &about, sizeof about) ? about.WorkingSetSize
                                                                              : 0;
}
