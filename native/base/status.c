#include "base/status.h"

const char* dp_status_text(DpStatus status)
{
    switch (status) {
        case DP_OK:
            return "all is well";
        case DP_BAD_ARGUMENT:
            return "a size, range or value cannot be worked with";
        case DP_NO_MEMORY:
            return "the machine has no more memory";
        case DP_NO_GROUND:
            return "there is no ground where it is asked for";
        case DP_CANNOT_OPEN:
            return "the file cannot be opened or created";
        case DP_CANNOT_WRITE:
            return "the file cannot be written";
        case DP_DISK_FULL:
            return "the disk is full";
        case DP_BAD_FILE:
            return "the file is damaged or of another kind";
        case DP_BAD_PACKING:
            return "the file's packing is unknown";
    }
    return "unknown status";
}
