#include "base/stream.h"

#include "check.h"

static const float  floats[3] = {-0.0f, 1.5e-40f, INFINITY};
static const double doubles[2] = {1.0 / 3.0, -1e300};
static const int    ints[2] = {INT32_MIN, 7};

// two chunks with one of everything
static void write_all(DpStateWriter* writer)
{
    dp_write_chunk(writer, "ones", 3);
    dp_write_u8(writer, 200);
    dp_write_u64(writer, 0x0123456789abcdefu);
    dp_write_i64(writer, -5);
    dp_write_f64(writer, 0.1);
    dp_write_end(writer);
    dp_write_chunk(writer, "many", 1);
    dp_write_u64(writer, 3);
    dp_write_floats(writer, floats, 3);
    dp_write_doubles(writer, doubles, 2);
    dp_write_ints(writer, ints, 2);
    dp_write_bytes(writer, "abc", 3);
    dp_write_end(writer);
}

static DpStatus read_all(const void* bytes, size_t size, bool look)
{
    DpStateReader  reader = dp_read_open(bytes, size);
    float          f[3];
    double         d[2];
    int32_t        n[2];
    char           text[3];
    const uint32_t version = dp_read_chunk(&reader, "ones", 4);
    const uint8_t  small = dp_read_u8(&reader);
    const uint64_t large = dp_read_u64(&reader);
    const int64_t  below = dp_read_int(&reader, -5, -5);
    const double   tenth = dp_read_number(&reader, 0.0, 1.0);
    dp_read_end(&reader);
    dp_read_chunk(&reader, "many", 1);
    const size_t count = dp_read_count(&reader, 3, 4);
    dp_read_floats(&reader, f, 3);
    dp_read_doubles(&reader, d, 2);
    dp_read_ints(&reader, n, 2);
    dp_read_bytes(&reader, text, 3);
    dp_read_end(&reader);
    if (reader.status == DP_OK && look) {
        CHECK(version == 3 && small == 200 && large == 0x0123456789abcdefu && below == -5);
        CHECK(tenth == 0.1 && count == 3 && reader.at == size);
        CHECK(memcmp(f, floats, sizeof f) == 0 && memcmp(d, doubles, sizeof d) == 0);
        CHECK(memcmp(n, ints, sizeof n) == 0 && memcmp(text, "abc", 3) == 0);
    }
    return reader.status;
}

TEST(reads_what_was_written)
{
    DpStateWriter writer = {0};
    write_all(&writer);
    CHECK(writer.status == DP_OK && read_all(writer.bytes, writer.size, true) == DP_OK);
    // low bytes first, on any machine
    CHECK(memcmp(writer.bytes, "ones\3\0\0\0\31\0\0\0", 12) == 0);
    CHECK(writer.bytes[24] == 200 && writer.bytes[25] == 0xef && writer.bytes[32] == 0x01);
    dp_write_drop(&writer);
}

TEST(refuses_what_is_damaged)
{
    DpStateWriter writer = {0};
    write_all(&writer);
    for (size_t size = 0; size < writer.size; ++size) {
        unsigned char* cut = malloc(size + 1);  // of its own, so that reading beyond is seen
        memcpy(cut, writer.bytes, size);
        CHECK(read_all(cut, size, false) == DP_BAD_FILE);
        free(cut);
    }
    for (size_t bit = 0; bit < 8 * writer.size; ++bit) {
        writer.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        CHECK(read_all(writer.bytes, writer.size, false) == DP_BAD_FILE);
        writer.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    dp_write_drop(&writer);
}

// chunks in the wrong order, too new, read too far or not to the end
TEST(refuses_what_is_not_asked_for)
{
    DpStateWriter writer = {0};
    write_all(&writer);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_read_is(&reader, "ones") && !dp_read_is(&reader, "many"));
    CHECK(dp_read_chunk(&reader, "many", 1) == 0 && reader.status == DP_BAD_FILE);
    reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_read_chunk(&reader, "ones", 2) == 0 && reader.status == DP_BAD_FILE);
    reader = dp_read_open(writer.bytes, writer.size);
    CHECK(dp_read_chunk(&reader, "ones", 3) == 3);
    dp_read_end(&reader);
    CHECK(reader.status == DP_BAD_FILE && dp_read_u64(&reader) == 0);
    reader = dp_read_open(writer.bytes, writer.size);
    float far[16] = {1.0f};
    dp_read_chunk(&reader, "ones", 3);
    dp_read_floats(&reader, far, 16);  // the chunk after it is none of its business
    CHECK(reader.status == DP_BAD_FILE && far[0] == 0.0f && far[15] == 0.0f);
    dp_write_drop(&writer);
    reader = dp_read_open(NULL, 0);
    CHECK(!dp_read_is(&reader, "ones") && dp_read_chunk(&reader, "ones", 1) == 0);
}

