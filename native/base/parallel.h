// base/parallel.h - one loop over things that do not touch each other.
#pragma once
#include "base/status.h"

// Work on item `index`; `worker` is 0 .. workers-1, for scratch memory of one's own.
typedef void (*DpWork)(void* context, int index, int worker);

// Call work for every index in 0 .. count-1, on up to `workers` threads; returns when all are done.
// Items are handed out in any order, so no item may read what another writes: then the result is
// the same for any number of workers. workers <= 1, or a machine that gives no threads: a plain loop.
void dp_parallel_for(int count, int workers, DpWork work, void* context);

// How many threads this machine runs at once, >= 1.
int dp_parallel_width(void);
