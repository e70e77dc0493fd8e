// python/numbers.h - records of numbers that people choose, base/number.h, as Python gives and reads them.
#pragma once
#include "base/number.h"
#include "python/buffers.h"

// The table: ((name, unit, low, high, usual, meaning), ..).
PyObject* dp_py_numbers(const DpNumber* table, int count);

// Put what `object` holds into the record, a dict of some numbers by name; those it does not name stay as
// they are. A sequence of all in the order of the table is read too, with a DeprecationWarning. 0, or -1 with an exception that names `what` and the number. Ranges
// are the room's to check.
int dp_py_read_numbers(PyObject* object, const char* what, const DpNumber* table, int count,
                       void* record);
