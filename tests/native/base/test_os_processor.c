// tests of os_processor.c: functions with a wider build are asked for where the processor has AVX2 and the system keeps
// its registers, and nowhere else
#include "check.h"

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#include <cpuid.h>

static unsigned kept_registers(void)
{
    unsigned low, high;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

// as Intel's manual says: leaf 1 has OSXSAVE (bit 27) and AVX (bit 28) in ecx, leaf 7 AVX2 (bit 5) in ebx, and the
// system saves the registers of SSE and AVX (bits 1, 2)
static int has_avx2(void)
{
    unsigned a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c >> 27 & 1) || !(c >> 28 & 1)) return 0;
    if ((kept_registers() & 6u) != 6u || !__get_cpuid_count(7, 0, &a, &b, &c, &d)) return 0;
    return (int)(b >> 5 & 1);
}

TEST(wide_builds_are_those_of_the_processor)
{
    for (int n = 0; n < 2; ++n) {  // asked for twice it says the same
        __builtin_cpu_init();
        CHECK(!__builtin_cpu_supports("avx2") == !has_avx2());
    }
}
#else
TEST(wide_builds_are_those_of_the_processor)
{
}
#endif

int main(void)
{
    RUN(wide_builds_are_those_of_the_processor);
    return check_done();
}
