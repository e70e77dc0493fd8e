#include "base/digest.h"

#include <string.h>

#define BLOCK (DP_DIGEST_WORDS * sizeof(uint64_t))

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
    for (; count >= BLOCK; at += BLOCK, count -= BLOCK) take_in(sum, at);
    unsigned char last[BLOCK] = {0};
    if (count > 0) memcpy(last, at, count);
    take_in(sum, last);
    memcpy(words, sum, sizeof sum);
}
