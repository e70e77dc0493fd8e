// maps/maps_file.c - files that appear whole or not at all, and the bytes they are made of.
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "base/memory.h"
#include "base/os.h"
#include "maps/maps_exr.h"

#define STRETCH ((size_t)1 << 20)  // of a file, written at once [bytes]

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

DpStatus dp_file_save(const char* path, const void* data, size_t size)
{
    static atomic_uint number;  // two threads may write beside each other
    const size_t       room = strlen(path) + 64;
    char*              part = dp_alloc(room, 1);
    if (!part) return DP_NO_MEMORY;
    snprintf(part, room, "%s.%ld-%u.part", path, dp_os_process(), atomic_fetch_add(&number, 1));

    DpFile   file;
    DpStatus status = dp_file_create(part, &file);
    if (status == DP_OK) {
        for (size_t done = 0; status == DP_OK && done < size; done += STRETCH) {
            const size_t left = size - done;
            status = dp_file_write(file, (const char*)data + done, left < STRETCH ? left : STRETCH);
            dp_memory_ease(STRETCH);
        }
        const DpStatus closed = dp_file_close(file);
        if (status == DP_OK) status = closed;
        if (status == DP_OK) status = dp_file_replace(part, path);
        if (status != DP_OK) dp_file_remove(part);
    }
    dp_free(part);
    return status;
}

// ---- lists of files ------------------------------------------------------------------------------

#define LONGEST_LINE 1024

DpStatus dp_list_add(const char* list, const char* path, const void* data, size_t size)
{
    const char* name = dp_os_name(path);
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
    DpFile   file;
    DpStatus status = dp_file_append(list, &file);
    if (status != DP_OK) return status;
    status = dp_file_write(file, line, (size_t)end);
    const DpStatus closed = dp_file_close(file);
    return status == DP_OK ? closed : status;
}
