// tests of os_posix.c and os_windows.c: threads, time and memory are the same on every system
#include "base/os.h"

#include <stdatomic.h>

#include "check.h"

static atomic_int sum;
static DpLock     lock = DP_LOCK_READY;
static DpSignal   changed = DP_SIGNAL_READY;
static int        arrived;

static void arrive(void* context)
{
    atomic_fetch_add(&sum, *(int*)context);
    dp_lock_take(&lock);
    ++arrived;
    dp_signal_all(&changed);
    dp_lock_give(&lock);
}

TEST(threads_start_meet_and_end)
{
    DpThread thread[4];
    int      number[4] = {1, 20, 300, 4000};
    for (int k = 0; k < 4; ++k) CHECK(dp_thread_start(&thread[k], arrive, &number[k]));
    dp_lock_take(&lock);
    while (arrived < 4) dp_signal_wait(&changed, &lock);
    dp_lock_give(&lock);
    for (int k = 0; k < 4; ++k) dp_thread_join(&thread[k]);
    CHECK(atomic_load(&sum) == 4321);
}

static DpLock ours;
static int    inside, most, turns;

static void take_turns(void* context)
{
    (void)context;
    for (int k = 0; k < 200; ++k) {
        dp_lock_take(&ours);
        ++inside;
        most = inside > most ? inside : most;
        ++turns;
        --inside;
        dp_lock_give(&ours);
    }
}

TEST(a_lock_lets_one_in_at_a_time)
{
    DpThread thread[4];
    dp_lock_create(&ours);
    for (int k = 0; k < 4; ++k) CHECK(dp_thread_start(&thread[k], take_turns, NULL));
    for (int k = 0; k < 4; ++k) dp_thread_join(&thread[k]);
    CHECK(most == 1 && turns == 800);
    dp_lock_destroy(&ours);
}

static DpLock   gate;
static DpSignal opened, passed;
static int      may_pass, have_passed, waiting;

static void wait_for_turn(void* context)
{
    (void)context;
    dp_lock_take(&gate);
    ++waiting;
    dp_signal_all(&passed);
    while (may_pass == 0) dp_signal_wait(&opened, &gate);
    --may_pass, ++have_passed;
    dp_signal_all(&passed);
    dp_lock_give(&gate);
}

// who sleeps has given the lock; a signal wakes one, or all
TEST(signals_wake_who_sleeps)
{
    DpThread thread[3];
    dp_lock_create(&gate), dp_signal_create(&opened), dp_signal_create(&passed);
    for (int k = 0; k < 3; ++k) {
        CHECK(dp_thread_start(&thread[k], wait_for_turn, NULL));
        if (k == 2) dp_thread_leave(&thread[k]);
    }
    dp_lock_take(&gate);
    while (waiting < 3) dp_signal_wait(&passed, &gate);
    may_pass = 1;
    dp_signal_one(&opened);
    while (have_passed < 1) dp_signal_wait(&passed, &gate);
    CHECK(have_passed == 1 && may_pass == 0);
    may_pass = 2;
    dp_signal_all(&opened);
    while (have_passed < 3) dp_signal_wait(&passed, &gate);
    dp_lock_give(&gate);
    for (int k = 0; k < 2; ++k) dp_thread_join(&thread[k]);
}

TEST(time_and_memory)
{
    const int64_t start = dp_os_time();
    int64_t       last = start;
    for (int k = 0; k < 1000; ++k) {
        const int64_t now = dp_os_time();
        CHECK(now >= last);
        last = now;
    }
    CHECK(dp_os_processors() >= 1);
    for (size_t even = 16; even <= 4096; even *= 4) {
        char* memory = dp_os_memory(even, 2 * even);
        CHECK(memory && (uintptr_t)memory % even == 0);
        if (memory) memset(memory, 7, 2 * even);
        dp_os_memory_free(memory);
    }
    dp_os_memory_free(NULL);
}

int main(void)
{
    RUN(threads_start_meet_and_end);
    RUN(a_lock_lets_one_in_at_a_time);
    RUN(signals_wake_who_sleeps);
    RUN(time_and_memory);
    return check_done();
}
