#include "base/stream.h"

#include <string.h>

#include "base/alloc.h"
#include "base/assert.h"
#include "base/digest.h"
#include "base/memory.h"

#define NAME 4
#define HEAD (NAME + 4 + 8 + 8)  // of a chunk: name, version, size, checksum
#define MIN_RUN 4                // fewer equal floats stand among others
#define RUN 0x80000000u          // in the word before floats: one float, so many times
#define MAX_RUN 0x7fffffffu

// ---- numbers as bytes --------------------------------------------------------------------------

static void put_number(unsigned char* to, uint64_t value, int bytes)
{
    for (int k = 0; k < bytes; ++k) to[k] = (unsigned char)(value >> 8 * k);
}

static uint64_t number_at(const unsigned char* from, int bytes)
{
    uint64_t value = 0;
    for (int k = 0; k < bytes; ++k) value |= (uint64_t)from[k] << 8 * k;
    return value;
}

// of a chunk's bytes, its name, version and size
static uint64_t checksum(const unsigned char* head, size_t size)
{
    uint64_t words[DP_DIGEST_WORDS], sum = number_at(head, 8) ^ number_at(head + 8, 8);
    dp_digest(head + HEAD, size, words);
    for (int k = 0; k < DP_DIGEST_WORDS; ++k) {
        sum = (sum ^ words[k]) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    return sum;
}

// ---- writing -----------------------------------------------------------------------------------

void dp_write_drop(DpStateWriter* writer)
{
    dp_free(writer->bytes);
    *writer = (DpStateWriter){.status = writer->status};
}

// room for so many bytes more, which count as written; NULL once something went wrong
static unsigned char* extend(DpStateWriter* writer, size_t count)
{
    if (writer->status != DP_OK) return NULL;
    const bool countable = count < SIZE_MAX / 4 && writer->size < SIZE_MAX / 4;
    if (!countable || !dp_make_room(&writer->bytes, writer->size + count, 1)) {
        writer->status = DP_NO_MEMORY;
        return NULL;
    }
    writer->size += count;
    dp_memory_ease(count);
    return writer->bytes + writer->size - count;
}

void dp_write_chunk(DpStateWriter* writer, const char* name, uint32_t version)
{
    DP_ASSERT(!writer->open && strlen(name) == NAME && version > 0);
    writer->chunk = writer->size, writer->open = true;
    unsigned char* head = extend(writer, HEAD);
    if (!head) return;
    memset(head, 0, HEAD);
    memcpy(head, name, NAME);
    put_number(head + NAME, version, 4);
}

void dp_write_end(DpStateWriter* writer)
{
    DP_ASSERT(writer->open);
    writer->open = false;
    if (writer->status != DP_OK) return;
    unsigned char* head = writer->bytes + writer->chunk;
    const size_t   size = writer->size - writer->chunk - HEAD;
    put_number(head + NAME + 4, size, 8);
    put_number(head + NAME + 12, checksum(head, size), 8);
}

void dp_write_bytes(DpStateWriter* writer, const void* bytes, size_t count)
{
    unsigned char* to = extend(writer, count);
    if (to && count > 0) memcpy(to, bytes, count);
}

void dp_write_u8(DpStateWriter* writer, uint8_t value)
{
    dp_write_bytes(writer, &value, 1);
}

void dp_write_u64(DpStateWriter* writer, uint64_t value)
{
    unsigned char* to = extend(writer, 8);
    if (to) put_number(to, value, 8);
}

void dp_write_i64(DpStateWriter* writer, int64_t value)
{
    dp_write_u64(writer, (uint64_t)value);
}

void dp_write_f64(DpStateWriter* writer, double value)
{
    dp_write_doubles(writer, &value, 1);
}

// `count` numbers of 4 bytes
static void write_words(DpStateWriter* writer, const void* value, size_t count)
{
    unsigned char* to = count < SIZE_MAX / 4 ? extend(writer, 4 * count) : NULL;
    for (size_t k = 0; to && k < count; ++k) {
        uint32_t bits;
        memcpy(&bits, (const char*)value + 4 * k, 4);
        put_number(to + 4 * k, bits, 4);
    }
}

void dp_write_ints(DpStateWriter* writer, const int32_t* value, size_t count)
{
    write_words(writer, value, count);
}

void dp_write_floats(DpStateWriter* writer, const float* value, size_t count)
{
    write_words(writer, value, count);
}

void dp_write_doubles(DpStateWriter* writer, const double* value, size_t count)
{
    unsigned char* to = count < SIZE_MAX / 8 ? extend(writer, 8 * count) : NULL;
    for (size_t k = 0; to && k < count; ++k) {
        uint64_t bits;
        memcpy(&bits, &value[k], 8);
        put_number(to + 8 * k, bits, 8);
    }
}

// how many floats from the first on have its bits
static size_t run_length(const float* value, size_t count)
{
    size_t n = 1;
    while (n < count && memcmp(&value[n], value, sizeof *value) == 0) ++n;
    return n;
}

// a word that says how many floats follow, or how often one does; then they
static void write_run(DpStateWriter* writer, const float* value, size_t count, bool equal)
{
    for (size_t done = 0; done < count;) {
        const size_t   n = count - done < MAX_RUN ? count - done : MAX_RUN;
        const uint32_t head = (uint32_t)n | (equal ? RUN : 0);
        write_words(writer, &head, 1);
        write_words(writer, value + done, equal ? 1 : n);
        done += n;
    }
}

void dp_write_runs(DpStateWriter* writer, const float* value, size_t count)
{
    size_t from = 0;  // of those that stand by themselves
    for (size_t k = 0; k < count;) {
        const size_t n = run_length(value + k, count - k);
        if (n >= MIN_RUN) {
            write_run(writer, value + from, k - from, false);
            write_run(writer, value + k, n, true);
            from = k + n;
        }
        k += n;
    }
    write_run(writer, value + from, count - from, false);
}

// ---- reading -----------------------------------------------------------------------------------

DpStateReader dp_read_open(const void* bytes, size_t size)
{
    return (DpStateReader){.bytes = bytes, .size = size};
}

void dp_read_check(DpStateReader* reader, bool holds)
{
    if (!holds && reader->status == DP_OK) reader->status = DP_BAD_FILE;
}

bool dp_read_is(const DpStateReader* reader, const char* name)
{
    return reader->status == DP_OK && !reader->open && reader->size - reader->at >= HEAD &&
           memcmp(reader->bytes + reader->at, name, NAME) == 0;
}

uint32_t dp_read_chunk(DpStateReader* reader, const char* name, uint32_t newest)
{
    DP_ASSERT(!reader->open && strlen(name) == NAME);
    dp_read_check(reader, dp_read_is(reader, name));
    if (reader->status != DP_OK) return 0;
    const unsigned char* head = reader->bytes + reader->at;
    const uint64_t       version = number_at(head + NAME, 4), size = number_at(head + NAME + 4, 8);
    dp_read_check(reader, version >= 1 && version <= newest &&
                              size <= reader->size - reader->at - HEAD &&
                              number_at(head + NAME + 12, 8) == checksum(head, (size_t)size));
    if (reader->status != DP_OK) return 0;
    reader->at += HEAD, reader->end = reader->at + (size_t)size, reader->open = true;
    return (uint32_t)version;
}

void dp_read_end(DpStateReader* reader)
{
    dp_read_check(reader, reader->open && reader->at == reader->end);
    reader->open = false;
}

// the next `count` bytes of the open chunk; NULL once something went wrong
static const unsigned char* take(DpStateReader* reader, size_t count)
{
    dp_read_check(reader, reader->open && count <= reader->end - reader->at);
    if (reader->status != DP_OK) return NULL;
    reader->at += count;
    dp_memory_ease(count);
    return reader->bytes + reader->at - count;
}

void dp_read_bytes(DpStateReader* reader, void* bytes, size_t count)
{
    const unsigned char* from = take(reader, count);
    if (count == 0) return;
    if (from)
        memcpy(bytes, from, count);
    else
        memset(bytes, 0, count);
}

uint8_t dp_read_u8(DpStateReader* reader)
{
    uint8_t value;
    dp_read_bytes(reader, &value, 1);
    return value;
}

uint64_t dp_read_u64(DpStateReader* reader)
{
    const unsigned char* from = take(reader, 8);
    return from ? number_at(from, 8) : 0;
}

int64_t dp_read_i64(DpStateReader* reader)
{
    const uint64_t bits = dp_read_u64(reader);
    int64_t        value;
    memcpy(&value, &bits, 8);
    return value;
}

double dp_read_f64(DpStateReader* reader)
{
    double value;
    dp_read_doubles(reader, &value, 1);
    return value;
}

// `count` numbers of 4 bytes
static void read_words(DpStateReader* reader, void* value, size_t count)
{
    const unsigned char* from = take(reader, count < SIZE_MAX / 4 ? 4 * count : SIZE_MAX);
    for (size_t k = 0; k < count; ++k) {
        const uint32_t bits = from ? (uint32_t)number_at(from + 4 * k, 4) : 0;
        memcpy((char*)value + 4 * k, &bits, 4);
    }
}

void dp_read_ints(DpStateReader* reader, int32_t* value, size_t count)
{
    read_words(reader, value, count);
}

void dp_read_floats(DpStateReader* reader, float* value, size_t count)
{
    read_words(reader, value, count);
}

void dp_read_doubles(DpStateReader* reader, double* value, size_t count)
{
    const unsigned char* from = take(reader, count < SIZE_MAX / 8 ? 8 * count : SIZE_MAX);
    for (size_t k = 0; k < count; ++k) {
        const uint64_t bits = from ? number_at(from + 8 * k, 8) : 0;
        memcpy(&value[k], &bits, 8);
    }
}

void dp_read_runs(DpStateReader* reader, float* value, size_t count)
{
    size_t done = 0;
    while (done < count && reader->status == DP_OK) {
        uint32_t head;
        read_words(reader, &head, 1);
        const size_t n = head & MAX_RUN;
        dp_read_check(reader, n > 0 && n <= count - done);
        if (reader->status != DP_OK) break;
        read_words(reader, value + done, head & RUN ? 1 : n);
        for (size_t k = 1; head & RUN && k < n; ++k) value[done + k] = value[done];
        done += n;
    }
    for (; reader->status != DP_OK && done < count; ++done) value[done] = 0.0f;
}

int64_t dp_read_int(DpStateReader* reader, int64_t low, int64_t high)
{
    const int64_t value = dp_read_i64(reader);
    const bool    holds = value >= low && value <= high;
    dp_read_check(reader, holds);
    return holds ? value : low;
}

double dp_read_number(DpStateReader* reader, double low, double high)
{
    const double value = dp_read_f64(reader);
    const bool   holds = value >= low && value <= high;
    dp_read_check(reader, holds);
    return holds ? value : low;
}

size_t dp_read_count(DpStateReader* reader, size_t max_count, size_t each)
{
    const uint64_t count = dp_read_u64(reader);
    const size_t   left = reader->open ? reader->end - reader->at : 0;
    dp_read_check(reader, count <= max_count && count <= left / each);
    return reader->status == DP_OK ? (size_t)count : 0;
}
