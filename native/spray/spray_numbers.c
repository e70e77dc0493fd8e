// spray/spray_numbers.c - the numbers of a spray, and what one grain of it holds.
#include "spray/spray.h"

#define NUMBER(...) DP_NUMBER_ROW(DpSprayNumbers, __VA_ARGS__)
static const DpNumber numbers_of[] = {DP_SPRAY_NUMBERS(NUMBER)};
#define COUNT ((int)(sizeof numbers_of / sizeof *numbers_of))

const DpNumber* dp_spray_numbers(int* count)
{
    *count = COUNT;
    return numbers_of;
}

DpStatus dp_spray_check(const DpSprayNumbers* numbers, DpReason* reason)
{
    if (dp_numbers_check(numbers, numbers_of, COUNT, reason) != DP_OK) return DP_BAD_ARGUMENT;
    if (numbers->slow_speed < numbers->fast_speed) return DP_OK;
    dp_reason(reason, "slow_speed of %g m/s is not below fast_speed, %g m/s", numbers->slow_speed,
              numbers->fast_speed);
    return DP_BAD_ARGUMENT;
}

double dp_spray_volume(const DpSprayNumbers* numbers)
{
    const double size = numbers->particle_size;
    return DP_PI / 6.0 * size * size * size;
}
