// python/py_place.c - Simulation.place: feet put on the ground the simulation holds. TRAIL (1) (2)
#include "python/numbers.h"
#include "python/py_inside.h"
#include "walker/walker.h"

static int read_options(PyObject* numbers, DpPlaceOptions* options)
{
    int             count;
    DpReason        reason;
    const DpNumber* table = dp_place_numbers(&count);
    if (dp_py_read_numbers(numbers, "numbers", table, count, options) < 0) return -1;
    if (dp_place_options_check(options, &reason) == DP_OK) return 0;
    PyErr_Format(PyExc_ValueError, "numbers: %s", reason.text);
    return -1;
}

PyObject* dp_py_place(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  o_gait, *o_numbers, *o_clearance, *o_pose, *o_com;
    int         walker, flat, carry;
    if (!PyArg_ParseTuple(args, "OippOOOO:place", &o_gait, &walker, &flat, &carry, &o_numbers,
                          &o_clearance, &o_pose, &o_com))
        return NULL;
    DpBuffers      buffers = {.count = 0};
    DpGait         gait = {0};
    PyObject*      result = NULL;
    DpPlaceOptions options = dp_place_options_default();
    options.flat = flat != 0, options.carry = carry != 0;
    if (dp_py_gait(&buffers, o_gait, &gait) < 0) goto done;
    if (read_options(o_numbers, &options) < 0) goto done;
    const double* clearance =
        dp_buffers_open(&buffers, o_clearance, "clearance", 'd', DP_SHAPE1(gait.points), false);
    if (!clearance || dp_buffers_finite(clearance, gait.points, "clearance") < 0) goto done;
    double* pose =
        dp_buffers_open(&buffers, o_pose, "pose", 'd', DP_SHAPE3(gait.parts, gait.times, 7), true);
    if (!pose) goto done;
    double* com =
        dp_buffers_open(&buffers, o_com, "com", 'd', DP_SHAPE3(gait.walkers, gait.times, 3), true);
    if (!com || !dp_py_enter(self)) goto done;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_place(self->terrain, &gait, walker, &options, clearance, pose, com);
    Py_END_ALLOW_THREADS
    self->busy = false;
    result = dp_py_because(status, "placing feet",
                           "walker must be one of the gait, whose poses are turns, and whose "
                           "parts, limbs and walkers are there");
done:
    dp_buffers_close(&buffers);
    return result;
}
