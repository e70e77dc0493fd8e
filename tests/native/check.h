// tests/native/check.h - what a C test needs: named tests, checks that tell what they saw, a closing
// line `N passed, N failed`, and no byte left behind.
//
//   TEST(keeps_volume) { CHECK_NEAR(after, before, 1e-6); }
//   int main(void) { RUN(keeps_volume); return check_done(); }
#pragma once
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"

static int check_passed, check_failed, check_bad;

#define TEST(name) static void test_##name(void)

#define CHECK(holds)                                                            \
    do {                                                                        \
        if (!(holds)) {                                                         \
            printf("  %s:%d: does not hold: %s\n", __FILE__, __LINE__, #holds); \
            check_bad = 1;                                                      \
        }                                                                       \
    } while (0)

// |got - want| <= slack, absolute
#define CHECK_NEAR(got, want, slack)                                                          \
    do {                                                                                      \
        const double got_ = (double)(got), want_ = (double)(want), slack_ = (double)(slack);  \
        if (!(fabs(got_ - want_) <= slack_)) {                                                \
            printf("  %s:%d: %s is %.9g, not %.9g +- %.3g\n", __FILE__, __LINE__, #got, got_, \
                   want_, slack_);                                                            \
            check_bad = 1;                                                                    \
        }                                                                                     \
    } while (0)

// |got - want| <= share * |want|
#define CHECK_CLOSE(got, want, share) CHECK_NEAR(got, want, (share)*fabs((double)(want)))

#define RUN(name)                                                                                  \
    do {                                                                                           \
        check_bad = 0;                                                                             \
        const size_t before_ = dp_bytes_live();                                                    \
        test_##name();                                                                             \
        if (dp_bytes_live() != before_) {                                                          \
            printf("  %s: %ld bytes left behind\n", #name, (long)dp_bytes_live() - (long)before_); \
            check_bad = 1;                                                                         \
        }                                                                                          \
        if (check_bad)                                                                             \
            ++check_failed;                                                                        \
        else                                                                                       \
            ++check_passed;                                                                        \
        printf("%s %s\n", check_bad ? "FAIL" : "ok  ", #name);                                     \
    } while (0)

static inline int check_done(void)
{
    printf("%d passed, %d failed\n", check_passed, check_failed);
    return check_failed != 0;
}

// The same numbers on every machine: uniform in 0..1.
static inline double check_random(unsigned* state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 16777216.0;
}
