// What must hold of loops: every item once, in any number of hands, within one another, and again.
#include "base/parallel.h"

#include <stdatomic.h>
#include <time.h>

#include "check.h"

#define ITEMS 200

typedef struct Count
{
    atomic_int done[ITEMS], at_once[64], clashes, workers;
} Count;

static void tick(void* context, int index, int worker)
{
    Count* count = context;
    if (worker < 0 || worker >= atomic_load(&count->workers)) atomic_fetch_add(&count->clashes, 1);
    if (atomic_fetch_add(&count->at_once[worker], 1) != 0) atomic_fetch_add(&count->clashes, 1);
    atomic_fetch_add(&count->done[index], 1);
    atomic_fetch_sub(&count->at_once[worker], 1);
}

static int wrong(Count* count, int items, int times)
{
    int bad = atomic_load(&count->clashes);
    for (int n = 0; n < items; ++n) bad += atomic_load(&count->done[n]) != times;
    return bad;
}

TEST(every_item_once_in_any_number_of_hands)
{
    for (int workers = 0; workers <= 9; ++workers)
        for (int items = 0; items <= ITEMS; items += 25) {
            static Count count;
            memset(&count, 0, sizeof count);
            atomic_store(&count.workers, workers < 1 ? 1 : workers);
            dp_parallel_for(items, workers, tick, &count);
            CHECK(wrong(&count, items, 1) == 0);
        }
}

// helpers look out for work and fall asleep: loops follow each other at once, and after a while
TEST(short_loops_again_and_again)
{
    static Count count;
    memset(&count, 0, sizeof count);
    atomic_store(&count.workers, 3);
    for (int n = 0; n < 2000; ++n) {
        const struct timespec nap = {0, n % 3 ? 0 : 30000 * (n % 9)};
        if (n % 50 == 0 && nap.tv_nsec) nanosleep(&nap, NULL);
        dp_parallel_for(5, 3, tick, &count);
    }
    CHECK(wrong(&count, 5, 2000) == 0);
}

static void outer(void* context, int index, int worker)
{
    Count* count = context;
    (void)worker;
    dp_parallel_for(20, 4, tick, &count[index]);
}

TEST(loops_within_loops)
{
    static Count count[8];
    memset(count, 0, sizeof count);
    for (int n = 0; n < 8; ++n) atomic_store(&count[n].workers, 4);
    for (int n = 0; n < 50; ++n) dp_parallel_for(8, 3, outer, count);
    for (int n = 0; n < 8; ++n) CHECK(wrong(&count[n], 20, 50) == 0);
}

int main(void)
{
    RUN(every_item_once_in_any_number_of_hands);
    RUN(short_loops_again_and_again);
    RUN(loops_within_loops);
    return check_done();
}
