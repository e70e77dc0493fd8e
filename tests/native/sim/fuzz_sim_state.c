// Whatever a state says of a simulation and its ground, it is refused or lived with: checksums are made
// good, since a fuzzer would never get past them. scripts/build --fuzz, then
//   mkdir corpus; build/fuzz/fuzz_sim_state -max_total_time=60 corpus/
#include <stdio.h>
#include <stdlib.h>

#include "base/stream.h"
#include "sim/planted.h"

#define HEAD 24   // bytes before those of a chunk: name, version, size, checksum
#define CHUNKS 2  // of the simulation, and of its ground

int LLVMFuzzerInitialize(int* count, char*** words);
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

static Stride        stride;
static DpStateWriter kept;
static size_t        begin[CHUNKS + 1];

static World open_world(void)
{
    World world;
    if (world_make(&world, NULL, 0.0, 0.0, 0.0, 1.0, 0.05, 1) != DP_OK ||
        dp_sim_load(world.sim, &stride.gait, stride.touching, stride.force, stride.point) != DP_OK)
        abort();
    return world;
}

int LLVMFuzzerInitialize(int* count, char*** words)
{
    stride = stride_make(1, 2, 80.0, 30.0);
    World world = open_world();
    if (dp_sim_run(world.sim, 20) != DP_OK || dp_sim_save_state(world.sim, &kept) != DP_OK) abort();
    world_drop(&world);
    for (int n = 0; n < CHUNKS; ++n) {
        uint64_t size;
        memcpy(&size, kept.bytes + begin[n] + 8, sizeof size);
        begin[n + 1] = begin[n] + HEAD + (size_t)size;
    }
    if (begin[CHUNKS] != kept.size) abort();
    for (int k = 1; k < *count; ++k) {
        if ((*words)[k][0] == '-') continue;
        for (int n = 0; n < CHUNKS; ++n) {
            char path[4096];
            snprintf(path, sizeof path, "%s/chunk%d", (*words)[k], n);
            FILE* file = fopen(path, "wb");
            if (!file) return 1;
            fputc(n, file);
            fwrite(kept.bytes + begin[n] + HEAD, 1, begin[n + 1] - begin[n] - HEAD, file);
            if (fclose(file) != 0) return 1;
        }
        break;  // the first folder is the one that grows
    }
    return 0;
}

// the first byte chooses the chunk that the others are; the other one is whole
int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    if (size < 1) return 0;
    World         world = open_world();
    const size_t  before = dp_bytes_live();
    DpStateWriter stream = {0};
    for (int n = 0; n < CHUNKS; ++n) {
        char name[5] = {0};
        memcpy(name, kept.bytes + begin[n], 4);
        dp_write_chunk(&stream, name, 1);
        if (data[0] % CHUNKS == n)
            dp_write_bytes(&stream, data + 1, size - 1);
        else
            dp_write_bytes(&stream, kept.bytes + begin[n] + HEAD, begin[n + 1] - begin[n] - HEAD);
        dp_write_end(&stream);
    }
    const DpStatus status = dp_sim_load_state(world.sim, stream.bytes, stream.size);
    dp_write_drop(&stream);
    if (status != DP_OK && dp_bytes_live() != before) abort();
    if (status == DP_OK) {  // it goes on, and says how it went
        (void)dp_sim_run(world.sim, stride.gait.times - 1);
        (void)dp_sim_settle(world.sim);
        (void)dp_sim_report(world.sim);
    }
    world_drop(&world);
    return 0;
}
