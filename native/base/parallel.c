#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#define MOST_WORKERS 64

typedef struct Shared
{
    DpWork     work;
    void*      context;
    int        count;
    atomic_int next;
} Shared;

typedef struct Worker
{
    Shared*   shared;
    int       index;
    pthread_t thread;
} Worker;

static void* run(void* argument)
{
    Worker* worker = argument;
    Shared* shared = worker->shared;
    for (;;) {
        const int index = atomic_fetch_add(&shared->next, 1);
        if (index >= shared->count) return NULL;
        shared->work(shared->context, index, worker->index);
    }
}

void dp_parallel_for(int count, int workers, DpWork work, void* context)
{
    if (workers > count) workers = count;
    if (workers > MOST_WORKERS) workers = MOST_WORKERS;
    Shared shared = {work, context, count, 0};
    Worker team[MOST_WORKERS];
    int    started = 1;
    for (int w = 0; w < (workers < 1 ? 1 : workers); ++w) team[w] = (Worker){&shared, w, 0};
    while (started < workers &&
           pthread_create(&team[started].thread, NULL, run, &team[started]) == 0)
        ++started;
    run(&team[0]);
    for (int w = 1; w < started; ++w) pthread_join(team[w].thread, NULL);
}

int dp_parallel_width(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > MOST_WORKERS ? MOST_WORKERS : (int)online;
}
