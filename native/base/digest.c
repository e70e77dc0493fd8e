#include "base/digest.h"

#include <string.h>

#include "base/memory.h"

#define BLOCK (DP_DIGEST_WORDS * sizeof(uint64_t))
#define STRETCH ((size_t)1 << 20)

// Every eighth word goes into the same number. Each turn can be undone, so one word that differs is
// never lost; several have to meet by chance.
static void take_in(uint64_t words[DP_DIGEST_WORDS], const unsigned char* block)
{
    uint64_t fresh[DP_DIGEST_WORDS];
    memcpy(fresh, block, BLOCK);
    for (int k = 0; k < DP_DIGEST_WORDS; ++k) {
        const uint64_t sum = words[k] + fresh[k] * 0xc2b2ae3d27d4eb4fu;
        words[k] = (sum << 31 | sum >> 33) * 0x9e3779b97f4a7c15u;
    }
}

void dp_digest(const void* bytes, size_t count, uint64_t words[DP_DIGEST_WORDS])
{
    const unsigned char* at = bytes;
    uint64_t             sum[DP_DIGEST_WORDS];
    for (int k = 0; k < DP_DIGEST_WORDS; ++k) sum[k] = (uint64_t)k + 1;
    while (count >= BLOCK) {
        const size_t stretch = count < STRETCH ? count / BLOCK * BLOCK : STRETCH;
        for (size_t k = 0; k < stretch; k += BLOCK) take_in(sum, at + k);
        at += stretch, count -= stretch;
        dp_memory_ease(stretch);
    }
    unsigned char last[BLOCK] = {0};
    if (count > 0) memcpy(last, at, count);
    take_in(sum, last);
    memcpy(words, sum, sizeof sum);
}
