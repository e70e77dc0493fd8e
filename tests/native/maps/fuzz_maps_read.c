// Any bytes at all are read or refused, without harm: scripts/build --fuzz, then
//   mkdir corpus; build/fuzz/fuzz_maps_read -max_total_time=60 corpus/
// The corpus begins with one small file of every sort.
#include "maps/foreign.h"

int LLVMFuzzerInitialize(int* count, char*** words);
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int LLVMFuzzerInitialize(int* count, char*** words)
{
    for (int k = 1; k < *count; ++k) {
        if ((*words)[k][0] == '-') continue;
        for (int s = 0; s < FOREIGN_SORTS; ++s) {
            char path[4096];
            snprintf(path, sizeof path, "%s/sort_%d.exr", (*words)[k], s);
            if (foreign_write(path, &foreign_sorts[s])) return 1;
        }
        break;  // the first folder is the one that grows
    }
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    char path[64];
    snprintf(path, sizeof path, "/dev/shm/desire_path_fuzz_%ld.exr", (long)getpid());
    FILE* file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0) abort();
    const size_t before = dp_bytes_live();
    DpMapFile*   map = NULL;
    if (dp_maps_read(path, &map) == DP_OK) {
        double sum = 0.0;  // every value is there to be read
        for (size_t k = 0; k < (size_t)map->nx * (size_t)map->ny * (size_t)map->channel_count; ++k)
            sum += (double)map->value[k];
        for (int k = 0; k < map->note_count; ++k)
            sum += (double)strlen(map->note_name[k]) + map->note_number[k];
        if (sum == 1.25e300) abort();  // keep the sum
    } else if (map) {
        abort();
    }
    dp_map_file_destroy(map);
    if (dp_bytes_live() != before) abort();
    unlink(path);
    return 0;
}
