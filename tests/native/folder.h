// tests/native/folder.h - a folder of a test's own, on every system.
#pragma once
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <direct.h>
#include <process.h>
#define FOLDER_MAKE(path) _mkdir(path)
#define FOLDER_REMOVE(path) _rmdir(path)
#define FOLDER_PROCESS ((long)_getpid())
#else
#include <sys/stat.h>
#include <unistd.h>
#define FOLDER_MAKE(path) mkdir(path, 0700)
#define FOLDER_REMOVE(path) rmdir(path)
#define FOLDER_PROCESS ((long)getpid())
#endif

// Make a folder that was not there, and put its path into `path`; ends the test when it cannot.
static inline void folder_make(char* path, size_t size, const char* name)
{
    const char* top = getenv("TMPDIR") ? getenv("TMPDIR")
                      : getenv("TEMP") ? getenv("TEMP")
                                       : "/tmp";
    for (int turn = 0; turn < 1000; ++turn) {
        const int length =
            snprintf(path, size, "%s/desire_path_%s_%ld_%d", top, name, FOLDER_PROCESS, turn);
        if (length < 0 || (size_t)length >= size) break;
        if (FOLDER_MAKE(path) == 0) return;
    }
    fprintf(stderr, "no folder can be made in %s\n", top);
    abort();
}
