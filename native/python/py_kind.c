// python/py_kind.c - kinds of plant: their numbers, and what the core says of one kind alone.
//
//   plants_default() -> (form, sheets, numbers ..)
//   plants_numbers() -> ((name, unit, low, high, of Carex pensylvanica, meaning), ..)
//   plants_shape(kind) -> (rows, stems, stems of a sheet, particles, bends)
//   plants_wear(kind, reserve, strength, angle, dt) -> strength
//   plants_regrow(kind, alpha, seconds) -> alpha
//
// kind: a dict of its form, its sheets and plants_numbers by name.
#include <math.h>

#include "python/numbers.h"
#include "python/py_inside.h"

#define BEFORE_NUMBERS 2  // of a kind: its form, its sheets

// one of two whole numbers; anything else is -1 with an exception
static int one_of(PyObject* value, const char* name, int low)
{
    const double given = value ? PyFloat_AsDouble(value) : (double)low;
    if (PyErr_Occurred()) return -1;
    if (given == (double)low || given == (double)low + 1.0) return (int)given;
    PyErr_Format(PyExc_ValueError, "kind: %s is neither %d nor %d", name, low, low + 1);
    return -1;
}

static int read_kind(PyObject* form, PyObject* sheets, PyObject* numbers, DpPlantKind* kind)
{
    int             count;
    const DpNumber* table = dp_plant_numbers(&count);
    DpReason        reason;
    *kind = dp_plant_kind_default();
    if ((kind->form = one_of(form, "form", DP_PLANT_SURFACE)) < 0) return -1;
    if ((kind->sheets = one_of(sheets, "sheets", 2)) < 0) return -1;
    if (dp_py_read_numbers(numbers, "kind", table, count, kind) < 0) return -1;
    if (dp_plant_kind_check(kind, &reason) == DP_OK) return 0;
    PyErr_Format(PyExc_ValueError, "kind: %s", reason.text);
    return -1;
}

int dp_py_kind(PyObject* object, DpPlantKind* kind)
{
    PyObject *form = NULL, *sheets = NULL, *numbers = NULL;
    int       read = -1, all;
    dp_plant_numbers(&all);
    all += BEFORE_NUMBERS;
    if (PyDict_Check(object)) {
        form = PyDict_GetItemString(object, "form"),
        sheets = PyDict_GetItemString(object, "sheets");
        Py_XINCREF(form), Py_XINCREF(sheets);
        numbers = PyDict_Copy(object);
        if (!numbers || (form && PyDict_DelItemString(numbers, "form") < 0) ||
            (sheets && PyDict_DelItemString(numbers, "sheets") < 0))
            goto done;
    } else if (!(form = PySequence_GetItem(object, 0)) ||
               !(sheets = PySequence_GetItem(object, 1)) ||
               !(numbers = PySequence_GetSlice(object, BEFORE_NUMBERS, PY_SSIZE_T_MAX)) ||
               PySequence_Size(object) != all) {
        PyErr_SetString(PyExc_TypeError, "kind: not a dict by name");
        goto done;
    }
    read = read_kind(form, sheets, numbers, kind);
done:
    Py_XDECREF(form), Py_XDECREF(sheets), Py_XDECREF(numbers);
    return read;
}

static PyObject* plants_numbers(PyObject* module, PyObject* none)
{
    (void)module, (void)none;
    int             count;
    const DpNumber* table = dp_plant_numbers(&count);
    return dp_py_numbers(table, count);
}

static PyObject* plants_default(PyObject* module, PyObject* none)
{
    (void)module, (void)none;
    int             count;
    const DpNumber* number = dp_plant_numbers(&count);
    DpPlantKind     kind = dp_plant_kind_default();
    PyObject*       list = PyTuple_New(BEFORE_NUMBERS + count);
    for (int k = 0; list && k < BEFORE_NUMBERS + count; ++k) {
        const int form = k == 0 ? kind.form : kind.sheets, n = k - BEFORE_NUMBERS;
        PyObject* one =
            n < 0 ? PyLong_FromLong(form) : PyFloat_FromDouble(dp_number_get(&kind, &number[n]));
        if (!one || PyTuple_SetItem(list, k, one) < 0) Py_CLEAR(list);
    }
    return list;
}

static PyObject* plants_shape(PyObject* module, PyObject* object)
{
    (void)module;
    DpBuffers   buffers = {0};
    DpPlantKind kind;
    PyObject*   answer = NULL;
    if (dp_py_kind(object, &kind) == 0) {
        const DpPlantShape s = dp_plant_shape(&kind);
        answer = Py_BuildValue("(iiiii)", s.rows, s.stems, s.stems_a_sheet, s.particles, s.bends);
    }
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* plants_wear(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *  object, *answer = NULL;
    double      reserve, strength, angle, dt;
    DpBuffers   buffers = {0};
    DpPlantKind kind;
    if (!PyArg_ParseTuple(arguments, "Odddd:plants_wear", &object, &reserve, &strength, &angle,
                          &dt))
        return NULL;
    if (dp_py_kind(object, &kind) == 0) {
        if (!(reserve > 0.0) || !(strength >= 0.0) || !isfinite(angle) || !(dt >= 0.0))
            PyErr_SetString(PyExc_ValueError,
                            "reserve, strength, angle, dt: one is out of its range");
        else
            answer = PyFloat_FromDouble(dp_plant_wear(&kind, reserve, strength, angle, dt));
    }
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* plants_regrow(PyObject* module, PyObject* arguments)
{
    (void)module;
    PyObject *  object, *answer = NULL;
    double      alpha, seconds;
    DpBuffers   buffers = {0};
    DpPlantKind kind;
    if (!PyArg_ParseTuple(arguments, "Odd:plants_regrow", &object, &alpha, &seconds)) return NULL;
    if (dp_py_kind(object, &kind) == 0) {
        if (!(alpha >= 0.0 && alpha <= 1.0) || !(seconds >= 0.0))
            PyErr_SetString(PyExc_ValueError, "alpha must be 0 to 1, seconds 0 or more");
        else
            answer = PyFloat_FromDouble(dp_plant_regrow(&kind, alpha, seconds));
    }
    dp_buffers_close(&buffers);
    return answer;
}

PyMethodDef dp_py_kind_methods[] = {
    {"plants_default", plants_default, METH_NOARGS,
     "plants_default() -> form, sheets and numbers of Carex pensylvanica, TRAIL Table 1."},
    {"plants_numbers", plants_numbers, METH_NOARGS,
     "plants_numbers() -> ((name, unit, low, high, of Carex pensylvanica, meaning), ..)\n\n"
     "The numbers of a kind of plant, in the order in which the core reads them."},
    {"plants_shape", plants_shape, METH_O,
     "plants_shape(kind) -> (rows, stems, stems of a sheet, particles, bends)."},
    {"plants_wear", plants_wear, METH_VARARGS,
     "plants_wear(kind, reserve, strength, angle, dt) -> strength of a bend held at angle. TRAIL "
     "(6)"},
    {"plants_regrow", plants_regrow, METH_VARARGS,
     "plants_regrow(kind, alpha, seconds) -> share of cover after so long without walkers."},
    {NULL, NULL, 0, NULL}};
