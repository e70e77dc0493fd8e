// base/os_files_posix.c - files of Linux and macOS.
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/os.h"

#define MAX_BYTES ((size_t)1 << 30)  // of one call

static DpStatus status_of(int error, DpStatus otherwise)
{
    return error == ENOSPC || error == EDQUOT ? DP_DISK_FULL : otherwise;
}

const char* dp_os_name(const char* path)
{
    const char* slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

long dp_os_process(void)
{
    return (long)getpid();
}

DpStatus dp_file_create(const char* path, DpFile* file)
{
    unlink(path);
    *file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return *file < 0 ? status_of(errno, DP_CANNOT_OPEN) : DP_OK;
}

DpStatus dp_file_append(const char* path, DpFile* file)
{
    *file = open(path, O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
    return *file < 0 ? DP_CANNOT_OPEN : DP_OK;
}

DpStatus dp_file_open(const char* path, DpFile* file, int64_t* size)
{
    *file = DP_NO_FILE;
    const int number = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (number < 0) return DP_CANNOT_OPEN;
    struct stat about;
    DpStatus    status = fstat(number, &about) == 0 ? DP_OK : DP_CANNOT_OPEN;
    if (status == DP_OK && !S_ISREG(about.st_mode)) status = DP_BAD_FILE;
    if (status != DP_OK) {
        close(number);
        return status;
    }
    *file = number;
    *size = (int64_t)about.st_size;
    return DP_OK;
}

DpStatus dp_file_write(DpFile file, const void* data, size_t size)
{
    const unsigned char* at = data;
    while (size > 0) {
        const ssize_t done = write((int)file, at, size < MAX_BYTES ? size : MAX_BYTES);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return status_of(errno, DP_CANNOT_WRITE);
        if (done == 0) return DP_CANNOT_WRITE;
        at += done;
        size -= (size_t)done;
    }
    return DP_OK;
}

int64_t dp_file_read(DpFile file, void* into, size_t size, int64_t offset)
{
    size_t got = 0;
    while (got < size) {
        const size_t  wanted = size - got < MAX_BYTES ? size - got : MAX_BYTES;
        const ssize_t step =
            pread((int)file, (char*)into + got, wanted, (off_t)offset + (off_t)got);
        if (step < 0 && errno == EINTR) continue;
        if (step < 0) return -1;
        if (step == 0) break;
        got += (size_t)step;
    }
    return (int64_t)got;
}

DpStatus dp_file_close(DpFile file)
{
    return file < 0 || close((int)file) == 0 ? DP_OK : status_of(errno, DP_CANNOT_WRITE);
}

DpStatus dp_file_replace(const char* from, const char* to)
{
    return rename(from, to) == 0 ? DP_OK : status_of(errno, DP_CANNOT_WRITE);
}

void dp_file_remove(const char* path)
{
    unlink(path);
}
