// tests/native/spray/usual.h - the numbers of a spray as they come.
#pragma once
#include "spray/spray.h"

static inline DpSprayNumbers usual(void)
{
    DpSprayNumbers  numbers;
    int             count;
    const DpNumber* table = dp_spray_numbers(&count);
    dp_numbers_usual(&numbers, table, count);
    return numbers;
}
