#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <time.h>
#include <unistd.h>

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
static pthread_mutex_t door = PTHREAD_MUTEX_INITIALIZER;  // of all below, and of a job's last line
static pthread_cond_t  called = PTHREAD_COND_INITIALIZER, finished = PTHREAD_COND_INITIALIZER;
static Job*            jobs;
static atomic_uint     posted;  // jobs so far
static int             helpers;
static pthread_once_t  forks = PTHREAD_ONCE_INIT;

static long now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (long)t.tv_sec * 1000000000L + t.tv_nsec;
}

static void pause_briefly(void)
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

// look for a while whether a job has come since `seen`, or, with a job, whether all have left it
static void look_out(unsigned seen, Job* job)
{
    const long until = now() + PATIENCE;
    do {
        for (int look = 0; look < LOOKS; ++look) {
            if (job ? atomic_load(&job->inside) == 0 : atomic_load(&posted) != seen) return;
            pause_briefly();
        }
    } while (now() < until);
}

static void work_at(Job* job, int worker)
{
    for (;;) {
        const int index = atomic_fetch_add(&job->next, 1);
        if (index >= job->count) return;
        job->work(job->context, index, worker);
    }
}

static void* help(void* unused)
{
    pthread_mutex_lock(&door);
    for (;;) {
        Job* job = jobs;
        while (job && job->joined >= job->workers) job = job->after;
        if (!job) {
            const unsigned seen = atomic_load(&posted);
            pthread_mutex_unlock(&door);
            look_out(seen, NULL);
            pthread_mutex_lock(&door);
            if (atomic_load(&posted) == seen) pthread_cond_wait(&called, &door);
            continue;
        }
        const int worker = job->joined++;
        atomic_fetch_add(&job->inside, 1);
        pthread_mutex_unlock(&door);
        work_at(job, worker);
        pthread_mutex_lock(&door);
        if (atomic_fetch_sub(&job->inside, 1) == 1) pthread_cond_broadcast(&finished);
    }
    return unused;
}

// a process that was forked has none of the helpers
static void forget_helpers(void)
{
    pthread_mutex_init(&door, NULL);
    pthread_cond_init(&called, NULL), pthread_cond_init(&finished, NULL);
    jobs = NULL, helpers = 0;
}

static void watch_forks(void)
{
    pthread_atfork(NULL, NULL, forget_helpers);
}

static bool start_helper(void)
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, help, NULL) != 0) return false;
    pthread_detach(thread);
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
    pthread_once(&forks, watch_forks);
    pthread_mutex_lock(&door);
    while (helpers < workers - 1 && start_helper()) ++helpers;
    job.after = jobs, jobs = &job;
    atomic_fetch_add(&posted, 1);
    for (int w = 1; w < workers; ++w) pthread_cond_signal(&called);
    pthread_mutex_unlock(&door);
    work_at(&job, 0);
    pthread_mutex_lock(&door);
    Job** link = &jobs;
    while (*link != &job) link = &(*link)->after;
    *link = job.after;
    pthread_mutex_unlock(&door);
    look_out(0, &job);
    if (atomic_load(&job.inside) == 0) return;
    pthread_mutex_lock(&door);
    while (atomic_load(&job.inside) > 0) pthread_cond_wait(&finished, &door);
    pthread_mutex_unlock(&door);
}

int dp_parallel_width(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > MAX_WORKERS ? MAX_WORKERS : (int)online;
}
