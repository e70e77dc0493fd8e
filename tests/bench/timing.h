// tests/bench/timing.h - what a timing is read from, and where it is kept.
#pragma once
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

// Seconds since some moment. With BENCH_CLOCK=processor those in which this program's threads ran: they
// hardly depend on what else the machine does.
static inline double bench_now(void)
{
    const char*     wanted = getenv("BENCH_CLOCK");
    const clockid_t clock =
        wanted && strcmp(wanted, "processor") == 0 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// How often, or for how long, a program does what it times: the number it was started with, or `usual`.
static inline int bench_count(int words, char** word, int usual)
{
    const int count = words > 1 ? atoi(word[1]) : 0;
    return count > 0 ? count : usual;
}

// Add one timing to the file that BENCH_KEEP names: `bench,what,seconds`. Without it: nothing.
// @param what  the same from run to run; its commas are left out
static inline void bench_keep(const char* bench, const char* what, double seconds)
{
    const char* path = getenv("BENCH_KEEP");
    FILE*       file = path ? fopen(path, "a") : NULL;
    if (!file) return;
    fprintf(file, "%s,", bench);
    for (; *what; ++what)
        if (*what != ',') fputc(*what, file);
    fprintf(file, ",%.9g\n", seconds);
    fclose(file);
}
