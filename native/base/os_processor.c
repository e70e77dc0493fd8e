// base/os_processor.c - which instructions the processor has, as functions with a wider build (DP_CLONES) ask for it
// where the compiler brings no answer of its own: the names and places below are those of GCC's and Clang's libraries.
#include <stdint.h>  // declares something on every machine

#include "base/wide.h"

#if defined(DP_CPU_MODEL) && defined(__x86_64__)
#include <cpuid.h>

#define AVX2_PLACE 10  // among the features [bit]

// Only the first word of features is asked for here, and of it the place of AVX2.
struct CpuModel
{
    unsigned vendor, type, subtype, features[1];
};
extern struct CpuModel __cpu_model;
int                    __cpu_indicator_init(void);

__attribute__((visibility("hidden"))) struct CpuModel __cpu_model;

// whether the system keeps the wide registers of every thread
static int keeps_wide(void)
{
    unsigned low, high;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return (low & 6u) == 6u;
}

__attribute__((visibility("hidden"))) int __cpu_indicator_init(void)
{
    unsigned a, b, c, d;
    if (__cpu_model.vendor) return 0;
    unsigned found = 0;
    if (__get_cpuid(1, &a, &b, &c, &d) && (c & bit_OSXSAVE) && (c & bit_AVX) && keeps_wide() &&
        __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & bit_AVX2))
        found = 1u << AVX2_PLACE;
    __cpu_model.features[0] = found;
    __cpu_model.vendor = 3;  // another one; also says that this is done
    return 0;
}
#endif
