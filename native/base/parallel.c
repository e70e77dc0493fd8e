#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <unistd.h>

#define MOST_WORKERS 64

// One loop. Its caller works at it, too, and takes it from the list before it waits for the others:
// so a loop within a loop, or one that no helper has time for, is done by its caller alone.
typedef struct Job
{
    DpWork      work;
    void*       context;
    int         count;
    atomic_int  next;
    int         workers, joined, inside;  // wanted; who came, the caller first; helpers at work
    struct Job* after;
} Job;

// Helpers stay once they are started and sleep between loops: to start a thread for each loop of a
// step costs more than many a loop does.
static pthread_mutex_t door = PTHREAD_MUTEX_INITIALIZER;  // of all below, and of a job's last line
static pthread_cond_t  called = PTHREAD_COND_INITIALIZER, finished = PTHREAD_COND_INITIALIZER;
static Job*            jobs;
static int             helpers;
static pthread_once_t  forks = PTHREAD_ONCE_INIT;

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
            pthread_cond_wait(&called, &door);
            continue;
        }
        const int worker = job->joined++;
        ++job->inside;
        pthread_mutex_unlock(&door);
        work_at(job, worker);
        pthread_mutex_lock(&door);
        if (--job->inside == 0) pthread_cond_broadcast(&finished);
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
    if (workers > MOST_WORKERS) workers = MOST_WORKERS;
    Job job = {.work = work, .context = context, .count = count, .workers = workers, .joined = 1};
    if (workers <= 1) {
        work_at(&job, 0);
        return;
    }
    pthread_once(&forks, watch_forks);
    pthread_mutex_lock(&door);
    while (helpers < workers - 1 && start_helper()) ++helpers;
    job.after = jobs, jobs = &job;
    for (int w = 1; w < workers; ++w) pthread_cond_signal(&called);
    pthread_mutex_unlock(&door);
    work_at(&job, 0);
    pthread_mutex_lock(&door);
    Job** link = &jobs;
    while (*link != &job) link = &(*link)->after;
    *link = job.after;
    while (job.inside > 0) pthread_cond_wait(&finished, &door);
    pthread_mutex_unlock(&door);
}

int dp_parallel_width(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > MOST_WORKERS ? MOST_WORKERS : (int)online;
}
