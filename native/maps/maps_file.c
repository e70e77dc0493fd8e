// maps/maps_file.c - files that appear whole or not at all, and the bytes they are made of.
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "maps/maps_exr.h"

DpStatus dp_bytes_put(DpBytes* bytes, size_t offset, const void* from, size_t count)
{
    if (offset > SIZE_MAX / 4 || count > SIZE_MAX / 4) return DP_NO_MEMORY;
    const size_t end = offset + count;
    if (!dp_make_room(&bytes->at, end, 1)) return DP_NO_MEMORY;
    if (offset > bytes->size) memset(bytes->at + bytes->size, 0, offset - bytes->size);
    if (count) memcpy(bytes->at + offset, from, count);
    if (end > bytes->size) bytes->size = end;
    return DP_OK;
}

void dp_bytes_free(DpBytes* bytes)
{
    dp_free(bytes->at);
    *bytes = (DpBytes){0};
}

static DpStatus status_of(int error)
{
    return error == ENOSPC || error == EDQUOT ? DP_DISK_FULL : DP_CANNOT_WRITE;
}

static DpStatus write_all(int file, const unsigned char* data, size_t size)
{
    while (size > 0) {
        const size_t  max_bytes = (size_t)1 << 30;
        const ssize_t done = write(file, data, size < max_bytes ? size : max_bytes);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return status_of(errno);
        if (done == 0) return DP_CANNOT_WRITE;
        data += done;
        size -= (size_t)done;
    }
    return DP_OK;
}

DpStatus dp_file_save(const char* path, const void* data, size_t size)
{
    static atomic_uint number;  // two threads may write beside each other
    const size_t       room = strlen(path) + 64;
    char*              part = dp_alloc(room, 1);
    if (!part) return DP_NO_MEMORY;
    snprintf(part, room, "%s.%ld-%u.part", path, (long)getpid(), atomic_fetch_add(&number, 1));

    unlink(part);  // left by a process of the same number that was killed
    const int file = open(part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    DpStatus  status = DP_OK;
    if (file < 0) {
        status = errno == ENOSPC || errno == EDQUOT ? DP_DISK_FULL : DP_CANNOT_OPEN;
    } else {
        status = write_all(file, data, size);
        // some disks only say at the end that they are full
        if (close(file) != 0 && status == DP_OK) status = status_of(errno);
        if (status == DP_OK && rename(part, path) != 0) status = status_of(errno);
        if (status != DP_OK) unlink(part);
    }
    dp_free(part);
    return status;
}

// ---- lists of files ------------------------------------------------------------------------------

#define LONGEST_LINE 1024

int dp_list_open(const char* path)
{
    return open(path, O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
}

DpStatus dp_list_add(int list, const char* path, const void* data, size_t size)
{
    const char* slash = strrchr(path, '/');
    const char* name = slash ? slash + 1 : path;
    uint64_t    words[DP_DIGEST_WORDS];
    dp_digest(data, size, words);
    unsigned char byte[sizeof words];
    memcpy(byte, words, sizeof words);
    char line[LONGEST_LINE];
    int  end = snprintf(line, sizeof line - 2 * sizeof byte - 1, "%s %zu:", name, size);
    if (end < 0 || (size_t)end >= sizeof line - 2 * sizeof byte - 1) return DP_BAD_ARGUMENT;
    for (size_t k = 0; k < sizeof byte; ++k, end += 2)
        snprintf(line + end, sizeof line - (size_t)end, "%02x", byte[k]);
    line[end++] = '\n';
    return write_all(list, (const unsigned char*)line, (size_t)end);
}

void dp_list_close(int list)
{
    if (list >= 0) close(list);
}
