// python/py_paths.c - when walkers arrive from where, and the ways they go.
#include "base/alloc.h"
#include "paths/paths.h"
#include "python/buffers.h"

// a field of float32 (ny, nx); false with an exception
static bool open_field(DpBuffers* buffers, PyObject* object, const char* name, double cell,
                       DpPathField* field)
{
    DpShape      shape = {2, {-1, -1}};
    const float* value = dp_buffers_open(buffers, object, name, 'f', &shape, false);
    if (!value) return false;
    if (shape.n[0] > INT32_MAX || shape.n[1] > INT32_MAX) {
        PyErr_Format(PyExc_ValueError, "%s: too many rows or columns", name);
        return false;
    }
    *field = (DpPathField){(int)shape.n[1], (int)shape.n[0], cell, value};
    return true;
}

static PyObject* arrival(PyObject* module, PyObject* arguments)
{
    PyObject *costs, *goals, *starts, *times;
    double    cell;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OdOOO:arrival", &costs, &cell, &goals, &starts, &times))
        return NULL;
    DpBuffers      buffers = {0};
    PyObject*      answer = NULL;
    DpPathField    cost;
    DpShape        goal_shape = {1, {-1}};
    const int32_t* goal = NULL;
    const float*   start = NULL;
    float*         time = NULL;
    if (!open_field(&buffers, costs, "cost", cell, &cost)) goto done;
    goal = dp_buffers_open(&buffers, goals, "goals", 'i', &goal_shape, false);
    if (goal)
        start = dp_buffers_open(&buffers, starts, "starts", 'f', DP_SHAPE1(goal_shape.n[0]), false);
    if (start)
        time = dp_buffers_open(&buffers, times, "time", 'f', DP_SHAPE2(cost.ny, cost.nx), true);
    if (time) {
        DpStatus status = DP_BAD_ARGUMENT;
        if (goal_shape.n[0] <= INT32_MAX) {
            const DpGoals to = {(int)goal_shape.n[0], goal, start};
            Py_BEGIN_ALLOW_THREADS
            status = dp_paths_arrival(time, &cost, &to);
            Py_END_ALLOW_THREADS
        }
        answer = dp_py_result(status, "arrival times");
    }
done:
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* direction(PyObject* module, PyObject* arguments)
{
    PyObject *times, *directions;
    double    cell;
    (void)module;
    if (!PyArg_ParseTuple(arguments, "OdO:direction", &times, &cell, &directions)) return NULL;
    DpBuffers   buffers = {0};
    PyObject*   answer = NULL;
    DpPathField time;
    float*      out = NULL;
    if (open_field(&buffers, times, "time", cell, &time))
        out = dp_buffers_open(&buffers, directions, "direction", 'f',
                              DP_SHAPE3(time.ny, time.nx, 2), true);
    if (out) {
        DpStatus status;
        Py_BEGIN_ALLOW_THREADS
        status = dp_paths_direction(out, &time);
        Py_END_ALLOW_THREADS
        answer = dp_py_result(status, "directions of arrival times");
    }
    dp_buffers_close(&buffers);
    return answer;
}

static PyObject* descend(PyObject* module, PyObject* arguments)
{
    PyObject *times, *pulls, *turns;
    double    cell, x, y, step;
    DpStray   stray = {0};
    if (!PyArg_ParseTuple(arguments, "OdOdddOd:descend", &times, &cell, &pulls, &x, &y, &step,
                          &turns, &stray.inertia))
        return NULL;
    DpBuffers    buffers = {0};
    PyObject*    answer = NULL;
    DpPathField  time;
    const float* pull = NULL;
    if (!open_field(&buffers, times, "time", cell, &time)) goto done;
    if (pulls != Py_None) {
        pull = dp_buffers_open(&buffers, pulls, "pull", 'f', DP_SHAPE3(time.ny, time.nx, 2), false);
        if (!pull) goto done;
    }
    if (turns != Py_None) {
        DpShape shape = {1, {-1}};
        stray.turn = dp_buffers_open(&buffers, turns, "turn", 'f', &shape, false);
        if (!stray.turn) goto done;
        stray.count = (int)(shape.n[0] < INT32_MAX ? shape.n[0] : INT32_MAX);
    }
    DpPath   path = {0};
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_paths_descend(&path, &time, pull, x, y, step, &stray);
    Py_END_ALLOW_THREADS
    answer = status == DP_OK
                 ? dp_py_block(module, path.point, 2 * (size_t)path.count * sizeof *path.point)
                 : dp_py_result(status, "a path to a goal");
done:
    dp_buffers_close(&buffers);
    return answer;
}

PyMethodDef dp_py_paths_methods[] = {
    {"arrival", arrival, METH_VARARGS,
     "arrival(cost, cell, goals, starts, time)\n--\n\n"
     "When a wave arrives that starts at the goals, see paths/paths.h: cost float32 (ny, nx), "
     "cell\n"
     "[m], goals int32 (g,) as j nx + i, starts float32 (g,); written to time float32 (ny, nx)."},
    {"direction", direction, METH_VARARGS,
     "direction(time, cell, direction)\n--\n\n"
     "Where times float32 (ny, nx) fall steepest; written to direction float32 (ny, nx, 2)."},
    {"descend", descend, METH_VARARGS,
     "descend(time, cell, pull, x, y, step, turn, inertia)\n--\n\n"
     "A path from (x, y) [m] down times float32 (ny, nx), pulled by float32 (ny, nx, 2) or None;\n"
     "steps err by turn float32 (n,) [rad] or None, and keep their heading over inertia [m].\n"
     "Returns a Block of float64 (n, 2) [m]."},
    {NULL, NULL, 0, NULL}};
