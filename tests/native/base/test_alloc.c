// The allocator counts what it lends; the loop over threads does every item once.
#include "base/alloc.h"

#include <stdatomic.h>
#include <stdint.h>

#include "base/parallel.h"
#include "base/status.h"
#include "check.h"

TEST(counts_what_is_lent)
{
    const size_t before = dp_bytes_live();
    char*        block = dp_alloc(10, 7);
    CHECK(block && dp_bytes_live() == before + 70);
    CHECK((uintptr_t)block % 64 == 0);
    for (int k = 0; k < 70; ++k) CHECK(block[k] == 0);
    block[69] = 5;
    block = dp_realloc(block, 100, 1);
    CHECK(block && block[69] == 5 && block[99] == 0);
    dp_free(block);
    CHECK(dp_bytes_live() == before);
}

TEST(refuses_what_cannot_be)
{
    CHECK(dp_alloc(0, 8) == NULL);
    CHECK(dp_alloc(SIZE_MAX / 2, 8) == NULL);
    dp_alloc_fail_after(1);
    void* first = dp_alloc(1, 1);
    CHECK(first != NULL);
    CHECK(dp_alloc(1, 1) == NULL);
    dp_alloc_fail_after(-1);
    dp_free(first);
    dp_free(NULL);
}

static void mark(void* context, int index, int worker)
{
    atomic_int* count = context;
    (void)worker;
    atomic_fetch_add(&count[index], 1);
}

TEST(every_item_once)
{
    for (int workers = 0; workers < 9; ++workers) {
        atomic_int count[100];
        for (int k = 0; k < 100; ++k) atomic_init(&count[k], 0);
        dp_parallel_for(100, workers, mark, count);
        for (int k = 0; k < 100; ++k) CHECK(atomic_load(&count[k]) == 1);
    }
    dp_parallel_for(0, 4, mark, NULL);
    CHECK(dp_parallel_width() >= 1);
}

TEST(every_status_has_words)
{
    for (int s = DP_OK; s <= DP_BAD_FILE; ++s) CHECK(strlen(dp_status_text((DpStatus)s)) > 5);
}

int main(void)
{
    RUN(counts_what_is_lent);
    RUN(refuses_what_cannot_be);
    RUN(every_item_once);
    RUN(every_status_has_words);
    return check_done();
}
