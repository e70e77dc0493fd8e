// base/number.h - numbers that people choose, as their room declares them once; and what is wrong with one.
//
// A room lists the numbers of a record as lines X(name, unit, low, high, usual, meaning). Its members, its table, its
// default and its check follow from the list, and so do panels, files, bindings and sentences.
#pragma once
#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"

typedef struct DpNumber
{
    const char* name;
    const char* unit;       // "m", "1/s", "-" ..
    double      low, high;  // low <= value <= high
    double      usual;      // where to start from
    const char* meaning;    // half a line
    size_t      offset;     // of the member in its record
    size_t      size;       // of a float or of a double
} DpNumber;

// A row of the table of `Record`, from its line.
#define DP_NUMBER_ROW(Record, name, unit, low, high, usual, meaning) \
    {#name, unit, low, high, usual, meaning, offsetof(Record, name), sizeof(((Record*)0)->name)},

// The member of a record, from its line.
#define DP_FLOAT_MEMBER(name, ...) float name;
#define DP_DOUBLE_MEMBER(name, ...) double name;

double dp_number_get(const void* record, const DpNumber* number);
void   dp_number_set(void* record, const DpNumber* number, double value);

// Is a value within its range, at the precision of its member? NaN is not.
bool dp_number_holds(const DpNumber* number, double value);

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

// All numbers of a record as they usually are, and whether each is within its range: else DP_BAD_ARGUMENT, and which
// one it is, if `reason` is there.
void     dp_numbers_usual(void* record, const DpNumber* table, int count);
DpStatus dp_numbers_check(const void* record, const DpNumber* table, int count, DpReason* reason);
