// tests of memory.c: blocks keep to a limit, and what they hold
#include "base/memory.h"

#include <stdatomic.h>

#ifndef _WIN32
#include <signal.h>
#include <sys/resource.h>
#endif

#include "base/os.h"
#include "base/parallel.h"
#include "check.h"
#include "folder.h"

#define MIB ((size_t)1 << 20)
#define ROOM (12 * MIB)  // beside what the test takes before
#define BLOCKS 64
#define SIZE (MIB + 4321)

static char folder[300], place[400];

static size_t hold(void)
{
    const size_t limit = dp_os_resident() + ROOM;
    CHECK(dp_memory_hold(place, limit) == DP_OK);
    return limit;
}

static void check_limit(size_t limit)
{
    CHECK(dp_os_resident() <= limit + limit / 10);
}

static void fill(unsigned char* block, size_t size, unsigned seed)
{
    for (size_t k = 0; k < size; ++k) {
        if (k % 4096 == 0) dp_memory_ease(4096);
        block[k] = (unsigned char)(k * 31 + seed);
    }
}

static int is_filled(const unsigned char* block, size_t size, unsigned seed)
{
    for (size_t k = 0; k < size; ++k) {
        if (k % 4096 == 0) dp_memory_ease(4096);
        if (block[k] != (unsigned char)(k * 31 + seed)) return 0;
    }
    return 1;
}

TEST(blocks_leave_and_come_back_as_they_were)
{
    unsigned char* block[BLOCKS];
    const size_t   limit = hold();
    for (unsigned b = 0; b < BLOCKS; ++b) {
        block[b] = dp_alloc(SIZE, 1);
        if (block[b]) fill(block[b], SIZE, b);
        check_limit(limit);
    }
    CHECK(dp_memory_needs() > 0 && dp_memory_needs() < limit);
    for (unsigned b = 0; b < BLOCKS; ++b) {
        CHECK(block[b] && is_filled(block[b], SIZE, b));
        check_limit(limit);
    }
    block[3] = dp_realloc(block[3], 3 * SIZE, 1);
    CHECK(is_filled(block[3], SIZE, 3) && block[3][SIZE] == 0 && block[3][3 * SIZE - 1] == 0);
    for (unsigned b = 0; b < BLOCKS / 2; ++b) dp_free(block[b]);
    dp_memory_release();  // the others stay where they are
    for (unsigned b = BLOCKS / 2; b < BLOCKS; ++b) {
        CHECK(is_filled(block[b], SIZE, b));
        dp_free(block[b]);
    }
}

TEST(memory_that_is_taken_again_is_zero)
{
    hold();
    for (int turn = 0; turn < 3; ++turn)
        for (size_t size = DP_HELD_LEAST; size < 200000; size = size * 5 / 3) {
            unsigned char* block = dp_alloc(size, 1);
            size_t         more = 0;
            for (size_t k = 0; k < size; ++k) more += block[k] != 0;
            CHECK(more == 0 && (size_t)block % 64 == 0);
            memset(block, 0xff, size);
            dp_free(block);
        }
    dp_memory_release();
}

static unsigned char* shared[BLOCKS];

static void work(void* context, int index, int worker)
{
    atomic_int* bad = context;
    (void)worker;
    for (unsigned turn = 0; turn < 4; ++turn) {
        fill(shared[index], SIZE / 4, (unsigned)index + turn);
        if (!is_filled(shared[index], SIZE / 4, (unsigned)index + turn)) atomic_store(bad, 1);
    }
}

TEST(threads_go_on_while_pages_leave)
{
    const size_t limit = hold();
    atomic_int   bad = 0;
    for (int b = 0; b < BLOCKS; ++b) shared[b] = dp_alloc(SIZE / 4, 1);
    dp_parallel_for(BLOCKS, 4, work, &bad);
    CHECK(atomic_load(&bad) == 0 && dp_memory_needs() > 0);
    check_limit(limit);
    for (int b = 0; b < BLOCKS; ++b) dp_free(shared[b]);
    dp_memory_release();
}

TEST(the_smaller_of_two_limits_counts)
{
    CHECK(dp_memory_hold(place, 1024 * MIB) == DP_OK);
    const size_t   limit = hold();
    unsigned char* block = dp_alloc(4 * ROOM, 1);
    check_limit(limit);
    dp_memory_release();
    unsigned char* another = dp_alloc(4 * ROOM, 1);  // it counts to the end of all
    check_limit(limit);
    dp_free(block), dp_free(another);
    dp_memory_release();
    block = dp_alloc(4 * ROOM, 1);
    CHECK(dp_os_resident() > limit + ROOM);
    dp_free(block);
}

TEST(the_file_has_no_name)
{
    hold();
    FILE* there = fopen(place, "rb");
    CHECK(!there);
    if (there) fclose(there);
    dp_memory_release();
}

TEST(what_cannot_be_held_is_told)
{
    char nowhere[500];
    snprintf(nowhere, sizeof nowhere, "%s/none/file", folder);
    CHECK(dp_memory_hold(nowhere, 1024 * MIB) == DP_CANNOT_OPEN);
    CHECK(dp_memory_hold(place, 0) == DP_BAD_ARGUMENT);
    CHECK(dp_memory_hold(NULL, MIB) == DP_BAD_ARGUMENT);
    unsigned char* block = dp_alloc(4 * ROOM, 1);  // nothing is held
    CHECK(block != NULL);
    dp_free(block);
}

#ifndef _WIN32
TEST(a_full_disk_is_told)
{
    struct rlimit was, less;
    getrlimit(RLIMIT_FSIZE, &was);
    less = was, less.rlim_cur = 8 * MIB;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &less);
    hold();
    unsigned char* small = dp_alloc(MIB, 1);
    CHECK(small != NULL && dp_memory_trouble() == DP_OK);
    CHECK(dp_alloc(32 * MIB, 1) == NULL && dp_memory_trouble() == DP_DISK_FULL);
    CHECK(dp_memory_trouble() == DP_OK);
    setrlimit(RLIMIT_FSIZE, &was);
    unsigned char* large = dp_alloc(32 * MIB, 1);
    CHECK(large != NULL);
    dp_free(small), dp_free(large);
    dp_memory_release();
}
#endif

int main(void)
{
    folder_make(folder, sizeof folder, "memory");
    snprintf(place, sizeof place, "%s/pages", folder);
    RUN(blocks_leave_and_come_back_as_they_were);
    RUN(memory_that_is_taken_again_is_zero);
    RUN(threads_go_on_while_pages_leave);
    RUN(the_smaller_of_two_limits_counts);
    RUN(the_file_has_no_name);
    RUN(what_cannot_be_held_is_told);
#ifndef _WIN32
    RUN(a_full_disk_is_told);
#endif
    FOLDER_REMOVE(folder);
    return check_done();
}
