// python/py_place.c - Simulation.place: feet put on the ground the simulation holds. TRAIL (1) (2)
#include "python/py_inside.h"

#define NUMBERS 5  // reach, toe_slope, foot_radius, body_radius, floor

PyObject* dp_py_place(PyObject* object, PyObject* args)
{
    Simulation* self = (Simulation*)object;
    PyObject *  o_gait, *o_numbers, *o_clearance, *o_pose, *o_com;
    int         walker, flat, carry;
    if (!PyArg_ParseTuple(args, "OippOOOO:place", &o_gait, &walker, &flat, &carry, &o_numbers,
                          &o_clearance, &o_pose, &o_com))
        return NULL;
    DpBuffers buffers = {.count = 0};
    DpGait    gait = {0};
    PyObject* result = NULL;
    if (dp_py_gait(&buffers, o_gait, &gait) < 0) goto done;
    const double* number =
        dp_buffers_open(&buffers, o_numbers, "numbers", 'd', DP_SHAPE1(NUMBERS), false);
    if (!number || dp_buffers_finite(number, NUMBERS, "numbers") < 0) goto done;
    const double* clearance =
        dp_buffers_open(&buffers, o_clearance, "clearance", 'd', DP_SHAPE1(gait.points), false);
    if (!clearance || dp_buffers_finite(clearance, gait.points, "clearance") < 0) goto done;
    double* pose =
        dp_buffers_open(&buffers, o_pose, "pose", 'd', DP_SHAPE3(gait.parts, gait.times, 7), true);
    if (!pose) goto done;
    double* com =
        dp_buffers_open(&buffers, o_com, "com", 'd', DP_SHAPE3(gait.walkers, gait.times, 3), true);
    if (!com || !dp_py_enter(self)) goto done;
    const DpPlaceOptions options = {.max_clearance = number[0],
                                    .toe_slope = number[1],
                                    .foot_radius = number[2],
                                    .body_radius = number[3],
                                    .flat = flat != 0,
                                    .carry = carry != 0,
                                    .floor = number[4]};
    DpStatus             status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_sim_place(self->terrain, &gait, walker, &options, clearance, pose, com);
    Py_END_ALLOW_THREADS
    self->busy = false;
    result = dp_py_result(status, "placing feet");
done:
    dp_buffers_close(&buffers);
    return result;
}
