#include "python/numbers.h"

#include <string.h>

PyObject* dp_py_numbers(const DpNumber* table, int count)
{
    PyObject* rows = PyTuple_New(count);
    for (int k = 0; rows && k < count; ++k, ++table) {
        PyObject* row = Py_BuildValue("(ssddds)", table->name, table->unit, table->low, table->high,
                                      table->usual, table->meaning);
        if (!row || PyTuple_SetItem(rows, k, row) < 0) Py_CLEAR(rows);
    }
    return rows;
}

// value is borrowed; NULL = it could not be had
static int read_one(PyObject* value, const char* what, const DpNumber* number, void* record)
{
    if (!value) return -1;
    const double given = PyFloat_AsDouble(value);
    if (PyErr_Occurred()) {
        if (PyErr_ExceptionMatches(PyExc_TypeError))
            PyErr_Format(PyExc_TypeError, "%s: %s is no number", what, number->name);
        return -1;
    }
    dp_number_set(record, number, given);
    return 0;
}

// a name in the dict that the table lacks
static int say_unknown(PyObject* dict, const char* what, const DpNumber* table, int count)
{
    PyObject * name, *value;
    Py_ssize_t at = 0;
    while (PyDict_Next(dict, &at, &name, &value)) {
        bool known = false;
        for (int k = 0; k < count && !known; ++k)
            known =
                PyUnicode_Check(name) && PyUnicode_CompareWithASCIIString(name, table[k].name) == 0;
        if (!known)
            return PyErr_Format(PyExc_ValueError, "%s: it has no number %R", what, name), -1;
    }
    return 0;
}

static int read_dict(PyObject* dict, const char* what, const DpNumber* table, int count,
                     void* record)
{
    Py_ssize_t known = 0;
    for (int k = 0; k < count; ++k) {
        PyObject* value = PyDict_GetItemString(dict, table[k].name);  // borrowed
        if (!value) continue;
        if (read_one(value, what, &table[k], record) < 0) return -1;
        ++known;
    }
    return known == PyDict_Size(dict) ? 0 : say_unknown(dict, what, table, count);
}

int dp_py_read_numbers(PyObject* object, const char* what, const DpNumber* table, int count,
                       void* record)
{
    if (PyDict_Check(object)) return read_dict(object, what, table, count, record);
    if (!PySequence_Check(object) || PySequence_Size(object) != count) {
        PyErr_Format(PyExc_TypeError, "%s: not a dict of numbers by name", what);
        return -1;
    }
    if (PyErr_WarnFormat(
            PyExc_DeprecationWarning, 1,
            "%s: numbers in a row are an old way to give them: give a dict of them by name",
            what) < 0)
        return -1;
    for (int k = 0; k < count; ++k) {
        PyObject* value = PySequence_GetItem(object, k);
        const int read = read_one(value, what, &table[k], record);
        Py_XDECREF(value);
        if (read < 0) return -1;
    }
    return 0;
}
