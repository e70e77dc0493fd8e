// base/os_inside_windows.h - what the files of Windows share.
#pragma once
#include "base/os.h"

// What an error of the system is called here; `otherwise`, where it is none of the disk's.
DpStatus dp_status_of(unsigned long error, DpStatus otherwise);

// CreateFileW for a path of any length, shared with all; what stands where CREATE_NEW is asked for goes.
DpStatus dp_open_as(const char* path, unsigned long access, unsigned long how, unsigned long flags,
                    DpFile* file);
