// base/status.h - how a function says what went wrong.
#pragma once

typedef enum DpStatus
{
    DP_OK = 0,
    DP_BAD_ARGUMENT,  // a size, range or pointer that cannot be worked with
    DP_NO_MEMORY,     // the machine has no more memory
    DP_NO_GROUND,     // there is no ground where it is asked for
    DP_CANNOT_OPEN,   // a file cannot be opened or created
    DP_CANNOT_WRITE,  // a file cannot be written whole; the old one is untouched
    DP_DISK_FULL,     // no space left; the old file is untouched
    DP_BAD_FILE,      // a file is damaged or of another kind
    DP_BAD_PACKING,   // a file is packed in a way that is not known here
} DpStatus;

// One lower-case clause for people, no full stop. Never NULL.
const char* dp_status_text(DpStatus status);
