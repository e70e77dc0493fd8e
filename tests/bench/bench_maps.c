// What frames and maps cost on this machine: scripts/bench maps
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "maps/maps.h"
#include "timing.h"

static int compare(const void* a, const void* b)
{
    const double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

static double median(double* value, int count)
{
    qsort(value, (size_t)count, sizeof *value, compare);
    return value[count / 2];
}

// a tile with one print: a deep sole, a rim that falls off, pressure under it, bare ground around
static void print_tile(float* rgba, double shift)
{
    memset(rgba, 0, DP_TILE * DP_TILE * 4 * sizeof *rgba);
    for (int j = 0; j < DP_TILE; ++j) {
        for (int i = 0; i < DP_TILE; ++i) {
            const double x = (i - 32 - shift) / 8.0, y = (j - 32 + 0.3 * shift) / 20.0;
            const double r = sqrt(x * x + y * y);
            float*       at = rgba + (j * DP_TILE + i) * 4;
            const double deep = r < 1.0 ? 0.02 * (1.0 + 0.3 * sin(5.0 * y) * cos(3.0 * x)) : 0.0;
            const double heap = r >= 1.0 && r < 1.6 ? 0.01 * (1.6 - r) : 0.0;
            at[0] = (float)(heap - deep);
            at[1] = 1.0f;
            at[2] = (float)deep;
            at[3] = (float)(deep * 3e5);
        }
    }
}

#define RGBA ((const char* const[]){"R", "G", "B", "A"})

// frames in which two tiles change, after a trail of `trail` tiles, each a new file as in a bake;
// [s] a frame, bytes of the last
static double walk(int tiles, int trail, const char* stem, double* whole, long* size)
{
    enum
    {
        COUNT = 60
    };
    char         path[4200];
    static float rgba[DP_TILE * DP_TILE * 4];
    double       took[COUNT];
    DpFrames*    frames;
    const double start = bench_now();
    if (dp_frames_create(&frames, tiles, tiles, RGBA, 4, NULL, 0) != DP_OK) exit(1);
    for (int k = 0; k < trail; ++k) {
        print_tile(rgba, 0.01 * k);
        dp_frames_set_tile(frames, k % tiles, k / tiles, rgba, 0);
    }
    snprintf(path, sizeof path, "%s.first", stem);
    dp_frames_write(frames, path, 0.0);
    *whole = bench_now() - start;
    unlink(path);
    for (int k = 0; k < COUNT; ++k) {
        print_tile(rgba, 0.1 * k);
        snprintf(path, sizeof path, "%s.%d", stem, k);
        const double from = bench_now();
        dp_frames_set_tile(frames, k % tiles, (k / 4) % tiles, rgba, 0);
        dp_frames_set_tile(frames, (k + 1) % tiles, (k / 4) % tiles, rgba, 0);
        if (dp_frames_write(frames, path, k / 24.0) != DP_OK) exit(1);
        took[k] = bench_now() - from;
    }
    struct stat about;
    *size = stat(path, &about) == 0 ? (long)about.st_size : -1;
    for (int k = 0; k < COUNT; ++k) {
        snprintf(path, sizeof path, "%s.%d", stem, k);
        unlink(path);
    }
    dp_frames_destroy(frames);
    return median(took, COUNT);
}

int main(void)
{
    const char* folder = getenv("TMPDIR");
    char        path[4096];
    snprintf(path, sizeof path, "%s/bench_maps_%ld.exr", folder ? folder : "/tmp", (long)getpid());

    static float rgba[DP_TILE * DP_TILE * 4];
    double       took[100];
    DpFrames*    frames;
    if (dp_frames_create(&frames, 1, 1, RGBA, 4, NULL, 0) != DP_OK) return 1;
    for (int k = 0; k < 100; ++k) {
        print_tile(rgba, 0.1 * k);
        const double from = bench_now();
        dp_frames_set_tile(frames, 0, 0, rgba, 0);
        took[k] = bench_now() - from;
    }
    dp_frames_destroy(frames);
    printf("one tile packed          %8.3f ms\n", 1e3 * median(took, 100));
    bench_keep("maps", "one tile packed", median(took, 100));

    static const int sides[][2] = {{256, 4}, {1024, 4}, {1024, 40}, {1024, 256}};
    for (int s = 0; s < 4; ++s) {
        double       whole;
        long         size;
        const double frame = walk(sides[s][0] / DP_TILE, sides[s][1], path, &whole, &size);
        printf(
            "%4d^2, %3d tiles walked  %8.3f ms a frame of two tiles, %8.3f ms whole, %ld bytes\n",
            sides[s][0], sides[s][1], 1e3 * frame, 1e3 * whole, size);
        char what[64];
        snprintf(what, sizeof what, "%d^2 %d tiles walked: a frame", sides[s][0], sides[s][1]);
        bench_keep("maps", what, frame);
    }

    const int          n = 1024;
    float*             grid = calloc((size_t)n * (size_t)n, sizeof *grid);
    const DpMapChannel channels[] = {
        {"compression", grid}, {"heap", grid}, {"plant_strength", grid}, {"pressure_time", grid}};
    if (!grid) return 1;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double r = fabs((i - 512.0) / 100.0);
            grid[j * n + i] = r < 1.0 ? (float)(0.02 * (1.0 - r * r) * sin(0.05 * j)) : 0.0f;
        }
    double from = bench_now();
    if (dp_maps_write(path, n, n, channels, 4, NULL, 0) != DP_OK) return 1;
    const double wrote = bench_now() - from;
    printf("four maps of 1024^2      %8.3f ms to write", 1e3 * wrote);
    bench_keep("maps", "four maps of 1024^2: write", wrote);
    DpMapFile* map;
    from = bench_now();
    if (dp_maps_read(path, &map) != DP_OK) return 1;
    const double was_read = bench_now() - from;
    printf(", %8.3f ms to read\n", 1e3 * was_read);
    bench_keep("maps", "four maps of 1024^2: read", was_read);
    dp_map_file_destroy(map);
    unlink(path);
    free(grid);
    return 0;
}
