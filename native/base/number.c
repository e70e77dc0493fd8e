#include "base/number.h"

#include <stdarg.h>
#include <stdio.h>

void dp_reason(DpReason* reason, const char* format, ...)
{
    va_list words;
    if (!reason) return;
    va_start(words, format);
    vsnprintf(reason->text, sizeof reason->text, format, words);
    va_end(words);
}
