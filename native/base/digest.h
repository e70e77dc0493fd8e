// base/digest.h - telling bytes from other bytes.
#pragma once
#include <stddef.h>
#include <stdint.h>

#define DP_DIGEST_WORDS 8

// Eight words that differ when any bytes differ, but for one chance in 2^64; not for secrets. The
// count is not part of it: tell it apart yourself. Reads memory about as fast as memory gives it.
void dp_digest(const void* bytes, size_t count, uint64_t words[DP_DIGEST_WORDS]);
