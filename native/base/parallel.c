#include "base/parallel.h"

#include <stdatomic.h>
#include <stdbool.h>

#include "base/os.h"

#define MAX_WORKERS 64
#define PATIENCE 100000  // who waits looks again and again for so long before it sleeps [ns]
#define LOOKS 64         // between two looks at the clock

// One loop. Its caller works at it, too, and takes it from the list before it waits for the others:
// so a loop within a loop, or one that no helper has time for, is done by its caller alone.
typedef struct Job
{
    DpWork      work;
    void*       context;
    int         count;
    atomic_int  next;
    int         workers, joined;  // wanted; who came, the caller first
    atomic_int  inside;           // helpers at work
    struct Job* after;
} Job;

// Helpers stay once they are started and sleep between loops: to start a thread for each loop of a
// step costs more than many a loop does. To wake one costs as much as a short loop, so they fall
// asleep late: loops of a step follow each other closely.
static DpLock      door = DP_LOCK_READY;  // of all below, and of a job's last line
static DpSignal    called = DP_SIGNAL_READY, finished = DP_SIGNAL_READY;
static Job*        jobs;
static atomic_uint posted;  // jobs so far
static int         helpers;
static DpThread    helper[MAX_WORKERS];

static void pause_briefly(void)
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

// look for a while whether a job has come since `seen`, or, with a job, whether all have left it
static void look_out(unsigned seen, Job* job)
{
    const int64_t until = dp_os_time() + PATIENCE;
    do {
        for (int look = 0; look < LOOKS; ++look) {
            if (job ? atomic_load(&job->inside) == 0 : atomic_load(&posted) != seen) return;
            pause_briefly();
        }
    } while (dp_os_time() < until);
}

static void work_at(Job* job, int worker)
{
    for (;;) {
        const int index = atomic_fetch_add(&job->next, 1);
        if (index >= job->count) return;
        job->work(job->context, index, worker);
    }
}

static void help(void* unused)
{
    (void)unused;
    dp_lock_take(&door);
    for (;;) {
        Job* job = jobs;
        while (job && job->joined >= job->workers) job = job->after;
        if (!job) {
            const unsigned seen = atomic_load(&posted);
            dp_lock_give(&door);
            look_out(seen, NULL);
            dp_lock_take(&door);
            if (atomic_load(&posted) == seen) dp_signal_wait(&called, &door);
            continue;
        }
        const int worker = job->joined++;
        atomic_fetch_add(&job->inside, 1);
        dp_lock_give(&door);
        work_at(job, worker);
        dp_lock_take(&door);
        if (atomic_fetch_sub(&job->inside, 1) == 1) dp_signal_all(&finished);
    }
}

// a process that was forked has none of the helpers
static void forget_helpers(void)
{
    dp_lock_create(&door);
    dp_signal_create(&called), dp_signal_create(&finished);
    jobs = NULL, helpers = 0;
}

static bool start_helper(void)
{
    dp_forks_watch(forget_helpers);
    if (!dp_thread_start(&helper[helpers], help, NULL)) return false;
    dp_thread_leave(&helper[helpers]);
    return true;
}

void dp_parallel_for(int count, int workers, DpWork work, void* context)
{
    if (workers > count) workers = count;
    if (workers > MAX_WORKERS) workers = MAX_WORKERS;
    Job job = {.work = work, .context = context, .count = count, .workers = workers, .joined = 1};
    if (workers <= 1) {
        work_at(&job, 0);
        return;
    }
    dp_lock_take(&door);
    while (helpers < workers - 1 && start_helper()) ++helpers;
    job.after = jobs, jobs = &job;
    atomic_fetch_add(&posted, 1);
    for (int w = 1; w < workers; ++w) dp_signal_one(&called);
    dp_lock_give(&door);
    work_at(&job, 0);
    dp_lock_take(&door);
    Job** link = &jobs;
    while (*link != &job) link = &(*link)->after;
    *link = job.after;
    dp_lock_give(&door);
    look_out(0, &job);
    if (atomic_load(&job.inside) == 0) return;
    dp_lock_take(&door);
    while (atomic_load(&job.inside) > 0) dp_signal_wait(&finished, &door);
    dp_lock_give(&door);
}

int dp_parallel_width(void)
{
    const int there = dp_os_processors();
    return there > MAX_WORKERS ? MAX_WORKERS : there;
}
