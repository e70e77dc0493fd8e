// Whatever a state says of plants, grass and laid stems, it is refused or lived with: checksums are
// made good, since a fuzzer would never get past them. scripts/build --fuzz, then
//   mkdir corpus; build/fuzz/fuzz_grass_load -max_total_time=60 corpus/
#include "bed.h"

#define HEAD 24  // bytes before those of a chunk

int LLVMFuzzerInitialize(int* count, char*** words);
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

static Bed           bed;
static DpStateWriter kept[3];  // plants, grass, laid stems
static const char*   names[3] = {"plnt", "gras", "laid"};

int LLVMFuzzerInitialize(int* count, char*** words)
{
    bed = bed_create();
    bed_walk(&bed, 0, 3);
    dp_plants_save(bed.plants, &kept[0]);
    dp_grass_save(bed.grass, &kept[1]);
    dp_plant_display_save(bed.display, &kept[2]);
    bed_destroy(&bed);
    for (int k = 1; k < *count; ++k) {
        if ((*words)[k][0] == '-') continue;
        for (int n = 0; n < 3; ++n) {
            char path[4096];
            snprintf(path, sizeof path, "%s/%s", (*words)[k], names[n]);
            FILE* file = fopen(path, "wb");
            if (!file) return 1;
            fputc(n, file);
            fwrite(kept[n].bytes + HEAD, 1, kept[n].size - HEAD, file);
            if (fclose(file) != 0) return 1;
        }
        break;  // the first folder is the one that grows
    }
    return 0;
}

// the first byte chooses the chunk that the others are; the two others are whole
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    if (size < 1) return 0;
    const size_t  before = dp_bytes_live();
    DpStateWriter stream = {0};
    for (int n = 0; n < 3; ++n) {
        const bool own = data[0] % 3 == n;
        dp_write_chunk(&stream, names[n], 1);
        if (own)
            dp_write_bytes(&stream, data + 1, size - 1);
        else
            dp_write_bytes(&stream, kept[n].bytes + HEAD, kept[n].size - HEAD);
        dp_write_end(&stream);
    }
    bed = bed_create();
    const DpStatus status = bed_load(&bed, stream.bytes, stream.size);
    if (status == DP_OK) bed_walk(&bed, 3, 5);
    if (status != DP_OK && status != DP_BAD_FILE && status != DP_NO_MEMORY) abort();
    dp_write_drop(&stream);
    bed_destroy(&bed);
    if (dp_bytes_live() != before || check_bad) abort();
    return 0;
}
