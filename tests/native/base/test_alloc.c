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

TEST(arrays_grow_and_keep_what_they_hold)
{
    int*         array = NULL;
    const size_t live = dp_bytes_live();
    CHECK(dp_make_room(&array, 0, sizeof *array) && !array);
    int moves = 0;
    for (int n = 0; n < 1000; ++n) {
        const int* was = array;
        CHECK(dp_make_room(&array, (size_t)n + 1, sizeof *array));
        moves += array != was;
        CHECK(array[n] == 0);  // what is new is zero
        array[n] = n;
    }
    for (int n = 0; n < 1000; ++n) CHECK(array[n] == n);
    CHECK(moves > 5 && moves < 30);
    const int* was = array;
    CHECK(dp_make_room(&array, 10, sizeof *array) && array == was);  // it never shrinks
    CHECK(dp_bytes_live() - live >= 4000 && dp_bytes_live() - live <= 6000);
    CHECK(dp_make_room(&array, 400, 10) && array == was);  // bytes count, not items
    dp_alloc_fail_after(0);
    CHECK(!dp_make_room(&array, 5000, sizeof *array) && array == was && array[999] == 999);
    dp_alloc_fail_after(-1);
    CHECK(!dp_make_room(&array, SIZE_MAX / 2, 8) && !dp_make_room(&array, SIZE_MAX, 1));
    CHECK(array == was);
    dp_free(array);
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
    for (int s = DP_OK; s <= DP_BAD_PACKING; ++s) CHECK(strlen(dp_status_text((DpStatus)s)) > 5);
}

int main(void)
{
    RUN(counts_what_is_lent);
    RUN(refuses_what_cannot_be);
    RUN(arrays_grow_and_keep_what_they_hold);
    RUN(every_item_once);
    RUN(every_status_has_words);
    return check_done();
}
