// base/number.h - a number that people choose, as its room declares it once; and what is wrong with one.
#pragma once

// Panels, files, bindings and checks read it from here.
typedef struct DpNumber
{
    const char* name;
    const char* unit;       // "m", "1/s", "-" ..
    double      low, high;  // low <= value <= high
    double      usual;      // where to start from
    const char* meaning;    // half a line
} DpNumber;

// Is a value within its range, as floats are? NaN is not.
static inline int dp_number_holds(const DpNumber* number, float value)
{
    return value >= (float)number->low && value <= (float)number->high;
}

// Which argument cannot be worked with, and why: a clause for people, as "root 3 is not a number".
typedef struct DpReason
{
    char text[160];
} DpReason;

// As printf does; NULL = nobody asked.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void dp_reason(DpReason* reason, const char* format, ...);
