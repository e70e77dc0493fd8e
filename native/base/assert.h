// base/assert.h - what must hold inside, once the doors have checked what comes in.
#pragma once
#ifdef DP_CHECKED  // on in every test build
#include <stdio.h>
#include <stdlib.h>
#define DP_ASSERT(holds)                                                           \
    do {                                                                           \
        if (!(holds)) {                                                            \
            fprintf(stderr, "%s:%d: must hold: %s\n", __FILE__, __LINE__, #holds); \
            abort();                                                               \
        }                                                                          \
    } while (0)
#else
#define DP_ASSERT(holds) ((void)0)
#endif
