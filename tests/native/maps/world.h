// tests/native/maps/world.h - what the tests of this room share: a folder of their own, grids with
// awkward numbers, bytes of files.
#pragma once
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "folder.h"
#include "maps/maps.h"

#define RGBA ((const char* const[]){"R", "G", "B", "A"})  // as frames have them

static char world_folder[512];

static inline const char* world_path(const char* name)
{
    static char path[4][640];
    static int  turn;
    if (!*world_folder) folder_make(world_folder, sizeof world_folder, "maps");
    char* out = path[turn++ % 4];
    snprintf(out, sizeof path[0], "%s/%s", world_folder, name);
    return out;
}

static inline void world_end(void)
{
    if (*world_folder) FOLDER_REMOVE(world_folder);
}

// numbers of every kind: smooth, zero, tiny, huge, negative zero, infinite, not a number
static inline float world_value(int i, int j, int c, unsigned seed)
{
    unsigned state = (unsigned)i * 73856093u ^ (unsigned)j * 19349663u ^ (unsigned)c * 83492791u ^
                     seed * 2654435761u;
    const double u = check_random(&state);
    if (u < 0.4) return 0.0f;
    if (u < 0.41) return -0.0f;
    if (u < 0.42) return INFINITY;
    if (u < 0.43) return NAN;
    if (u < 0.44) return 1e-42f;
    if (u < 0.45) return -3e38f;
    return (float)(0.01 * sin(0.1 * i) * cos(0.13 * j) + 1e-4 * u);
}

static inline size_t world_bytes(const char* path, unsigned char* into, size_t most)
{
    FILE* file = fopen(path, "rb");
    if (!file) return 0;
    const size_t size = fread(into, 1, most, file);
    fclose(file);
    return size;
}

static inline void world_put(const char* path, const void* data, size_t size)
{
    FILE* file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file)) abort();
}
