// base/os_files_windows.c - files of Windows.
#include <string.h>

#include "base/os.h"
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include "base/os_inside_windows.h"

#define MAX_BYTES ((size_t)1 << 30)  // of one call
#define LONGEST_PATH 32767           // of what the system takes
#define TRIES 50     // at a place that somebody has open, a search or a scanner for a moment
#define PATIENCE 20  // between two of them [ms]

DpStatus dp_status_of(unsigned long error, DpStatus otherwise)
{
    return error == ERROR_DISK_FULL || error == ERROR_HANDLE_DISK_FULL ||
                   error == ERROR_DISK_QUOTA_EXCEEDED
               ? DP_DISK_FULL
               : otherwise;
}

// A path as the system takes it at any length, with its mark for that. On the stack: a file can be closed up and
// removed when there is no memory left.
typedef struct WidePath
{
    wchar_t text[LONGEST_PATH + 16];
} WidePath;

// False when there is no such path.
static bool wide_path(const char* path, WidePath* wide)
{
    static const wchar_t mark[] = L"\\\\?\\", mark_of_share[] = L"\\\\?\\UNC\\";
    wchar_t              given[LONGEST_PATH];
    if (MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, given, LONGEST_PATH) <= 0)
        return false;
    wchar_t*    at = wide->text + 8;  // room for the longer mark
    const DWORD length = GetFullPathNameW(given, LONGEST_PATH, at, NULL);
    if (length == 0 || length >= LONGEST_PATH) return false;
    const bool     marked = wcsncmp(at, L"\\\\?\\", 4) == 0 || wcsncmp(at, L"\\\\.\\", 4) == 0;
    const bool     share = !marked && at[0] == L'\\' && at[1] == L'\\';
    const wchar_t* front = marked ? L"" : share ? mark_of_share : mark;
    wchar_t*       rest = share ? at + 2 : at;
    const size_t   size = wcslen(front), left = wcslen(rest) + 1;
    memmove(wide->text + size, rest, left * sizeof *rest);
    memcpy(wide->text, front, size * sizeof *front);
    return true;
}

const char* dp_os_name(const char* path)
{
    const char* name = path;
    for (const char* at = path; *at; ++at)
        if (*at == '/' || *at == '\\' || *at == ':') name = at + 1;
    return name;
}

long dp_os_process(void)
{
    return (long)GetCurrentProcessId();
}

DpStatus dp_open_as(const char* path, unsigned long access, unsigned long how, unsigned long flags,
                    DpFile* file)
{
    *file = DP_NO_FILE;
    WidePath name;
    if (!wide_path(path, &name)) return DP_CANNOT_OPEN;
    if (how == CREATE_NEW) DeleteFileW(name.text);
    const DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    HANDLE      handle = CreateFileW(name.text, access, shared, NULL, how, flags, NULL);
    if (handle == INVALID_HANDLE_VALUE) return dp_status_of(GetLastError(), DP_CANNOT_OPEN);
    *file = (DpFile)handle;
    return DP_OK;
}

DpStatus dp_file_create(const char* path, DpFile* file)
{
    return dp_open_as(path, GENERIC_WRITE, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, file);
}

static DpStatus refuse(DpFile* file, DpStatus status)
{
    CloseHandle((HANDLE)*file);
    *file = DP_NO_FILE;
    return status;
}

DpStatus dp_file_append(const char* path, DpFile* file)
{
    const DpStatus status = dp_open_as(path, FILE_APPEND_DATA | FILE_READ_ATTRIBUTES, OPEN_EXISTING,
                                       FILE_FLAG_OPEN_REPARSE_POINT, file);
    if (status != DP_OK) return DP_CANNOT_OPEN;
    BY_HANDLE_FILE_INFORMATION about;
    const bool                 link = !GetFileInformationByHandle((HANDLE)*file, &about) ||
                      (about.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
    return link ? refuse(file, DP_CANNOT_OPEN) : DP_OK;
}

DpStatus dp_file_open(const char* path, DpFile* file, int64_t* size)
{
    // with the flag a folder opens, too, and is told apart from what is not there
    const DpStatus status =
        dp_open_as(path, GENERIC_READ, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, file);
    if (status != DP_OK) return DP_CANNOT_OPEN;
    BY_HANDLE_FILE_INFORMATION about;
    LARGE_INTEGER              bytes;
    if (GetFileType((HANDLE)*file) != FILE_TYPE_DISK ||
        !GetFileInformationByHandle((HANDLE)*file, &about) ||
        (about.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY))
        return refuse(file, DP_BAD_FILE);
    if (!GetFileSizeEx((HANDLE)*file, &bytes)) return refuse(file, DP_CANNOT_OPEN);
    *size = bytes.QuadPart;
    return DP_OK;
}

DpStatus dp_file_write(DpFile file, const void* data, size_t size)
{
    const unsigned char* at = data;
    while (size > 0) {
        DWORD done = 0;
        if (!WriteFile((HANDLE)file, at, (DWORD)(size < MAX_BYTES ? size : MAX_BYTES), &done, NULL))
            return dp_status_of(GetLastError(), DP_CANNOT_WRITE);
        if (done == 0) return DP_CANNOT_WRITE;
        at += done;
        size -= done;
    }
    return DP_OK;
}

int64_t dp_file_read(DpFile file, void* into, size_t size, int64_t offset)
{
    size_t got = 0;
    while (got < size) {
        const uint64_t place = (uint64_t)offset + got;
        OVERLAPPED     from = {0};
        from.Offset = (DWORD)place, from.OffsetHigh = (DWORD)(place >> 32);
        const DWORD wanted = (DWORD)(size - got < MAX_BYTES ? size - got : MAX_BYTES);
        DWORD       step = 0;
        if (!ReadFile((HANDLE)file, (char*)into + got, wanted, &step, &from)) {
            if (GetLastError() == ERROR_HANDLE_EOF) break;
            return -1;
        }
        if (step == 0) break;
        got += step;
    }
    return (int64_t)got;
}

DpStatus dp_file_close(DpFile file)
{
    return file == DP_NO_FILE || CloseHandle((HANDLE)file)
               ? DP_OK
               : dp_status_of(GetLastError(), DP_CANNOT_WRITE);
}

DpStatus dp_file_replace(const char* from, const char* to)
{
    WidePath one, other;
    DpStatus status = wide_path(from, &one) && wide_path(to, &other) ? DP_OK : DP_CANNOT_WRITE;
    for (int t = 0; status == DP_OK; ++t) {
        if (MoveFileExW(one.text, other.text, MOVEFILE_REPLACE_EXISTING)) break;
        const DWORD error = GetLastError();
        const DWORD about = GetFileAttributesW(other.text);
        const bool  folder = about != INVALID_FILE_ATTRIBUTES && (about & FILE_ATTRIBUTE_DIRECTORY);
        const bool  held = error == ERROR_ACCESS_DENIED || error == ERROR_SHARING_VIOLATION;
        if (held && !folder && t < TRIES)
            Sleep(PATIENCE);
        else
            status = dp_status_of(error, DP_CANNOT_WRITE);
    }
    return status;
}

void dp_file_remove(const char* path)
{
    WidePath name;
    if (wide_path(path, &name)) DeleteFileW(name.text);
}
