// python/py_spray.c - what sticks to soles and flies: its numbers, and the grains in the air. MODEL 6.15
#include "python/numbers.h"
#include "python/py_inside.h"

PyObject* dp_py_spray(PyObject* object, PyObject* dict)
{
    Simulation*     self = (Simulation*)object;
    int             count;
    const DpNumber* table = dp_spray_numbers(&count);
    DpSprayNumbers  numbers;
    DpReason        reason;
    dp_numbers_usual(&numbers, table, count);
    if (dp_py_read_numbers(dict, "spray", table, count, &numbers) < 0) return NULL;
    if (dp_spray_check(&numbers, &reason) != DP_OK)
        return PyErr_Format(PyExc_ValueError, "spray: %s", reason.text);
    if (!dp_py_enter(self)) return NULL;
    const DpStatus status = dp_sim_spray(self->sim, &numbers);
    self->busy = false;
    return dp_py_because(status, "beginning a spray", "it begins once, before the first step");
}

int dp_py_add_spray(PyObject* numbers, const DpSimReport* report)
{
    PyObject* spray =
        Py_BuildValue("{s:d,s:d,s:d,s:d}", "thrown_m3", report->thrown, "stuck_m3", report->stuck,
                      "airborne_m3", report->airborne, "beside_m3", report->beside);
    const int added = spray ? PyDict_Update(numbers, spray) : -1;
    Py_XDECREF(spray);
    return added;
}

PyObject* dp_py_grains(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    (void)unused;
    return PyLong_FromLong(dp_sim_grains(self->sim));
}

PyObject* dp_py_read_grains(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  at_object, *velocity_object, *soil_object, *name_object, *result = NULL;
    if (!PyArg_ParseTuple(args, "OOOO:read_grains", &at_object, &velocity_object, &soil_object,
                          &name_object))
        return NULL;
    DpBuffers        buffers = {.count = 0};
    DpShape          shape = {2, {-1, 3}};
    double*          at = dp_buffers_open(&buffers, at_object, "position", 'd', &shape, true);
    const Py_ssize_t n = shape.n[0];
    double*          velocity =
        at ? dp_buffers_open(&buffers, velocity_object, "velocity", 'd', DP_SHAPE2(n, 3), true)
                    : NULL;
    int32_t* soil =
        velocity ? dp_buffers_open(&buffers, soil_object, "soil", 'i', DP_SHAPE1(n), true) : NULL;
    int32_t* name =
        soil ? dp_buffers_open(&buffers, name_object, "name", 'i', DP_SHAPE1(n), true) : NULL;
    if (name && dp_py_enter(self)) {
        const bool fits = n == dp_sim_grains(self->sim);
        for (Py_ssize_t k = 0; fits && k < n; ++k) {
            const DpGrain grain = dp_sim_grain(self->sim, (int)k);
            at[3 * k] = grain.at.x, at[3 * k + 1] = grain.at.y, at[3 * k + 2] = grain.at.z;
            velocity[3 * k] = grain.velocity.x, velocity[3 * k + 1] = grain.velocity.y;
            velocity[3 * k + 2] = grain.velocity.z;
            soil[k] = grain.kind, name[k] = (int32_t)grain.name;
        }
        self->busy = false;
        result = dp_py_because(fits ? DP_OK : DP_BAD_ARGUMENT, "reading what flies",
                               "give room for as many grains as grains() tells");
    }
    dp_buffers_close(&buffers);
    return result;
}

static PyObject* spray_numbers(PyObject* module, PyObject* none)
{
    (void)module, (void)none;
    int             count;
    const DpNumber* table = dp_spray_numbers(&count);
    return dp_py_numbers(table, count);
}

PyMethodDef dp_py_spray_methods[] = {
    {"spray_numbers", spray_numbers, METH_NOARGS,
     "spray_numbers() -> ((name, unit, low, high, usual, meaning), ..)\n\n"
     "The numbers of a spray, in the order in which the core reads them."},
    {NULL, NULL, 0, NULL}};