TEST(numbers_keep_to_their_range)
{
    DpStateWriter writer = {0};
    dp_write_chunk(&writer, "nums", 1);
    dp_write_f64(&writer, (double)NAN);
    dp_write_i64(&writer, 11);
    dp_write_u64(&writer, UINT64_MAX);
    dp_write_end(&writer);
    DpStateReader reader = dp_read_open(writer.bytes, writer.size);
    dp_read_chunk(&reader, "nums", 1);
    CHECK(dp_read_number(&reader, 2.0, 3.0) == 2.0 && reader.status == DP_BAD_FILE);
    reader.status = DP_OK;
    CHECK(dp_read_int(&reader, 1, 10) == 1 && reader.status == DP_BAD_FILE);
    reader.status = DP_OK;
    CHECK(dp_read_count(&reader, SIZE_MAX, 1) == 0 && reader.status == DP_BAD_FILE);
    dp_write_drop(&writer);
}

// 1 1 1 1 1, 2, 3 3, 0 .. 0 -0: two runs, and what is between and after them
TEST(runs_take_little)
{
    float value[1000] = {1, 1, 1, 1, 1, 2, 3, 3}, read[1000];
    value[999] = -0.0f;
    for (size_t count = 0; count <= 1000; count += count < 12 ? 1 : 988) {
        DpStateWriter writer = {0};
        dp_write_chunk(&writer, "runs", 1);
        dp_write_runs(&writer, value, count);
        dp_write_end(&writer);
        CHECK(writer.size <= 24 + 4 * (2 + 4 + 2 + 2));
        DpStateReader reader = dp_read_open(writer.bytes, writer.size);
        dp_read_chunk(&reader, "runs", 1);
        dp_read_runs(&reader, read, count);
        dp_read_end(&reader);
        CHECK(reader.status == DP_OK && memcmp(read, value, count * sizeof *read) == 0);
        reader = dp_read_open(writer.bytes, writer.size);
        dp_read_chunk(&reader, "runs", 1);
        if (count > 0) dp_read_runs(&reader, read, count - 1);  // fewer than there are
        dp_read_end(&reader);
        CHECK(count == 0 || reader.status == DP_BAD_FILE);
        dp_write_drop(&writer);
    }
}

TEST(without_memory_it_says_so)
{
    for (long left = 0; left < 2; ++left) {
        DpStateWriter writer = {0};
        dp_alloc_fail_after(left);
        write_all(&writer);
        for (int k = 0; k < 1000; ++k) dp_write_u64(&writer, 1);
        dp_alloc_fail_after(-1);
        CHECK(writer.status == DP_NO_MEMORY);
        dp_write_drop(&writer);
        CHECK(writer.status == DP_NO_MEMORY && !writer.bytes);
    }
}

int main(void)
{
    RUN(reads_what_was_written);
    RUN(refuses_what_is_damaged);
    RUN(refuses_what_is_not_asked_for);
    RUN(numbers_keep_to_their_range);
    RUN(runs_take_little);
    RUN(without_memory_it_says_so);
    return check_done();
}
