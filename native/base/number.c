#include "base/number.h"

#include <stdarg.h>
#include <stdio.h>

double dp_number_get(const void* record, const DpNumber* number)
{
    const void* member = (const char*)record + number->offset;
    return number->size == sizeof(float) ? (double)*(const float*)member : *(const double*)member;
}

void dp_number_set(void* record, const DpNumber* number, double value)
{
    void* member = (char*)record + number->offset;
    if (number->size == sizeof(float))
        *(float*)member = (float)value;
    else
        *(double*)member = value;
}

bool dp_number_holds(const DpNumber* number, double value)
{
    if (number->size == sizeof(float))
        return (float)value >= (float)number->low && (float)value <= (float)number->high;
    return value >= number->low && value <= number->high;
}

void dp_reason(DpReason* reason, const char* format, ...)
{
    va_list words;
    if (!reason) return;
    va_start(words, format);
    vsnprintf(reason->text, sizeof reason->text, format, words);
    va_end(words);
}

void dp_numbers_usual(void* record, const DpNumber* table, int count)
{
    for (int k = 0; k < count; ++k) dp_number_set(record, &table[k], table[k].usual);
}

DpStatus dp_numbers_check(const void* record, const DpNumber* table, int count, DpReason* reason)
{
    for (int k = 0; k < count; ++k) {
        const double value = dp_number_get(record, &table[k]);
        if (dp_number_holds(&table[k], value)) continue;
        dp_reason(reason, "%s of %g %s is out of its range, %g to %g", table[k].name, value,
                  table[k].unit, table[k].low, table[k].high);
        return DP_BAD_ARGUMENT;
    }
    return DP_OK;
}
