// Bytes that differ have digests that differ.
#include "base/digest.h"

#include <stdbool.h>
#include <string.h>

#include "check.h"

#define COUNT 200

static bool differs(const unsigned char* a, const unsigned char* b, size_t count)
{
    uint64_t one[DP_DIGEST_WORDS], two[DP_DIGEST_WORDS];
    dp_digest(a, count, one);
    dp_digest(b, count, two);
    return memcmp(one, two, sizeof one) != 0;
}

TEST(every_bit_counts)
{
    unsigned char bytes[COUNT], other[COUNT];
    for (int k = 0; k < COUNT; ++k) bytes[k] = (unsigned char)(k * k);
    memcpy(other, bytes, COUNT);
    CHECK(!differs(bytes, other, COUNT));
    for (int bit = 0; bit < 8 * COUNT; ++bit) {
        other[bit / 8] = (unsigned char)(other[bit / 8] ^ (1 << bit % 8));
        CHECK(differs(bytes, other, COUNT));
        other[bit / 8] = bytes[bit / 8];
    }
}

TEST(places_count)
{
    double a[20] = {0}, b[20] = {0};
    a[3] = b[11] = -1.0;  // the same numbers elsewhere
    CHECK(differs((const unsigned char*)a, (const unsigned char*)b, sizeof a));
    memset(a, 0, sizeof a), memset(b, 0, sizeof b);
    a[3] = -0.0, b[11] = -0.0;
    CHECK(differs((const unsigned char*)a, (const unsigned char*)b, sizeof a));
    float c[40] = {0}, d[40] = {0};
    d[7] = -0.0f, d[22] = d[23] = -0.0f;  // signs only
    CHECK(differs((const unsigned char*)c, (const unsigned char*)d, sizeof c));
}

int main(void)
{
    RUN(every_bit_counts);
    RUN(places_count);
    return check_done();
}
